"""Plans of hidden mechanisms: the force of each mechanism along a motion, and its parameters at a given size."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from lostmotion.contracts import Array
from lostmotion_trials.blind.pilot import EffectDraft, Pilot

Plan = Callable[[Pilot, str, np.random.Generator], EffectDraft]
"""Makes the draft of a mechanism from the motion without it, the place at which it acts, and a random generator."""


def make_force_plan(name: str, force: Callable[[Array, Array], Array]) -> Plan:
    """Return the plan of a mechanism of one parameter: a force of position and velocity relative to its place."""
    return lambda pilot, at, _rng: EffectDraft(force(*pilot.compute_motion(at)), lambda size: {name: size})


def plan_stribeck(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of dry friction that is larger at low speed."""
    v = pilot.compute_motion(at)[1]
    share, velocity = rng.uniform(0.3, 1.0), float(np.std(v)) * math.exp(rng.uniform(-3.0, -1.0))
    force = np.sign(v) * (1.0 + share * np.exp(-((v / velocity) ** 2)))
    return EffectDraft(force, lambda size: {"force": size, "excess": float(share * size), "velocity": velocity})


def make_bristle_plan(*, excess: bool = False, name: str = "deflection", low: float = 0.01, high: float = 0.1) -> Plan:
    """Return the plan of bristle friction; `low` and `high` bound its travel in standard deviations of the position.

    `name` is the parameter of the travel. With `excess` the friction is larger at low speed, as in `plan_stribeck`.
    """

    def plan(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
        x, v = pilot.compute_motion(at)
        travel = float(np.std(x)) * math.exp(rng.uniform(math.log(low), math.log(high)))
        more = plan_stribeck(pilot, at, rng).parameters(1.0) if excess else {}
        return EffectDraft(np.sign(v), lambda size: {"force": size, **_scale_parameters(more, size), name: travel})

    return plan


def _scale_parameters(more: Mapping[str, float], size: float) -> dict[str, float]:
    """Return the further parameters of friction at a size (N): only the excess is proportional to it."""
    return {key: value * size if key == "excess" else value for key, value in more.items() if key != "force"}


def plan_parametric_stiffness(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a stiffness that varies with the phase of the drive."""
    ratio, phase, body = float(rng.integers(1, 3)), float(rng.uniform(0.0, 2.0 * math.pi)), pilot.rig.body
    x = pilot.compute_motion(pilot.gap_place)[0]
    spring = body.k0 * (x - body.x0 * pilot.contact_sign) * np.abs(pilot.contact_sign) if body.k0 else body.k * x
    wave = np.cos(ratio * pilot.rig.signal.omega * pilot.rig.time + phase)
    return EffectDraft(spring * wave, lambda size: {"depth": size, "phase": phase, "ratio": ratio})


def plan_drive_harmonic(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a harmonic of the drive."""
    ratio, phase = float(rng.integers(2, 4)), float(rng.uniform(0.0, 2.0 * math.pi))
    pace = ratio * pilot.rig.signal.omega
    angle = pace * pilot.rig.time + phase
    force = _compute_drive_force(pilot, np.cos(angle), -pace * np.sin(angle))
    return EffectDraft(force, lambda size: {"amplitude": size, "phase": phase, "ratio": ratio})


def _compute_drive_force(pilot: Pilot, value: Array, slope: Array) -> Array:
    """Return the force (samples,) of a change of the drive with this value and time derivative (samples,)."""
    body = pilot.rig.body
    return body.c * slope + body.k0 * np.abs(pilot.contact_sign) * value if pilot.rig.based else value


def plan_drive_delay(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a delay of the drive."""
    bend = np.gradient(pilot.du, 1.0 / pilot.rig.rate)
    return EffectDraft(_compute_drive_force(pilot, pilot.du, bend), lambda size: {"delay": size})


def plan_drive_gain(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a gain error of the drive."""
    return EffectDraft(_compute_drive_force(pilot, pilot.u, pilot.du), lambda size: {"error": size})


def plan_sensor_delay(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a delay of the sensor; without a moving base it equals a delay of the drive."""
    if not pilot.rig.based:
        return plan_drive_delay(pilot, at, rng)
    return EffectDraft(pilot.v, lambda size: {"delay": size}, on_sensor=True)


def plan_sensor_gain(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a gain error of the sensor."""
    return EffectDraft(pilot.q, lambda size: {"error": size}, on_sensor=True)


def plan_gap_drift(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a gap that grows with time."""
    return EffectDraft(pilot.rig.body.k0 * pilot.contact_sign * pilot.rig.time, lambda size: {"rate": size})


def plan_gap_shift(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a gap that is not centred."""
    return EffectDraft(pilot.rig.body.k0 * np.abs(pilot.contact_sign), lambda size: {"shift": size})


def plan_contact_damping(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of viscous damping in the contact."""
    slide = pilot.compute_motion(pilot.gap_place)[1]
    return EffectDraft(slide * np.abs(pilot.contact_sign), lambda size: {"coefficient": size})


def plan_narrowing_wave(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a wave over position whose wavelength decreases."""
    length = float(np.ptp(pilot.q)) / float(rng.uniform(2.0, 5.0))
    turns, chirp = pilot.q / length, float(rng.uniform(0.15, 0.3))
    force = np.sin(2.0 * math.pi * turns * (1.0 + chirp * turns))
    return EffectDraft(force, lambda size: {"force": size, "length": length, "chirp": chirp})


def plan_rough_friction(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of friction that grows with the square of position."""
    length = float(np.std(pilot.q))
    return EffectDraft(np.sign(pilot.v) * (pilot.q / length) ** 2, lambda size: {"force": size, "length": length})


def plan_bump(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a force bump at one position."""
    low, high = np.quantile(pilot.q, [0.2, 0.8])
    middle, width = float(rng.uniform(low, high)), float(0.08 * np.ptp(pilot.q))
    force = np.exp(-(((pilot.q - middle) / width) ** 2))
    return EffectDraft(force, lambda size: {"force": size, "middle": middle, "width": width})


def plan_position_drag(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of viscous damping that grows with the square of position."""
    return EffectDraft(pilot.q**2 * pilot.v, lambda size: {"coefficient": size})


def plan_backlash(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a gap in a spring."""
    stiff = pilot.rig.body.k
    return EffectDraft(stiff * np.sign(pilot.q), lambda size: {"gap": size})


def plan_end_stop(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of an end stop at one end or at both ends."""
    side = float(rng.integers(-1, 2))
    reach = np.abs(pilot.q) if side == 0.0 else np.maximum(side * pilot.q, 0.0)
    travel = float(np.quantile(reach, rng.uniform(0.7, 0.95)))
    over = np.sign(pilot.q) * np.maximum(reach - travel, 0.0)
    return EffectDraft(over, lambda size: {"stiffness": size, "travel": travel, "side": side})


def plan_hunt_crossley(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of viscous damping that grows with the depth of the contact."""
    x, v = pilot.compute_motion(pilot.gap_place)
    return EffectDraft(np.maximum(np.abs(x) - pilot.rig.body.x0, 0.0) * v, lambda size: {"coefficient": size})


def plan_hertz(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a contact force with exponent 1.5 of the depth."""
    x = pilot.compute_motion(pilot.gap_place)[0]
    depth = np.maximum(np.abs(x) - pilot.rig.body.x0, 0.0)
    return EffectDraft(np.sign(x) * depth**1.5, lambda size: {"coefficient": size})


def plan_hidden_mode(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a hidden mass on a spring: the force is that of its inertia, amplified near its resonance."""
    ratio, damping = math.exp(rng.uniform(-0.7, 1.1)), float(rng.uniform(0.01, 0.06))
    rate = 1.0 / pilot.rig.rate
    frequency = ratio * float(np.std(pilot.v) / np.std(pilot.q)) / (2.0 * math.pi)
    frequency = min(frequency, pilot.rig.rate / 8.0)
    omega = 2.0 * math.pi * np.fft.rfftfreq(len(pilot.q), rate)
    w = 2.0 * math.pi * frequency
    transfer = (w**2 + 2j * damping * w * omega) / (w**2 - omega**2 + 2j * damping * w * omega)
    force = np.fft.irfft(np.fft.rfft(pilot.q) * omega**2 * transfer, len(pilot.q))
    return EffectDraft(force, lambda size: {"mass": size, "frequency": frequency, "damping": damping})


def plan_directional_friction(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of friction with a different level in each direction."""
    v, share = pilot.compute_motion(at)[1], float(rng.uniform(0.2, 0.6))
    swap = bool(rng.integers(2))
    levels = (1.0, share) if swap else (share, 1.0)
    force = np.where(v > 0.0, levels[0], -levels[1])
    parameters = lambda size: {"forward": levels[0] * size, "backward": levels[1] * size}  # noqa: E731
    return EffectDraft(force, parameters, simpler=(np.sign(v),))


def plan_position_friction(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of friction whose level is a wave over position."""
    x, v = pilot.compute_motion(at)
    pitch, share = float(np.ptp(x) / rng.uniform(3.0, 6.0)), float(rng.uniform(0.4, 0.9))
    phase = float(rng.uniform(0.0, 2.0 * math.pi))
    force = np.sign(v) * (1.0 + share * np.cos(2.0 * math.pi * x / pitch + phase))
    parameters = lambda size: {"force": size, "wave": share * size, "pitch": pitch, "phase": phase}  # noqa: E731
    return EffectDraft(force, parameters, simpler=(np.sign(v),))


def plan_load_friction(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of friction proportional to the load."""
    x, v = pilot.compute_motion(pilot.gap_place)
    body = pilot.rig.body
    load = body.k0 * np.maximum(np.abs(x) - body.x0, 0.0) if body.k0 else np.abs(pilot.u)
    return EffectDraft(load * np.sign(v), lambda size: {"coefficient": size}, simpler=(np.sign(v),))


def plan_friction_drift(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of friction whose level approaches another value exponentially in time."""
    v, span = pilot.compute_motion(at)[1], pilot.rig.samples / pilot.rig.rate
    share, time = float(rng.choice([-0.7, 1.5])), float(rng.uniform(0.15, 0.4)) * span
    level = 1.0 + share * (1.0 - np.exp(-pilot.rig.time / time))
    parameters = lambda size: {"force": size, "change": share * size, "time": time}  # noqa: E731
    return EffectDraft(np.sign(v) * level, parameters, simpler=(np.sign(v),))


def plan_damping_drift(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of viscous damping that grows with time."""
    return EffectDraft(pilot.rig.time * pilot.v, lambda size: {"rate": size})


def plan_cogging(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a force that is a wave over position."""
    pitch, phase = float(np.ptp(pilot.q) / rng.uniform(3.0, 12.0)), float(rng.uniform(0.0, 2.0 * math.pi))
    force = np.sin(2.0 * math.pi * pilot.q / pitch + phase)
    return EffectDraft(force, lambda size: {"force": size, "pitch": pitch, "phase": phase})


def plan_inertia_change(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a mass that changes at one time."""
    time = float(rng.uniform(0.2, 0.5)) * pilot.rig.samples / pilot.rig.rate
    force = np.gradient(pilot.v, 1.0 / pilot.rig.rate) * (pilot.rig.time > time)
    return EffectDraft(force, lambda size: {"change": size, "time": time})


def plan_actuator_lag(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a first-order lag of the actuator; for small lags it equals a delay."""
    late = plan_drive_delay(pilot, at, rng)
    return EffectDraft(late.force, lambda size: {"time": size})


def plan_sensor_lag(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a first-order lag of the sensor."""
    return EffectDraft(pilot.v, lambda size: {"time": size}, on_sensor=True)


def plan_sensor_ripple(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a sensor error that is a wave over its reading."""
    pitch, phase = float(np.ptp(pilot.q) / rng.uniform(3.0, 8.0)), float(rng.uniform(0.0, 2.0 * math.pi))
    shown = np.cos(2.0 * math.pi * pilot.q / pitch + phase)
    return EffectDraft(shown, lambda size: {"size": size, "pitch": pitch, "phase": phase}, on_sensor=True)


def plan_saturation(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a drive that saturates; its size is the part of the drive that is lost."""
    return _plan_cut(pilot, lambda level: pilot.u - np.clip(pilot.u, -level, level), "limit", down=True)


def plan_dead_zone(pilot: Pilot, at: str, rng: np.random.Generator) -> EffectDraft:
    """Return the draft of a drive with a dead zone."""
    return _plan_cut(pilot, lambda level: np.clip(pilot.u, -level, level), "width", down=False)


LEVELS = np.linspace(0.02, 0.98, 60)
"""Levels of a cut, as shares of the peak of the drive, between which the level for a given size is interpolated."""


def _plan_cut(pilot: Pilot, lost: Callable[[float], Array], name: str, *, down: bool) -> EffectDraft:
    """Return the draft of a cut drive; at size 1 the lost part is as large as with a level of half the peak.

    `lost` returns the lost drive (samples,) at a level, `name` is the parameter of the level, and `down` states that
    more is lost at lower levels.
    """
    peak = float(np.max(np.abs(pilot.u)))
    sizes = np.array([float(np.std(lost(peak * level))) for level in LEVELS])
    middle = float(np.std(lost(0.5 * peak)))
    slope = np.gradient(lost(0.5 * peak), 1.0 / pilot.rig.rate)
    force = _compute_drive_force(pilot, lost(0.5 * peak), slope)

    def find_level(size: float) -> dict[str, float]:
        order = slice(None, None, -1) if down else slice(None)
        level = float(np.interp(size * middle, sizes[order], LEVELS[order]))
        return {name: level * peak}

    return EffectDraft(force, find_level)
