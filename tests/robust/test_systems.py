"""What only the family of Unix has is not needed: the same work is done with it taken away, in a path with spaces."""

from __future__ import annotations

import subprocess
import sys

SCRIPT = """
import os, sys
for name in ("fcntl", "resource"):
    sys.modules[name] = None
for name in ("getuid", "getgid", "fork"):
    if hasattr(os, name):
        delattr(os, name)
import numpy as np
from scipy.integrate import solve_ivp
import lostmotion as lm

t = np.arange(900) / 60.0
force = lambda s: 5.0 * np.sin(7.0 * s) + 4.0 * np.sin(11.3 * s + 1.0)
rates = lambda s, y: [y[1], (force(s) - 2.0 * y[1] - 90.0 * y[0] - 1.5 * np.tanh(y[1] / 1e-4)) / 1.0]
x = solve_ivp(rates, (0.0, t[-1]), [0.0, 0.0], "LSODA", t_eval=t, rtol=1e-8, atol=1e-10, max_step=2e-3).y[0]
noise = 2e-4 * np.random.default_rng(0).standard_normal(t.size)
recording = lm.Recording.from_arrays(
    t, inputs={"force": force(t)}, sensors={"position": x + noise}, units={"force": "N", "position": "m"}
)
priors = {"c": lm.LogUniform(0.1, 50.0), "k": lm.LogUniform(5.0, 900.0)}
case = lm.Case(recording, "linear_oscillator", {"m": 1.0}, priors)
path = case.write("a folder with spaces")
found = lm.diagnose(path, terms=["coulomb_friction", "offset_force"], progress=False, out="the result of it")
print(found.found[0].mechanism, lm.load("the result of it").verdict)
few = {"periods": 20, "transient": 5, "starts": 1, "jobs": 1}
table = lm.map("lin_backlash", "a map.zarr", axes="alpha=0.3:0.4:2", sets=("zeta=0.05",), **few)
print(table.sizes["alpha"])
"""


def test_a_diagnosis_and_a_map_without_what_only_unix_has(tmp_path):
    place = tmp_path / "my machine, run 1"
    place.mkdir()
    done = subprocess.run([sys.executable, "-c", SCRIPT], cwd=place, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == ["coulomb_friction mismatch", "2"]
    assert (place / "the result of it" / "report.html").is_file()
