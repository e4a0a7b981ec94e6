"""What all pages share: the frame and its style sheet, the look of figures, and numbers as a reader meets them."""
