"""The objects of a notebook: recordings, cases and results, and the functions that lead from one to the next.

The command line does the same work on files. Nothing here writes a file unless it is asked to.
"""
