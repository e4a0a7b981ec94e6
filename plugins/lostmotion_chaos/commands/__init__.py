"""The commands `analyse` and `map`."""
