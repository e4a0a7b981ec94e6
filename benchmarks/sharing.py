"""How often recordings that differ in nothing but their level seem to: `python benchmarks/sharing.py`.

Sets of three recordings at levels of 1, 2 and 4, of which the noise of the force is as large as the drive and has a
memory or none; the least p-value over two parameters, corrected for their number. It takes about a minute.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "science"))

from several import least

SETS = 100

if __name__ == "__main__":
    for memory in (0.0, 0.6, 0.9):
        p = np.array([least(number, memory) for number in range(SETS)])
        print(f"memory {memory}: of {SETS} sets {np.sum(p < 0.05)} have p < 0.05, {np.sum(p < 0.01)} p < 0.01")
