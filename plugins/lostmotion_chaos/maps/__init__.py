"""Maps: quantities of a model over its parameters, computed cell by cell, stored in chunks, and interpolated."""
