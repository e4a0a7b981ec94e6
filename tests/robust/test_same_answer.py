"""The same seed gives the same bytes, with any number of workers, forked or spawned; and answers do not drift."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import frozen
import numpy as np
import pytest

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def here() -> dict[str, list[float]]:
    """The answers of this process, on one core."""
    return frozen.answers(1)


def test_answers_have_not_changed(here: dict[str, list[float]]) -> None:
    """Tolerances: 1e-6 of the size of a position after a second of chaos (7 / s blows rounding up a thousandfold),
    1e-6 of a likelihood, three standard errors of an exponent, and none for whole numbers."""
    kept = json.loads((HERE / "frozen.json").read_text(encoding="utf-8"))
    assert here.keys() == kept.keys()
    np.testing.assert_allclose(here["position"], kept["position"], rtol=0, atol=1e-6 * np.ptp(kept["position"]))
    np.testing.assert_allclose(here["likelihood"], kept["likelihood"], rtol=1e-6)
    values, errors = np.split(np.array(kept["exponent"]), 2)
    np.testing.assert_array_less(np.abs(np.split(np.array(here["exponent"]), 2)[0] - values), 3.0 * errors)
    assert here["embedding"] == kept["embedding"]


@pytest.mark.slow
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_another_process_with_other_workers_gives_the_same_bytes(here: dict[str, list[float]], method: str) -> None:
    """A fresh interpreter starts the process: to fork one that has threads is to inherit their locks."""
    code = "import json, multiprocessing, frozen; ear, mouth = multiprocessing.Pipe(duplex=False); "
    code += f"child = multiprocessing.get_context({method!r}).Process(target=frozen.told, args=(mouth, 2)); "
    code += "child.start(); mouth.close(); print(json.dumps(ear.recv())); child.join()"
    assert _said(code) == here


@pytest.mark.slow
@pytest.mark.parametrize("seed", ["0", "4711"])
def test_neither_hashes_nor_the_cores_allowed_change_a_byte(here: dict[str, list[float]], seed: str) -> None:
    code = "import os; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}); import frozen, json; "
    code += "print(json.dumps(frozen.answers(2)))"
    assert _said(code, PYTHONHASHSEED=seed) == here


def _said(code: str, **more: str) -> dict[str, list[float]]:
    """Return what a fresh interpreter prints as JSON."""
    found = {**os.environ, "PYTHONPATH": str(HERE), **more}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=found, timeout=300, check=True
    )
    return dict(json.loads(done.stdout))
