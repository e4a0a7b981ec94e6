"""Nonlinear time series analysis: from a recording to the kind of its motion, and the page."""
