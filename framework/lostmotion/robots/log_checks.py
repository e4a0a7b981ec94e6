"""What is looked at before any fit: whether recorded torques agree with the inverse dynamics of the model at all.

All signals are averaged over short windows first, so that noise of the accelerations does not decide.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.parts import Array
from lostmotion.quantities import name_force
from lostmotion.results.robots import Check
from lostmotion.robots.arm import TapedArm
from lostmotion.robots.arm_effects import GAINS
from lostmotion.robots.arm_model import TOLERANCE
from lostmotion.robots.arm_preparation import estimate_noise
from lostmotion.robots.tape import Tape, smooth_path
from lostmotion.simulators import Simulator

WINDOW = 0.05
"""The length (s) of the windows over which signals are averaged."""
AGREES, OPPOSED = 0.7, -0.5
"""A correlation of torque and inverse dynamics above which they agree, and below which their signs are opposed."""
BETTER = 0.6
"""Another reading of the log is proposed if it leaves less than this share of the unexplained torque."""
CLEAR = 0.35
"""A reading of the log explains a torque if it leaves less than this share of its standard deviation."""
LAG, MOST_LAG = 3, 60
"""Samples of lag between torque and motion that are told, and the largest ones that are tried."""
LEAST_TRAVEL = 50.0
"""A joint hardly moves if its travel is less than so many standard deviations of its noise."""
DEGREE, WIDE = 180.0 / math.pi, 7.0
"""Degrees in a radian; the travel (rad) of a joint beyond which its positions may be in degrees."""


@dataclass(frozen=True, eq=False)
class _Fit:
    """How much of each torque the model leaves, as a share of its standard deviation, and the slopes of its parts.

    `size` is the standard deviation of the model's torque as such a share. `brakes` tells whether the friction that was
    allowed for takes power from the motion.
    """

    left: Array
    correlation: Array
    slope: Array
    size: Array
    brakes: Array

    @property
    def explained(self) -> Array:
        """Whether the model explains each torque (n,) together with friction, or friction nearly alone."""
        fits = (np.abs(self.slope - 1.0) < BETTER) | (self.size < CLEAR)
        return np.asarray((self.left < CLEAR) & (self.brakes > 0.0) & fits)


def check_log(arm: TapedArm, simulator: Simulator, tolerance: float = TOLERANCE) -> tuple[Check, ...]:
    """Return the checks of a log, each with the remedy; those that `stop` make a diagnosis meaningless.

    Values of the model are known within the share `tolerance`.
    """
    found = [*_check_motion(arm, simulator)]
    if any(check.stop for check in found):
        return tuple(found)
    base = _compare(arm, arm.torque)
    faults = [*_check_angles(arm, simulator, base)] or [*_check_order(arm, base)]
    faults = faults or [*_check_gravity(arm, simulator, base)] or [*_check_signs(arm, base)]
    faults = faults or [*_check_positions(arm, simulator, base)] or [*_check_scale(arm, simulator, base, tolerance)]
    found += faults
    if not faults:
        found += [*_check_side(arm)]
        found += [*_check_lag(arm, base)]
    found += [
        Check("torque", joint, True, _describe_agreement(base, j, joint))
        for j, joint in enumerate(arm.joints)
        if not any(check.joint == joint and not check.passed for check in found)
    ]
    return tuple(found)


def _describe_agreement(base: _Fit, j: int, joint: str) -> str:
    """Return how the torque of a joint agrees with the model, in a sentence."""
    told = f"Torque and inverse dynamics of {joint} correlate with {base.correlation[j]:.3f}"
    return (
        f"{told}; with friction of any size {100.0 * base.left[j]:.0f} % of the torque are left."
        if (base.correlation[j] < AGREES)
        else f"{told}."
    )


def average(x: Array, dt: float) -> Array:
    """Return signals (samples, ...) averaged over windows (windows, ...)."""
    size = max(1, round(WINDOW / dt))
    count = len(x) // size
    return np.asarray(x[: count * size].reshape(count, size, *x.shape[1:]).mean(axis=1))


def predict_torque(arm: TapedArm, side: str | None = None) -> Array:
    """Return the torque (samples, n) of the model along the path, as the sensor of this side shows it."""
    path, tape = arm.tape.path, arm.tape
    spring = arm.get({}, "stiffness") * (path.q - arm.get({}, "rest"))
    found = tape.torque + spring
    if (side or arm.side) == "motor":
        found = found + arm.get({}, "armature") * path.a + arm.get({}, "damping") * path.v
        found = found + arm.get({}, "frictionloss") * np.tanh(path.v / (1e-9 + 0.05 * np.std(path.v, axis=0)))
    return np.asarray(found)


def _compare(arm: TapedArm, torque: Array, model: Array | None = None) -> _Fit:
    """Return how well a torque (samples, n) agrees with the model, friction of any size at each joint allowed for."""
    dt, path = arm.log.dt, arm.tape.path
    model = average(predict_torque(arm) if model is None else model, dt)
    torque, v = average(torque, dt), average(path.v, dt)
    n = torque.shape[1]
    left, correlation, slope, size, brakes = np.zeros((5, n))
    for j in range(n):
        speed = v[:, j]
        rubbing = _list_friction(speed)
        rest = torque[:, j] - model[:, j]
        friction = rubbing @ np.linalg.lstsq(rubbing, rest, rcond=None)[0]
        brakes[j] = np.mean((friction - np.mean(friction)) * (speed - np.mean(speed)))
        whole = max(float(np.std(torque[:, j])), 1e-12)
        left[j], size[j] = np.std(rest - friction) / whole, np.std(model[:, j]) / whole
        correlation[j] = np.corrcoef(torque[:, j], model[:, j])[0, 1]
        full = np.column_stack([model[:, j], rubbing])
        slope[j] = np.linalg.lstsq(full, torque[:, j], rcond=None)[0][0]
    return _Fit(left, np.nan_to_num(correlation), slope, size, brakes)


def _list_friction(speed: Array) -> Array:
    """Return a constant, viscous friction and dry friction (windows, 3) of unit size at a speed (windows,)."""
    return np.column_stack([np.ones_like(speed), speed, np.tanh(speed / (0.05 * np.std(speed) + 1e-12))])


def _check_motion(arm: TapedArm, simulator: Simulator) -> Iterator[Check]:
    """Yield a check for each joint that hardly moves."""
    noise = estimate_noise(arm.log.positions)
    for j, joint in enumerate(arm.joints):
        travel = float(np.ptp(arm.log.positions[:, j]))
        unit = "rad" if simulator.moves[j] == "rotation" else "m"
        if travel < LEAST_TRAVEL * noise[j] or travel < 1e-3:
            yield Check(
                "motion", joint, False,
                f"{joint} moves by {travel:.3g} {unit} only: what it lacks cannot be seen; leave it out of [model]"
                " joints, or record a motion of this joint.",
            )  # fmt: skip


def _check_angles(arm: TapedArm, simulator: Simulator, base: _Fit) -> Iterator[Check]:
    """Yield a check if the positions agree with the torques when they are read as degrees."""
    if base.left.max() < CLEAR or np.ptp(arm.log.positions, axis=0).max() < WIDE:
        return
    other = _reread(arm, simulator, arm.log.readings / DEGREE, arm.log.torque)
    if other.left.mean() < BETTER * base.left.mean() and np.median(other.correlation) > AGREES:
        yield Check(
            "unit", "", False,
            "The positions look like degrees, not radians: give the unit of the position columns in the case.",
            stop=True,
        )  # fmt: skip


def _reread(arm: TapedArm, simulator: Simulator, readings: Array, torque: Array) -> _Fit:
    """Return the agreement for other readings and torques."""
    log = replace(arm.log, torque=torque, readings=readings)
    path, still = smooth_path(log.positions, log.dt), np.zeros_like(arm.tape.mass)
    tape = Tape(path, still, np.asarray(simulator.inverse(path.q, path.v, path.a)), still, still)
    other = replace(arm, log=log, tape=tape, _cache={})
    return _compare(other, other.torque)


def _check_positions(arm: TapedArm, simulator: Simulator, base: _Fit) -> Iterator[Check]:
    """Yield a check if the torques agree with the model for other positions of a joint, or of two joints swapped."""
    if base.left.max() < CLEAR:
        return
    tried = [(_reread(arm, simulator, *other), joint, says) for joint, says, *other in _list_readings(arm, simulator)]
    best, joint, says = min(tried, key=lambda one: float(one[0].left.mean()))
    if best.left.mean() < BETTER * base.left.mean() and best.correlation.min() > AGREES:
        yield Check("order" if "swapped" in says else "unit", joint, False, says, stop=True)


def _list_readings(arm: TapedArm, simulator: Simulator) -> Iterator[tuple[str, str, Array, Array]]:
    """Yield a joint, a sentence, and readings and torques (samples, ...) as they may be meant."""
    readings, torque = arm.log.readings, arm.log.torque
    place = {pick: i for i, pick in enumerate(arm.log.picks)}
    for j, (joint, moves) in enumerate(zip(arm.joints, simulator.moves, strict=True)):
        own = [i for (k, _), i in place.items() if k == j]
        turns = moves == "rotation"
        unit = (1.0 / DEGREE, 'be in degrees: give unit = "deg"') if turns else (1e-3, 'be in mm: give unit = "mm"')
        for factor, says in ((-1.0, "have the opposite sign: give factor = -1"), unit):
            other = readings.copy()
            other[:, own] *= factor
            yield joint, f"The positions of {joint} seem to {says} for its position.", other, torque
        for quarters in (-1, 1, 2) if turns else ():
            other = readings.copy()
            other[:, place[j, 0]] += 0.5 * math.pi * quarters
            says = f"The zero of the encoder of {joint} seems to be shifted: add {90 * quarters} degrees to its column"
            yield joint, f"{says}, or correct the zero of the joint in the model.", other, torque
        for k in range(j):
            turned = [place[{j: k, k: j}.get(i, i), order] for i, order in arm.log.picks if (i, order) in place]
            names, other = f"{arm.joints[k]} and {joint}", readings[:, turned]
            yield joint, f"The positions of {names} look swapped: check the order of the columns.", other, torque
            both = torque.copy()
            both[:, [j, k]] = both[:, [k, j]]
            yield joint, f"The joints {names} look swapped: check the names of their columns.", other, both


def _check_order(arm: TapedArm, base: _Fit) -> Iterator[Check]:
    """Yield a check if two torque columns agree with the model when they are swapped."""
    if base.left.max() < CLEAR:
        return
    model = predict_torque(arm)
    for i, j in itertools.combinations(range(len(arm.joints)), 2):
        torque = arm.torque.copy()
        torque[:, [i, j]] = torque[:, [j, i]]
        other = _compare(arm, torque, model)
        pair = [i, j]
        if other.left[pair].mean() < BETTER * base.left[pair].mean() and other.correlation[pair].min() > AGREES:
            yield Check(
                "order", arm.joints[i], False,
                f"The torques of {arm.joints[i]} and {arm.joints[j]} look swapped: the torque of each agrees with the"
                " inverse dynamics of the other. Check the order of the columns.", stop=True,
            )  # fmt: skip


def _check_gravity(arm: TapedArm, simulator: Simulator, base: _Fit) -> Iterator[Check]:
    """Yield a check if the torques agree with the model under the opposite gravity, or without it."""
    if base.left.max() < CLEAR:
        return
    none = np.zeros_like(arm.tape.path.q)
    weight = np.asarray(simulator.inverse(arm.tape.path.q, none, none))
    model = predict_torque(arm)
    if float(np.max(np.abs(weight))) < 1e-9 and _seems_heavy(arm, model, base):
        yield Check(
            "gravity", "", False,
            "The model has no gravity, but most of the torque that it leaves depends on the positions as a weight does:"
            " switch gravity on in the model.", stop=True,
        )  # fmt: skip
        return
    for share, says in (
        (2.0, "The torques agree with gravity in the opposite direction: check the direction of gravity in the model"),
        (1.0, "The torques agree with the model without gravity: the log has the torque after a compensation of"
         " gravity, or the arm moves in a horizontal plane. Switch gravity off in the model"),
    ):  # fmt: skip
        other = _compare(arm, arm.torque, model - share * weight)
        if other.left.mean() < BETTER * base.left.mean() and np.median(other.correlation) > AGREES:
            yield Check("gravity", "", False, f"{says}.", stop=True)
            return


def _seems_heavy(arm: TapedArm, model: Array, base: _Fit) -> bool:
    """Return whether waves over the positions, and over sums of neighbours, explain most of what a model leaves."""
    q, v = (average(x, arm.log.dt) for x in (arm.tape.path.q, arm.tape.path.v))
    rest = average(arm.torque - model, arm.log.dt)
    angles = np.hstack([q, q[:, 1:] + q[:, :-1], q[:, 1:] - q[:, :-1]])
    j = int(np.argmax(base.left))
    full = np.hstack([np.cos(angles), np.sin(angles), _list_friction(v[:, j])])
    left = rest[:, j] - full @ np.linalg.lstsq(full, rest[:, j], rcond=None)[0]
    return bool(np.std(left) < BETTER * base.left[j] * np.std(average(arm.torque[:, j], arm.log.dt)))


def _check_signs(arm: TapedArm, base: _Fit) -> Iterator[Check]:
    """Yield a check for each joint whose torque has the opposite sign."""
    for j, joint in enumerate(arm.joints):
        if base.correlation[j] < OPPOSED and base.slope[j] < 0.0:
            yield Check(
                "sign", joint, False,
                f"The torque of {joint} has the opposite sign of the inverse dynamics (correlation"
                f" {base.correlation[j]:.2f}): give factor = -1 for its torque, or for its position if that is turned.",
                stop=True,
            )  # fmt: skip


def _measure_parts(arm: TapedArm) -> tuple[Array, Array]:
    """Return the sizes (rms, n) of the torque of inertia and of all else that the model has at each joint.

    Inertia is counted with each entry of the mass matrix for itself, so that entries do not cancel.
    """
    a, mass = average(arm.tape.path.a, arm.log.dt), average(arm.tape.mass, arm.log.dt)
    inertia = np.sqrt(np.sum(np.mean((mass * a[:, None, :]) ** 2, axis=0), axis=1))
    return np.asarray(inertia), np.asarray(np.std(average(arm.tape.bias, arm.log.dt), axis=0))


def _check_scale(arm: TapedArm, simulator: Simulator, base: _Fit, tolerance: float) -> Iterator[Check]:
    """Yield a check for each joint whose torque has another size, or does not agree at all."""
    inertia, others = _measure_parts(arm)
    sizes = np.std(average(arm.torque, arm.log.dt), axis=0)
    unsure = tolerance * np.hypot(inertia, others) / np.maximum(sizes, 1e-300)
    stops = bool(np.median(np.where(base.explained, 1.0, base.correlation)) < AGREES)
    for j, joint in enumerate(arm.joints):
        slope, agrees = float(base.slope[j]), base.correlation[j] > AGREES
        if agrees and not GAINS[0] < slope < GAINS[1]:
            word = name_force(simulator.moves[j])
            small, large = ("N mm", "kN m") if word == "torque" else ("mN", "kN")
            hint = (
                f"{small} or a percentage"
                if slope > GAINS[1]
                else f"{large}, a motor current or a {word} before the gear"
            )
            yield Check(
                "unit", joint, False,
                f"The {word} of {joint} is {slope:.3g} times that of the model: it may be in {hint}; give its unit or"
                " a factor.", stop=True,
            )  # fmt: skip
        elif unsure[j] > CLEAR and base.left[j] > CLEAR:
            unit = "N m" if simulator.moves[j] == "rotation" else "N"
            yield Check(
                "resonance", joint, False,
                f"The {name_force(simulator.moves[j])} of {joint} ({sizes[j]:.2g} {unit}) is a small difference of"
                f" large parts of the model, as near a resonance: inertia has {inertia[j]:.2g} {unit}, gravity and the"
                f" rest {others[j]:.2g} {unit}. Where these are known within {100.0 * tolerance:.2g} %, the"
                f" {name_force(simulator.moves[j])} is known within {100.0 * unsure[j]:.0f} %, and the model leaves"
                f" {100.0 * base.left[j]:.0f} % of it: this motion cannot tell what {joint} lacks. Record one at other"
                " frequencies, or with larger torques.", stop=stops,
            )  # fmt: skip
        elif not agrees and not base.explained[j]:
            yield Check(
                "torque", joint, False,
                f"Torque and inverse dynamics of {joint} hardly agree (correlation {base.correlation[j]:.2f},"
                f" {100.0 * base.left[j]:.0f} % unexplained): friction may be most of the torque; else check the sign,"
                " unit, order and clock of this joint.",
                stop=stops,
            )  # fmt: skip


def _check_side(arm: TapedArm) -> Iterator[Check]:
    """Yield a check for each joint whose torque looks like that of the other side of the gear."""
    path, dt = arm.tape.path, arm.log.dt
    link = average(predict_torque(arm, "link"), dt)
    motor = average(np.asarray(path.a), dt)
    torque, v = average(arm.torque, dt), average(path.v, dt)
    armature = np.array([arm.motor_inertia.get(joint, 0.0) for joint in arm.joints])
    for j, joint in enumerate(arm.joints):
        if armature[j] <= 0.0:
            continue
        speed = v[:, j]
        full = np.column_stack([armature[j] * motor[:, j], link[:, j], _list_friction(speed)])
        found, *_ = np.linalg.lstsq(full, torque[:, j], rcond=None)
        rest = torque[:, j] - full @ found
        error = math.sqrt(float(np.linalg.inv(full.T @ full)[0, 0]) * float(rest @ rest) / max(len(rest) - 5, 1))
        wanted = 1.0 if arm.side == "motor" else 0.0
        if abs(found[0] - (1.0 - wanted)) < 0.35 and abs(found[0] - wanted) > 6.0 * error and error < 0.1:
            other = "link" if arm.side == "motor" else "motor"
            yield Check(
                "side", joint, False,
                f"The torque of {joint} {'lacks' if wanted else 'contains'} the inertia of its motor: it looks"
                f' measured on the {other} side of the gear; write torque = "{other}".', stop=True,
            )  # fmt: skip


def _check_lag(arm: TapedArm, base: _Fit) -> Iterator[Check]:
    """Yield a check if all torques agree better when they are shifted in time."""
    model, torque = predict_torque(arm), arm.torque
    if base.left.max() < 0.02:
        return
    lags = np.arange(-MOST_LAG, MOST_LAG + 1)
    left = np.array([_compare(arm, np.roll(torque, lag, axis=0), model).left for lag in lags])
    best = lags[np.argmin(left, axis=0)]
    lag = int(np.median(best))
    gain = left[lag + MOST_LAG] / left[MOST_LAG]
    if abs(lag) >= LAG and np.all(np.abs(best - lag) <= LAG) and np.all(gain < BETTER):
        later = "later" if lag > 0 else "earlier"
        yield Check(
            "clock", "", False,
            f"All torques act {abs(lag) * arm.log.dt * 1e3:.3g} ms {later} than the log has them: torque and position"
            " have different clocks; shift one of the columns.", stop=True,
        )  # fmt: skip
