"""Lets the tests of this folder import `independent`, and `made_facts` of tests/framework: importlib mode does not."""

import sys
from pathlib import Path

for folder in ("framework", "science"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))
