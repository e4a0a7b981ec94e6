"""Forces along a known trajectory, for `judge_oracle.py`: of hidden effects, and of the flaws of an imperfect rig."""

from __future__ import annotations

import math

import numba
import numpy as np
from scipy.signal import lfilter

from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.imperfect import (
    World,
    _compute_timed_force,
    _evaluate_over_time,
    _evaluate_waves,
)
from lostmotion_trials.blind.mechanisms import Effect, Pilot
from lostmotion_trials.integrators.hidden import Hidden, _drags, _levels, _pressing, _remembered, _springs

FINE = 20
"""Steps per sample of a force with memory, and of a lag."""
KNOWN_ERROR = 0.0043
"""Standard deviation of the relative error of a known value: its size is log-uniform from 0.001 to 0.01."""
LINE_LEFT = 0.3
"""Standard deviation of the constant and of the straight line that remain of a smooth force, over its rms."""
BEND_ERROR = 0.005 / math.sqrt(3.0)
"""Standard deviation of the bend of a sensor, which is uniform up to 0.005."""


@numba.njit(cache=True, nogil=True)
def _act(t, motion, base, force, body, hidden, nothing):  # type: ignore[no-untyped-def]
    """Return the force (samples,) of hidden springs, drags and dry friction along a motion (2, samples)."""
    told = np.zeros(len(t))
    for k in range(len(t)):
        x, v = motion[0, k], motion[1, k]
        gap, slide = x - base[0, k], v - base[1, k]
        told[k] = _springs(t[k], x, gap, body, hidden) - _springs(t[k], x, gap, body, nothing)
        told[k] += _drags(t[k], x, v, gap, slide, body, hidden)
        rub = slide if hidden.friction_place == 1.0 else v
        place = gap if hidden.friction_place == 1.0 else x
        ahead, back = _levels(t[k], rub, place, _pressing(force[k], gap, body), hidden)
        told[k] -= ahead if rub > 0.0 else -back
    return told


@numba.njit(cache=True, nogil=True)
def _remember(v, step, every, hidden, kind):  # type: ignore[no-untyped-def]
    """Return the force (samples,) with memory of a velocity (steps,); `kind` is its factor."""
    z, told = 0.0, np.zeros(len(v) // every)
    for k in range(len(v)):
        z = _remembered(z, v[k], step, hidden)
        if k % every == 0:
            told[k // every] = -z * kind
    return told


def compute_effect_force(effect: Effect, pilot: Pilot, operator: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """Return the force (samples,) of an effect along a trajectory, and the error of the sensor if that causes it."""
    hidden, outside = convert_effects(pilot.rig, (effect,))
    shown = compute_sensor_error(effect, pilot, outside)
    if shown is not None:
        return np.concatenate([[0.0], operator @ shown, [0.0]]), shown
    return compute_inner_force(hidden, pilot) + compute_drive_error(pilot, outside), None


def compute_inner_force(hidden: Hidden, pilot: Pilot) -> np.ndarray:
    """Return the force (samples,) of everything that acts on the body itself."""
    rig, t = pilot.rig, pilot.rig.time
    based = 1.0 if rig.based else 0.0
    base, motion = based * np.stack([pilot.u, pilot.du]), np.stack([pilot.q, pilot.v])
    told = _act(t, motion, base, (1.0 - based) * pilot.u, rig.body, hidden, Hidden())
    a = np.gradient(pilot.v, 1.0 / rig.rate)
    if hidden.memory > 0.0:
        v = pilot.v - base[1] if hidden.memory_place == 1.0 else pilot.v
        fine = np.interp(np.arange(len(v) * FINE) / FINE, np.arange(len(v)), v)
        kind = hidden.memory_force if hidden.memory == 3.0 else 1.0
        told += _remember(fine, 1.0 / (rig.rate * FINE), FINE, hidden, kind)
    if hidden.mode_mass > 0.0:
        told += compute_mode_force(hidden, pilot)
    return told - hidden.added * a * (t >= hidden.added_from)


def compute_mode_force(hidden: Hidden, pilot: Pilot) -> np.ndarray:
    """Return the force (samples,) of a hidden mass on the body, by its transfer function."""
    n = len(pilot.q)
    omega = 2.0 * math.pi * np.fft.rfftfreq(n, 1.0 / pilot.rig.rate)
    held = hidden.mode_stiffness + 1j * omega * hidden.mode_drag
    moved = held / (held - hidden.mode_mass * omega**2)
    return np.fft.irfft(hidden.mode_mass * omega**2 * moved * np.fft.rfft(pilot.q - pilot.q.mean()), n)


def compute_drive_error(pilot: Pilot, outside) -> np.ndarray:
    """Return the force (samples,) of the difference of the true drive and the recorded one."""
    rig, t, body = pilot.rig, pilot.rig.time, pilot.rig.body
    value, slope = outside.distort_drive(rig.signal, t)
    if outside.actuator_time > 0.0:
        fine = np.arange(-FINE * 50, FINE * len(t)) / (FINE * rig.rate)
        share = -math.expm1(-1.0 / (FINE * rig.rate * outside.actuator_time))
        raw = outside.distort_drive(rig.signal, fine)[0]
        late = lfilter([share], [1.0, share - 1.0], raw, zi=[(1.0 - share) * raw[0]])[0]
        value, slope = late[FINE * 50 :: FINE], ((raw - late) / outside.actuator_time)[FINE * 50 :: FINE]
    more, faster = value - pilot.u, slope - pilot.du
    return body.c * faster + body.k0 * np.abs(pilot.contact_sign) * more if rig.based else more


def compute_sensor_error(effect: Effect, pilot: Pilot, outside) -> np.ndarray | None:
    """Return the error (samples,) of a sensor; None for an effect that is none of the sensor."""
    if effect.mechanism in ("sensor_delay", "sensor_lag"):
        late, lag = outside.sensor_delay, outside.sensor_time
        return -(late + lag) * pilot.v + (0.5 * late**2 + lag**2) * np.gradient(pilot.v, 1.0 / pilot.rig.rate)
    if effect.mechanism == "sensor_gain":
        return outside.sensor_gain * pilot.q
    if effect.mechanism == "position_ripple":
        size, pitch, phase = outside.ripple
        return size * np.cos(2.0 * math.pi * pilot.q / pitch + phase)
    return None


def list_inner_forces(pilot: Pilot) -> dict[str, np.ndarray]:
    """Return the forces (samples,) of the model whose factors may be wrong: inertia, springs, contact."""
    body = pilot.rig.body
    x = pilot.compute_motion(pilot.gap_place)[0]
    pressed = np.sign(x) * np.maximum(np.abs(x) - body.x0, 0.0)
    contact = body.k0 * pressed if body.k0 else np.zeros(len(x))
    return {
        "m": body.m * np.gradient(pilot.v, 1.0 / pilot.rig.rate),
        "k": body.k * pilot.q,
        "k1": body.k * pilot.q,
        "k0": contact,
    }


def list_free_columns(pilot: Pilot) -> list[np.ndarray]:
    """Return the forces (samples,) of the parameters that the case estimates, each twice as large as they are."""
    body, (x, v) = pilot.rig.body, pilot.compute_motion(pilot.gap_place)
    free = [2.0 * body.c * v]
    if body.k0:
        free.append(2.0 * body.k0 * body.x0 * pilot.contact_sign)
    else:
        free.append(2.0 * body.k * x)
    return free


def compute_flaw_columns(pilot: Pilot, world: World, operator: np.ndarray) -> np.ndarray:
    """Return what flaws and free parameters may add to the force (samples, columns), each with a unit prior."""
    columns = list_free_columns(pilot)
    inner = list_inner_forces(pilot)
    columns += [KNOWN_ERROR * inner[name] for name in world.stated if name in inner]
    columns += [
        error * force for error, force in zip(*measure_sensor_flaws(pilot, world, operator, prior=True), strict=True)
    ]
    columns.append(compute_foot_force(pilot, world))
    for blemish in world.smooth:
        columns += list_smooth_columns(blemish.over, blemish.rms, pilot, world)
    return np.stack(columns, axis=1)


def compute_foot_force(pilot: Pilot, world: World) -> np.ndarray:
    """Return the change of the force (samples,) by the compliance of the foot, with its true stiffness, without lag."""
    body, inner = pilot.rig.body, list_inner_forces(pilot)
    if not body.k0:
        return np.zeros(len(pilot.q))
    return body.k0 * np.abs(pilot.contact_sign) * (inner["k0"] + inner["k1"]) / world.flaws["foot"]


def measure_sensor_flaws(pilot: Pilot, world: World, operator: np.ndarray, *, prior: bool) -> tuple[list, list]:
    """Return the sizes of bend and far mode, and their forces (samples,): those of the prior, or the true ones."""
    middle = float(np.mean(pilot.q))
    size = float(np.max(np.abs(pilot.q - middle)))
    z = (pilot.q - middle) / size
    inertial = list_inner_forces(pilot)["m"]
    errors = [size * z**2, size * z**3, world.flaws["far_compliance"] * inertial]
    forces = [np.concatenate([[0.0], operator @ error, [0.0]]) for error in errors]
    return ([BEND_ERROR, BEND_ERROR, 1.0] if prior else [*world.bend, 1.0]), forces


def list_smooth_columns(over: str, rms: float, pilot: Pilot, world: World) -> list[np.ndarray]:
    """Return the waves (samples,) of a smooth force, together of this expected rms without a straight line."""
    units = [(1.0, 0.0), (0.0, 1.0)]
    waves = [tuple(unit if k == j else (0.0, 0.0) for k in range(4)) for j in range(4) for unit in units]
    rig = pilot.rig
    shown = {"position": (pilot.q, world.flaws["position"]), "velocity": (pilot.v, world.flaws["velocity"])}
    told, rest = [], []
    for number, wave in enumerate(waves):
        order = number // 2 + 1
        if over in shown:
            moved, scale = shown[over]
            angle = 0.25 * math.pi * moved / scale + 0.25 * math.pi
            along = _evaluate_waves(wave, angle)
            line = np.column_stack([np.ones_like(moved), moved])
            along = along - line @ np.linalg.lstsq(line, along, rcond=None)[0]
        elif over == "phase":
            along = _evaluate_waves(wave, rig.signal.omega * rig.time)
        else:
            along = _evaluate_over_time(wave, rig.time / rig.time[-1])
        told.append(along / order)
    whole = math.sqrt(sum(float(np.mean(w**2)) for w in told))
    if over in shown:  # the generator removes the line along the motion without the effect, so a part of it remains
        moved = shown[over][0]
        rest = [LINE_LEFT * rms * np.ones_like(moved), LINE_LEFT * rms * moved / max(float(np.std(moved)), 1e-300)]
    return [rms / max(whole, 1e-300) * w for w in told] + rest


def compute_true_flaws(pilot: Pilot, world: World, operator: np.ndarray) -> np.ndarray:
    """Return the force (samples,) of the true flaws along the trajectory; friction over the speed is not in it."""
    z = {name: np.linspace(-3.0, 3.0, len(world.curves[name])) for name in ("position", "velocity")}
    total = np.interp(pilot.q / world.flaws["position"], z["position"], world.curves["position"])
    total += np.interp(pilot.v / world.flaws["velocity"], z["velocity"], world.curves["velocity"])
    total += _compute_timed_force(world, pilot.rig, pilot.rig.time)
    inner = list_inner_forces(pilot)
    total += sum((error - 1.0) * inner[name] for name, error in world.stated.items() if name in inner)
    total += sum(
        size * force for size, force in zip(*measure_sensor_flaws(pilot, world, operator, prior=False), strict=True)
    )
    return total + compute_foot_force(pilot, world)
