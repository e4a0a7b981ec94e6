"""Lets the tests of this folder `import independent`, the integrator of tests/science that shares nothing with ours."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "science"))
