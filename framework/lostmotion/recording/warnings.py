"""Warnings about a recording that can be used: signs, swapped columns, units of angles, sensors, clocks.

False alarms must be rare: each condition was checked on recordings without the fault, real ones among them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lostmotion.quantities import si_factor
from lostmotion.recording.drift import note_drift
from lostmotion.recording.value_checks import fill_lost, runs_of
from lostmotion.settings import DEFAULT, RecordingSettings

Array = NDArray[np.float64]
JUMP, WHOLE = 0.75, 1e-12
"""A counter overflows when it jumps by this share of its range, and by at most the rest of it elsewhere; the error of
whole numbers that were converted to SI units."""
QUIET, MOSTLY = 0.05, 0.9
"""An input is impulsive when more than the second share of its samples is below the first share of its peak."""
SEGMENTS, HEARD = 16, 1e-3
"""Segments over which the power is averaged; frequencies from this share of the strongest power on are counted."""
BACKWARD = "on average power flows from the machine to its drive"
"""The first words of the note on a wrong sign."""
_POWERS = {("force", "position"): 1, ("force", "velocity"): 0, ("force", "acceleration"): -1}
_ANGLE = {"deg": re.compile(r"deg|°"), "rad": re.compile(r"rad")}


class CheckedChannel(NamedTuple):
    """A channel in SI units (n,), NaN where a sample was lost, with its column, quantity and the unit of its file."""

    values: Array
    column: str
    quantity: str
    unit: str
    factor: float

    @property
    def kind(self) -> str:
        """The quantity; a torque counts as a force."""
        return "force" if self.quantity == "torque" else self.quantity


def warnings_of(
    inputs: Sequence[CheckedChannel],
    sensors: Sequence[CheckedChannel],
    dt: float,
    limits: RecordingSettings = DEFAULT.recording,
) -> tuple[str, ...]:
    """Return warnings about inputs and sensors that were sampled together every `dt` s.

    Units and power are compared only where there is one input: of several, one may absorb the power of another. Clocks
    are not compared in a hammer test: the force is zero between hits, and the frequency may depend on the amplitude.
    """
    from lostmotion.signals.impacts import note_hits, note_overload  # imported late: it loads SciPy

    each = [*(("excitation", s) for s in inputs), *(("response", s) for s in sensors)]
    pairs = [(inputs[0], sensors[0])] if len(inputs) == 1 else []
    return (
        *(note for role, signal in each for note in note_angle(signal, f"the {role} {signal.column!r}", limits)),
        *(note for s in sensors for note in note_overflow(s, f"the response {s.column!r}")),
        *(note for pair in pairs for note in note_units(*pair, limits)),
        *(note for s in sensors for note in note_frozen(s.values, f"the response {s.column!r}", dt, limits)),
        *(note for role, s in each for note in note_far(s.values, f"the {role} {s.column!r}", limits)),
        *(note for s in sensors for note in note_overload(s.values, f"the response {s.column!r}", stuck=limits.stuck)),
        *(note for u in inputs if is_impulsive(u.values) for note in note_hits(u.values, dt)),
        *(note for pair in pairs for note in note_power(*pair, dt, limits)),
        *(note for u, z in pairs if not is_impulsive(u.values) for note in note_drift(u.values, z.values, dt, limits)),
    )


def note_overflow(signal: CheckedChannel, what: str) -> Iterator[str]:
    """Yield a note when a channel of whole numbers jumps by 2^16 or 2^32, as a counter that overflows does."""
    counts = signal.values / signal.factor
    seen = counts[np.isfinite(counts)]
    if seen.size < 2 or np.abs(seen - np.rint(seen)).max() > WHOLE * max(1.0, float(np.abs(seen).max())):
        return
    steps, width = np.abs(np.diff(seen)), float(np.ptp(seen)) + 1.0
    for bits in (16, 32):
        size = 2.0**bits
        jumps = steps > JUMP * size
        if jumps.any() and width <= size and steps[~jumps].max(initial=0.0) < (1.0 - JUMP) * size:
            yield (
                f"{what} jumps by about {size:.0f} at {int(jumps.sum())} samples: a counter of {bits} bits that"
                f" overflows? Undo it, for instance by numpy.unwrap(x, period={size:.0f})"
            )


def is_impulsive(values: Array) -> bool:
    """Return whether an input (n,) is at rest most of the time, as the force of a hammer is."""
    away = np.abs(values - np.median(values))
    return float(np.mean(away < QUIET * away.max())) > MOSTLY


def note_angle(signal: CheckedChannel, what: str, limits: RecordingSettings) -> Iterator[str]:
    """Yield a note when an angle in rad is so large that its unit may be degrees."""
    if not _ANGLE["rad"].search(signal.unit) or signal.quantity not in ("position", "base_position"):
        return
    seen = signal.values[np.isfinite(signal.values)]
    away = seen - np.median(seen)
    largest, swings = float(np.abs(seen).max()), int(np.count_nonzero(np.diff(np.sign(away))))
    degrees = "are these degrees? Then write unit = 'deg'"
    if largest > 2 * math.pi * limits.turns:
        yield f"{what} reaches {largest:.4g} rad, more than {limits.turns:g} turns: {degrees}"
    elif swings >= limits.swings and np.abs(away).max() > math.pi:
        yield f"{what} oscillates by {np.abs(away).max():.4g} rad, more than half a turn: {degrees}"


def note_units(excitation: CheckedChannel, response: CheckedChannel, limits: RecordingSettings) -> Iterator[str]:
    """Yield a note when one angle is in degrees and the other in rad, but their numbers have the same size."""
    units = [next((name for name, word in _ANGLE.items() if word.search(s.unit)), "") for s in (excitation, response)]
    if sorted(units) != ["deg", "rad"] or {excitation.quantity, response.quantity} != {"base_position", "position"}:
        return
    sizes = [float(np.nanstd(s.values)) / si_factor(s.unit, s.quantity)[0] for s in (excitation, response)]
    if 1.0 / limits.same_size < sizes[0] / sizes[1] < limits.same_size:
        yield (
            f"the excitation is in {excitation.unit} and the response in {response.unit}, but their numbers have the "
            f"same size ({sizes[0]:.3g} and {sizes[1]:.3g}): are both in one unit?"
        )


def note_frozen(values: Array, what: str, dt: float, limits: RecordingSettings) -> Iterator[str]:
    """Yield a note when the samples (n,) are constant over a long run, and hardly ever repeat elsewhere."""
    for first, last in (runs := list_frozen(values, limits))[:1].tolist():
        yield (
            f"{what} stays at exactly {values[first]:.6g} for {last - first} samples from {first * dt:.6g} s "
            f"after its start, {len(runs)} such runs in all, and hardly ever repeats a value elsewhere: the sensor "
            "may have been stuck; cut these runs out with t_start and t_end"
        )


def list_frozen(values: Array, limits: RecordingSettings) -> NDArray[np.intp]:
    """Return the first sample and the sample after the last of each long run of one value (runs, 2).

    There is none if the samples (n,) often repeat a value elsewhere, as those of a coarse converter do.
    """
    runs = runs_of(np.diff(values) == 0.0)
    lengths = np.diff(runs, axis=1)[:, 0]
    long = lengths >= limits.frozen
    if lengths[~long].sum() > limits.repeats * values.size:
        return runs[:0]
    return np.array([0, 1]) + runs[long]


def note_far(values: Array, what: str, limits: RecordingSettings) -> Iterator[str]:
    """Yield a note when one value lies far from all others, as a marker of lost samples does."""
    seen = values[np.isfinite(values)]
    for far in list_far(seen, limits):
        yield (
            f"{what} is {far:.6g} at {int(np.count_nonzero(seen == far))} samples, more than {limits.far:g} times "
            "the range of all others away: a glitch, or a marker of lost samples? Then empty these cells"
        )


def list_far(seen: Array, limits: RecordingSettings) -> list[float]:
    """Return the largest and the smallest of some finite values (n,), each if it lies far from all others."""
    found = []
    for far in (float(seen.max()), float(seen.min())):
        rest = seen[seen != far]
        width = float(np.ptp(rest)) if rest.size else 0.0
        if width and abs(far - float(np.median(rest))) > limits.far * width:
            found.append(far)
    return found


def note_power(
    excitation: CheckedChannel, response: CheckedChannel, dt: float, limits: RecordingSettings
) -> Iterator[str]:
    """Yield a note when on average power flows from the machine to its drive, which a passive machine cannot do."""
    pair = (excitation.kind, response.kind)
    if pair == ("base_position", "force"):
        force, motion, order = response, excitation, 1
    elif pair in _POWERS:
        force, motion, order = excitation, response, _POWERS[pair]
    else:
        return
    share, errors = mean_power(fill_lost(force.values), fill_lost(motion.values), dt, order)
    if share < -limits.returned and errors < -limits.returned_errors:
        yield (
            f"{BACKWARD} ({-share:.2g} of force times speed): one of the "
            f"signs is wrong (factor = -1.0), or {excitation.column!r} and {response.column!r} are swapped, or one of "
            "them is late"
        )


def mean_power(force: Array, motion: Array, dt: float, order: int) -> tuple[float, float]:
    """Return the mean power divided by the apparent power, and divided by its own standard error.

    The speed is the derivative of `motion` (n,) of the given `order`. Only frequencies that the force contains count.
    """
    size = 2 * (motion.size // (SEGMENTS + 1))
    if size < 16:
        return 0.0, 0.0
    omega = 2.0 * math.pi * np.fft.rfftfreq(size, dt)
    omega[0] = 1.0
    one = _spectra(force / (np.abs(force).max() or 1.0), size)
    other = _spectra(motion / (np.abs(motion).max() or 1.0), size) * (1j * omega) ** order
    loud = np.mean(np.abs(one) ** 2, axis=0)
    loud[:2] = 0.0
    heard = loud > HEARD * loud.max()
    power = np.sum((np.conj(one) * other).real[:, heard], axis=1)
    apparent = float(np.mean(np.linalg.norm(one[:, heard], axis=1) * np.linalg.norm(other[:, heard], axis=1)))
    error = float(np.std(power, ddof=1)) / math.sqrt(SEGMENTS)
    mean = float(np.mean(power))
    return (mean / apparent, mean / error) if apparent and error else (0.0, 0.0)


def _spectra(values: Array, size: int) -> NDArray[np.complex128]:
    """Return the spectra (segments, size // 2 + 1) of overlapping, tapered segments after removal of their means."""
    pieces = np.stack([values[k * (size // 2) :][:size] for k in range(SEGMENTS)])
    return np.fft.rfft((pieces - pieces.mean(axis=1, keepdims=True)) * np.hanning(size), axis=1)
