"""lostmotion finds the physics that a machine model leaves out."""

__version__ = "0.1.0"
