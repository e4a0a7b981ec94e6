"""Compiled loops: the k-d tree and nearest neighbours, and the stroboscopic map with tangent vectors."""
