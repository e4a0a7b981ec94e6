"""The built-in surrogates."""
