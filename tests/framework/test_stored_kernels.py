"""Compiled code is found again in another copy of a package, and not after a change in any of its kernels."""

import os
import subprocess
import sys

import pytest

from lostmotion.kernels.stored import compute_address
from lostmotion.likelihood import compose
from lostmotion.likelihood.system import System
from lostmotion.registry import default

INNER = "import numba\n@numba.njit\ndef twice(x):\n    return {factor} * x\n"
OUTER = """
from lostmotion.kernels.stored import stored
from doubler._kernels_inner import twice
@stored(nogil=True)
def double(x):
    return twice(x)
"""
RUN = "from doubler._kernels import double; print(double(3.0), sum(double.stats.cache_hits.values()))"


@pytest.fixture
def copy(tmp_path):
    """Return a function that runs a copy of a package, and returns its result and how often its code was found."""

    def run(name, factor=2.0):
        package = tmp_path / name / "doubler"
        package.mkdir(parents=True)
        (package / "__init__.py").touch()
        (package / "_kernels_inner.py").write_text(INNER.format(factor=factor))
        (package / "_kernels.py").write_text(OUTER)
        env = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
        env |= {
            "LOSTMOTION_CACHE": str(tmp_path / "cache"),
            "PYTHONPATH": os.pathsep.join([str(package.parent), *sys.path]),
        }
        done = subprocess.run([sys.executable, "-c", RUN], env=env, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return tuple(map(float, done.stdout.split()))

    return run


def test_another_copy_compiles_nothing_and_a_change_of_an_inlined_function_is_noticed(copy):
    assert copy("first") == (6.0, 0.0)
    assert copy("second") == (6.0, 1.0)
    assert copy("changed", factor=5.0) == (15.0, 0.0)


def test_the_address_is_that_of_the_sources_and_not_of_their_place(tmp_path):
    for name in ("one", "other"):
        (tmp_path / name / "kernels").mkdir(parents=True)
        (tmp_path / name / "kernels" / "loops.py").write_text("A = 1\n")
    one, other = (compute_address.__wrapped__(tmp_path / name, tmp_path / name) for name in ("one", "other"))
    assert one == other
    (tmp_path / "other" / "kernels" / "loops.py").write_text("A = 2\n")
    assert compute_address.__wrapped__(tmp_path / "other", tmp_path / "other") != one


def test_laws_are_compiled_anew_after_a_change_of_the_lanes(monkeypatch, tmp_path):
    """Code for blocks with rows of 32 points is wrong for others: the name of the file changes with their source."""
    monkeypatch.setenv("LOSTMOTION_CACHE", str(tmp_path))
    registry = default()
    friction = registry.load("term", "coulomb_friction")(at="ground")
    law = System(registry.make("model", "linear_oscillator"), (friction,)).blueprint.laws[0]
    kept = compose.compile_law.__wrapped__(law, 1)
    monkeypatch.setattr(compose, "read_source", lambda *names: "STRIDE = 16")
    other = compose.compile_law.__wrapped__(law, 1)
    assert kept[1].fndesc.modname != other[1].fndesc.modname
