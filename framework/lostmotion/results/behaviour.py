"""Behaviour of recording and models: predictions, attractors, exponents, dimensions and free decays."""

from __future__ import annotations

from dataclasses import dataclass

from lostmotion.codec import described


@dataclass(frozen=True)
class ValidTime:
    """The time for which a free run stays near the recording."""

    value: float = described("this time, in the unit of the horizon")
    or_longer: bool = described("whether the free run ended before its error became too large")


@dataclass(frozen=True)
class Distance:
    """The distance between two attractors."""

    value: float = described("energy distance, in standard deviations of the motion")
    p: float = described("p-value against chance")
    status: str = described("ok, too_short, diverged, transient or absent", default="ok")


@dataclass(frozen=True)
class ExponentInterval:
    """A largest Lyapunov exponent."""

    value: float = described("the exponent", unit="1/s")
    low: float = described("lower end of its central 95 % interval", unit="1/s")
    high: float = described("upper end of it", unit="1/s")
    status: str = described("ok or too_short")


@dataclass(frozen=True)
class DimensionInterval:
    """A correlation dimension."""

    value: float = described("the dimension")
    low: float = described("lower end of its central 95 % interval")
    high: float = described("upper end of it")
    status: str = described("a status of an estimate")
    says: str = described("the reason where the status is not ok")


@dataclass(frozen=True)
class Chance:
    """A p-value."""

    p: float = described("the p-value")


@dataclass(frozen=True)
class ModelBehaviour:
    """The behaviour of a model."""

    heldout_log_score: float = described("mean log density of one-step predictions of held-out samples")
    free_run_error: float = described("error of free runs over the horizon, over the deviation of the response")
    valid_prediction_time: ValidTime = described("time for which the error of a free run is below 40 % of the motion")
    attractor_distance: Distance = described("distance between the attractors of recording and free run")
    largest_exponent: ExponentInterval = described("largest Lyapunov exponent")
    d2: DimensionInterval = described("correlation dimension of a free run")
    whiteness: Chance = described("Ljung-Box test of one-step errors")


@dataclass(frozen=True)
class NoiseFloor:
    """The values that noise alone would give."""

    heldout_log_score: float = described("the score that the last model predicts for itself")
    free_run_error: float = described("measurement noise over the deviation of the response")
    attractor_distance: Distance = described("between the halves of the recording")
    d2: DimensionInterval = described("correlation dimension of the recording")


@dataclass(frozen=True)
class MeasureTexts:
    """A text for each measure: its unit, or a sentence on it."""

    heldout_log_score: str = described("of the log score")
    free_run_error: str = described("of the error of free runs")
    valid_prediction_time: str = described("of the time for which free runs are valid")
    attractor_distance: str = described("of the distance between attractors")
    largest_exponent: str = described("of the exponent")
    d2: str = described("of the dimension")
    whiteness: str = described("of the test of whiteness")


@dataclass(frozen=True)
class HorizonLength:
    """The time over which free runs are compared."""

    value: float = described("its length, in `unit`")
    unit: str = described("Lyapunov times, drive periods or natural periods")


@dataclass(frozen=True, kw_only=True)
class Behaviour:
    """Measures of the motion: before, after, and of noise alone."""

    before: ModelBehaviour = described("of the nominal model")
    after: ModelBehaviour | None = described("of the model with the found mechanisms", default=None)
    noise_floor: NoiseFloor = described("of noise alone")
    units: MeasureTexts = described("units of the measures")
    horizon: HorizonLength = described("the time over which free runs are compared")
    says: MeasureTexts = described("a sentence on each measure")


@dataclass(frozen=True)
class DecayCycles:
    """A free decay, cycle by cycle; lists are (cycles,)."""

    time: tuple[float, ...] = described("time from the start of the recording", unit="s")
    amplitude: tuple[float, ...] = described("amplitude, in the `unit` of the decays")
    frequency: tuple[float, ...] = described("frequency", unit="Hz")
    decrement: tuple[float, ...] = described("logarithmic decrement")
    damping_ratio: tuple[float, ...] = described("damping as a share of critical damping")


@dataclass(frozen=True)
class Decays:
    """Free decays of the recording and of free runs of the models from the same starts."""

    says: str = described("dependence of frequency and damping on the amplitude, in sentences")
    unit: str | None = described("unit of amplitudes", default=None)
    measured: tuple[DecayCycles, ...] | None = described("of the recording", default=None)
    before: tuple[DecayCycles, ...] | None = described("of the nominal model", default=None)
    after: tuple[DecayCycles, ...] | None = described("of the model with the found mechanisms", default=None)
