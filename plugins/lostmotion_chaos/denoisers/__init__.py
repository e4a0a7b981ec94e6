"""The built-in denoisers."""
