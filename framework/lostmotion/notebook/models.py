"""A model without a recording as Python functions: `lostmotion.model(...)` and `lostmotion.simulate(...)`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from lostmotion.arguments import checked, choice, list_texts, mapping, maybe, positive, share, text, words
from lostmotion.contracts import Machine
from lostmotion.notebook.argument_rules import KNOWN, RUN
from lostmotion.preparation.prepare import find_dynamics
from lostmotion.registry import Registry, default
from lostmotion.robots.arm_model import make_robot_model
from lostmotion.simulation import simulated_machine as _simulate
from lostmotion.written import is_equation, model_of


@checked(
    text=maybe(words),
    units=maybe(mapping(text, "{'k': 'N/m'}")),
    motion=maybe(choice("translation", "rotation")),
    params=words,
)
def model(text: str | Sequence[str] | None = None, **options: Any) -> Any:
    """Return a model by its name, one made from equations of motion, or the simulation of a robot.

    `lm.model("m*x'' + c*x' + k*x = force")`: `options` are fields of a model with a name, or `units` (SI, by
    parameter), `motion` and `params` for equations. `lm.model(mujoco="arm.xml", joints=["shoulder"], torque="motor")`,
    or `urdf=`, or `inverse=` a function of q, v, a, each (samples, joints), or "my_model.py:inverse": `joints` are
    those that move, `torque` is the side of the gear where it was measured, "motor" or "link", `tolerance` the share
    within which values of the model are known, `hold` "step" or "smooth". `lm.model(dynamics="my_arm.py:MyArm")` is a
    machine that is stepped, by its class in a file or its name. Raises `PluginError` for an unknown name and
    `CaseError` for what cannot be read.
    """
    if text is None and "dynamics" in options:
        name = find_dynamics(options.pop("dynamics"), Path(), default())
        return default().make("dynamics", name, **options)
    if text is None:
        return make_robot_model(**options)
    lines = (text,) if isinstance(text, str) else tuple(text)
    if len(lines) == 1 and not is_equation(lines[0]):
        found: Machine = default().make("model", lines[0], **options)
        return found
    cls: Any = model_of(lines, **options)
    made: Machine = cls()
    return made


@checked(
    **RUN,
    model=text,
    drives=words,
    motion=maybe(choice("translation", "rotation")),
    values=KNOWN,
    duration=positive,
    rate=positive,
    initial=maybe(KNOWN),
    noise=share,
)
def simulate(
    model: str,
    *,
    terms: str | Iterable[str] = (),
    drives: str | Iterable[str],
    motion: str | None = None,
    registry: Registry | None = None,
    out: str | Path | None = None,
    values: Mapping[str, float],
    duration: float,
    rate: float,
    initial: Mapping[str, float] | None = None,
    noise: float = 0.0,
    seed: int = 0,
) -> _simulate.SimulatedTable:
    """Return the table of a simulated machine, with columns (samples,) by name; `out` (.csv, .nc) is an optional file.

    `values` and `initial` are values of parameters and states by name, in SI units. `drives` are texts such as
    "harmonic:amplitude=1,frequency=2"; `duration` is in s and `rate` in Hz. `noise` is white, as a share of the
    standard deviation of each channel. `motion` ("translation", "rotation") selects one kind where a model allows both.
    """
    known = registry or default()
    assembly, own = _simulate.assembly_of(known, model, list_texts(terms), motion)
    used = [("model", model), *(("term", term.name) for term in assembly.terms)]
    every = {**own, **values}
    plan = _simulate.Plan(
        assembly, every, list_texts(drives), duration, rate, initial or {}, noise, seed, known.origins(*used)
    )
    table = _simulate.simulate(plan)
    if out is not None:
        table.save(Path(out))
    return table
