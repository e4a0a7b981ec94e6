"""The figures of the page of validation, from the stored results in `benchmarks/results`."""

from __future__ import annotations

import sys
from pathlib import Path

BENCHMARKS = Path(__file__).resolve().parents[2] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

from validation_figures import FIGURES  # noqa: E402 - after the path to the benchmarks

SOURCES = sorted((BENCHMARKS / "results").glob("*.json"))
"""Files that the figures depend on."""


def draw(part):
    """Return the figure of this name."""
    return FIGURES[part]()
