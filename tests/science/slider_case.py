"""A slider with backlash as a case, recorded by another integrator, for tests of commands."""

import numpy as np
from independent import Machine, recording

CASE = """
title = "Slider with backlash"

[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }

[model]
name = "lin_backlash"
known = { m = 1.0, k0 = 40000.0, k1 = 0.0 }

[model.estimate]
c = { low = 0.8, high = 80.0, scale = "log" }
x0 = { low = 5e-4, high = 5e-2, scale = "log" }
"""


def case_in(folder, friction, case=CASE):
    """Return a case with a recording of 25 periods at 100 samples, 1 % noise, made by another integrator."""
    made = recording(Machine(coulomb=friction), periods=25, per_period=100, seed=7)
    rows = np.column_stack([made.time, made.force, made.position])
    np.savetxt(folder / "recording.csv", rows, delimiter=",", header="time,force,position", comments="", fmt="%.9g")
    (folder / "case.toml").write_text(case, encoding="utf-8")
    return folder / "case.toml"
