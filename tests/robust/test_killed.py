"""SIGKILL at any moment leaves whole files, and what is started again ends with the same bytes.

`benchmarks/killed.py` does so to whole commands at fifty random moments; here are the parts they are made of, quickly.
Chains and campaigns have theirs in `tests/framework/test_keep.py` and `test_calibrate.py`.
"""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
WRITER = """
import sys; from pathlib import Path; import numpy as np
from lostmotion.storage import StoredArray, save_arrays, save_json
folder = Path(sys.argv[1])
for k in range(10**6):
    save_json(folder / "facts.json", {"k": k, "x": [k] * 5000})
    save_arrays(folder / "arrays.nc", {"x": StoredArray(("t",), np.full(5000, float(k)))}, {}, {"k": str(k)})
    print(k, flush=True)
"""


def test_files_are_whole_whenever_their_writer_is_killed(tmp_path: Path) -> None:
    rng, seen = np.random.default_rng(5), []
    for _ in range(2):
        child = subprocess.Popen([sys.executable, "-c", WRITER, str(tmp_path)], stdout=subprocess.PIPE, text=True)
        assert child.stdout is not None
        for _ in range(2):
            assert child.stdout.readline()
        time.sleep(float(rng.uniform(0.0, 0.05)))
        child.send_signal(signal.SIGKILL)
        child.communicate()
        facts = json.loads((tmp_path / "facts.json").read_text(encoding="utf-8"))
        assert facts["x"] == [facts["k"]] * 5000
        with h5py.File(tmp_path / "arrays.nc") as file:
            assert np.all(file["x"][...] == float(file.attrs["k"]))
        seen.append(facts["k"])
    assert max(seen) > 0
    assert len([p for p in tmp_path.iterdir() if p.name.startswith(".")]) <= 2


@pytest.mark.slow
@pytest.mark.parametrize("name", ["map", "identify"])
def test_a_command_that_was_killed_ends_with_the_same_bytes(name: str) -> None:
    line = [sys.executable, str(ROOT / "benchmarks" / "killed.py"), "--kills", "3", "--only", name, "--seed", "7"]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "3 kills" in done.stdout
