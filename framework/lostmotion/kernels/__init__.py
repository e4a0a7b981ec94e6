"""Compiled loops: the composed kernel of a model and its terms, the filter through it, and the smoother.

Nothing here knows of models or plugins: `compose` is handed plain functions and returns compiled ones.
"""

from lostmotion.kernels.compose import Blueprint, Compiled, Law, Place, build
from lostmotion.kernels.smooth import smooth

__all__ = ["Blueprint", "Compiled", "Law", "Place", "build", "smooth"]
