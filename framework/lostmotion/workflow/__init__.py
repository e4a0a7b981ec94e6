"""Whole tasks, each from its input to the files it writes; the command line is a thin door to these."""
