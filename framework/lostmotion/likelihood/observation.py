"""One recording on one even clock: its inputs, the readings of its sensors, and which sensors they are."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.interpolate import Akima1DInterpolator, CubicSpline
from scipy.ndimage import binary_dilation
from scipy.optimize import brentq, minimize_scalar

from lostmotion.contracts import Array, Machine, Model
from lostmotion.errors import CaseError, nearest
from lostmotion.likelihood.drive import SILENT, Drive, DriveHarmonic
from lostmotion.likelihood.input_curve import InputCurve
from lostmotion.likelihood.sensors import Sensor, measure_white_noise
from lostmotion.likelihood.space import make_level_name
from lostmotion.likelihood.splines import fit_smoothing_spline
from lostmotion.noises import Noise, White, make_basic
from lostmotion.quantities import quantity_of
from lostmotion.recording import Recording

if TYPE_CHECKING:
    import xarray as xr


FIRST = 9
"""Readings of a sensor from which the initial states are estimated."""
HEARD, GUARD = 5.0, 4
"""A hit exceeds the noise by this many standard deviations, and is extended by this many samples at either end."""
EDGES = 0.65
QUIET, STRUCK = 0.5, 6.0
"""A force that hits is quiet for at least this share of the time; a hit is this many standard deviations of it high,
and the usual noise is a thousandth of its peak: the gauge was chosen for the hits, however low its noise is between
them."""


FEWEST_PERIODS, LINE = 4, 0.75
"""A periodic drive has at least this many periods, and its line this share of the spectral power (a square: 0.81)."""


@dataclass(frozen=True)
class Observation:
    """One recording as a filter sees it: `inputs` (samples, inputs) and `readings` (samples, sensors), every `dt` s.

    A reading that is NaN was not taken. `begin` is its first sample in the recording; `held` says that the inputs are
    constant between the samples; `harmonic` is the drive of the whole recording. `driven` are the names of the inputs
    that were recorded, none where the machine is left to itself; `lead` is the column of the one that drives it and
    `slope` that of its time derivative, where the model has this as an input of its own. `begun` are mean (n,) and
    covariance (n, n) of the states of the model at the first sample, where more is known than the first readings show.
    `gauge_noise` is the standard deviation of what was left out of a periodic force, `outliers` the number of readings
    of the whole recording that were left out. `gains` are readings per true value of each sensor, 1 by default.
    """

    name: str
    readings: Array
    inputs: Array
    dt: float
    sensors: tuple[Sensor, ...]
    held: bool = False
    begin: int = 0
    harmonic: DriveHarmonic = SILENT
    driven: tuple[str, ...] | None = None
    lead: int = 0
    slope: int | None = None
    begun: tuple[Array, Array] | None = None
    gauge_noise: float = 0.0
    outliers: int = 0
    gains: tuple[float, ...] = ()

    @classmethod
    def of(cls, name: str, response: Array, inputs: Array, dt: float, channel: str, **more: Any) -> Observation:
        """Return the observation of one sensor with the readings `response` (samples,)."""
        more = {"slope": 1 if inputs.shape[1] == 2 else None} | more
        return cls(name, np.asarray(response, dtype=float)[:, None], inputs, dt, (Sensor(channel),), **more)

    @property
    def response(self) -> Array:
        """The readings (samples,) of the first sensor; errors are given in its unit."""
        return self.readings[:, 0]

    @property
    def channel(self) -> str:
        """The channel of the first sensor."""
        return self.sensors[0].channel

    def level(self, name: str, sensor: int) -> str:
        """Return the parameter for a level of a sensor: `log_noise`, or `log_noise:name` where there are several."""
        return make_level_name(name, self.sensors[sensor].label, len(self.sensors) > 1)

    @property
    def samples(self) -> int:
        """The number of samples."""
        return len(self.readings)

    @property
    def time(self) -> Array:
        """The time of each sample from the start of the recording, in s."""
        return np.asarray((self.begin + np.arange(self.samples)) * self.dt, dtype=float)

    def part(self, start: int, stop: int) -> Observation:
        """Return the samples from `start` up to `stop` as an observation of its own."""
        cut = slice(start, stop)
        begun = None if start else self.begun
        return replace(
            self, readings=self.readings[cut], inputs=self.inputs[cut], begin=self.begin + start, begun=begun
        )

    def cut_again(self, part: Observation) -> Observation:
        """Return a part of this recording with what was left out of the whole one since it was cut."""
        cut = slice(part.begin - self.begin, part.begin - self.begin + part.samples)
        left = replace(part, gauge_noise=self.gauge_noise, outliers=self.outliers)
        return replace(left, readings=self.readings[cut], inputs=self.inputs[cut])

    @cached_property
    def drive(self) -> Drive:
        """The inputs between the samples."""
        if self.held:
            drive = Drive.held(self.inputs, self.dt)
        else:
            powers = self.dt ** np.arange(4)
            cubics = np.zeros((self.samples, 4, self.inputs.shape[1]))
            cubics[:-1] = self._curve.spline.c[::-1].transpose(1, 0, 2) * powers[None, :, None]
            cubics[-1, 0] = self.inputs[-1]
            drive = Drive(cubics, self.dt)
        return replace(drive, begin=self.begin * self.dt, harmonic=self.harmonic)

    @cached_property
    def _curve(self) -> InputCurve:
        return InputCurve(self.inputs, self.dt, self.held)

    def read_again(self, **changes: Any) -> Observation:
        """Return the recording with other readings, sensors or gains; the curves of its inputs are computed once."""
        other = replace(self, **changes)
        vars(other).update(drive=self.drive, _curve=self._curve)
        return other

    def recorded(self, column: int, t: Array) -> Array:
        """Return a recorded input at times `t` (s, from the start of the recording), of any shape.

        Outside of the recording it is predicted from it. One that is held between the samples is averaged over a
        quarter of a sample.
        """
        return self._curve.evaluate(column, t - self.begin * self.dt)

    @property
    def columns(self) -> tuple[Callable[[Array], Array], ...]:
        """The recorded inputs as functions of time (s, from the start of the recording)."""
        return tuple(partial(self.recorded, column) for column in range(self.inputs.shape[1]))

    @property
    def free(self) -> bool:
        """Whether nothing drives the machine."""
        return self.driven == ()

    @cached_property
    def excitation(self) -> Array:
        """The input (samples,) that drives the machine."""
        return self.inputs[:, self.lead]

    @cached_property
    def period(self) -> float | None:
        """The period of the drive in samples, or None where no line stands out of the spectrum of the input."""
        return find_period(self.excitation)

    @cached_property
    def noises(self) -> tuple[float, ...]:
        """The standard deviation of white noise of each sensor, from fourth differences (an upper estimate)."""
        return tuple(_estimate_noise(z) for z in self.readings.T)

    @property
    def noise(self) -> float:
        """The standard deviation of white noise of the first sensor (an upper estimate)."""
        return self.noises[0]

    @cached_property
    def amplitude(self) -> float:
        """The amplitude of the response: sqrt(2) times its standard deviation."""
        return math.sqrt(2.0) * float(np.nanstd(self.response))

    def amplitude_of(self, label: str) -> float:
        """Return the amplitude of the readings of a sensor, of the only one if `label` is empty."""
        labels = [sensor.label for sensor in self.sensors]
        return math.sqrt(2.0) * float(np.nanstd(self.readings[:, labels.index(label) if label else 0]))

    @cached_property
    def travel(self) -> float:
        """The amplitude of the first input, for instance of a base motion: sqrt(2) times its standard deviation."""
        return math.sqrt(2.0) * float(np.std(self.excitation))

    @cached_property
    def hit_peak(self) -> float:
        """The highest peak of the first input where that consists of hits, as of a hammer, else zero."""
        u = self.excitation
        peak = float(np.abs(u - np.median(u)).max())
        return peak if peak > STRUCK * float(np.std(u)) else 0.0

    @cached_property
    def input_variance(self) -> Array:
        """The variance (samples,) of the mean of the first input up to the next sample, from its interpolation.

        The edge of a hit that begins between two samples is not sampled: any interpolation is wrong by some per cent of
        the peak over one sample. The difference of two interpolations is a measure of that; it is `EDGES` of the error
        for half-sines of 6 to 25 samples. Other inputs are known well.
        """
        if self.held or not self.hit_peak:
            return np.zeros(self.samples)
        t, u = np.arange(self.samples) * self.dt, self.excitation
        ways = (CubicSpline(t, u), Akima1DInterpolator(t, u))
        sums = [np.diff(way.antiderivative()(t), append=math.nan) / self.dt for way in ways]
        return np.asarray(np.nan_to_num((sums[0] - sums[1]) / EDGES) ** 2, dtype=float)

    @cached_property
    def first(self) -> tuple[tuple[float, float], ...]:
        """The reading of each sensor and its time derivative at the first sample, from a parabola.

        NaN for a sensor that has fewer than three readings among the first samples.
        """
        return tuple(_estimate_start(z, self.dt) for z in self.readings[: FIRST * self.sparsest].T)

    @cached_property
    def sparsest(self) -> int:
        """The number of samples between two readings of the slowest sensor; 1 where each sample has all of them."""
        counts = np.count_nonzero(np.isfinite(self.readings), axis=0)
        return max(1, round(self.samples / max(int(counts.min()), 1)))


def shift_sensors(observation: Observation, late: Sequence[int], most: int) -> Observation:
    """Return an observation with each sensor moved ahead by the samples that it is `late`.

    The first `most` readings of each sensor are left out, so that the number of readings does not depend on the delay.
    """
    readings = np.full_like(observation.readings, np.nan)
    for sensor, lag in enumerate(late):
        stop = observation.samples - lag
        readings[most - lag : stop, sensor] = observation.readings[most:, sensor]
    return observation.read_again(readings=readings)


def _estimate_start(z: Array, dt: float) -> tuple[float, float]:
    """Return value and time derivative at the first of a few readings (samples,)."""
    kept = np.flatnonzero(np.isfinite(z))[:FIRST]
    if len(kept) < 3:
        return math.nan, math.nan
    bend = np.polynomial.Polynomial.fit(kept * dt, z[kept], 2)
    return float(bend(0.0)), float(bend.deriv()(0.0))


def _estimate_noise(z: Array) -> float:
    """Return the standard deviation of white noise in readings (samples,), at least what rounding of numbers leaves."""
    return max(measure_white_noise(z), 1e-7 * math.sqrt(2.0) * float(np.nanstd(z)))


def find_static_equilibrium(observation: Observation, model: Model, p: Array) -> tuple[float, float]:
    """Return the position of a body moved by its base at the first sample, and its uncertainty (m or rad).

    It is where the model, with the parameters `p` and moving with its base, shows the measured force, within ten times
    the noise. Inside a gap that is the whole gap: a recording of force should begin in contact.
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


def make_observation(
    recording: Recording, model: Machine, *, held: bool = False, make_noise: Callable[[str], Noise] = make_basic
) -> Observation:
    """Return the observation of a recording for `model`; the velocity of a measured base motion comes from a spline.

    An input of the model that was not recorded is zero. `make_noise` returns a noise by its name. Raises `CaseError`
    for inputs and channels the model lacks.
    """
    inputs = np.zeros((recording.n, len(model.inputs)))
    driven = tuple(str(array.attrs["of"]) for array in recording.inputs)
    for name, array in zip(driven, recording.inputs, strict=True):
        if name not in model.inputs:
            raise CaseError(
                f"{model.name} is driven by {' and '.join(model.inputs)}, but the excitation of {recording.name} is a"
                f" {name}{nearest(name, model.inputs)}: choose another model or another column"
            )
        u = round_values(np.asarray(array.values, dtype=float))
        inputs[:, model.inputs.index(name)] = u if held or quantity_of(name) != "force" else window_force(u)
    if "base_velocity" in driven and "base_position" not in driven:
        raise CaseError(f"{recording.name} has the velocity of the base without its position: give base_position")
    if "base_position" in driven and "base_velocity" in model.inputs and "base_velocity" not in driven:
        spline = fit_smoothing_spline(inputs[:, model.inputs.index("base_position")], recording.dt)
        inputs[:, model.inputs.index("base_velocity")] = spline.derivative()(np.arange(recording.n) * recording.dt)
        inputs[:, model.inputs.index("base_position")] = spline(np.arange(recording.n) * recording.dt)
    readings = np.stack([round_values(np.asarray(array.values, dtype=float)) for array in recording.sensors], axis=1)
    sensors = tuple(_make_sensor(array, model, recording.name, make_noise) for array in recording.sensors)
    lead = model.inputs.index(driven[0]) if driven else 0
    bare = Observation(recording.name, readings, inputs, recording.dt, sensors, held=held, driven=driven, lead=lead)
    return replace(bare, slope=find_slope_column(model.inputs, lead), harmonic=find_harmonic(bare))


def find_slope_column(inputs: Sequence[str], lead: int) -> int | None:
    """Return the column of the time derivative of an input of a model; None where the model has no such input."""
    moved = inputs[lead] == "base_position" and "base_velocity" in inputs
    return list(inputs).index("base_velocity") if moved else None


def _make_sensor(array: xr.DataArray, model: Machine, recording: str, make_noise: Callable[[str], Noise]) -> Sensor:
    """Return the sensor of an array of a recording; raise `CaseError` for a channel that the model lacks."""
    channel, name = str(array.attrs["of"]), str(array.attrs["sensor"])
    if channel not in model.channels:
        raise CaseError(
            f"{model.name} shows {', '.join(model.channels)}, but {name or 'the response'} of {recording} is a"
            f" {channel}{nearest(channel, model.channels)}: choose another model or another column"
        )
    made = [make_noise(kind.strip()) for kind in str(array.attrs["noise"]).split("+")]
    noises = tuple(made) if isinstance(made[0], White) else (White(), *made)
    return Sensor(channel, name, noises, loose=array.attrs.get("zero") == "unknown")


def window_force(force: Array) -> Array:
    """Return a measured force (samples,) with nothing but its mean between hits, where it shows only white noise.

    The force window of impact testing (Halvorsen, Brown, Sound and Vibration 11 (1977) 8-21). Between hits the noise of
    the gauge would be an input of the model; a body at rest does not respond to it, and seems to be held by friction.
    Any other force is returned unchanged: one that is quiet for less than `QUIET` of the time, or not white then.
    """
    middle, noise = float(np.median(force)), _estimate_noise(force)
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


def round_values(values: Array) -> Array:
    """Return values (samples,) rounded to ten digits of the largest, so that a change of units changes no bit of them.

    A filter through kinks amplifies a difference in the last digit of a double to the fourth digit of a result.
    """
    peak = float(np.nanmax(np.abs(values), initial=0.0))
    if not 0.0 < peak < math.inf:
        return values
    grain = 2.0 ** (math.floor(math.log2(peak * (1.0 + 1e-9))) - 33)
    return np.asarray(np.round(values / grain) * grain, dtype=float)


def find_harmonic(observation: Observation) -> DriveHarmonic:
    """Return the frequency (rad/s, 0 where there is none) and the amplitude of the drive of a recording."""
    return DriveHarmonic(
        2.0 * math.pi / (observation.period * observation.dt) if observation.period else 0.0, observation.travel
    )


def find_period(signal: Array) -> float | None:
    """Return the period of a signal in samples, or None where no line dominates its spectrum.

    A step has most of its power at the lowest frequencies; the lines of a multisine are close together.
    """
    u = signal - signal.mean()
    if not u.any():
        return None
    size = len(u)
    power = np.abs(np.fft.rfft(u * np.hanning(size))) ** 2
    power[:2] = 0.0
    peak = int(np.argmax(power))
    if peak < FEWEST_PERIODS or power[max(peak - 3, 0) : peak + 4].sum() < LINE * power.sum():
        return None
    return float(size / _refine_line(u * np.hanning(size), peak))


def _refine_line(windowed: Array, peak: int) -> float:
    """Return the frequency (bins) of the spectral maximum next to bin `peak`, two hundred times finer than a bin."""
    angle = 2.0j * math.pi * np.arange(len(windowed)) / len(windowed)

    def depth(place: float) -> float:
        return -float(np.abs(np.sum(windowed * np.exp(-angle * place))))

    return float(minimize_scalar(depth, bounds=(peak - 1.0, peak + 1.0), method="bounded", options={"xatol": 1e-6}).x)
