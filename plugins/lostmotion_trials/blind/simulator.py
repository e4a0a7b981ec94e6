"""Random machines for a blind trial, simulated by an integrator that shares no code with the framework."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import lfilter

from lostmotion.codec import described
from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion_trials.integrators.hidden import Body, Hidden, move

STEPS_PER_RATE = 0.0015
"""Integration step times the fastest rate: a tenth of that of a final fit."""
LEAST_SUBSTEPS, MOST_SUBSTEPS = 10, 6000
"""Bounds of the integration steps per sample."""
PIECE_SAMPLES = 500
"""Samples that are computed in one call."""
SETTLING_PERIODS = 40
"""Periods of the drive that pass before a recording begins."""
REST_SAMPLES = 20
"""Samples before a recording that begins at rest."""
CYCLE_SAMPLES = 12.0
"""Least number of samples per cycle of the contact and of the fastest tone."""
EXCITATION_NOISE = 1e-3
"""Noise of the measured excitation over its amplitude."""
GAP_MODELS = ("lin_backlash", "robot_joint")
"""Models with a gap."""
CHANNELS = ("position", "velocity", "acceleration")
LAG_STEPS = 20
"""Integration steps per sample of a sensor that lags."""


@dataclass(frozen=True)
class BlindDrive:
    """A drive: tones (the strongest first) whose frequency may rise, lasting steps, and hits of one hump each."""

    tones: tuple[tuple[float, float, float], ...] = described(
        "amplitude, angular frequency (rad/s) and phase of each tone"
    )
    sweep: float = described(
        "rise of the frequency from the beginning of the recording on", unit="rad/s^2", default=0.0
    )
    steps: tuple[tuple[float, float, float], ...] = described("time (s), size and length (s) of each step", default=())
    hits: tuple[tuple[float, float, float], ...] = described("time (s), size and length (s) of each hit", default=())
    pace: float = described(
        "angular frequency that sets the time scale of a drive without tones", unit="rad/s", default=0.0
    )

    @property
    def omega(self) -> float:
        """Return the angular frequency of the strongest tone, or `pace` without tones, in rad/s."""
        return self.tones[0][1] if self.tones else self.pace

    @property
    def amplitude(self) -> float:
        """Return sqrt(2) times the standard deviation over a long time, or the largest step or hit if larger."""
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
        """Return the time derivative of the drive at the times `t` (s)."""
        late = np.maximum(t, 0.0)
        more = 0.5 * self.sweep * late**2
        slopes = (-a * (w + self.sweep * late) * np.sin(w * t + p + more) for a, w, p in self.tones)
        slope = sum(slopes, np.zeros(len(t)))
        for events, shape in ((self.steps, _rise_smoothly), (self.hits, _shape_hump)):
            for at, size, long in events:
                during = (t > at) & (t < at + long)
                slope[during] += size / long * shape((t[during] - at) / long)[1]
        return np.asarray(slope, dtype=float)

    def count_settling_samples(self, rate: float) -> int:
        """Return the number of samples before a recording begins; before steps and hits a machine is at rest."""
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
class Disturbances:
    """Errors of drive and sensor and a random force, which are not part of the equation of motion; SI units."""

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

    def distort_drive(self, signal: BlindDrive, t: Array) -> tuple[Array, Array]:
        """Return the true drive and its time derivative at the times `t` (s), given the recorded drive `signal`.

        The lag of the actuator is not included.
        """
        amplitude, pace, phase = self.harmonic
        late, gain = t - self.excitation_delay, 1.0 + self.excitation_gain
        value = gain * signal.value(late) + amplitude * np.cos(pace * t + phase)
        slope = gain * signal.slope(late) - amplitude * pace * np.sin(pace * t + phase)
        acts = (np.abs(value) < self.limit) & (np.abs(value) > self.dead)
        value = np.clip(value, -self.limit, self.limit) - np.clip(value, -self.dead, self.dead)
        return value, slope * acts

    def leave_out_sensor(self) -> Disturbances:
        """Return the errors of the drive and the random force alone: a sensor with them shows the motion as it is."""
        return replace(self, sensor_delay=0.0, sensor_gain=0.0, sensor_time=0.0, step=0.0, ripple=(0.0, 1.0, 0.0))

    def apply_sensor(self, seen: Array, rate: float) -> Array:
        """Return the reading (samples,) of a sensor with a lag and a ripple over its reading."""
        if self.sensor_time > 0.0:
            seen = _filter_lag(seen, rate, self.sensor_time)
        size, pitch, phase = self.ripple
        return np.asarray(seen + size * np.cos(2.0 * math.pi * seen / pitch + phase))


def _filter_lag(seen: Array, rate: float, time: float) -> Array:
    """Return samples after a first-order lag with a time constant (s), by Euler's rule on a fine spline."""
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
    """A machine, its drive and its recording."""

    model: str = described("model of the machine")
    values: Mapping[str, float] = described("true parameters, in SI units")
    estimated: tuple[str, ...] = described("parameters that the case estimates")
    signal: BlindDrive = described("drive of the machine")
    rate: float = described("samples in a second", unit="Hz")
    samples: int = described("samples of the recording")
    noise: float = described("measurement noise over the standard deviation of its own motion")
    priors: Mapping[str, WidePrior] = described("prior of each estimated parameter in the case", default={})
    channel: str = described("quantity of the sensor: position, velocity or acceleration", default="position")

    @property
    def body(self) -> Body:
        """Return the parameters in the form of the integrator."""
        v = self.values
        return Body(v["m"], v["c"], v.get("k", v.get("k1", 0.0)), v.get("k0", 0.0), v.get("x0", 0.0))

    @property
    def based(self) -> bool:
        """Return whether the motion of its base drives the machine."""
        return self.model == "robot_joint"

    @property
    def places(self) -> tuple[str, ...]:
        """Return the places at which a force may act."""
        return ("ground", "base") if self.based else ("ground",)

    @property
    def time(self) -> Array:
        """Return the time of each sample (samples,) in s."""
        return np.asarray(np.arange(self.samples) / self.rate)


def simulate_machine(rig: BlindMachine, hidden: Hidden, disturbances: Disturbances, rng: np.random.Generator) -> Array:
    """Return the readings (samples,) of a sensor without noise, after the machine has settled."""
    state = np.zeros(6)
    state[0] = find_start(rig)

    def follow(force: Array, base: Array, clock: tuple[float, float], every: int) -> Array:
        seen = np.asarray(move(force, base, rig.body, hidden, state, clock, every))  # type: ignore[no-untyped-call]
        return np.asarray(seen[:, CHANNELS.index(rig.channel)])

    return simulate_pieces(rig, disturbances, rng, bound_pace(rig) / STEPS_PER_RATE, follow)


def bound_pace(rig: BlindMachine) -> float:
    """Return an upper bound of the rates (1/s) at which a machine moves."""
    return math.sqrt((rig.body.k + rig.body.k0) / rig.body.m) + rig.body.c / rig.body.m + rig.signal.omega


def find_start(rig: BlindMachine) -> float:
    """Return the position (m or rad) at the beginning of the simulation, before the machine settles."""
    if not rig.based:
        return 0.0
    begin = -rig.signal.count_settling_samples(rig.rate) / rig.rate
    return float(rig.signal.value(np.array([begin]))[0])


Follow = Callable[[Array, Array, tuple[float, float], int], Array]
"""Simulates a piece under a force (steps,) and the motion of the base (3, steps): position, velocity in the middle of
steps, velocity at their ends. The further arguments are begin and step (s), and the number of steps per sample. Returns
the readings of the sensor at the samples."""


def simulate_pieces(
    rig: BlindMachine,
    disturbances: Disturbances,
    rng: np.random.Generator,
    pace: float,
    follow: Follow,
    beside: Callable[[Array], Array | float] = lambda _middles: 0.0,
) -> Array:
    """Return the readings (samples,) of a sensor without noise, computed piece by piece, after the machine has settled.

    At least `pace` steps per second are made. `beside` returns a further force (N) at times (s). Raises `DataError`
    when the motion diverges.
    """
    every = int(min(max(math.ceil(pace / rig.rate), LEAST_SUBSTEPS), MOST_SUBSTEPS))
    settle = rig.signal.count_settling_samples(rig.rate)
    step = 1.0 / (rig.rate * every)
    kicks, seen = disturbances.rms * rng.standard_normal(settle + rig.samples), []
    behind = 0.0
    for first in range(-settle, rig.samples, PIECE_SAMPLES):
        count = min(PIECE_SAMPLES, rig.samples - first)
        begin = first / rig.rate - disturbances.sensor_delay
        edges = np.asarray(begin + np.arange(count * every + 1) * step, dtype=float)
        middles = edges[:-1] + 0.5 * step
        value, slope = disturbances.distort_drive(rig.signal, middles)
        force = np.repeat(kicks[settle + first : settle + first + count], every) + beside(middles)
        base = np.zeros((3, len(value)))
        if rig.based:
            base[0], base[1], base[2] = value, slope, disturbances.distort_drive(rig.signal, edges[1:])[1]
        if disturbances.actuator_time > 0.0:
            share = -math.expm1(-step / disturbances.actuator_time)
            lagged, left = lfilter([share], [1.0, share - 1.0], value, zi=[behind])
            rates, behind, value = (value - lagged) / disturbances.actuator_time, float(left[0]), lagged
            if rig.based:
                base[0], base[1] = lagged, rates
                base[2] = np.append(0.5 * (rates[1:] + rates[:-1]), rates[-1])
        seen.append(follow(force if rig.based else force + value, base, (begin, step), every))
    whole = np.concatenate(seen)
    if not np.isfinite(whole).all():
        raise DataError("the simulated motion diverges")
    return (1.0 + disturbances.sensor_gain) * disturbances.apply_sensor(whole, rig.rate)[settle:]


def draw_rig(rng: np.random.Generator, most: int) -> BlindMachine:
    """Return a machine with random parameters under a random drive, with at most `most` samples."""
    model = str(
        rng.choice(["lin_backlash", "robot_joint", "linear_oscillator", "rigid_drive"], p=[0.5, 0.3, 0.15, 0.05])
    )
    natural, mass = draw_log_uniform(rng, 5.0, 300.0), draw_log_uniform(rng, 0.05, 50.0)
    ratio = draw_log_uniform(rng, *((0.12, 0.5) if model == "robot_joint" else (0.2, 1.2)))
    values, amplitude = draw_parameters(model, mass, natural, rng)
    signal = _draw_signal(amplitude, ratio * natural, rng, single=model in GAP_MODELS)
    top = max(w for _, w, _ in signal.tones)
    samples = round(draw_log_uniform(rng, min(3000, most), most))
    period = max(draw_log_uniform(rng, 20.0, 200.0), CYCLE_SAMPLES / ratio, CYCLE_SAMPLES * top / signal.omega)
    rate = period * signal.omega / (2.0 * math.pi)
    if rng.random() < 0.15:
        signal = BlindDrive(signal.tones[:1], float(rng.uniform(0.3, 1.0)) * signal.omega * rate / samples)
    estimated = {"linear_oscillator": ("c", "k"), "rigid_drive": ("m", "c")}.get(model, ("c", "x0"))
    priors = {name: wide_prior(values[name], rng) for name in estimated}
    return BlindMachine(model, values, estimated, signal, rate, samples, draw_log_uniform(rng, 0.003, 0.1), priors)


def draw_log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Return a random number between `low` and `high` whose logarithm is uniformly distributed."""
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def draw_parameters(
    model: str, mass: float, natural: float, rng: np.random.Generator
) -> tuple[dict[str, float], float]:
    """Return random parameters of a machine and the amplitude of its drive, in SI units.

    `natural` is the angular natural frequency in rad/s.
    """
    stiff, zeta = mass * natural**2, draw_log_uniform(rng, 0.01, 0.1)
    damping = 2.0 * zeta * mass * natural
    if model == "robot_joint":
        values = {
            "m": mass / 100.0,
            "c": damping / 100.0,
            "k0": stiff / 100.0,
            "x0": draw_log_uniform(rng, 2e-3, 3e-2),
            "mgl": 0.0,
        }
        return values, draw_log_uniform(rng, 1.5, 8.0) * values["x0"]
    length = draw_log_uniform(rng, 1e-5, 1e-2)
    if model == "lin_backlash":
        values = {"m": mass, "c": damping, "k1": 0.0, "k0": stiff, "x0": length}
        return values, draw_log_uniform(rng, 0.15, 2.0) * stiff * length
    if model == "linear_oscillator":
        return {"m": mass, "c": damping, "k": stiff}, stiff * length
    return {"m": mass, "c": 10.0 * damping}, stiff * length


def _draw_signal(amplitude: float, omega: float, rng: np.random.Generator, *, single: bool) -> BlindDrive:
    """Return a drive of one tone, or of several tones without a common period; without a gap several are needed."""
    tones = [(amplitude, omega, float(rng.uniform(0.0, 2.0 * math.pi)))]
    if not single or rng.random() < 0.3:
        for low, high in ((0.3, 0.7), (1.4, 2.2)):
            share, pace, phase = rng.uniform(0.2, 0.6), rng.uniform(low, high), rng.uniform(0.0, 2.0 * math.pi)
            tones.append((float(share) * amplitude, float(pace) * omega, float(phase)))
    return BlindDrive(tuple(tones))


def wide_prior(value: float, rng: np.random.Generator) -> WidePrior:
    """Return a wide prior that contains a value, not close to its ends."""
    below, above = 10.0 ** rng.uniform(0.4, 1.2, 2)
    return WidePrior(_round_digits(value / below), _round_digits(value * above))


def _round_digits(value: float) -> float:
    """Return a number rounded to three significant digits."""
    return float(f"{value:.3g}")
