"""A machine set in motion: a model with terms, parameters by name, and a drive."""
