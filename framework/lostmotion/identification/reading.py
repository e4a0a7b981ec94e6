"""What one recording says of its level: the drive, the kind of motion, the exponent and the correlation dimension.

The chain is that of `analyse` without noise reduction and surrogate tests, which cost most and serve other questions:
of a machine whose model is believed nobody asks whether it is noise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from lostmotion.analysis.beat import LOUDEST, returned
from lostmotion.analysis.embed import embed
from lostmotion.analysis.quantify import quantify
from lostmotion.case import CaseFile
from lostmotion.case.levels import Level, Measured
from lostmotion.contracts import Array
from lostmotion.defaults import DIMENSION, EMBEDDER, EXPONENT, METER
from lostmotion.errors import CaseError
from lostmotion.recording import Recording, load_recording
from lostmotion.registry import Registry
from lostmotion.results import Estimate, percent
from lostmotion.signals import checked, refined_period

PAIRS = 8_000_000
"""Pairs of points for a dimension: a fifth of the time of `analyse`, and an interval that is hardly wider."""
ERRORS = {
    "lyapunov": (0.054, 0.74, 0.063),
    "d2": (-0.019, 0.51, 0.032),
    "d2 of a moved base": (0.034, 0.51, 0.032),
}
"""Of each estimator: how much too large it is as a share of its value; by what the standard deviation that it claims is
to be multiplied; and an error beside that, as a share of the value: `benchmarks/levels.py chaos --machines 358`, of
which 114 exponents and 105 dimensions could be read.

Dimensions of machines that a force drives come out too small, which passes for more damping; those of machines on a
base that moves too large. There the motion of the base is most of what is seen, and noise that is small beside it is
four times as large beside the part that is chaotic."""
FORCES = ("N", "N m")
"""Units of a drive that is no motion of the base."""
HARMONIC = 0.1
"""Share of the excitation (standard deviation) that may be no sine of one frequency: its noise and small harmonics."""


@dataclass(frozen=True, eq=False)
class Signals:
    """A response `x` (n,) and what drove it, `u` (n,), both in SI units, sampled every `dt` s."""

    name: str
    x: Array
    u: Array
    dt: float
    unit: str


@dataclass(frozen=True, eq=False)
class Read:
    """A level as it was read, with the estimates behind it, as far as they were made."""

    level: Level
    exponent: Estimate | None = None
    dimension: Estimate | None = None


def signals_of(recording: Recording) -> Signals:
    """Return the longest stretch of a recording without a lost sample."""
    if not recording.inputs:
        raise CaseError(
            f"nothing drives the machine in {recording.name}: the quantifier route wants a harmonic drive at one level"
            " in each recording"
        )
    response, drive = recording.sensors[0], recording.inputs[0]
    x = np.asarray(response.to_numpy(), dtype=float)
    lost = np.concatenate([[-1], np.flatnonzero(~np.isfinite(x)), [len(x)]])
    longest = int(np.argmax(np.diff(lost)))
    keep = slice(int(lost[longest]) + 1, int(lost[longest + 1]))
    u = np.asarray(drive.to_numpy(), dtype=float)[keep]
    return Signals(recording.name, x[keep], u, recording.dt, str(drive.attrs["units"]))


def read_levels(case: CaseFile, registry: Registry, rng: np.random.Generator) -> tuple[Read, ...]:
    """Return what the recordings of a case say, one level each."""
    streams = rng.spawn(len(case.recordings))
    loaded = (load_recording(spec, case.folder) for spec in case.recordings)
    return tuple(read_level(signals_of(one), registry, own) for one, own in zip(loaded, streams, strict=True))


def read_level(signals: Signals, registry: Registry, rng: np.random.Generator) -> Read:
    """Return what a recording says of its level; raises `CaseError` where the drive is no harmonic one.

    A motion that comes back to within its noise is periodic; of any other one the exponent decides.
    """
    amplitude, omega = harmonic_of(signals)
    level = Level(signals.name, amplitude, omega, unit=signals.unit)
    period = 2.0 * math.pi / omega
    series = embed(checked(signals.x), registry.make("embedder", EMBEDDER), dt=signals.dt, period=period)

    def measured(name: str, **options: int) -> Estimate:
        return quantify(series, registry.make("quantifier", name, **options), rng=rng)

    if returned(series, period, LOUDEST)[0] and returned(series, period, _loudness(measured(METER)))[0]:
        return Read(replace(level, motion="periodic"))
    exponent = measured(EXPONENT)
    if exponent.status not in ("ok", "uncertain") or exponent.low <= 0.0:
        return Read(level, exponent)
    dimension = measured(DIMENSION, pairs=PAIRS)
    seen_as = "d2" if signals.unit in FORCES else "d2 of a moved base"
    found = corrected(seen_as, dimension) if dimension.ok else None
    level = replace(level, motion="chaotic", lyapunov=corrected("lyapunov", exponent), d2=found)
    return Read(level, exponent, dimension)


def _loudness(noise: Estimate) -> float:
    """Return the upper end of the noise level, no more than can pass for noise."""
    return min(noise.high, LOUDEST) if math.isfinite(noise.high) else 0.0


def corrected(name: str, estimate: Estimate) -> Measured:
    """Return an estimate without its bias, and with the standard deviation that it has been found to have."""
    bias, scale, share = ERRORS[name]
    value, claimed = estimate.value / (1.0 + bias), (estimate.high - estimate.low) / 3.92
    return Measured(value, math.hypot(scale * claimed, share * estimate.value))


def harmonic_of(signals: Signals) -> tuple[float, float]:
    """Return amplitude and angular frequency (rad/s) of the drive, by least squares on the measured excitation."""
    period = refined_period(signals.u, signals.dt)
    if period is None:
        raise CaseError(
            f"the excitation of {signals.name} is not periodic: the quantifier route wants a harmonic drive at one "
            "level in each recording"
        )
    omega = 2.0 * math.pi / period
    angle = omega * signals.dt * np.arange(len(signals.u))
    waves = np.stack([np.cos(angle), np.sin(angle), np.ones_like(angle)], axis=1)
    found = np.linalg.lstsq(waves, signals.u, rcond=None)[0]
    rest = float(np.std(signals.u - waves @ found)) / max(float(np.std(signals.u)), 1e-300)
    if rest > HARMONIC:
        raise CaseError(
            f"the excitation of {signals.name} is no sine: {percent(rest)} of it is left, {100 * HARMONIC:g} % at "
            "most are wanted by the quantifier route"
        )
    return float(math.hypot(found[0], found[1])), omega
