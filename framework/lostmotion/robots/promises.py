"""The effects that are tried in an arm, and what each promises beside a hypothesis.

A promise is the evidence that an effect would add if one-step errors were linear in it. It only proposes: every set is
fitted before it counts.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.contracts import DriveTerm, Term
from lostmotion.defaults import BEFORE_GEARS, INERTIA_CHANGE
from lostmotion.evidence.expansion import compute_log_evidence
from lostmotion.likelihood.innovations import Innovations
from lostmotion.parts import Array
from lostmotion.quantities import TIME
from lostmotion.robots.arm import Column, FilteredLog, TapedArm, can_act
from lostmotion.robots.arm_effects import ArmEffect, GearEffect, JointScales, LawEffect, MassEffect, Shape
from lostmotion.robots.arm_hypothesis import ArmFrame, ArmHypothesis
from lostmotion.robots.gears import BACKLASH, GEARS, HYSTERESIS
from lostmotion.robots.pitch_scan import find_pitches
from lostmotion.robots.soft_friction import SOFT_FRICTION
from lostmotion.robots.tape import Path

TYPICAL_MASS = 0.1
"""The usual error of a mass or an armature, as a share of it."""
SAME_LAW = 3.0
"""A law that contains a simpler one must gain so much log evidence over it (odds of 20) to count as another one."""
SAME = 0.9999
"""The cosine of the effects of two laws on this log above which only the more common one is tried."""


@dataclass(frozen=True)
class ArmPromise:
    """An effect, the values of its parameters to start from, and the score that it promises.

    `shift` is the step of the coordinates of the hypothesis that comes with it, where it is predicted. A fit begins at
    each of `levels` of the random force, in units of the fitted one.
    """

    effect: ArmEffect
    start: Mapping[str, float]
    gain: float
    shift: Array | None = None
    levels: tuple[float, ...] = (1.0,)


Group = tuple[ArmPromise, ...]
"""Effects that are proposed together."""
MOST_GROUPS = 2
"""The number of laws that are proposed at several joints at once."""


def list_groups(promises: Sequence[ArmPromise], most: int) -> list[Group]:
    """Return proposals of two to `most` effects at once: a law at several joints, and the best law of each joint.

    Forces at different joints hardly share an explanation, so that their promises add up. A law in all joints is
    proposed in the form that promises most: one after the other, a search does not reach the richer form of many.
    """
    by_law: dict[str, list[ArmPromise]] = {}
    by_joint: dict[int, ArmPromise] = {}
    for law, promise in _list_laws(promises):  # the best first
        by_law.setdefault(law.term.name, []).append(promise)
    for law, promise in _list_laws(leave_richer(promises)):
        by_joint.setdefault(law.joint, promise)
    ranked = sorted(by_law.values(), key=lambda group: -sum(p.gain for p in group))[:MOST_GROUPS]
    found = [tuple(group[:most]) for group in (*ranked, list(by_joint.values()))]
    return list({frozenset(p.effect.key for p in group): group for group in found if len(group) > 1}.values())


def _list_laws(promises: Sequence[ArmPromise]) -> list[tuple[LawEffect, ArmPromise]]:
    return [(p.effect, p) for p in promises if p.gain > 0.0 and isinstance(p.effect, LawEffect)]


def list_effects(
    arm: TapedArm, scales: Sequence[JointScales], terms: Iterable[Term], points: Sequence[str], plain: FilteredLog
) -> list[ArmEffect]:
    """Return all effects of an arm: laws at joints and drives, gears, masses; `plain` is the filtered nominal model."""
    found: list[ArmEffect] = []
    terms = [*(term for term in terms if can_act(term)), SOFT_FRICTION]
    for j, joint in enumerate(arm.joints):
        pitches = find_pitches(arm, plain, j)
        controlled = joint in arm.log.controlled
        for term in terms:
            if arm.side == "link" and term.name in BEFORE_GEARS:
                continue
            if controlled and isinstance(term, DriveTerm) and any(q.dimension != TIME for q in term.params):
                continue  # what depends on the size of a torque: only that of the set point is known beforehand
            at = f"{joint}.torque" if isinstance(term, DriveTerm) else joint
            found.append(LawEffect(replace(term, at=at), arm, j, scales[j], pitches))  # type: ignore[type-var]
        armature = arm.values.get(f"{joint}.armature", 0.0)
        unit = TYPICAL_MASS * max(armature, float(arm.tape.mass[:, j, j].mean()))
        found.append(MassEffect(INERTIA_CHANGE, joint, f"{joint}.armature", arm, unit))
        if armature > 0.0 and not controlled:
            found += [GearEffect(law, arm, j) for law in GEARS]
            found += [GearEffect(HYSTERESIS, arm, j, term) for term in terms if term.name == HYSTERESIS.name]
    for name in arm.parts:
        at, kind = name.rsplit(".", 1)
        if kind == "payload" and at in points:
            heaviest = max((abs(v) for k, v in arm.values.items() if k.endswith(".mass")), default=1.0)
            found.append(MassEffect("payload", at, name, arm, TYPICAL_MASS * heaviest))
        elif kind == "mass":
            found.append(MassEffect(INERTIA_CHANGE, at, name, arm, TYPICAL_MASS * abs(arm.values[name])))
    return found


@dataclass(frozen=True, eq=False)
class Screen:
    """The shapes of all effects along a path, with their columns, computed once."""

    effects: tuple[ArmEffect, ...]
    shapes: tuple[tuple[ArmEffect, Shape, slice], ...]
    columns: tuple[Column, ...]


def make_screen(arm: TapedArm, effects: Sequence[ArmEffect], accelerations: Array) -> Screen:
    """Return the shapes of effects along the path of the tape of an arm."""
    shapes: list[tuple[ArmEffect, Shape, slice]] = []
    columns: list[Column] = []
    for effect in effects:
        for shape in effect.list_shapes(arm.tape.path, accelerations):
            kept = [np.isfinite(c.force).all() and np.any(c.force) for c in shape.columns]
            if all(kept):
                shapes.append((effect, shape, slice(len(columns), len(columns) + len(shape.columns))))
                columns += shape.columns
    return Screen(tuple(effects), tuple(shapes), tuple(columns))


def list_promises(screen: Screen, beside: ArmHypothesis, price: float, temper: float) -> list[ArmPromise]:
    """Return what the effects of a screen promise beside a hypothesis, the best shape of each, best first."""
    frame = beside.frame
    gears = {e.joint: e.make(beside.values) for e in frame.gears}
    more = frame.arm.differentiate(beside.kept, screen.columns, gears)
    seen, used = beside.expansion, beside.used
    e, v = seen.here.errors, seen.here.variances
    slopes = more @ (-e / v)
    cross = (seen.errors[used] / v) @ more.T
    own = seen.gradient[used] - frame.weigh(beside.choice)[used] * (seen.at[used] - seen.middle[used])
    pulled = np.linalg.solve(beside.precision, np.column_stack([cross, own]))
    best: dict[str, ArmPromise] = {}
    size = np.sqrt(np.sum(more * more / v, axis=1))
    singles: list[tuple[int, str]] = []
    for effect, shape, part in sorted(screen.shapes, key=lambda row: row[0].price):
        if any(_overlaps(effect, present) for present in frame.effects):
            continue
        linear = isinstance(effect, LawEffect) and not isinstance(effect.term, DriveTerm)
        if linear and part.stop - part.start == 1 and size[part.start] > 0.0:
            row = more[part.start] / (v * size[part.start])
            if any(key != effect.key and abs(row @ more[i]) > SAME * size[i] for i, key in singles):
                continue
            singles.append((part.start, effect.key))
        units = {c.key: c.unit for c in effect.coordinates}
        block = more[part]
        information = (block / v) @ block.T - cross[:, part].T @ pulled[:, part]
        gradient = slopes[part] - cross[:, part].T @ pulled[:, -1]
        found = _weigh_shape(effect, shape, gradient, information, price, temper)
        if found is not None and (effect.key not in best or found.gain > best[effect.key].gain):
            step = np.array([found.start[c] / units[c] for c in shape.amplitudes])
            shift = np.zeros(len(seen.at))
            shift[used] = -pulled[:, part] @ step
            best[effect.key] = replace(found, shift=shift)
    return sorted(best.values(), key=lambda p: -p.gain)


def _overlaps(effect: ArmEffect, present: ArmEffect) -> bool:
    """Return whether an effect is present, or a part of it is, within another law that it does not contain itself.

    Data do not tell how two laws that contain the same simpler one divide it.
    """
    own, other = {effect.key, *effect.extends}, {present.key, *present.extends}
    return present.key not in effect.extends and not own.isdisjoint(other)


def leave_richer(promises: Sequence[ArmPromise]) -> list[ArmPromise]:
    """Return the promises without laws of which a simpler form promises as much: they follow once that is in the set.

    Friction through bristles that bend far is no dry friction, and a fit of that does not lead to it.
    """
    known = {p.effect.key: p.gain for p in promises if p.gain > 0.0}
    return [p for p in promises if all(p.gain > known.get(key, -math.inf) + SAME_LAW for key in p.effect.extends)]


def _weigh_shape(
    effect: ArmEffect, shape: Shape, gradient: Array, information: Array, price: float, temper: float
) -> ArmPromise | None:
    """Return what one shape promises; None where an amplitude would have the wrong sign."""
    gradient, information = gradient.copy(), information.copy()
    coordinates = {c.key: c for c in effect.coordinates}
    kept = list(range(len(shape.amplitudes)))
    while True:
        inner = information[np.ix_(kept, kept)] + np.eye(len(kept))
        step = np.linalg.solve(inner, gradient[kept])
        wrong = [i for i, s in zip(kept, step, strict=True) if s < 0.0 and coordinates[shape.amplitudes[i]].low == 0.0]
        if not wrong:
            break
        kept = [i for i in kept if i not in wrong]
        if not kept:
            return None
    evidence = compute_log_evidence(gradient[kept], information[np.ix_(kept, kept)], np.ones(len(kept)))
    own = [coordinates[shape.amplitudes[i]] for i in kept]
    inside = np.clip(step, [c.low / c.unit for c in own], [c.high / c.unit for c in own])
    evidence -= 0.5 * float((step - inside) @ inner @ (step - inside))
    values = dict.fromkeys(shape.amplitudes, 0.0) | {c.key: c.unit * float(s) for c, s in zip(own, inside, strict=True)}
    effect = effect.choose(shape.values) if isinstance(effect, LawEffect) else effect
    return ArmPromise(effect, {**shape.values, **values}, evidence / temper - price - effect.price)


def list_gear_promises(
    screen: Screen, beside: ArmHypothesis, small: float, price: float, temper: float
) -> list[ArmPromise]:
    """Return what gears promise, from filters at a few values, at a `small` share of the fitted random force.

    What a flexible gear does is smooth: inertias and smooth forces take its place. It is tried at the fitted levels as
    well, with the gain of all fitted coordinates in one step from there, and fitted from the level that promises more.
    """
    frame, found = beside.frame, []
    at = beside.at.copy()
    at[: len(frame.arm.joints)] += math.log(small)
    plain = float(frame.run(at).seen.log_likelihood)
    force = frame.discrepancy.force(at[len(frame.own) :])
    present = {e.joint: e.key for e in frame.gears}
    for effect in screen.effects:
        if not isinstance(effect, GearEffect) or present.get(effect.joint, "") not in _list_gears_before(effect):
            continue
        kept = [e for e in frame.effects if e.key not in effect.extends]
        wider = replace(frame, effects=(*kept, effect))
        best, start = -math.inf, {}
        levels: tuple[float, ...] = ()
        for values in effect.list_starts(beside.values):
            own = {c.key: c.place(values[c.key]) for c in effect.coordinates}
            told = float(wider.run(_place(wider, frame, at, own), force=force).seen.log_likelihood) - plain
            tried: tuple[float, ...] = (1.0, small)
            if effect.law is not BACKLASH:
                seen = wider.run(_place(wider, frame, beside.at, own), force=force).seen
                fitted = _gain_in_one_step(beside, seen)
                told, tried = (told, (small,)) if told > fitted else (fitted, (1.0,))
            if told > best:
                best, start, levels = told, values, tried
        if math.isfinite(best):
            found.append(ArmPromise(effect, start, best / temper - price - effect.price, levels=levels))
    return sorted(found, key=lambda p: -p.gain)


def _list_gears_before(effect: GearEffect) -> tuple[str, ...]:
    """Return what a joint may have before a gear is tried there: none, or for an inner law a flexible one."""
    return ("",) if effect.inner is None else effect.extends


def _place(wider: ArmFrame, frame: ArmFrame, at: Array, more: Mapping[str, float]) -> Array:
    """Return own coordinates of a wider frame: those of a frame, and `more`."""
    known = {c.key: float(x) for c, x in zip(frame.own, at, strict=False)} | dict(more)
    return np.array([known[c.key] for c in wider.own])


def _gain_in_one_step(beside: ArmHypothesis, seen: Innovations) -> float:
    """Return the gain of other one-step errors over a hypothesis, after a step with the derivatives of that one.

    Levels of noise stay: the log-likelihood is not quadratic in them, and predicted gains of any size where errors are
    large.
    """
    expansion, moved = beside.expansion, beside.used >= beside.frame.levels
    used = beside.used[moved]
    weights = beside.frame.weigh(beside.choice)[used]
    pull = expansion.score(seen)[used] - weights * (expansion.at[used] - expansion.middle[used])
    if not (seen.finite and np.isfinite(pull).all()):
        return -math.inf
    step = np.linalg.solve(beside.precision[np.ix_(moved, moved)], pull)
    return float(seen.log_likelihood - expansion.here.log_likelihood) + 0.5 * float(pull @ step)


def relinearise(kept: FilteredLog, joints: int) -> Path:
    """Return the path of a filtered recording."""
    a = kept.accelerations[:, :joints].copy()
    a[-1] = a[-2]
    return Path(kept.states[:, :joints], kept.states[:, joints : 2 * joints], a)
