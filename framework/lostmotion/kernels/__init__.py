"""Compiled loops: numbers in lanes, the filter through a model, free motion, the smoother, neighbours.

Nothing here knows of models or plugins: `lostmotion.likelihood` writes their functions into one and hands it over.
"""
