"""How recording and models behave: predictions, attractors, exponents, dimensions and free decays."""

from __future__ import annotations

from dataclasses import dataclass

from lostmotion.codec import told


@dataclass(frozen=True)
class ValidTime:
    """How long a free run stays near the recording."""

    value: float = told("that time, in the unit of the horizon")
    or_longer: bool = told("whether it was followed no longer")


@dataclass(frozen=True)
class Distance:
    """How far apart two attractors are."""

    value: float = told("energy distance, in standard deviations of the motion")
    p: float = told("p-value against chance")
    status: str = told("ok, too_short, diverged or transient")


@dataclass(frozen=True)
class ExponentInterval:
    """A largest Lyapunov exponent."""

    value: float = told("the exponent", unit="1/s")
    low: float = told("lower end of its central 95 % interval", unit="1/s")
    high: float = told("upper end of it", unit="1/s")
    status: str = told("ok or too_short")


@dataclass(frozen=True)
class DimensionInterval:
    """A correlation dimension."""

    value: float = told("the dimension")
    low: float = told("lower end of its central 95 % interval")
    high: float = told("upper end of it")
    status: str = told("a status of an estimate")
    says: str = told("what is wrong where the status is not ok")


@dataclass(frozen=True)
class Chance:
    """A p-value."""

    p: float = told("the p-value")


@dataclass(frozen=True)
class ModelBehaviour:
    """How a model behaves."""

    heldout_log_score: float = told("mean log density of one-step predictions of held-out samples")
    free_run_error: float = told("error of free runs over the horizon, over the deviation of the response")
    valid_prediction_time: ValidTime = told("how long a free run errs by less than 40 % of the motion")
    attractor_distance: Distance = told("distance between the attractors of recording and free run")
    largest_exponent: ExponentInterval = told("largest Lyapunov exponent")
    d2: DimensionInterval = told("correlation dimension of a free run")
    whiteness: Chance = told("Ljung-Box test of one-step errors")


@dataclass(frozen=True)
class NoiseFloor:
    """What noise alone would give."""

    heldout_log_score: float = told("what the last model itself expects")
    free_run_error: float = told("measurement noise over the deviation of the response")
    attractor_distance: Distance = told("between the halves of the recording")
    d2: DimensionInterval = told("correlation dimension of the recording")


@dataclass(frozen=True)
class MeasureTexts:
    """A text for each measure: its unit, or a sentence on it."""

    heldout_log_score: str = told("of the log score")
    free_run_error: str = told("of the error of free runs")
    valid_prediction_time: str = told("of the time that free runs hold")
    attractor_distance: str = told("of the distance between attractors")
    largest_exponent: str = told("of the exponent")
    d2: str = told("of the dimension")
    whiteness: str = told("of the test of whiteness")


@dataclass(frozen=True)
class HorizonLength:
    """The time over which free runs are compared."""

    value: float = told("its length, in `unit`")
    unit: str = told("Lyapunov times, drive periods or natural periods")


@dataclass(frozen=True, kw_only=True)
class Behaviour:
    """Measures of the motion: before, after, and of noise alone."""

    before: ModelBehaviour = told("of the nominal model")
    after: ModelBehaviour | None = told("of the model with what was found", default=None)
    noise_floor: NoiseFloor = told("of noise alone")
    units: MeasureTexts = told("units of the measures")
    horizon: HorizonLength = told("the time over which free runs are compared")
    says: MeasureTexts = told("a sentence on each measure")


@dataclass(frozen=True)
class DecayCycles:
    """A free decay, cycle by cycle; lists are (cycles,)."""

    time: tuple[float, ...] = told("time from the start of the recording", unit="s")
    amplitude: tuple[float, ...] = told("amplitude, in the `unit` of the decays")
    frequency: tuple[float, ...] = told("frequency", unit="Hz")
    decrement: tuple[float, ...] = told("logarithmic decrement")
    damping_ratio: tuple[float, ...] = told("damping as a share of critical damping")


@dataclass(frozen=True)
class Decays:
    """Free decays of the recording and of free runs of the models from the same starts."""

    says: str = told("how frequency and damping go with amplitude, in sentences")
    unit: str | None = told("unit of amplitudes", default=None)
    measured: tuple[DecayCycles, ...] | None = told("of the recording", default=None)
    before: tuple[DecayCycles, ...] | None = told("of the nominal model", default=None)
    after: tuple[DecayCycles, ...] | None = told("of the model with what was found", default=None)
