"""What an expert reads off recordings of real rigs without a model of ours: least squares, Hilbert transform, momentum.

Each function returns named numbers with units, for tests and for `benchmarks/gallery.py`; `data` is where the
recordings lie.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
from rigs import BLOCKS, RUNS, Array, beam_signal, bistable_signal, motor_signal, wheel_signal
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import minimize
from scipy.signal import savgol_filter

Numbers = Mapping[str, tuple[float, str]]
EARLY, LATE = (0.3, 0.6), (1.2, 1.49)
"""Two stretches (s) of the ringing beam, at large and at small amplitude; the second ends where the fit ends."""
MOVING = 5.0
"""Above this speed (rad/s) the shaft of the motor drive turns for sure, and does not stick."""


def motors(data: Path) -> Numbers:
    """Return inertia, viscous friction, dry friction and constant torque of the motor drive, by least squares.

    Over all four runs: torque = J dw/dt + B w + friction sign(w) - constant, derivatives by cubics over 31 samples.
    """
    rows, torques = [], []
    for run in RUNS:
        _, torque, velocity = motor_signal(data, run)
        smooth, slope = (savgol_filter(velocity, 31, 3, deriv=d, delta=1e-3) for d in (0, 1))
        used = np.abs(smooth) > MOVING
        rows.append(np.stack([slope, smooth, np.sign(smooth), -np.ones_like(smooth)], axis=1)[used])
        torques.append(torque[used])
    a, b = np.vstack(rows), np.concatenate(torques)
    found = np.linalg.lstsq(a, b, rcond=None)[0]
    names = ("inertia", "viscous friction", "dry friction", "constant torque")
    units = ("kg m^2", "N m s/rad", "N m", "N m")
    named = {name: (float(x), unit) for name, x, unit in zip(names, found, units, strict=True)}
    return named | {"torque left over, rms": (float(np.std(b - a @ found)), "N m")}


def motor(data: Path) -> Numbers:
    """Return viscous friction and the torque beyond it, from the two steady speeds of the first run."""
    time, torque, velocity = motor_signal(data, RUNS[0])
    ends = [(time >= start) & (time < start + 2.0) for start in (8.0, 18.0)]
    (slow, low), (fast, high) = ((velocity[part].mean(), torque[part].mean()) for part in ends)
    viscous = float((high - low) / (fast - slow))
    return {"viscous friction": (viscous, "N m s/rad"), "torque beyond it": (float(low - viscous * slow), "N m")}


def beam(data: Path) -> Numbers:
    """Return frequency and damping ratio of the first mode early and late, by the Hilbert transform."""
    t, wave = beam_signal(data)
    numbers = {}
    for name, (start, end) in {"early": EARLY, "late": LATE, "whole": (EARLY[0], LATE[1])}.items():
        part = (t > start) & (t < end)
        omega = np.polyfit(t[part], np.unwrap(np.angle(wave[part])), 1)[0]
        fade = -np.polyfit(t[part], np.log(np.abs(wave[part])), 1)[0]
        numbers[f"frequency, {name}"] = (float(omega / (2.0 * math.pi)), "Hz")
        numbers[f"damping ratio, {name}"] = (float(fade / omega), "")
    return numbers


def wheel(data: Path) -> Numbers:
    """Return friction and inertia (torques as currents) of the geared wheel, from deceleration and momentum."""
    t, angle, current = wheel_signal(data)
    coasting, speeding = (t > 3.2) & (t < 3.65), (t > 0.86) & (t < 1.0)
    slope = np.polyfit(t[coasting], np.deg2rad(angle[coasting]), 2)[0] * 2.0
    ending = (t > 0.97) & (t < 1.0)
    gained = np.polyfit(t[ending], np.deg2rad(angle[ending]), 1)[0]
    impulse, rested = float(current[speeding].mean() * 0.14), float(current[coasting].mean())
    inertia = impulse / (gained - slope * 0.14)
    return {"friction": (rested - inertia * slope, "A"), "inertia": (inertia, "A s^2")}


def bistable(data: Path, which: str = "asymmetric") -> Numbers:
    """Return the factor of the base's acceleration and the three rests of the bistable beam, by least squares.

    The acceleration is regressed on velocity, voltage of the piezo, position and its square and cube, one, and the
    acceleration of the base; the position at which each block begins is searched for.
    """
    parts = [bistable_signal(data, which, block) for block in BLOCKS]

    def solved(begun: Array) -> tuple[float, Array]:
        rows, slopes = [], []
        for (t, base, velocity, piezo), start in zip(parts, begun, strict=True):
            x = cumulative_trapezoid(velocity, t, initial=0.0)
            x += 0.01 * start - x.mean()
            rows.append(np.stack([9.80665 * base, velocity, piezo, x**3, x**2, x, np.ones_like(x)], axis=1))
            slopes.append(savgol_filter(velocity, 5, 3, deriv=1, delta=t[1] - t[0]))
        a, b = np.vstack(rows), np.concatenate(slopes)
        found = np.linalg.lstsq(a, b, rcond=None)[0]
        return float(np.std(b - a @ found) / np.std(b)), found

    simplex = np.vstack([np.zeros(len(parts)), 0.5 * np.eye(len(parts))])
    options = {"initial_simplex": simplex, "xatol": 1e-3, "maxiter": 500}
    best = minimize(lambda z: solved(z)[0], simplex[0], method="Nelder-Mead", options=options)
    left, found = solved(best.x)
    rests = sorted(float(root.real) for root in np.roots(found[3:]) if abs(root.imag) < 1e-9)
    return {
        "factor of the base acceleration": (float(-found[0]), ""),
        **{f"rest {i + 1}": (1e3 * rest, "mm") for i, rest in enumerate(rests)},
        "acceleration left over": (100.0 * left, "%"),
    }


READ: Mapping[str, Callable[[Path], Numbers]] = {
    "motor_run": motor,
    "motor_drive": motors,
    "reuss_beam": beam,
    "bistable_beam": bistable,
    "gear_wheel": wheel,
}
"""What is read off by hand, by the name that a case has in the gallery."""
