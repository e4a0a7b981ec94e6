"""The plans of a blind trial: the force of each mechanism along a motion, and its parameters at a size."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from lostmotion.contracts import Array
from lostmotion_trials.blind.pilot import EffectDraft, Pilot

Plan = Callable[[Pilot, str, np.random.Generator], EffectDraft]


def one(name: str, force: Callable[[Array, Array], Array]) -> Plan:
    """Return the plan of a mechanism of one parameter, a force of position and velocity relative to its place."""
    return lambda pilot, at, _rng: EffectDraft(force(*pilot.motion(at)), lambda size: {name: size})


def stribeck(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of dry friction that is larger near rest."""
    v = pilot.motion(at)[1]
    share, velocity = rng.uniform(0.3, 1.0), float(np.std(v)) * math.exp(rng.uniform(-3.0, -1.0))
    felt = np.sign(v) * (1.0 + share * np.exp(-((v / velocity) ** 2)))
    return EffectDraft(felt, lambda size: {"force": size, "excess": float(share * size), "velocity": velocity})


def bristle(*, excess: bool = False, name: str = "deflection", low: float = 0.01, high: float = 0.1) -> Plan:
    """Return the plan of friction with bristles, whose travel has a range in deviations of the position."""

    def plan(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
        x, v = pilot.motion(at)
        travel = float(np.std(x)) * math.exp(rng.uniform(math.log(low), math.log(high)))
        more = stribeck(pilot, at, rng).parameters(1.0) if excess else {}
        return EffectDraft(np.sign(v), lambda size: {"force": size, **grown(more, size), name: travel})

    return plan


def grown(more: Mapping[str, float], size: float) -> dict[str, float]:
    """Return the further parameters of friction at a size."""
    return {key: value * size if key == "excess" else value for key, value in more.items() if key != "force"}


def parametric(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a stiffness that pulsates."""
    ratio, phase, body = float(rng.integers(1, 3)), float(rng.uniform(0.0, 2.0 * math.pi)), pilot.rig.body
    x = pilot.motion(pilot.own)[0]
    spring = body.k0 * (x - body.x0 * pilot.touching) * np.abs(pilot.touching) if body.k0 else body.k * x
    wave = np.cos(ratio * pilot.rig.signal.omega * pilot.rig.time + phase)
    return EffectDraft(spring * wave, lambda size: {"depth": size, "phase": phase, "ratio": ratio})


def harmonic(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a harmonic of the drive."""
    ratio, phase = float(rng.integers(2, 4)), float(rng.uniform(0.0, 2.0 * math.pi))
    pace = ratio * pilot.rig.signal.omega
    angle = pace * pilot.rig.time + phase
    felt = driven(pilot, np.cos(angle), -pace * np.sin(angle))
    return EffectDraft(felt, lambda size: {"amplitude": size, "phase": phase, "ratio": ratio})


def driven(pilot: Pilot, value: Array, slope: Array) -> Array:
    """Return the force (samples,) of a change of the drive."""
    body = pilot.rig.body
    return body.c * slope + body.k0 * np.abs(pilot.touching) * value if pilot.rig.based else value


def late_drive(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a drive that is late."""
    bend = np.gradient(pilot.du, 1.0 / pilot.rig.rate)
    return EffectDraft(driven(pilot, pilot.du, bend), lambda size: {"delay": size})


def more_drive(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a drive of another gain."""
    return EffectDraft(driven(pilot, pilot.u, pilot.du), lambda size: {"error": size})


def late_sensor(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a sensor that is late."""
    if not pilot.rig.based:
        return late_drive(pilot, at, rng)
    return EffectDraft(pilot.v, lambda size: {"delay": size}, shown=True)


def more_sensor(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a sensor of another gain."""
    return EffectDraft(pilot.q, lambda size: {"error": size}, shown=True)


def drift(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a gap that grows."""
    return EffectDraft(pilot.rig.body.k0 * pilot.touching * pilot.rig.time, lambda size: {"rate": size})


def asymmetric(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a gap off its middle."""
    return EffectDraft(pilot.rig.body.k0 * np.abs(pilot.touching), lambda size: {"shift": size})


def contact_drag(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a drag in the contact."""
    slide = pilot.motion(pilot.own)[1]
    return EffectDraft(slide * np.abs(pilot.touching), lambda size: {"coefficient": size})


def narrowing(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a wave over position that narrows."""
    length = float(np.ptp(pilot.q)) / float(rng.uniform(2.0, 5.0))
    turns, chirp = pilot.q / length, float(rng.uniform(0.15, 0.3))
    felt = np.sin(2.0 * math.pi * turns * (1.0 + chirp * turns))
    return EffectDraft(felt, lambda size: {"force": size, "length": length, "chirp": chirp})


def rough(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of friction that grows with the square of position."""
    length = float(np.std(pilot.q))
    return EffectDraft(np.sign(pilot.v) * (pilot.q / length) ** 2, lambda size: {"force": size, "length": length})


def bump(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a bump at one position."""
    low, high = np.quantile(pilot.q, [0.2, 0.8])
    middle, width = float(rng.uniform(low, high)), float(0.08 * np.ptp(pilot.q))
    felt = np.exp(-(((pilot.q - middle) / width) ** 2))
    return EffectDraft(felt, lambda size: {"force": size, "middle": middle, "width": width})


def mixed(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a drag that grows with position."""
    return EffectDraft(pilot.q**2 * pilot.v, lambda size: {"coefficient": size})


def play(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return play in a spring: a gap of a size needs no shape."""
    stiff = pilot.rig.body.k
    return EffectDraft(stiff * np.sign(pilot.q), lambda size: {"gap": size})


def stop(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a stop at one end or at both."""
    side = float(rng.integers(-1, 2))
    reach = np.abs(pilot.q) if side == 0.0 else np.maximum(side * pilot.q, 0.0)
    travel = float(np.quantile(reach, rng.uniform(0.7, 0.95)))
    over = np.sign(pilot.q) * np.maximum(reach - travel, 0.0)
    return EffectDraft(over, lambda size: {"stiffness": size, "travel": travel, "side": side})


def crushed(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a drag that grows with the depth of the contact."""
    x, v = pilot.motion(pilot.own)
    return EffectDraft(np.maximum(np.abs(x) - pilot.rig.body.x0, 0.0) * v, lambda size: {"coefficient": size})


def curved(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a contact that stiffens."""
    x = pilot.motion(pilot.own)[0]
    depth = np.maximum(np.abs(x) - pilot.rig.body.x0, 0.0)
    return EffectDraft(np.sign(x) * depth**1.5, lambda size: {"coefficient": size})


def rattling(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return a hidden mass, whose force is that of its inertia: its acceleration is that of the body, and more."""
    ratio, damping = math.exp(rng.uniform(-0.7, 1.1)), float(rng.uniform(0.01, 0.06))
    rate = 1.0 / pilot.rig.rate
    frequency = ratio * float(np.std(pilot.v) / np.std(pilot.q)) / (2.0 * math.pi)
    frequency = min(frequency, pilot.rig.rate / 8.0)
    omega = 2.0 * math.pi * np.fft.rfftfreq(len(pilot.q), rate)
    w = 2.0 * math.pi * frequency
    held = (w**2 + 2j * damping * w * omega) / (w**2 - omega**2 + 2j * damping * w * omega)
    felt = np.fft.irfft(np.fft.rfft(pilot.q) * omega**2 * held, len(pilot.q))
    return EffectDraft(felt, lambda size: {"mass": size, "frequency": frequency, "damping": damping})


def two_ways(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of two levels of friction."""
    v, share = pilot.motion(at)[1], float(rng.uniform(0.2, 0.6))
    swap = bool(rng.integers(2))
    levels = (1.0, share) if swap else (share, 1.0)
    felt = np.where(v > 0.0, levels[0], -levels[1])
    told = lambda size: {"forward": levels[0] * size, "backward": levels[1] * size}  # noqa: E731
    return EffectDraft(felt, told, beside=(np.sign(v),))


def wavy(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of friction with a wave over position."""
    x, v = pilot.motion(at)
    pitch, share = float(np.ptp(x) / rng.uniform(3.0, 6.0)), float(rng.uniform(0.4, 0.9))
    phase = float(rng.uniform(0.0, 2.0 * math.pi))
    felt = np.sign(v) * (1.0 + share * np.cos(2.0 * math.pi * x / pitch + phase))
    told = lambda size: {"force": size, "wave": share * size, "pitch": pitch, "phase": phase}  # noqa: E731
    return EffectDraft(felt, told, beside=(np.sign(v),))


def loaded(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of friction that grows with the load."""
    x, v = pilot.motion(pilot.own)
    body = pilot.rig.body
    load = body.k0 * np.maximum(np.abs(x) - body.x0, 0.0) if body.k0 else np.abs(pilot.u)
    return EffectDraft(load * np.sign(v), lambda size: {"coefficient": size}, beside=(np.sign(v),))


def warming(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of friction that changes with time."""
    v, span = pilot.motion(at)[1], pilot.rig.samples / pilot.rig.rate
    share, time = float(rng.choice([-0.7, 1.5])), float(rng.uniform(0.15, 0.4)) * span
    level = 1.0 + share * (1.0 - np.exp(-pilot.rig.time / time))
    told = lambda size: {"force": size, "change": share * size, "time": time}  # noqa: E731
    return EffectDraft(np.sign(v) * level, told, beside=(np.sign(v),))


def aging(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a drag that grows."""
    return EffectDraft(pilot.rig.time * pilot.v, lambda size: {"rate": size})


def magnets(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a force with a wave over position."""
    pitch, phase = float(np.ptp(pilot.q) / rng.uniform(3.0, 12.0)), float(rng.uniform(0.0, 2.0 * math.pi))
    felt = np.sin(2.0 * math.pi * pilot.q / pitch + phase)
    return EffectDraft(felt, lambda size: {"force": size, "pitch": pitch, "phase": phase})


def heavier(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a mass that changes."""
    time = float(rng.uniform(0.2, 0.5)) * pilot.rig.samples / pilot.rig.rate
    felt = np.gradient(pilot.v, 1.0 / pilot.rig.rate) * (pilot.rig.time > time)
    return EffectDraft(felt, lambda size: {"change": size, "time": time})


def behind(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of an actuator that lags."""
    late = late_drive(pilot, at, rng)
    return EffectDraft(late.felt, lambda size: {"time": size})


def sensor_behind(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a sensor that lags."""
    return EffectDraft(pilot.v, lambda size: {"time": size}, shown=True)


def sensor_wave(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a sensor with a wave over what it shows."""
    pitch, phase = float(np.ptp(pilot.q) / rng.uniform(3.0, 8.0)), float(rng.uniform(0.0, 2.0 * math.pi))
    shown = np.cos(2.0 * math.pi * pilot.q / pitch + phase)
    return EffectDraft(shown, lambda size: {"size": size, "pitch": pitch, "phase": phase}, shown=True)


def limited(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return a drive that is cut: how much is lost says how low the limit is."""
    return _cut(pilot, lambda level: pilot.u - np.clip(pilot.u, -level, level), "limit", down=True)


def dead(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the plan of a drive with a dead zone."""
    return _cut(pilot, lambda level: np.clip(pilot.u, -level, level), "width", down=False)


LEVELS = np.linspace(0.02, 0.98, 60)
"""Levels of a cut, in peaks of the drive, among which the one of a wanted size is looked for."""


def _cut(pilot: Pilot, lost: Callable[[float], Array], name: str, *, down: bool) -> EffectDraft:
    """Return a mechanism whose size is a level: that at which the lost drive is `size` times what is lost halfway."""
    peak = float(np.max(np.abs(pilot.u)))
    sizes = np.array([float(np.std(lost(peak * level))) for level in LEVELS])
    middle = float(np.std(lost(0.5 * peak)))
    slope = np.gradient(lost(0.5 * peak), 1.0 / pilot.rig.rate)
    felt = driven(pilot, lost(0.5 * peak), slope)

    def told(size: float) -> dict[str, float]:
        order = slice(None, None, -1) if down else slice(None)
        level = float(np.interp(size * middle, sizes[order], LEVELS[order]))
        return {name: level * peak}

    return EffectDraft(felt, told)
