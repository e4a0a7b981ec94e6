"""Readers of further formats, each on a library of its own that is an extra of the package; offered by the hook."""
