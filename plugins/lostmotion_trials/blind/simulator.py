"""Machines for a blind trial: drawn at random in size and excitation, and recorded by an integrator of their own."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import lfilter

from lostmotion.codec import described
from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion_trials.integrators.hidden import Body, Hidden, move

STEPS_PER_RATE = 0.0015
"""Steps times the fastest rate: a tenth of those of a final fit."""
LEAST_SUBSTEPS, MOST_SUBSTEPS = 10, 6000
PIECE_SAMPLES = 500
"""Samples that are computed at a time."""
SETTLING_PERIODS = 40
"""Periods of the drive that pass before a recording begins."""
REST_SAMPLES = 20
"""Samples before a recording that begins at rest."""
CYCLE_SAMPLES = 12.0
"""Samples to a cycle of the contact at the least."""
USUAL = 1e-3
"""Noise of the measured excitation over its amplitude."""
GAP_MODELS = ("lin_backlash", "robot_joint")
CHANNELS = ("position", "velocity", "acceleration")
LAG_STEPS = 20
"""Steps to a sample of a sensor that lags."""


@dataclass(frozen=True)
class BlindDrive:
    """A drive: tones, the first the strongest, that may rise in frequency; steps that stay; hits of one hump each."""

    tones: tuple[tuple[float, float, float], ...] = described(
        "amplitude, angular frequency (rad/s) and phase of each tone"
    )
    sweep: float = described(
        "rise of the frequency from the beginning of the recording on", unit="rad/s^2", default=0.0
    )
    steps: tuple[tuple[float, float, float], ...] = described("time (s), size and length (s) of each step", default=())
    hits: tuple[tuple[float, float, float], ...] = described("time (s), size and length (s) of each hit", default=())
    pace: float = described("angular frequency that says what is slow or fast without tones", unit="rad/s", default=0.0)

    @property
    def omega(self) -> float:
        """The angular frequency of the strongest tone, in rad/s."""
        return self.tones[0][1] if self.tones else self.pace

    @property
    def amplitude(self) -> float:
        """sqrt(2) standard deviations over a long time; of steps and hits the largest size."""
        events = max((abs(size) for _, size, _ in (*self.steps, *self.hits)), default=0.0)
        return max(math.sqrt(sum(a**2 for a, _, _ in self.tones)), events)

    def value(self, t: Array) -> Array:
        """Return the drive at the times `t` (s)."""
        more = 0.5 * self.sweep * np.maximum(t, 0.0) ** 2
        value = sum((a * np.cos(w * t + p + more) for a, w, p in self.tones), np.zeros(len(t)))
        for at, size, long in self.steps:
            value[t >= at] += size * _rise_smoothly((t[t >= at] - at) / long)[0]
        for at, size, long in self.hits:
            during = (t > at) & (t < at + long)
            value[during] += size * _shape_hump((t[during] - at) / long)[0]
        return np.asarray(value, dtype=float)

    def slope(self, t: Array) -> Array:
        """Return its time derivative."""
        late = np.maximum(t, 0.0)
        more = 0.5 * self.sweep * late**2
        slopes = (-a * (w + self.sweep * late) * np.sin(w * t + p + more) for a, w, p in self.tones)
        slope = sum(slopes, np.zeros(len(t)))
        for events, shape in ((self.steps, _rise_smoothly), (self.hits, _shape_hump)):
            for at, size, long in events:
                during = (t > at) & (t < at + long)
                slope[during] += size / long * shape((t[during] - at) / long)[1]
        return np.asarray(slope, dtype=float)

    def settling(self, rate: float) -> int:
        """Return how many samples pass before a recording begins: before steps and hits a machine is at rest."""
        return math.ceil(SETTLING_PERIODS * 2.0 * math.pi / self.omega * rate) if self.tones else REST_SAMPLES


def _rise_smoothly(z: Array) -> tuple[Array, Array]:
    """Return a smooth step from 0 to 1 over 0 < z < 1, and its slope."""
    at = np.clip(z, 0.0, 1.0)
    return at**3 * (10.0 - 15.0 * at + 6.0 * at**2), 30.0 * (at * (1.0 - at)) ** 2


def _shape_hump(z: Array) -> tuple[Array, Array]:
    """Return one hump of height 1 over 0 < z < 1, and its slope."""
    at = np.clip(z, 0.0, 1.0)
    return np.sin(math.pi * at) ** 2, math.pi * np.sin(2.0 * math.pi * at)


@dataclass(frozen=True)
class Meddling:
    """What a machine does to its drive, its sensors and itself that stands in no equation of motion; SI units."""

    excitation_delay: float = 0.0
    excitation_gain: float = 0.0
    harmonic: tuple[float, float, float] = (0.0, 0.0, 0.0)
    sensor_delay: float = 0.0
    sensor_gain: float = 0.0
    step: float = 0.0
    rms: float = 0.0
    limit: float = math.inf
    dead: float = 0.0
    actuator_time: float = 0.0
    sensor_time: float = 0.0
    ripple: tuple[float, float, float] = (0.0, 1.0, 0.0)

    def drive(self, signal: BlindDrive, t: Array) -> tuple[Array, Array]:
        """Return the true drive and its slope at the times `t` (s) where the recording will show `signal`.

        An actuator that lags is not part of it.
        """
        amplitude, pace, phase = self.harmonic
        late, gain = t - self.excitation_delay, 1.0 + self.excitation_gain
        value = gain * signal.value(late) + amplitude * np.cos(pace * t + phase)
        slope = gain * signal.slope(late) - amplitude * pace * np.sin(pace * t + phase)
        acts = (np.abs(value) < self.limit) & (np.abs(value) > self.dead)
        value = np.clip(value, -self.limit, self.limit) - np.clip(value, -self.dead, self.dead)
        return value, slope * acts

    def shown(self, seen: Array, rate: float) -> Array:
        """Return what a sensor shows (samples,) that lags and has a ripple over what it shows."""
        if self.sensor_time > 0.0:
            seen = _filter_lag(seen, rate, self.sensor_time)
        size, pitch, phase = self.ripple
        return np.asarray(seen + size * np.cos(2.0 * math.pi * seen / pitch + phase))


def _filter_lag(seen: Array, rate: float, time: float) -> Array:
    """Return samples behind a lag of first order with a time constant (s), by Euler's rule on a fine spline."""
    fine = np.arange(len(seen) * LAG_STEPS) / LAG_STEPS
    between = CubicSpline(np.arange(len(seen)), seen)(fine)
    share = -math.expm1(-1.0 / (rate * LAG_STEPS * time))
    middle = 0.5 * (between[1:] + between[:-1])
    lagged, _ = lfilter([share], [1.0, share - 1.0], middle, zi=[(1.0 - share) * between[0]])
    return np.asarray(np.concatenate([between[:1], lagged])[::LAG_STEPS])


@dataclass(frozen=True)
class WidePrior:
    """A wide prior over the logarithm of a parameter."""

    low: float = described("lower end of its range, in SI units")
    high: float = described("upper end of its range, in SI units")
    scale: str = described("`log`: its logarithm is uniform", default="log")


@dataclass(frozen=True)
class BlindMachine:
    """A machine, its drive and how it is recorded."""

    model: str = described("model of the machine")
    values: Mapping[str, float] = described("true parameters, in SI units")
    estimated: tuple[str, ...] = described("parameters that the case estimates")
    signal: BlindDrive = described("what drives it")
    rate: float = described("samples in a second", unit="Hz")
    samples: int = described("samples of the recording")
    noise: float = described("measurement noise over the deviation of its own motion")
    priors: Mapping[str, WidePrior] = described("what the case says of the parameters that it estimates", default={})
    channel: str = described("what the sensor shows: position, velocity or acceleration", default="position")

    @property
    def body(self) -> Body:
        """The parameters as the integrator takes them."""
        v = self.values
        return Body(v["m"], v["c"], v.get("k", v.get("k1", 0.0)), v.get("k0", 0.0), v.get("x0", 0.0))

    @property
    def based(self) -> bool:
        """Whether it is driven by the motion of its base."""
        return self.model == "robot_joint"

    @property
    def places(self) -> tuple[str, ...]:
        """Where a force may act."""
        return ("ground", "base") if self.based else ("ground",)

    @property
    def time(self) -> Array:
        """The time of each sample (samples,), in s."""
        return np.asarray(np.arange(self.samples) / self.rate)


def moved(rig: BlindMachine, hidden: Hidden, meddling: Meddling, rng: np.random.Generator) -> Array:
    """Return what a sensor without noise shows (samples,), after the machine has settled."""
    state = np.zeros(6)
    state[0] = find_start(rig)

    def follow(force: Array, base: Array, clock: tuple[float, float], every: int) -> Array:
        seen = np.asarray(move(force, base, rig.body, hidden, state, clock, every))  # type: ignore[no-untyped-call]
        return np.asarray(seen[:, CHANNELS.index(rig.channel)])

    return simulate_pieces(rig, meddling, rng, bound_pace(rig) / STEPS_PER_RATE, follow)


def bound_pace(rig: BlindMachine) -> float:
    """Return an upper bound of the rates (1/s) at which a machine moves."""
    return math.sqrt((rig.body.k + rig.body.k0) / rig.body.m) + rig.body.c / rig.body.m + rig.signal.omega


def find_start(rig: BlindMachine) -> float:
    """Return the position at which a machine begins, before it settles."""
    return float(rig.signal.value(np.array([-rig.signal.settling(rig.rate) / rig.rate]))[0]) if rig.based else 0.0


Follow = Callable[[Array, Array, tuple[float, float], int], Array]
"""Moves a machine on under a force (steps,) and the motion of its base (3, steps): position, velocity in the middle of
steps, velocity at their ends. Told when it begins and the step (s), and how many steps make a sample; returns what a
sensor shows at samples."""


def simulate_pieces(
    rig: BlindMachine,
    meddling: Meddling,
    rng: np.random.Generator,
    pace: float,
    follow: Follow,
    beside: Callable[[Array], Array | float] = lambda _middles: 0.0,
) -> Array:
    """Return what a sensor without noise shows (samples,), piece by piece, after the machine has settled.

    At least `pace` steps are made in a second. `beside` is a further force (N) at times (s). Raises `DataError` when
    the motion leaves all bounds.
    """
    every = int(min(max(math.ceil(pace / rig.rate), LEAST_SUBSTEPS), MOST_SUBSTEPS))
    settle = rig.signal.settling(rig.rate)
    step = 1.0 / (rig.rate * every)
    kicks, seen = meddling.rms * rng.standard_normal(settle + rig.samples), []
    behind = 0.0
    for first in range(-settle, rig.samples, PIECE_SAMPLES):
        count = min(PIECE_SAMPLES, rig.samples - first)
        begin = first / rig.rate - meddling.sensor_delay
        edges = np.asarray(begin + np.arange(count * every + 1) * step, dtype=float)
        middles = edges[:-1] + 0.5 * step
        value, slope = meddling.drive(rig.signal, middles)
        force = np.repeat(kicks[settle + first : settle + first + count], every) + beside(middles)
        base = np.zeros((3, len(value)))
        if rig.based:
            base[0], base[1], base[2] = value, slope, meddling.drive(rig.signal, edges[1:])[1]
        if meddling.actuator_time > 0.0:
            share = -math.expm1(-step / meddling.actuator_time)
            lagged, left = lfilter([share], [1.0, share - 1.0], value, zi=[behind])
            rates, behind, value = (value - lagged) / meddling.actuator_time, float(left[0]), lagged
            if rig.based:
                base[0], base[1] = lagged, rates
                base[2] = np.append(0.5 * (rates[1:] + rates[:-1]), rates[-1])
        seen.append(follow(force if rig.based else force + value, base, (begin, step), every))
    whole = np.concatenate(seen)
    if not np.isfinite(whole).all():
        raise DataError("the simulated motion left all bounds")
    return (1.0 + meddling.sensor_gain) * meddling.shown(whole, rig.rate)[settle:]


def draw_rig(rng: np.random.Generator, most: int) -> BlindMachine:
    """Return a machine of random size under a random drive, with recordings of `most` samples at most."""
    model = str(
        rng.choice(["lin_backlash", "robot_joint", "linear_oscillator", "rigid_drive"], p=[0.5, 0.3, 0.15, 0.05])
    )
    natural, mass = drawn_log(rng, 5.0, 300.0), drawn_log(rng, 0.05, 50.0)
    ratio = drawn_log(rng, *((0.12, 0.5) if model == "robot_joint" else (0.2, 1.2)))
    values, amplitude = sized(model, mass, natural, rng)
    signal = _draw_signal(amplitude, ratio * natural, rng, single=model in GAP_MODELS)
    top = max(w for _, w, _ in signal.tones)
    samples = round(drawn_log(rng, min(3000, most), most))
    period = max(drawn_log(rng, 20.0, 200.0), CYCLE_SAMPLES / ratio, CYCLE_SAMPLES * top / signal.omega)
    rate = period * signal.omega / (2.0 * math.pi)
    if rng.random() < 0.15:
        signal = BlindDrive(signal.tones[:1], float(rng.uniform(0.3, 1.0)) * signal.omega * rate / samples)
    estimated = {"linear_oscillator": ("c", "k"), "rigid_drive": ("m", "c")}.get(model, ("c", "x0"))
    priors = {name: wide_prior(values[name], rng) for name in estimated}
    return BlindMachine(model, values, estimated, signal, rate, samples, drawn_log(rng, 0.003, 0.1), priors)


def drawn_log(rng: np.random.Generator, low: float, high: float) -> float:
    """Return a number whose logarithm is uniform."""
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def sized(model: str, mass: float, natural: float, rng: np.random.Generator) -> tuple[dict[str, float], float]:
    """Return the parameters of a machine and the amplitude of its drive, in SI units."""
    stiff, zeta = mass * natural**2, drawn_log(rng, 0.01, 0.1)
    damping = 2.0 * zeta * mass * natural
    if model == "robot_joint":
        values = {
            "m": mass / 100.0,
            "c": damping / 100.0,
            "k0": stiff / 100.0,
            "x0": drawn_log(rng, 2e-3, 3e-2),
            "mgl": 0.0,
        }
        return values, drawn_log(rng, 1.5, 8.0) * values["x0"]
    length = drawn_log(rng, 1e-5, 1e-2)
    if model == "lin_backlash":
        values = {"m": mass, "c": damping, "k1": 0.0, "k0": stiff, "x0": length}
        return values, drawn_log(rng, 0.15, 2.0) * stiff * length
    if model == "linear_oscillator":
        return {"m": mass, "c": damping, "k": stiff}, stiff * length
    return {"m": mass, "c": 10.0 * damping}, stiff * length


def _draw_signal(amplitude: float, omega: float, rng: np.random.Generator, *, single: bool) -> BlindDrive:
    """Return one tone, or several that do not repeat; a machine without a gap needs several to tell anything."""
    tones = [(amplitude, omega, float(rng.uniform(0.0, 2.0 * math.pi)))]
    if not single or rng.random() < 0.3:
        for low, high in ((0.3, 0.7), (1.4, 2.2)):
            share, pace, phase = rng.uniform(0.2, 0.6), rng.uniform(low, high), rng.uniform(0.0, 2.0 * math.pi)
            tones.append((float(share) * amplitude, float(pace) * omega, float(phase)))
    return BlindDrive(tuple(tones))


def wide_prior(value: float, rng: np.random.Generator) -> WidePrior:
    """Return a wide prior that holds a value, anywhere but near its ends."""
    below, above = 10.0 ** rng.uniform(0.4, 1.2, 2)
    return WidePrior(_round_digits(value / below), _round_digits(value * above))


def _round_digits(value: float) -> float:
    return float(f"{value:.3g}")
