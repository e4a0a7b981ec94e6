"""Forces that a model file cannot express, as a Python file with a callback of MuJoCo."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from lostmotion.simulators import FoundMechanism

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

def apply(model, data):
    """Add the forces to the passive ones; MuJoCo calls this function in each step."""
    unit, moved = np.zeros((1, model.nv)), np.zeros((1, model.nv))
    for joint, law, values, needs in FORCES:
        dof, at = model.joint(joint).dofadr[0], model.joint(joint).qposadr[0]
        unit[:] = 0.0
        unit[0, dof] = 1.0
        mujoco.mj_solveM(model, data, moved, unit)
        step, inertia = model.opt.timestep, 1.0 / moved[0, dof]
        known = {"mobility": step / inertia, "inertia": inertia, "step": step, "finest": step, "angle": 1.0}
        p = (*values, *(known[name] for name in needs))
        data.qfrc_passive[dof] += law(data.time, data.qpos[at], data.qvel[dof], (), p, ())
'''


def write_callback(found: Sequence[FoundMechanism]) -> str:
    """Return the Python file of laws; empty without any."""
    if not found:
        return ""
    laws = "\n\n".join(dict.fromkeys(one.law for one in found))
    rows = "".join(_write_row(one) for one in found)
    meaning = '"""The joint, the law, its parameters (SI), and what it needs of the machine."""'
    return f"{HEAD}{laws}\n\nFORCES = (\n{rows})\n{meaning}\n{FOOT}"


def _write_row(one: FoundMechanism) -> str:
    values = ", ".join(repr(float(x)) for x in one.values.values())
    says = " ".join(one.says.split())  # a name in a file may have a line break, which would end the comment
    return f"    # {says}\n    ({one.at!r}, {one.mechanism}, ({values},), {one.needs!r}),\n"


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
