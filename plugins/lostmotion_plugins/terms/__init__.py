"""Pieces of physics that a model may lack, each under the name that a diagnosis uses for it."""
