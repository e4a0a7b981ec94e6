"""A model under a periodic drive as a stroboscopic map, with its tangent vectors."""
