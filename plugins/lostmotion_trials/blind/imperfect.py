"""Machines with the flaws of real rigs, which no term describes, in addition to the hidden mechanism.

The flaws are: small smooth forces over position, velocity, phase or time; friction whose level follows a random curve
over the speed; a compliant foot; a higher mode in the sensor reading; known values that are slightly wrong; a
non-linear sensor; coloured noise, mains hum and a quantised reading. The size of the hidden mechanism is a share of the
force of inertia.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from lostmotion.codec import described
from lostmotion.contracts import Array
from lostmotion.settings import DEFAULT
from lostmotion_trials.blind.mechanisms import NOISY, TABLE, UNKNOWN, Effect, Pilot
from lostmotion_trials.blind.simulator import (
    CYCLE_SAMPLES,
    BlindDrive,
    BlindMachine,
    Disturbances,
    bound_pace,
    draw_log_uniform,
    draw_parameters,
    find_start,
    simulate_pieces,
    wide_prior,
)
from lostmotion_trials.integrators.hidden import Hidden
from lostmotion_trials.integrators.imperfect import CELLS, REACH, Flaws, move_rough

CYCLE, MULTISINE, SWEEP, STEPS, IMPACTS = "cycle", "multisine", "sweep", "steps", "impacts"
KINDS = (CYCLE, MULTISINE, SWEEP, STEPS, IMPACTS)
STEPS_PER_RATE = 0.003
"""Integration step times the fastest rate: a fifth of that of a final fit."""
LEAST_SAMPLES = 1500
"""Least length of a recording, unless the trial allows fewer samples."""
EFFECT_SIZES = (0.02, 0.3)
"""Range of the hidden force over the force of inertia (rms), or of a sensor error over the motion."""
SMOOTH_SIZES = (0.005, 0.05)
"""Range of the rms of all smooth forces together over the amplitude of the drive, or of the inertia force if less."""
WAVES = 4
"""Waves of a random function."""
LEAST_LEVEL = 0.1
"""The least level of friction over the speed, in shares of its usual one."""
FITTED = 1.0 - DEFAULT.heldout.share
"""The share of a recording that a diagnosis fits; the rest is held out."""
Curve = tuple[tuple[float, float], ...]
"""Cosine and sine of each wave of a random function."""


@dataclass(frozen=True)
class Blemish:
    """A small smooth force."""

    over: str = described("argument of the force: position, velocity, phase or time")
    rms: float = described("its root mean square", unit="N")
    waves: Curve = described("cosine and sine of each wave of its random function")


@dataclass(frozen=True)
class World:
    """The flaws of one rig; sizes of noise, hum and step are in standard deviations of the measurement noise."""

    kind: str = described("kind of the drive")
    smooth: tuple[Blemish, ...] = described("small smooth forces")
    friction: Curve = described("waves of the random curve of the level of friction over the speed")
    flaws: Mapping[str, float] = described("scales of the motion, the compliant foot and the higher mode, in SI units")
    stated: Mapping[str, float] = described("each known value in the case over its true value")
    bend: tuple[float, float] = described(
        "even and odd non-linearity of the sensor at its largest reading, as a share of that"
    )
    slow: float = described("share of the noise variance that is correlated in time")
    memory: float = described("correlation of that noise from one sample to the next")
    hum: float = described("amplitude of the hum")
    hum_pace: float = described("angular frequency of the hum", unit="rad/s")
    step: float = described("quantisation of the readings")
    curves: Mapping[str, tuple[float, ...]] = described("tables of the integrator, by their argument", default={})


def draw_machine(kind: str, rng: np.random.Generator, most: int) -> BlindMachine:
    """Return a machine with random parameters under a drive of a kind, with at most `most` samples."""
    gapped = 0.55 if kind == IMPACTS else 0.45
    joint = 0.0 if kind == IMPACTS else 0.3
    names, weights = ["lin_backlash", "robot_joint", "linear_oscillator"], [gapped, joint, 1.0 - gapped - joint]
    model = str(rng.choice(names, p=weights))
    natural, mass = draw_log_uniform(rng, 5.0, 300.0), draw_log_uniform(rng, 0.05, 50.0)
    values, amplitude = draw_parameters(model, mass, natural, rng)
    if model == "lin_backlash" and kind in (IMPACTS, STEPS):
        values["k1"] = float(rng.uniform(0.03, 0.2)) * values["k0"]
    ratio = draw_log_uniform(rng, *((0.12, 0.5) if model == "robot_joint" else (0.2, 1.2)))
    samples = round(draw_log_uniform(rng, min(LEAST_SAMPLES, most), most))
    period = max(draw_log_uniform(rng, 25.0, 100.0), CYCLE_SAMPLES / ratio)
    rate = period * ratio * natural / (2.0 * math.pi)
    signal = _draw_signal(kind, amplitude, ratio * natural, (natural, samples / rate), rng)
    top = max((w for _, w, _ in signal.tones), default=0.0) / (ratio * natural)
    rate *= max(1.0, CYCLE_SAMPLES * top / period)
    estimated = ("c", "k") if model == "linear_oscillator" else ("c", "x0")
    priors = {name: wide_prior(values[name], rng) for name in estimated}
    return BlindMachine(model, values, estimated, signal, rate, samples, draw_log_uniform(rng, 0.002, 0.03), priors)


def _draw_signal(
    kind: str, size: float, omega: float, times: tuple[float, float], rng: np.random.Generator
) -> BlindDrive:
    """Return a drive of a kind; `times` are the natural angular frequency (rad/s) and the duration (s)."""
    natural, duration = times
    turn = float(rng.uniform(0.0, 2.0 * math.pi))
    if kind == CYCLE:
        return BlindDrive(((size, omega, turn),))
    if kind == SWEEP:
        return BlindDrive(((size, 0.5 * omega, turn),), float(rng.uniform(0.7, 1.5)) * omega / duration)
    if kind == MULTISINE:
        base = 2.0 * math.pi * float(rng.integers(2, 5)) / duration
        lines = np.unique(np.round(np.linspace(0.3, 1.8, int(rng.integers(8, 17))) * omega / base))
        turns = rng.uniform(0.0, 2.0 * math.pi, len(lines))
        each = size * math.sqrt(2.0 / len(lines))
        return BlindDrive(tuple((each, float(n) * base, float(p)) for n, p in zip(lines, turns, strict=True) if n > 0))
    cycle = 2.0 * math.pi / natural
    events, at = [], 0.02 * duration
    spaced = max(0.1 * duration, 4.0 * cycle) if kind == IMPACTS else max(0.03 * duration, 2.0 * cycle)
    while at < duration:
        long = float(rng.uniform(0.3, 0.7)) * cycle
        events.append((at, size * float(rng.uniform(0.5, 1.5)) * float(rng.choice([-1.0, 1.0])), long))
        at += spaced * float(rng.uniform(0.7, 1.5))
    if kind == IMPACTS:
        return BlindDrive((), hits=tuple((t, 3.0 * s, long) for t, s, long in events), pace=omega)
    levels = [s for _, s, _ in events]
    jumps = [new - old for new, old in zip(levels, [0.0, *levels[:-1]], strict=True)]
    return BlindDrive((), steps=tuple((t, j, long) for (t, _, long), j in zip(events, jumps, strict=True)), pace=omega)


def draw_world(kind: str, pilot: Pilot, rng: np.random.Generator) -> World:
    """Return random flaws of a rig whose motion without a hidden mechanism is that of the pilot."""
    rig, body = pilot.rig, pilot.rig.body
    offered = ["position", "velocity", "time", *(["phase"] if kind == CYCLE else [])]
    overs = [str(o) for o in rng.choice(offered, size=int(rng.integers(1, 4)), replace=False)]
    drive = math.inf if rig.based else rig.signal.amplitude
    reference = min(drive, math.sqrt(2.0) * pilot.inertial_force)
    whole = draw_log_uniform(rng, *SMOOTH_SIZES) * reference / math.sqrt(len(overs))
    stiff = body.k + body.k0
    pace = math.sqrt(stiff / body.m)
    foot = stiff * draw_log_uniform(rng, 50.0, 500.0)
    flaws = {
        "foot": foot,
        "foot_drag": foot * float(rng.uniform(0.03, 0.1)) / pace,
        "far_pace": float(rng.uniform(6.0, 15.0)) * pace,
        "far_loss": draw_log_uniform(rng, 0.005, 0.03),
        "far_compliance": draw_log_uniform(rng, 0.001, 0.01) / stiff,
    }
    known = [name for name, value in rig.values.items() if name not in rig.estimated and value]
    smooth = tuple(Blemish(over, whole, _draw_waves(rng)) for over in overs)
    made = World(
        kind=kind,
        smooth=smooth,
        friction=_draw_waves(rng),
        flaws=flaws,
        stated={name: 1.0 + float(rng.choice([-1.0, 1.0])) * draw_log_uniform(rng, 0.001, 0.01) for name in known},
        bend=(float(rng.uniform(-0.005, 0.005)), float(rng.uniform(-0.005, 0.005))),
        slow=float(rng.uniform(0.1, 0.8)),
        memory=float(rng.uniform(0.3, 0.9)),
        hum=draw_log_uniform(rng, 0.1, 1.0),
        hum_pace=float(rng.uniform(0.1, 2.5)) * rig.rate,
        step=draw_log_uniform(rng, 0.1, 2.0),
    )
    return follow_motion(made, pilot, rng)


def follow_motion(world: World, pilot: Pilot, rng: np.random.Generator) -> World:
    """Return a world with its curves over another motion of the rig, the one with what is hidden in it.

    Where a hidden gain or a limit of the drive makes the motion several times smaller, curves over the motion without
    it have a constant and a slope there, which are true forces that the truth does not tell.
    """
    flaws = {**world.flaws, "position": _measure_scale(pilot.q), "velocity": _measure_scale(pilot.v)}
    made = replace(world, flaws=flaws)
    return replace(made, curves=_tabulate_curves(made, pilot, rng))


def _measure_scale(moved: Array) -> float:
    """Return the scale of a motion: its standard deviation, or 0.4 of the largest value if more (after a hit)."""
    return max(float(np.std(moved)), 0.4 * float(np.max(np.abs(moved))))


def _draw_waves(rng: np.random.Generator) -> Curve:
    """Return the waves of a random smooth function; the amplitude falls with the order."""
    return tuple(tuple((rng.standard_normal(2) / k).tolist()) for k in range(1, WAVES + 1))


def _evaluate_waves(waves: Curve, angle: Array) -> Array:
    """Return a random function at angles (rad); pi is half a wavelength of the slowest wave."""
    rows = (a * np.cos(k * angle) + b * np.sin(k * angle) for k, (a, b) in enumerate(waves, start=1))
    return np.asarray(sum(rows), dtype=float)


def _tabulate_curves(world: World, pilot: Pilot, rng: np.random.Generator) -> dict[str, tuple[float, ...]]:
    """Return the curves (CELLS + 1,) over position, velocity and speed that the integrator reads."""
    z = np.linspace(-REACH, REACH, CELLS + 1)
    shape = _evaluate_waves(world.friction, 0.5 * math.pi * np.abs(z))
    level = float(rng.uniform(0.05, 0.2))
    tables = {name: np.zeros(CELLS + 1) for name in ("position", "velocity")}
    moved = {"position": pilot.q, "velocity": pilot.v}
    for blemish in world.smooth:
        if blemish.over in tables:
            raw = _evaluate_waves(blemish.waves, 0.5 * math.pi * z / 2.0 + 0.25 * math.pi)
            seen = moved[blemish.over] / world.flaws[blemish.over]
            tables[blemish.over] += _scale_curve(raw, z, seen, blemish.rms)
    uneven = np.exp(level * shape / max(float(np.std(shape)), 1e-12))
    friction = level_curve(uneven, z, np.abs(pilot.v) / world.flaws["velocity"])
    return {name: tuple(table.tolist()) for name, table in {"friction": friction, **tables}.items()}


def level_curve(raw: Array, z: Array, seen: Array) -> Array:
    """Return a curve of the level of friction over `z` whose straight line over the speeds `seen` (samples,) is 1.

    A level that changes in proportion to the speed is viscous damping. Without this the true force and damping would be
    known to the size of the curve only. Beyond the largest speed that was seen the curve is constant.
    """
    line, _ = fit_line(np.interp(seen, z, raw), seen)
    near = np.minimum(np.abs(z), float(np.max(seen)))
    level: Array = 1.0 + np.interp(near, z, raw) - line[0] - line[1] * near
    return np.maximum(level, LEAST_LEVEL)


def _scale_curve(raw: Array, z: Array, seen: Array, rms: float) -> Array:
    """Return the curve over `z` without its straight line, scaled to this rms along the motion `seen` (samples,).

    The straight line is removed because terms of the library describe it: a constant is an offset, a slope a stiffness
    or a damping.
    """
    line, left = fit_line(np.interp(seen, z, raw), seen)
    rest = float(np.std(left))
    curve = (raw - line[0] - line[1] * z) * rms / max(rest, 1e-300)
    return np.asarray(np.where(np.abs(z) < REACH, curve, np.interp(z, z[1:-1], curve[1:-1])), dtype=float)


def fit_line(values: Array, over: Array) -> tuple[Array, Array]:
    """Return the straight line (2,) through values (n,) over their arguments (n,), and what it leaves (n,)."""
    rows = np.column_stack([np.ones_like(over), over])
    line = np.asarray(np.linalg.lstsq(rows, values, rcond=None)[0], dtype=float)
    return line, np.asarray(values - rows @ line, dtype=float)


def simulate_imperfect(
    rig: BlindMachine, hidden: tuple[Hidden, Disturbances], world: World, rng: np.random.Generator
) -> Array:
    """Return the readings (samples,) of the sensor before its noise, after the machine has settled."""
    inside, disturbances = hidden
    curves = np.array([world.curves[name] for name in ("position", "velocity", "friction")])
    flaws, state = Flaws(**world.flaws), np.zeros(9)
    state[0] = find_start(rig)

    def follow(force: Array, base: Array, clock: tuple[float, float], every: int) -> Array:
        arguments = (force, base, rig.body, inside, flaws, curves, state, clock, every)
        return np.asarray(move_rough(*arguments)[:, 0])  # type: ignore[no-untyped-call]

    fastest = max(bound_pace(rig), 0.4 * world.flaws["far_pace"])
    return simulate_pieces(
        rig, disturbances, rng, fastest / STEPS_PER_RATE, follow, partial(_compute_timed_force, world, rig)
    )


def _compute_timed_force(world: World, rig: BlindMachine, t: Array) -> Array:
    """Return the smooth forces (samples,) over phase and time at the times `t` (s)."""
    total, duration = np.zeros(len(t)), rig.samples / rig.rate
    for blemish in world.smooth:
        if blemish.over == "phase":
            size = math.sqrt(0.5 * sum(a * a + b * b for a, b in blemish.waves))
            total += blemish.rms / max(size, 1e-300) * _evaluate_waves(blemish.waves, rig.signal.omega * t)
        if blemish.over == "time":
            size = float(np.std(_evaluate_over_time(blemish.waves, np.linspace(0.0, 1.0, 2001))))
            total += blemish.rms / max(size, 1e-300) * _evaluate_over_time(blemish.waves, t / duration)
    return total


def _evaluate_over_time(waves: Curve, share: Array) -> Array:
    """Return a random function at shares of a recording, with zero mean in the fitted part and in the held-out part.

    A straight line with these means is subtracted, because a term of the library describes a constant force.
    """
    parts = ((0.0, FITTED), (FITTED, 1.0))
    means = [float(np.mean(_evaluate_waves(waves, math.pi * np.linspace(a, b, 2001)))) for a, b in parts]
    slope = 2.0 * (means[1] - means[0])
    return np.asarray(_evaluate_waves(waves, math.pi * share) - means[0] - slope * (share - 0.5 * FITTED))


def record_imperfect(
    rig: BlindMachine, truth: Array, world: World, rng: np.random.Generator, *, hidden_step: float = 0.0
) -> tuple[Array, float]:
    """Return the recorded response (samples,) and the standard deviation of its noise.

    Readings are whole multiples of a hidden step, if there is one, and else of that of the world.
    """
    from scipy.signal import lfilter

    clean = rig.signal.value(rig.time)
    own = truth - clean if rig.based else truth
    middle = float(np.mean(truth))
    noise, size = rig.noise * float(np.std(own)), float(np.max(np.abs(truth - middle)))
    z = (truth - middle) / size
    bent = truth + size * (world.bend[0] * z**2 + world.bend[1] * z**3)
    white, slow = rng.standard_normal((2, len(truth)))
    slow = lfilter([math.sqrt(1.0 - world.memory**2)], [1.0, -world.memory], slow)
    hum = world.hum * np.cos(world.hum_pace * rig.time + float(rng.uniform(0.0, 2.0 * math.pi)))
    shown = bent + noise * (math.sqrt(1.0 - world.slow) * white + math.sqrt(world.slow) * slow + hum)
    step = hidden_step or world.step * noise
    return step * np.round(shown / step), noise


def draw_effect(name: str, pilot: Pilot, rng: np.random.Generator) -> Effect:
    """Return a mechanism of a random size; its force is a share of the force of inertia (`EFFECT_SIZES`)."""
    what = str(rng.choice(list(UNKNOWN))) if name == "unknown" else ""
    mechanism = UNKNOWN[what] if what else TABLE[name]
    at = str(rng.choice(mechanism.find_places(pilot.rig)))
    draft = mechanism.plan(pilot, at, rng)
    if name in NOISY:
        return Effect(name, at, draft.parameters(NOISY[name](pilot, float(rng.random()))))
    share = draw_log_uniform(rng, *EFFECT_SIZES)
    reference = float(np.std(pilot.q)) if draft.on_sensor else pilot.inertial_force
    size = share * reference / max(float(np.sqrt(np.mean(draft.force**2))), 1e-300)
    size *= rng.choice([-1.0, 1.0]) if mechanism.signed else 1.0
    return Effect(name, at, draft.parameters(float(size)), what)
