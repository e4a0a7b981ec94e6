"""Lets the tests of this folder import its fixtures, integrators of tests/science, and `toys` of tests/framework."""

import sys
from pathlib import Path

for folder in ("framework", "science", "chaos"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))
