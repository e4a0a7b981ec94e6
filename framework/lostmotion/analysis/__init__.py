"""The chaos laboratory: from a recording to what kind of motion it is, step by step, and the page."""
