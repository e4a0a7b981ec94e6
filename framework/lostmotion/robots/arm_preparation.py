"""From a simulator and a log to a search: tape, first fit, a tape along the filtered path, discrepancy, candidates."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import Term
from lostmotion.errors import CaseError, DataError, nearest
from lostmotion.evidence.bare import Budget
from lostmotion.likelihood.sensors import measure_white_noise
from lostmotion.parts import Array
from lostmotion.robots.arm import TapedArm
from lostmotion.robots.arm_discrepancy import LARGE, SIZES, make_discrepancy, make_none
from lostmotion.robots.arm_effects import ArmCoordinate, ArmEffect, measure_scales
from lostmotion.robots.arm_hypothesis import ArmFrame, fit_hypothesis, list_base
from lostmotion.robots.arm_search import ArmSearch, Say
from lostmotion.robots.log import RobotLog
from lostmotion.robots.promises import list_effects, make_screen, relinearise
from lostmotion.robots.tape import Path, make_inertial_parts, make_part, make_shares, make_tape, smooth_path
from lostmotion.simulators import Simulator

FITTED = 0.7
"""The share of the log that is fitted; the rest is held out."""
FORCE = 0.02
"""The random force to start from, as a share of the torque."""
MOST_EFFECTS = 4
"""The largest number of effects in a set; with more than two joints, two for each."""
SECONDS = 1200.0
"""The processor time of a search (s)."""


@dataclass(frozen=True)
class SearchOptions:
    """How a search is done: the tolerance of known values, the most effects of a set, and its processor time (s).

    `asked` are the effects that are tried, by name or as NAME@PLACE; all, if empty. `jobs` is the number
    of threads.
    """

    tolerance: float = 0.02
    most: int = MOST_EFFECTS
    budget: float = SECONDS
    asked: tuple[str, ...] = ()
    jobs: int = 1


def make_arm(
    simulator: Simulator,
    log: RobotLog,
    side: str = "motor",
    *,
    known: Mapping[str, float] | None = None,
    parts: bool = True,
) -> TapedArm:
    """Return an arm along the smoothed recorded path, with other `known` values; without its `parts` for a check.

    Where the torque is that of the link, the motor with its armature, damping and friction is on the other side of the
    sensor, and these values are not part of the arm.
    """
    tape = make_tape(simulator, smooth_path(log.positions, log.dt))
    names = (*simulator.linear, *(f"{point}.payload" for point in simulator.points)) if parts else ()
    made = {name: make_part(simulator, name, tape) for name in names}
    taken = {**simulator.taken, **(known or {})}
    inertia = {joint: taken.get(f"{joint}.armature", 0.0) for joint in log.joints}
    if side == "link":
        lost = (".armature", ".damping", ".frictionloss")
        taken = {key: 0.0 if key.endswith(lost) else value for key, value in taken.items()}
    return TapedArm(log, tape, made, {**simulator.linear, **taken}, side, inertia)


def renew_tape(arm: TapedArm, simulator: Simulator, path: Path) -> TapedArm:
    """Return the arm with a tape along another path."""
    tape = make_tape(simulator, path)
    return replace(arm, tape=tape, parts={name: make_part(simulator, name, tape) for name in arm.parts}, _cache={})


def estimate_noise(readings: Array) -> Array:
    """Return the noise (sd) of each column of readings, from its fourth differences."""
    return np.maximum([measure_white_noise(column) for column in readings.T], 1e-9)


def prepare_search(
    arm: TapedArm,
    simulator: Simulator,
    terms: Iterable[Term],
    estimated: Mapping[str, ArmCoordinate],
    options: SearchOptions,
    say: Say = lambda _: None,
) -> tuple[ArmSearch, Array]:
    """Return a search, and the coordinates of the nominal fit to start it from."""
    last = int(FITTED * arm.log.samples)
    scales = measure_scales(arm)
    base = list_base(arm, [FORCE * s.force for s in scales], estimate_noise(arm.log.readings).tolist(), estimated)
    say("nominal model")
    path, at = _filter_path(arm, base, last)
    arm = renew_tape(arm, simulator, path)
    sizes = simulator.inertial
    inertial = {name: (part, sizes[name]) for name, part in make_inertial_parts(simulator, arm.tape).items()}
    if not (inertial or simulator.linear):
        inertial = {name: (part, 1.0) for name, part in make_shares(simulator, arm.tape).items()}
    usual, large = (
        make_discrepancy(arm, scales, options.tolerance, set(estimated), inertial, widths) for widths in (SIZES, LARGE)
    )
    plain = ArmFrame(arm, (), base, make_none(arm), last).run(at, keep=True)
    effects = _choose_effects(list_effects(arm, scales, terms, simulator.points, plain), options.asked)
    screen = make_screen(arm, effects, arm.tape.path.a)
    frame = ArmFrame(arm, (), base, usual, last)
    budget = Budget(seconds=options.budget)
    most = max(options.most, 2 * len(arm.joints)) if len(arm.joints) > 2 else options.most
    search = ArmSearch(frame, screen, large, arm.log.samples, most, budget, options.jobs, say)
    return search, np.concatenate([at, np.zeros(len(usual.columns))])


def _choose_effects(effects: Sequence[ArmEffect], asked: Sequence[str]) -> list[ArmEffect]:
    """Return the effects that are asked for by name or as NAME@PLACE, or all; raise `CaseError` for an unknown one."""
    names = {effect.key.partition("@")[0]: None for effect in effects} | {effect.key: None for effect in effects}
    for wanted in asked:
        if wanted not in names:
            short = [name for name in names if "@" not in name]
            raise CaseError(
                f"no mechanism {wanted!r} can act in this robot{nearest(wanted, names)}: there are {', '.join(short)}"
            )
    return [e for e in effects if not asked or {e.key, e.key.partition("@")[0]} & set(asked)]


def _filter_path(arm: TapedArm, base: Sequence[ArmCoordinate], last: int) -> tuple[Path, Array]:
    """Return the filtered path of the nominal model, and its fitted levels."""
    frame = ArmFrame(arm, (), tuple(base), make_none(arm), last)
    start = np.array([c.mean for c in base])
    # From a small random force alone, a fit does not reach the large one of a log that the model hardly explains.
    large = np.where(np.arange(len(start)) < len(arm.joints), start - math.log(FORCE), start)
    fitted = [one for one in (fit_hypothesis(frame, at, 0.0) for at in (start, large)) if one is not None]
    found = max(fitted, key=lambda one: one.log_evidence, default=None)
    if found is None:
        raise DataError(
            f"the nominal model diverges from the log {arm.log.name}: check signs, units and the order of the joints"
        )
    return relinearise(frame.run(found.at, last=arm.log.samples, keep=True), len(arm.joints)), found.at
