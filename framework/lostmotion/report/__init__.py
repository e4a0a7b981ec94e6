"""The common parts of all pages: frame, style sheet, style of figures, and formatting of numbers."""
