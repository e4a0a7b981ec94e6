"""Lets the tests of this folder import `independent` of tests/science, an integrator that shares nothing with ours, and
`answers` of tests/framework.
"""

import sys
from pathlib import Path

for folder in ("science", "framework"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))
