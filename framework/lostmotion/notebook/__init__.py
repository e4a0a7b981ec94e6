"""The Python interface for notebooks: recordings, cases and results as objects, and the functions between them.

The command line does the same work on files. No function here writes a file unless this is requested.
"""
