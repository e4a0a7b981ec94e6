"""Simulation of a machine: a model with terms, parameters by name, and a drive."""
