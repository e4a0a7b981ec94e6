"""Forces that a model file cannot express, as a Python file with a callback of MuJoCo."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from lostmotion.simulators import RATE, FoundMechanism

HEAD = '''"""Forces at joints that arm_found.xml cannot express: a callback of MuJoCo, written by lostmotion.

    import mujoco
    import arm_found

    model = mujoco.MjModel.from_xml_path("arm_found.xml")
    mujoco.set_mjcb_passive(arm_found.apply)
"""

from __future__ import annotations

import math

import mujoco
import numpy as np


'''
FOOT = '''
BENT = {}
"""The inner state of each law that has one, and its time (s)."""


def follow(law, rate, t, x, v, p):
    """Return the inner state of a law at a time; it begins at zero, and again where time goes back."""
    before, state = BENT.get(law, (t, 0.0))
    change = np.zeros(1)
    rate(t, x, v, (), p, (state,), change)
    BENT[law] = (t, state + (t - before) * change[0]) if t >= before else (t, 0.0)
    return BENT[law][1]


def apply(model, data):
    """Add the forces to the passive ones; MuJoCo calls this function in each step."""
    unit, moved = np.zeros((1, model.nv)), np.zeros((1, model.nv))
    for joint, law, values, needs, rate in FORCES:
        dof, at = model.joint(joint).dofadr[0], model.joint(joint).qposadr[0]
        unit[:] = 0.0
        unit[0, dof] = 1.0
        mujoco.mj_solveM(model, data, moved, unit)
        step, inertia = model.opt.timestep, 1.0 / moved[0, dof]
        known = {"mobility": step / inertia, "inertia": inertia, "step": step, "finest": step, "angle": 1.0}
        p = (*values, *(known[name] for name in needs))
        t, x, v = data.time, data.qpos[at], data.qvel[dof]
        states = (follow((joint, law), rate, t, x, v, p),) if rate else ()
        data.qfrc_passive[dof] += law(t, x, v, (), p, states)
'''


def write_callback(found: Sequence[FoundMechanism]) -> str:
    """Return the Python file of laws; empty without any."""
    if not found:
        return ""
    laws = "\n\n".join(dict.fromkeys(text for one in found for text in (one.law, one.rate) if text))
    rows = "".join(_write_row(one) for one in found)
    meaning = '"""The joint, the law, its parameters (SI), what it needs of the machine, and the rate of its state."""'
    return f"{HEAD}{laws}\n\nFORCES = (\n{rows})\n{meaning}\n{FOOT}"


def _write_row(one: FoundMechanism) -> str:
    values = ", ".join(repr(float(x)) for x in one.values.values())
    rate = f"{one.mechanism}{RATE}" if one.rate else None
    says = " ".join(one.says.split())  # a name in a file may have a line break, which would end the comment
    return f"    # {says}\n    ({one.at!r}, {one.mechanism}, ({values},), {one.needs!r}, {rate}),\n"


@contextmanager
def calling(mujoco: Any, text: str) -> Iterator[None]:
    """Let MuJoCo call the function `apply` of a Python file within the context."""
    if not text:
        yield
        return
    made: dict[str, Any] = {}
    exec(compile(text, "arm_found.py", "exec"), made)  # noqa: S102 - our own text, of laws of loaded plugins
    mujoco.set_mjcb_passive(made["apply"])
    try:
        yield
    finally:
        mujoco.set_mjcb_passive(None)
