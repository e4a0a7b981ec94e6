"""Integrators that simulate the machines of the trials and share no code with the framework."""
