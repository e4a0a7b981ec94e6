"""Integrators that share nothing with the framework: what moves the machines of the trials."""
