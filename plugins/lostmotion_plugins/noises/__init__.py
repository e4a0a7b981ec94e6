"""Measurement noise of sensors, each a small linear state-space block."""
