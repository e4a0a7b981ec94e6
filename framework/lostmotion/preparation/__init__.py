"""Preparation of the user's input for the stages: the case, its terms, and checks of third-party plugins."""
