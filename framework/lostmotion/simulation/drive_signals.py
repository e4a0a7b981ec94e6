"""Drives of a simulated machine: signals with exact derivatives, made from texts such as `harmonic:omega=40`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from lostmotion.contracts import Array
from lostmotion.errors import CaseError, nearest

Function = Callable[[Array], Array]
LINES, KNOTS = 10_000, 10_000_000
"""The greatest number of lines of a multisine, and of random values of noise."""


@dataclass(frozen=True)
class DriveSignal:
    """A function of time (s) and its exact derivative, both of arrays; `top` (Hz) is its highest frequency."""

    value: Function
    slope: Function
    top: float

    def __add__(self, other: DriveSignal) -> DriveSignal:
        top = max(self.top, other.top)
        return DriveSignal(lambda t: self.value(t) + other.value(t), lambda t: self.slope(t) + other.slope(t), top)


def signal_of(text: str, *, duration: float, rng: np.random.Generator) -> DriveSignal:
    """Return the signal of a text `kind:key=value,...`; `rng` draws phases and noise."""
    kind, _, rest = text.partition(":")
    if kind not in KINDS:
        raise CaseError(f"there is no drive {kind!r}{nearest(kind, KINDS)}: the drives are {', '.join(KINDS)}")
    make, keys, defaults = KINDS[kind]
    options = parse_pairs(rest, f"drive {text!r}")
    for key in options:
        if key not in keys:
            raise CaseError(f"drive {kind} has no {key!r}{nearest(key, keys)}: it has {', '.join(keys)}")
    return make(Options(kind, {**defaults, **options}), duration, rng)


def parse_pairs(text: str, whose: str) -> dict[str, str]:
    """Return `key=value,key=value` as a dictionary; `whose` begins the message of the `CaseError` for another text."""
    found: dict[str, str] = {}
    for piece in filter(None, text.split(",")):
        key, equals, value = (part.strip() for part in piece.partition("="))
        if not equals or not key or not value:
            raise CaseError(f"{whose} has {piece!r}: write key=value, with commas between several")
        if key in found:
            raise CaseError(f"{whose} gives {key} twice: keep one")
        found[key] = value
    return found


def parse_number(text: str, whose: str) -> float:
    """Return a finite number; raise `CaseError` with a sentence that begins with `whose` for another text."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise CaseError(f"{whose} is {text!r}: expected a finite number, such as 0.5 or 4e4")
    return value


@dataclass(frozen=True)
class Options:
    """The options of one drive, with access as numbers."""

    kind: str
    texts: Mapping[str, str]

    def number(self, key: str, *, positive: bool = False) -> float:
        """Return the number of `key`; raise `CaseError` where it is missing."""
        if key not in self.texts:
            raise CaseError(f"drive {self.kind} lacks {key}: write {self.kind}:{key}=...")
        value = parse_number(self.texts[key], f"{key} of drive {self.kind}")
        if positive and value <= 0.0:
            raise CaseError(f"{key} of drive {self.kind} is {value:g}: expected more than zero")
        return value

    def shares(self) -> list[float]:
        """Return the amplitudes of the second, third, ... harmonic as shares of the first."""
        text = self.texts["harmonics"]
        return [parse_number(part, f"harmonics of drive {self.kind}") for part in text.split("/") if part]

    def omega(self) -> float:
        """Return the angular frequency (rad/s), given as `omega` or as `frequency` (Hz)."""
        if ("omega" in self.texts) == ("frequency" in self.texts):
            found = "both omega and frequency" if "omega" in self.texts else "neither omega nor frequency"
            raise CaseError(f"drive {self.kind} has {found}: give one, omega in rad/s or frequency in Hz")
        if "omega" in self.texts:
            return self.number("omega", positive=True)
        return 2.0 * math.pi * self.number("frequency", positive=True)

    def band(self) -> tuple[float, float]:
        """Return `low` and `high` (Hz), in this order."""
        low, high = self.number("low", positive=True), self.number("high", positive=True)
        if low >= high:
            raise CaseError(f"drive {self.kind} has low = {low:g} and high = {high:g}: low must be below high")
        return low, high


def _sum_waves(waves: Sequence[tuple[float, float, float]]) -> DriveSignal:
    """Return the sum of `amplitude * cos(omega t + phase)`."""
    return DriveSignal(
        lambda t: sum((a * np.cos(w * t + f) for a, w, f in waves), np.zeros(len(t))),
        lambda t: sum((-a * w * np.sin(w * t + f) for a, w, f in waves), np.zeros(len(t))),
        max((w for a, w, _ in waves if a), default=0.0) / (2.0 * math.pi),
    )


def _make_harmonic(options: Options, duration: float, rng: np.random.Generator) -> DriveSignal:
    """Return amplitude * cos(omega t + phase) with shares of its harmonics, all with a maximum at the same time."""
    amplitude, omega, phase = options.number("amplitude"), options.omega(), options.number("phase")
    return _sum_waves([(amplitude * s, n * omega, n * phase) for n, s in enumerate([1.0, *options.shares()], start=1)])


def _make_sweep(options: Options, duration: float, rng: np.random.Generator) -> DriveSignal:
    """Return a sine whose frequency changes linearly from `start` to `stop` (Hz) over the duration."""
    amplitude = options.number("amplitude")
    first, last = (2.0 * math.pi * options.number(key, positive=True) for key in ("start", "stop"))
    pace = (last - first) / duration
    return DriveSignal(
        lambda t: amplitude * np.sin((first + 0.5 * pace * t) * t),
        lambda t: amplitude * (first + pace * t) * np.cos((first + 0.5 * pace * t) * t),
        max(first, last) / (2.0 * math.pi),
    )


def _make_multisine(options: Options, duration: float, rng: np.random.Generator) -> DriveSignal:
    """Return lines of equal amplitude from `low` to `high` (Hz) with random phases."""
    rms, lines = options.number("rms"), options.number("lines", positive=True)
    if lines != round(lines) or lines > LINES:
        raise CaseError(f"lines of drive multisine is {lines:g}: expected a whole number up to {LINES}")
    omegas = 2.0 * math.pi * np.linspace(*options.band(), round(lines))
    phases = rng.uniform(0.0, 2.0 * math.pi, len(omegas))
    amplitude = rms * math.sqrt(2.0 / len(omegas))
    return _sum_waves([(amplitude, w, f) for w, f in zip(omegas.tolist(), phases.tolist(), strict=True)])


def _make_step(options: Options, duration: float, rng: np.random.Generator) -> DriveSignal:
    """Return a step of `size` at the time `at` (s), which rises smoothly within `rise` (s)."""
    size, at, rise = options.number("size"), options.number("at"), options.number("rise", positive=True)

    def share(t: Array) -> Array:
        return np.clip((t - at) / rise, 0.0, 1.0)

    return DriveSignal(
        lambda t: size * share(t) ** 3 * (10.0 - 15.0 * share(t) + 6.0 * share(t) ** 2),
        lambda t: size / rise * 30.0 * (share(t) * (1.0 - share(t))) ** 2,
        0.0,
    )


def _make_noise(options: Options, duration: float, rng: np.random.Generator) -> DriveSignal:
    """Return a spline through normal random values, with little power above `bandwidth` (Hz)."""
    rms, bandwidth = options.number("rms"), options.number("bandwidth", positive=True)
    if 2.0 * bandwidth * duration > KNOTS:
        raise CaseError(f"drive noise up to {bandwidth:g} Hz for {duration:g} s is too long: lower the bandwidth")
    knots = np.arange(math.ceil(2.0 * bandwidth * duration) + 8) / (2.0 * bandwidth)
    values = rng.standard_normal(len(knots))
    spline = CubicSpline(knots, rms * values / values.std())
    return DriveSignal(spline, spline.derivative(), bandwidth)


Maker = Callable[[Options, float, np.random.Generator], DriveSignal]
KINDS: Mapping[str, tuple[Maker, tuple[str, ...], Mapping[str, str]]] = {
    "harmonic": (
        _make_harmonic,
        ("amplitude", "omega", "frequency", "phase", "harmonics"),
        {"phase": "0", "harmonics": ""},
    ),
    "sweep": (_make_sweep, ("amplitude", "start", "stop"), {}),
    "multisine": (_make_multisine, ("rms", "low", "high", "lines"), {"lines": "20"}),
    "step": (_make_step, ("size", "at", "rise"), {"at": "0", "rise": "0.01"}),
    "noise": (_make_noise, ("rms", "bandwidth"), {}),
}
"""For each kind of drive: its function, its keys, and the default values of optional keys."""
