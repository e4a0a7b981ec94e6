"""`pytest benchmarks` keeps what it measured in the folder .benchmarks, where `compare.py` finds it."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1] / "tests" / "framework")]


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    """Have pytest-benchmark save each run, at the top of the project, wherever it is started.

    It measures nothing where tests might be shared out, and our settings say how they would be.
    """
    if not getattr(config.option, "numprocesses", None):
        config.option.dist = "no"
    if hasattr(config.option, "benchmark_autosave"):
        config.option.benchmark_autosave = "speed"
        config.option.benchmark_storage = f"file://{Path(__file__).parents[1] / '.benchmarks'}"
