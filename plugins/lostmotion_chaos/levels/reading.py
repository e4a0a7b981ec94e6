"""Read one level from a recording: the drive, the kind of motion, the exponent and the correlation dimension.

The steps are those of `analyse` without noise reduction and surrogate tests. These cost most of the time, and the
question whether the motion is noise does not arise where a model of the machine is given.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.case.drive_levels import Level, Measured
from lostmotion.contracts import Array
from lostmotion.errors import CaseError
from lostmotion.recording import Recording, load_recording
from lostmotion.registry import Registry
from lostmotion.results import Estimate, percent
from lostmotion.settings import DEFAULT, MotionSettings, Settings
from lostmotion.signals import refined_period
from lostmotion_chaos.analysis.embed import embed
from lostmotion_chaos.analysis.period import find_return
from lostmotion_chaos.analysis.quantify import quantify
from lostmotion_chaos.defaults import DIMENSION, EMBEDDER, EXPONENT, METER
from lostmotion_chaos.signals.series import checked

PAIRS = 8_000_000
"""Pairs of points for a dimension: a fifth of the computing time of `analyse`, with nearly the same interval."""
ESTIMATOR_ERRORS = {
    "lyapunov": (0.054, 0.74, 0.063),
    "d2": (-0.019, 0.51, 0.032),
    "d2 of a moved base": (0.034, 0.51, 0.032),
}
"""For each estimator: its relative bias, the factor on its stated standard deviation, and an additional relative error.

Measured with `benchmarks/levels.py chaos --machines 358`, where 114 exponents and 105 dimensions could be estimated.
Dimensions of machines driven by a force are estimated too small, which looks like more damping. Those of machines on a
moving base are estimated too large: most of the response is the motion of the base, and noise that is small relative to
it is four times as large relative to the chaotic part."""
HARMONIC = 0.1
"""A drive is harmonic when this share of its standard deviation, or less, is not a sine of one frequency: its noise and
small harmonics."""
FORCE_UNITS = ("N", "N m")
"""Units of a drive that is a force or torque, not a motion of the base."""


@dataclass(frozen=True, eq=False)
class Signals:
    """A response `x` (n,) and its excitation `u` (n,), both in SI units, sampled every `dt` s."""

    name: str
    x: Array
    u: Array
    dt: float
    unit: str


@dataclass(frozen=True, eq=False)
class ReadLevel:
    """A level read from a recording, with the estimates it is based on, as far as they were made."""

    level: Level
    exponent: Estimate | None = None
    dimension: Estimate | None = None


def extract_signals(recording: Recording) -> Signals:
    """Return the longest section of a recording without a lost sample."""
    if not recording.inputs:
        raise CaseError(
            f"{recording.name} has no excitation: the quantifier route needs a harmonic drive at one level in each"
            " recording"
        )
    response, drive = recording.sensors[0], recording.inputs[0]
    x = np.asarray(response.to_numpy(), dtype=float)
    lost = np.concatenate([[-1], np.flatnonzero(~np.isfinite(x)), [len(x)]])
    longest = int(np.argmax(np.diff(lost)))
    keep = slice(int(lost[longest]) + 1, int(lost[longest + 1]))
    u = np.asarray(drive.to_numpy(), dtype=float)[keep]
    return Signals(recording.name, x[keep], u, recording.dt, str(drive.attrs["units"]))


def read_levels(
    case: CaseFile, registry: Registry, rng: np.random.Generator, settings: Settings = DEFAULT
) -> tuple[ReadLevel, ...]:
    """Return the levels read from the recordings of a case, one for each recording."""
    streams = rng.spawn(len(case.recordings))
    loaded = (load_recording(spec, case.folder, settings.recording) for spec in case.recordings)
    return tuple(
        read_level(extract_signals(one), registry, own, settings) for one, own in zip(loaded, streams, strict=True)
    )


def read_level(
    signals: Signals, registry: Registry, rng: np.random.Generator, settings: Settings = DEFAULT
) -> ReadLevel:
    """Return the level read from a recording; raise `CaseError` where the drive is not harmonic.

    A motion that repeats to within its noise is periodic; otherwise the exponent decides.
    """
    amplitude, omega = fit_harmonic(signals)
    motion = settings.motion
    level = Level(signals.name, amplitude, omega, unit=signals.unit)
    period = 2.0 * math.pi / omega
    series = embed(checked(signals.x), registry.make("embedder", EMBEDDER), dt=signals.dt, period=period)

    def measured(name: str, **options: int) -> Estimate:
        return quantify(series, registry.make("quantifier", name, **options), rng=rng)

    def repeats(noise: float) -> bool:
        return bool(find_return(series, period, noise)[0])

    if repeats(motion.loudest) and repeats(_bound_noise(measured(METER), motion)):
        return ReadLevel(replace(level, motion="periodic"))
    exponent = measured(EXPONENT)
    if exponent.status not in ("ok", "uncertain") or exponent.low <= 0.0:
        return ReadLevel(level, exponent)
    dimension = measured(DIMENSION, pairs=PAIRS)
    seen_as = "d2" if signals.unit in FORCE_UNITS else "d2 of a moved base"
    found = correct_estimate(seen_as, dimension) if dimension.ok else None
    level = replace(level, motion="chaotic", lyapunov=correct_estimate("lyapunov", exponent), d2=found)
    return ReadLevel(level, exponent, dimension)


def _bound_noise(noise: Estimate, limits: MotionSettings) -> float:
    """Return the upper end of the noise level, limited to the largest level that is accepted as noise."""
    return min(noise.high, limits.loudest) if math.isfinite(noise.high) else 0.0


def correct_estimate(name: str, estimate: Estimate) -> Measured:
    """Return an estimate corrected for its measured bias, with its measured standard deviation."""
    bias, scale, share = ESTIMATOR_ERRORS[name]
    value, claimed = estimate.value / (1.0 + bias), (estimate.high - estimate.low) / 3.92
    return Measured(value, math.hypot(scale * claimed, share * estimate.value))


def fit_harmonic(signals: Signals) -> tuple[float, float]:
    """Return amplitude and angular frequency (rad/s) of the drive, by least squares on the measured excitation."""
    period = refined_period(signals.u, signals.dt)
    if period is None:
        raise CaseError(
            f"the excitation of {signals.name} is not periodic: the quantifier route needs a harmonic drive at one "
            "level in each recording"
        )
    omega = 2.0 * math.pi / period
    angle = omega * signals.dt * np.arange(len(signals.u))
    waves = np.stack([np.cos(angle), np.sin(angle), np.ones_like(angle)], axis=1)
    found = np.linalg.lstsq(waves, signals.u, rcond=None)[0]
    rest = float(np.std(signals.u - waves @ found)) / max(float(np.std(signals.u)), 1e-300)
    if rest > HARMONIC:
        raise CaseError(
            f"the excitation of {signals.name} is not a sine: {percent(rest)} of it remain beside the best sine, and "
            f"the quantifier route allows {100 * HARMONIC:g} %"
        )
    return float(math.hypot(found[0], found[1])), omega
