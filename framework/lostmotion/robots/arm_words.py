"""The result of a search in words and numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Term
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.evidence.probabilities import compute_probabilities
from lostmotion.parts import Array
from lostmotion.quantities import name_force, unit_of
from lostmotion.results import Interval, attach_unit, percent
from lostmotion.results.diagnosis import Candidate, Confusion, Mechanism
from lostmotion.results.robots import Dependence, JointRow
from lostmotion.robots.arm import TapedArm
from lostmotion.robots.arm_effects import GAIN_ERROR, ArmCoordinate, ArmEffect, GearEffect, LawEffect, MassEffect
from lostmotion.robots.arm_hypothesis import ArmHypothesis
from lostmotion.robots.arm_search import NOTHING, ArmSearch, find_probabilities, simplify
from lostmotion.robots.free_runs import HeldOutRuns
from lostmotion.robots.tape import Path

SURE, LIKELY = 0.95, 0.5
"""The posterior probability above which an effect is named, and is told as likely."""
CLOSE = 3.0
"""A set whose score is within this distance of the best one cannot be told from it."""
BINS = 16


def find_place(effect: ArmEffect) -> str:
    """Return the place of an effect."""
    return effect.key.partition("@")[2]


def make_interval(found: ArmHypothesis, c: ArmCoordinate, motion: str) -> Interval:
    """Return median and 95 % interval of a coordinate."""
    index = [own.key for own in found.frame.own].index(c.key)
    middle, sd = float(found.at[index]), found.deviation(c.key)
    low, median, high = (c.value(middle + step * sd) for step in (-1.96, 0.0, 1.96))
    unit = c.dimension.unit(motion) if c.dimension is not None else "1"
    if c.key.endswith(".mass"):
        unit = "kg"
    return Interval(median, low, high, unit)


def describe_effect(
    found: ArmHypothesis, effect: ArmEffect, motions: Mapping[str, str]
) -> tuple[str, dict[str, Interval]]:
    """Return the finding in a sentence, and its parameters."""
    at = find_place(effect)
    motion = motions.get(at.partition(".")[0], "rotation")
    told = {c.key.rsplit(".", 1)[1]: make_interval(found, c, motion) for c in effect.coordinates}
    words = {name: attach_unit(f"{x.median:.4g}", x.unit) for name, x in told.items()}
    if isinstance(effect, GearEffect):
        return f"{effect.law.physics.format(**words)} (in the gear of {found.frame.arm.joints[effect.joint]}).", told
    if isinstance(effect, MassEffect):
        return _describe_mass(effect, told, motion, found.frame.arm.values.get(effect.value, 0.0))
    assert isinstance(effect, LawEffect)  # noqa: S101 - the three kinds of effects
    words |= _word_choices(effect.term, effect.fixed)
    where = f" at {effect.arm.joints[effect.joint]}"
    return f"{effect.term.physics.format(**words)}{where}.", told


def _describe_mass(
    effect: MassEffect, told: dict[str, Interval], motion: str, known: float
) -> tuple[str, dict[str, Interval]]:
    """Return the finding of a mass or of a moment of inertia, which the model has as `known`, and its parameters."""
    at = find_place(effect)
    if effect.name == "payload":
        return f"A mass of {told['mass'].median:.4g} kg is carried at {at}.", told
    of_joint = effect.value.endswith(".armature")
    change = told["change"] if of_joint else replace(told["change"], unit="kg")
    told, turns = {"change": change}, of_joint and motion == "rotation"
    size = attach_unit(f"{known + change.median:.4g}", change.unit)
    word = "moment of inertia" if turns else "mass"
    if known == 0.0:
        more = attach_unit(f"{abs(change.median):.4g}", change.unit)
        way = "larger" if change.median > 0.0 else "smaller"
        return f"The {word} that moves with {at} is {more} {way} than in the model.", told
    owner, inertia = (f"the motor of {at}", "") if of_joint else (at, " (with its inertia in proportion)")
    return f"The {word} of {owner} is {size}, not {attach_unit(f'{known:.4g}', change.unit)}{inertia}.", told


def _word_choices(term: Term, fixed: Mapping[str, float]) -> dict[str, str]:
    """Return the words of the parameters that are not fitted."""
    found = {}
    for q in term.params:
        if q.prior.choices:
            value = next(v for key, v in fixed.items() if key.endswith(f".{q.name}"))
            found[q.name] = q.prior.words[q.prior.choices.index(value)] if q.prior.words else f"{value:g}"
    return found


def find_told(search: ArmSearch) -> ArmHypothesis:
    """Return the hypothesis that the answer is about: that of the mechanisms which are more likely than not.

    Where these were not fitted together it is the best one, with each law in its simplest form that explains as much.
    """
    named = frozenset(key for key, share in find_probabilities(search).items() if share >= LIKELY)
    known = search.found.get(named - {NOTHING})
    return known if known is not None else search.found[simplify(search, search.best.terms)]


def list_findings(search: ArmSearch, told_of: ArmHypothesis, motions: Mapping[str, str]) -> tuple[Mechanism, ...]:
    """Return the mechanisms that are more likely than not: named ones first, and those that explain most.

    Their parameters are those of the hypothesis `told_of`, where it has them.
    """
    shares, found = find_probabilities(search), []
    arm, gains = search.frame.arm, []
    for key, share in shares.items():
        if share < LIKELY or key == NOTHING:
            continue
        state = "named" if share >= SURE else "likely"
        holders = [one for one in search.found.values() if key in one.terms]
        best = told_of if key in told_of.terms else max(holders, key=lambda one: one.score(search.temper))
        less = search.found.get(best.terms - {key})
        gains.append(best.score(search.temper) - less.score(search.temper) if less is not None else 0.0)
        if key == UNKNOWN:
            found.append(_describe_unknown(best, share, state, motions))
            continue
        effect = next(e for e in best.frame.effects if e.key == key)
        says, told = describe_effect(best, effect, motions)
        name, at = key.split("@")
        doubts = () if state == "named" else ("Other sets of mechanisms explain the log nearly as well.",)
        values = [(best.values[c.key], c) for c in effect.coordinates if c.key.endswith(f".{GAIN_ERROR}")]
        if any(not c.low < value < c.high for value, c in values):
            state, doubts = "likely", (*doubts, "The gain is at the end of the range that is tried.")
        drive = _measure_share(best, effect, arm)
        found.append(
            Mechanism(
                mechanism=name, at=at, probability=share, state=state, doubts=doubts, parameters=told,
                share_of_drive=drive, says=says,
            )
        )  # fmt: skip
    order = sorted(range(len(found)), key=lambda i: (found[i].state != "named", -gains[i]))
    return tuple(found[i] for i in order)


def _measure_share(found: ArmHypothesis, effect: ArmEffect, arm: TapedArm) -> float | None:
    """Return the amplitude of a force over the torque of its joint; None for an effect that is no force."""
    if not isinstance(effect, LawEffect):
        return None
    forces = [
        c for c in effect.coordinates if c.amplitude and c.dimension is not None and tuple(c.dimension[:3]) == (1, 0, 0)
    ]
    if not forces:
        return None
    size = math.sqrt(sum(found.values[c.key] ** 2 for c in forces))
    return size / max(float(np.std(arm.torque[:, effect.joint])), 1e-300)


def _describe_unknown(found: ArmHypothesis, share: float, state: str, motions: Mapping[str, str]) -> Mechanism:
    """Return a torque without a name: its joint, its size, and what it depends on."""
    sizes = measure_forces(found)
    joint = max(found.frame.arm.joints, key=lambda j: sum(v for (name, _), v in sizes.items() if name == j))
    over = sorted(((v, o) for (name, o), v in sizes.items() if name == joint), reverse=True)
    depends = tuple(o for v, o in over if v > 0.3 * over[0][0])
    word, unit = name_force(motions[joint]), unit_of("force", motions[joint])
    says = (
        f"A {word} of {over[0][0]:.3g} {unit} (rms) at {joint} that no mechanism of the library explains depends on"
        f" {' and '.join(depends)}."
    )
    return Mechanism(
        mechanism=UNKNOWN, at=joint, probability=share, state=state, depends_on=depends, parameters={}, says=says
    )


def measure_forces(found: ArmHypothesis) -> dict[tuple[str, str], float]:
    """Return the rms of each smooth force that is present, by joint and what it depends on (N m)."""
    frame = found.frame
    rest, told = found.at[len(frame.own) :], {}
    for force, option in zip(frame.discrepancy.forces, found.choice[:-1], strict=True):
        if option >= 0:
            made = frame.discrepancy.force(np.where(np.isin(np.arange(len(rest)), np.r_[force.columns]), rest, 0.0))
            made = made[:, force.joint]
            told[frame.arm.joints[force.joint], force.over] = float(np.sqrt(np.mean(made**2)))
    return told


def rank_sets(search: ArmSearch) -> tuple[Candidate, ...]:
    """Return every set that was fitted, the most probable first."""
    plain = search.found[frozenset()]
    temper, shares = search.temper, compute_probabilities(search.found.values(), search.temper)
    rows = []
    for terms, one in sorted(search.found.items(), key=lambda pair: -pair[1].score(temper)):
        names = sorted(terms) or [NOTHING]
        gain = (one.log_evidence + one.heldout - plain.log_evidence - plain.heldout) / temper
        mechanism = " + ".join(name.partition("@")[0] for name in names)
        at = " + ".join(dict.fromkeys(name.partition("@")[2] for name in names))
        rows.append(
            Candidate(
                mechanism=mechanism,
                at=at,
                log_evidence_gain=gain,
                probability=shares[terms],
                price=one.price,
                fitted=True,
            )
        )
    return tuple(rows)


def list_confusions(search: ArmSearch, best: ArmHypothesis) -> tuple[Confusion, ...]:
    """Return the effects that may stand in place of one of a hypothesis.

    A law that explains hardly more than a simpler one, which it contains, is counted as that one.
    """
    found = []
    for terms, one in search.found.items():
        more, less = terms - best.terms, best.terms - terms
        close = one.score(search.temper) > best.score(search.temper) - CLOSE
        if len(more) == 1 and len(less) == 1 and close and simplify(search, terms) != best.terms:
            (new,), (old,) = more, less
            name, _, at = new.partition("@")
            share = find_probabilities(search).get(new, 0.0)
            says = f"{new} explains this log nearly as well as {old}."
            found.append(Confusion(mechanism=name, at=at, probability=share, says=says))
    for effect in best.frame.effects:
        if isinstance(effect, LawEffect):
            found += [
                Confusion(
                    mechanism=name, at=effect.key.partition("@")[2], says=f"No log can tell {name} from {effect.key}."
                )
                for name in effect.term.equals
            ]
    return tuple(found)


def list_joints(
    search: ArmSearch, before: tuple[ArmHypothesis, HeldOutRuns], after: tuple[ArmHypothesis, HeldOutRuns],
    found: Sequence[Mechanism], motions: Mapping[str, str],
) -> tuple[JointRow, ...]:  # fmt: skip
    """Return each joint, before and after."""
    arm, rows = search.frame.arm, []
    for j, joint in enumerate(arm.joints):
        random = [one.values[f"{joint}.random_force"] for one, _ in (before, after)]
        rows.append(
            JointRow(
                joint=joint,
                unit=unit_of("force", motions[joint]),
                torque=float(np.std(arm.torque[:, j])),
                random_before=random[0],
                random_after=random[1],
                nrmse_before=float(before[1].nrmse[j]),
                nrmse_after=float(after[1].nrmse[j]),
                white_before=float(before[1].white[j]),
                white_after=float(after[1].white[j]),
                found=tuple(m.mechanism for m in found if m.at.partition(".")[0] == joint),
            )
        )
    return tuple(rows)


def describe_dependence(torque: Array, path: Path, arm: TapedArm) -> Dependence:
    """Return what the missing torque (windows, n) depends on, for the joint at which it is largest in its torque.

    `path` is that of the windows.
    """
    shares = np.std(torque, axis=0) / np.std(arm.torque, axis=0)
    j, time = int(np.argmax(shares)), np.arange(len(torque), dtype=float)
    over = {"position": path.q[:, j], "velocity": path.v[:, j], "time": time}
    told = {name: max(0.0, _explain(torque[:, j], x)) for name, x in over.items()}
    best = max(told, key=lambda name: told[name])
    says = (
        f"What the model leaves of the torque is largest at {arm.joints[j]} ({percent(float(shares[j]))} of its"
        f" torque) and depends most on {best} (which explains {percent(told[best])} of it)."
    )
    return Dependence(says, {**told, "phase": 0.0})


def _explain(y: Array, x: Array) -> float:
    """Return the share of the variance of `y` that its means in bins of `x` explain."""
    edges = np.quantile(x, np.linspace(0.0, 1.0, BINS + 1)[1:-1])
    which = np.searchsorted(edges, x)
    means = np.array([y[which == b].mean() if np.any(which == b) else 0.0 for b in range(BINS)])
    return float(np.var(means[which]) / max(float(np.var(y)), 1e-300))
