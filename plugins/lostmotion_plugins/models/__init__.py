"""Machines: the nominal models that a recording is held against."""
