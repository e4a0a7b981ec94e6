"""The built-in quantifiers."""
