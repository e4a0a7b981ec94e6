"""Compiled loops: arithmetic on vector lanes, the filter, free simulation, and the smoother.

Nothing in this package depends on models or plugins. `lostmotion.likelihood` writes the functions of models and terms
into source text, compiles it, and passes it to these kernels.
"""
