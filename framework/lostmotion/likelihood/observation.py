"""One recording on one even clock: what drove the machine, what its sensors showed, and which sensors they are."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.interpolate import Akima1DInterpolator, CubicSpline
from scipy.ndimage import binary_dilation
from scipy.optimize import brentq, minimize_scalar

from lostmotion.contracts import Array, Interface, Model
from lostmotion.errors import CaseError
from lostmotion.likelihood.drive import SILENT, Drive, Tone
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.splines import smoothing_spline
from lostmotion.recording import Recording

HEARD, GUARD = 5.0, 4
"""A hit stands so many deviations of the noise out of it, and begins and ends so many samples further out."""
EDGES = 0.65
QUIET, STRUCK = 0.5, 6.0
"""Between hits a force is quiet for this share of the time at least; a hit is so many of its deviations high, and a
thousandth of its peak is the usual noise: the gauge was chosen for the hits, however quiet it is between them."""


@dataclass(frozen=True)
class Observation:
    """One recording as an engine sees it: `inputs` (samples, inputs) and `readings` (samples, sensors), every `dt` s.

    A reading that is NaN was not taken. `begin` is where it starts in the recording, in samples; `held` says that the
    input is constant between the samples; `tone` is the drive of the whole recording; `begun` are mean (n,) and
    covariance (n, n) of the states of the model at the first sample, where more is known than the readings there show.
    """

    name: str
    readings: Array
    inputs: Array
    dt: float
    sensors: tuple[Sensor, ...]
    held: bool = False
    begin: int = 0
    tone: Tone = SILENT
    begun: tuple[Array, Array] | None = None

    @classmethod
    def of(cls, name: str, response: Array, inputs: Array, dt: float, channel: str, **more: Any) -> Observation:
        """Return the observation of one sensor with the readings `response` (samples,)."""
        return cls(name, np.asarray(response, dtype=float)[:, None], inputs, dt, (Sensor(channel),), **more)

    @property
    def response(self) -> Array:
        """The readings (samples,) of the first sensor: the one in whose unit errors are told."""
        return self.readings[:, 0]

    @property
    def channel(self) -> str:
        """The channel of the first sensor."""
        return self.sensors[0].channel

    @property
    def samples(self) -> int:
        """The number of samples."""
        return len(self.readings)

    @property
    def time(self) -> Array:
        """The time of each sample from the start of the recording, in s."""
        return np.asarray((self.begin + np.arange(self.samples)) * self.dt, dtype=float)

    def motion_at(self, place: Interface, states: Array) -> Array:
        """Return relative position and velocity (2, samples) at a place of the model, along `states` (samples, n)."""
        return np.array([place.motion(y, u) for y, u in zip(states, self.inputs, strict=True)]).T

    def part(self, start: int, stop: int) -> Observation:
        """Return the samples from `start` up to `stop` as an observation of its own."""
        cut = slice(start, stop)
        begun = None if start else self.begun
        return replace(
            self, readings=self.readings[cut], inputs=self.inputs[cut], begin=self.begin + start, begun=begun
        )

    @cached_property
    def drive(self) -> Drive:
        """The inputs between the samples."""
        if self.held:
            drive = Drive.held(self.inputs, self.dt)
        else:
            powers = self.dt ** np.arange(4)
            cubics = np.zeros((self.samples, 4, self.inputs.shape[1]))
            cubics[:-1] = self._spline.c[::-1].transpose(1, 0, 2) * powers[None, :, None]
            cubics[-1, 0] = self.inputs[-1]
            drive = Drive(cubics, self.dt)
        return replace(drive, begin=self.begin * self.dt, tone=self.tone)

    @cached_property
    def _spline(self) -> CubicSpline:
        return CubicSpline(np.arange(self.samples) * self.dt, self.inputs)

    def recorded(self, t: Array, order: int) -> Array:
        """Return the recorded input of some order at times `t` (s, from the start of the recording), of any shape.

        Beyond its ends it stays what it is there. One that is held between the samples is the mean over a quarter of a
        sample.
        """
        start, last = self.begin * self.dt, (self.samples - 1) * self.dt
        if not self.held:
            return np.asarray(self._spline(np.clip(t - start, 0.0, last))[..., order])
        half = 0.125 * self.dt
        edges = np.arange(self.samples + 1) * self.dt
        sums = np.concatenate([[0.0], np.cumsum(self.inputs[:, order])]) * self.dt
        middle = np.clip(t - start, half, edges[-1] - half)
        return np.asarray(
            (np.interp(middle + half, edges, sums) - np.interp(middle - half, edges, sums)) / (2.0 * half)
        )

    @cached_property
    def period(self) -> float | None:
        """The period of the drive in samples, or None where no line stands out of the spectrum of the input."""
        return period_of(self.inputs[:, 0])

    @cached_property
    def noises(self) -> tuple[float, ...]:
        """The standard deviation of white noise of each sensor, from fourth differences (an upper guess)."""
        return tuple(_noise(z) for z in self.readings.T)

    @property
    def noise(self) -> float:
        """The standard deviation of white noise of the first sensor (an upper guess)."""
        return self.noises[0]

    @cached_property
    def amplitude(self) -> float:
        """The amplitude of the response: sqrt(2) times its standard deviation."""
        return math.sqrt(2.0) * float(np.nanstd(self.response))

    @cached_property
    def travel(self) -> float:
        """The amplitude of the first input, for instance of a base motion: sqrt(2) times its standard deviation."""
        return math.sqrt(2.0) * float(np.std(self.inputs[:, 0]))

    @cached_property
    def struck(self) -> float:
        """The highest peak of the first input where that hits, as a hammer does, else zero."""
        u = self.inputs[:, 0]
        peak = float(np.abs(u - np.median(u)).max())
        return peak if peak > STRUCK * float(np.std(u)) else 0.0

    @cached_property
    def unsure(self) -> Array:
        """The variance (samples,) of the mean of the first input up to the next sample, of how it goes between them.

        A hit that begins between two samples has an edge that no sample shows: whatever goes through the samples is off
        by some per cent of the peak over one of them. It shows in how far two ways to interpolate are apart; their
        distance is `EDGES` of the error for half-sines of 6 to 25 samples. Other inputs are known well.
        """
        if self.held or not self.struck:
            return np.zeros(self.samples)
        t, u = np.arange(self.samples) * self.dt, self.inputs[:, 0]
        ways = (CubicSpline(t, u), Akima1DInterpolator(t, u))
        sums = [np.diff(way.antiderivative()(t), append=math.nan) / self.dt for way in ways]
        return np.asarray(np.nan_to_num((sums[0] - sums[1]) / EDGES) ** 2, dtype=float)

    @cached_property
    def first(self) -> tuple[tuple[float, float], ...]:
        """The reading of each sensor and its time derivative at the first sample, from a parabola."""
        return tuple(_begun(z, self.dt) for z in self.readings[:9].T)


def _begun(z: Array, dt: float) -> tuple[float, float]:
    """Return value and time derivative at the first of a few readings (samples,)."""
    kept = np.flatnonzero(np.isfinite(z))
    bend = np.polynomial.Polynomial.fit(kept * dt, z[kept], 2)
    return float(bend(0.0)), float(bend.deriv()(0.0))


def _noise(z: Array) -> float:
    """Return the standard deviation of white noise in readings (samples,), from fourth differences."""
    fourth = np.diff(z, 4)
    fourth = fourth[np.isfinite(fourth)]
    size = float(np.median(np.abs(fourth)) / 0.6745 / math.sqrt(70.0)) if len(fourth) else 0.0
    return max(size, 1e-7 * math.sqrt(2.0) * float(np.nanstd(z)))


def static_equilibrium(observation: Observation, model: Model, p: Array) -> tuple[float, float]:
    """Return where a body moved by its base stands at the first sample, and how far that is open (m or rad).

    It is where the model, with the parameters `p` and moving with its base, shows the force that was measured, give or
    take ten times the noise. Inside a gap that is the whole gap: a recording of force had better begin in contact.
    """
    y, seen = np.zeros(len(model.states)), np.zeros(len(model.channels))
    u, still = observation.inputs[0], np.zeros(len(model.states))
    y[1], index = u[1], model.channels.index(observation.channel)
    reach = 10.0 * float(np.ptp(observation.inputs[:, 0]))

    def short(position: float, level: float) -> float:
        y[0] = position
        model.observe(0.0, y, still, u, p, seen)
        return float(seen[index]) - level

    ends = []
    for level in (
        observation.response[0] - 10.0 * observation.noise,
        observation.response[0] + 10.0 * observation.noise,
    ):
        low, high = u[0] - reach, u[0] + reach
        if not short(low, level) > 0.0 > short(high, level):
            return float(u[0]), 0.1 * reach
        ends.append(float(brentq(short, low, high, args=(level,))))
    return 0.5 * (ends[0] + ends[1]), 0.5 * (ends[0] - ends[1])


def observation_of(recording: Recording, model: Model, *, held: bool = False) -> Observation:
    """Return the observation of a recording for `model`; the velocity of a measured base motion comes from a spline."""
    excitation = recording.data["excitation"]
    u = rounded(np.asarray(excitation.values, dtype=float))
    offered = "base_position" if excitation.attrs.get("quantity") == "base_position" else "force"
    if offered not in model.inputs:
        raise CaseError(
            f"{model.name} is driven by {' and '.join(model.inputs)}, but the excitation of {recording.name} is a"
            f" {excitation.attrs.get('quantity')}: choose another model or another column"
        )
    inputs = (u if held or offered != "force" else windowed(u))[:, None]
    if offered == "base_position":
        spline = smoothing_spline(u, recording.dt)
        t = np.arange(len(u)) * recording.dt
        inputs = np.stack([spline(t), spline.derivative()(t)], axis=1)
    z = rounded(np.asarray(recording.data["response"].values, dtype=float))
    bare = Observation.of(recording.name, z, inputs, recording.dt, _channel(recording, model), held=held)
    return replace(bare, tone=tone_of(bare))


def windowed(force: Array) -> Array:
    """Return a measured force (samples,) with nothing but its mean between hits, where it shows only white noise.

    The force window of impact testing (Halvorsen, Brown, Sound and Vibration 11 (1977) 8-21). Between hits the noise of
    the gauge would be handed to the model as a force that is known; a body at rest does not answer it, as if friction
    held it. Any other force is returned as it is: one that is quiet for less than `QUIET` of the time, or not white
    then.
    """
    middle, noise = float(np.median(force)), _noise(force)
    loud = np.abs(force - middle) > HEARD * noise
    near = binary_dilation(loud, iterations=GUARD)
    rest = force[~near] - middle
    peak = float(np.abs(force - middle).max())
    if len(rest) < QUIET * len(force) or peak < STRUCK * float(np.std(force)) or not rest.any():
        return force
    rest = rest - rest.mean()
    alike = [float(rest[lag:] @ rest[:-lag]) / float(rest @ rest) for lag in (1, 2, 3)]
    if max(map(abs, alike)) > 4.0 / math.sqrt(len(rest)):
        return force
    return np.where(near, force, force[~near].mean())


def rounded(values: Array) -> Array:
    """Return values (samples,) to ten digits of the largest, so that a change of units changes no bit of them.

    A filter through kinks makes a difference in the last digit of a double one in the fourth digit of an answer.
    """
    peak = float(np.nanmax(np.abs(values), initial=0.0))
    if not 0.0 < peak < math.inf:
        return values
    grain = 2.0 ** (math.floor(math.log2(peak * (1.0 + 1e-9))) - 33)
    return np.asarray(np.round(values / grain) * grain, dtype=float)


def tone_of(observation: Observation) -> Tone:
    """Return the frequency (rad/s, 0 where there is none) and the amplitude of what drives a recording."""
    return Tone(
        2.0 * math.pi / (observation.period * observation.dt) if observation.period else 0.0, observation.travel
    )


def _channel(recording: Recording, model: Model) -> str:
    """Return the channel of the model that the response of a recording shows; a torque is a force of a rotation."""
    quantity = str(recording.data["response"].attrs["quantity"])
    channel = "force" if quantity == "torque" else quantity
    if channel not in model.channels:
        raise CaseError(
            f"{model.name} shows {', '.join(model.channels)}, but the response of {recording.name} is a {quantity}:"
            " choose another model or another column"
        )
    return channel


def period_of(signal: Array) -> float | None:
    """Return the period of a signal in samples, or None where no line stands out of its spectrum."""
    u = signal - signal.mean()
    if not u.any():
        return None
    size = len(u)
    power = np.abs(np.fft.rfft(u * np.hanning(size))) ** 2
    power[:2] = 0.0
    peak = int(np.argmax(power))
    if peak < 2 or power[max(peak - 3, 0) : peak + 4].sum() < 0.5 * power.sum():
        return None
    return float(size / _refined(u * np.hanning(size), peak))


def _refined(windowed: Array, peak: int) -> float:
    """Return where between the bins the line next to bin `peak` is highest: two hundred times finer than a bin."""
    angle = 2.0j * math.pi * np.arange(len(windowed)) / len(windowed)

    def depth(place: float) -> float:
        return -float(np.abs(np.sum(windowed * np.exp(-angle * place))))

    return float(minimize_scalar(depth, bounds=(peak - 1.0, peak + 1.0), method="bounded", options={"xatol": 1e-6}).x)
