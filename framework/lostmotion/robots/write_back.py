"""The model with what was found in it, stepped by its own simulator: how much of the gain on held-out data stays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lostmotion.contracts import DriveTerm, Term
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.results.diagnosis import Mechanism
from lostmotion.results.robots import WrittenModel
from lostmotion.robots.arm_effects import LawEffect
from lostmotion.robots.arm_hypothesis import ArmHypothesis
from lostmotion.robots.arm_search import ArmSearch
from lostmotion.robots.free_runs import HORIZON
from lostmotion.robots.law_text import write_law, write_rate
from lostmotion.robots.refutation import ToldRuns
from lostmotion.simulators import FoundMechanism, Simulator

DRIVE = ".torque"
"""The end of the place of a mechanism of the drive: the torques of a run are given, so that it cannot be tried."""


def measure_written(
    best: ArmHypothesis,
    runs: ToldRuns,
    simulator: Simulator,
    found: Sequence[FoundMechanism],
    known: Mapping[str, float],
) -> WrittenModel | None:
    """Return how the written model predicts held-out data; None where it cannot be stepped, or nothing is written.

    The gain is that of the effects alone: neither the file nor the runs that it is compared with have the discrepancy.
    All runs begin at filtered states.
    """
    log = best.frame.arm.log
    if not found or simulator.step is None or best.frame.arm.side != "motor" or log.controlled:
        return None
    if any(one.at.endswith(DRIVE) for one in found):
        return None
    written = simulator.with_found(found, known)
    if written is None or written.step is None:
        return None
    first, length = best.frame.last, max(2, round(HORIZON / log.dt))
    begins = np.arange(first, log.samples - length, length)
    states = best.frame.run(best.at, last=log.samples, keep=True).states[begins]
    q, v = _place_states(best, states)
    tau = np.zeros((len(begins), length, q.shape[1]))
    tau[:, :, : len(log.joints)] = log.drive([], {})[np.add.outer(begins, np.arange(length))]
    rolled, _ = written.roll(q, v, tau, log.dt, step=written.step)
    places = [i for i, (_, order) in enumerate(log.picks) if order == 0]
    joints = [j for j, order in log.picks if order == 0]
    shown = np.full((log.samples - first, len(places)), np.nan)
    for begin, run in zip(begins - first, rolled, strict=True):
        shown[begin + 1 : begin + length] = run[:-1, joints]
    readings = log.readings[first:, places]
    nrmse = np.sqrt(np.nanmean((readings - shown) ** 2, axis=0)) / np.nanstd(readings, axis=0)
    before, after = (float(np.mean(one.nrmse)) for one in (runs.before_alone, runs.after_alone))
    error = float(np.mean(nrmse))
    return WrittenModel(before, after, error, (before - error) / max(before - after, 1e-300))


def _place_states(best: ArmHypothesis, states: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return positions and velocities (runs, joints) of motors, and then of links relative to their motors."""
    n, gears = len(best.frame.arm.joints), sorted(gear.joint for gear in best.frame.gears)
    found = []
    for order in (0, 1):
        links = states[:, order * n : (order + 1) * n]
        motors = links.copy()
        for place, j in enumerate(gears):
            motors[:, j] = states[:, 2 * n + 2 * place + order]
        found.append(np.concatenate([motors, (links - motors)[:, gears]], axis=1))
    return found[0], found[1]


def list_changes(found: Sequence[Mechanism], search: ArmSearch) -> tuple[FoundMechanism, ...]:
    """Return the named mechanisms for a simulator, which writes them into its own file."""
    laws = (e for e in search.screen.effects if isinstance(e, LawEffect) and not isinstance(e.term, DriveTerm))
    terms = {law.key: law.term for law in laws}
    return tuple(_make_change(m, terms.get(f"{m.mechanism}@{m.at}")) for m in found if m.mechanism != UNKNOWN)


def _make_change(m: Mechanism, law: Term | None) -> FoundMechanism:
    """Return a mechanism for a simulator; the parameters of a law are in its own order."""
    values = {name: x.median for name, x in m.parameters.items()}
    if law is None:
        return FoundMechanism(m.mechanism, m.at, values, m.says)
    ordered = {q.name: values[q.name] for q in law.params}
    return FoundMechanism(m.mechanism, m.at, ordered, m.says, write_law(law), law.needs, write_rate(law))
