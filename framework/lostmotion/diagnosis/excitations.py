"""Candidate excitations: levels, frequencies and waveforms within the limits of a machine."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array
from lostmotion.likelihood.drive import DriveHarmonic
from lostmotion.likelihood.observation import Observation

FACTORS = (0.5, 0.7, 1.4, 2.0)
"""Levels and frequencies that are tried, relative to those of the recording."""
FEWEST = 10.0
"""The smallest number of samples per period of an excitation."""
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
LINES = 20
REPEAT, HARMONIC, TONES, SWEEP, MULTISINE = "repeat", "harmonic", "two tones", "slow sweep", "random-phase multisine"


class Limits(NamedTuple):
    """The largest level (amplitude, SI unit of the input) and the highest frequency (Hz) that are allowed."""

    level: float
    frequency: float


@dataclass(frozen=True)
class Excitation:
    """An excitation: `inputs` (samples, inputs) and the name of its waveform.

    `level` is sqrt(2) times the rms in the unit of the input, the amplitude of a sine; `band` (Hz) holds its lowest and
    highest frequency.
    """

    waveform: str
    level: float
    band: tuple[float, float]
    inputs: Array
    harmonic: DriveHarmonic


def repeat_drive(observation: Observation, samples: int, natural: float) -> Excitation:
    """Return the first samples of the input of a recording; `natural` (Hz) is used if it has no single frequency."""
    frequency = find_frequency(observation, natural)
    return Excitation(
        REPEAT, observation.travel, (frequency, frequency), observation.inputs[:samples], observation.harmonic
    )


def find_frequency(observation: Observation, natural: float) -> float:
    """Return the frequency (Hz) of the drive of a recording, or `natural` if there is no single one."""
    period = observation.period
    return 1.0 / (period * observation.dt) if period else natural


def choose_limits(observation: Observation, natural: float) -> Limits:
    """Return twice the level and twice the frequency of a recording."""
    return Limits(2.0 * observation.travel, 2.0 * find_frequency(observation, natural))


def list_candidates(
    observation: Observation, samples: int, limits: Limits, rng: np.random.Generator
) -> list[Excitation]:
    """Return the excitations to compare, each with this number of samples every `observation.dt` s."""
    natural = 0.5 * limits.frequency
    frequency, level = find_frequency(observation, natural), observation.travel
    top = min(limits.frequency, 1.0 / (FEWEST * observation.dt))
    levels, frequencies = _list_within(level, limits.level), _list_within(frequency, top)
    found = [_make_excitation(observation, samples, HARMONIC, a, _list_tones([f])) for a in levels for f in frequencies]
    if observation.period:
        found = [c for c in found if not (_is_near(c.level, level) and _is_near(c.band[0], frequency))]
    band = (min(0.5 * frequency, 0.5 * top), min(2.0 * frequency, top))
    for a in sorted({min(level, limits.level), max(levels)}):
        found.append(_make_excitation(observation, samples, TONES, a, _list_tones([GOLDEN * band[1], band[1]])))
        found.append(_make_excitation(observation, samples, SWEEP, a, band))
        found.append(_make_excitation(observation, samples, MULTISINE, a, _draw_multisine(band, rng)))
    return found


def _is_near(a: float, b: float) -> bool:
    return abs(a - b) < 0.05 * b


def _list_within(usual: float, most: float) -> list[float]:
    """Return the values to try around a usual one, with the limit `most` if it is at most twice the usual value."""
    tried = [f * usual for f in (*FACTORS, 1.0) if f * usual <= most * 1.0001]
    return sorted(tried if any(_is_near(t, most) for t in tried) or most > 2.0 * usual else [*tried, most])


Wave = list[tuple[float, float, float]]
"""Lines of a signal: share of the power, frequency (Hz), phase (rad)."""


def _list_tones(frequencies: list[float]) -> Wave:
    return [(1.0 / len(frequencies), f, 0.5 * k * math.pi) for k, f in enumerate(frequencies)]


def _draw_multisine(band: tuple[float, float], rng: np.random.Generator) -> Wave:
    lines = np.linspace(*band, LINES)
    return [
        (1.0 / LINES, float(f), float(phase))
        for f, phase in zip(lines, rng.uniform(0, 2 * math.pi, LINES), strict=True)
    ]


def _make_excitation(
    observation: Observation, samples: int, waveform: str, level: float, shape: Wave | tuple[float, float]
) -> Excitation:
    """Return an excitation about the mean of the old one; a `shape` that is a pair is the band (Hz) of a sweep."""
    t: Array = np.arange(samples, dtype=float) * observation.dt
    if isinstance(shape, tuple):
        rows, band = [_compute_sweep(t, shape)], shape
    else:
        rows = list(_compute_waves(t, shape))
        band = (min(f for _, f, _ in shape), max(f for _, f, _ in shape))
    value, slope = (level * np.sum([row[k] for row in rows], axis=0) for k in (0, 1))
    inputs = np.tile(np.mean(observation.inputs, axis=0), (samples, 1))
    inputs[:, observation.lead] += value
    if observation.slope is not None:
        inputs[:, observation.slope] = slope
    omega = 2.0 * math.pi * band[0] if waveform == HARMONIC else 0.0
    return Excitation(waveform, level, band, inputs, DriveHarmonic(omega, level))


def _compute_waves(t: Array, wave: Wave) -> Iterator[tuple[Array, Array]]:
    for share, f, phase in wave:
        omega, size = 2.0 * math.pi * f, math.sqrt(share)
        yield size * np.cos(omega * t + phase), -size * omega * np.sin(omega * t + phase)


def _compute_sweep(t: Array, band: tuple[float, float]) -> tuple[Array, Array]:
    """Return a linear sine sweep over a band, and its derivative."""
    first, last = (2.0 * math.pi * f for f in band)
    pace = (last - first) / max(float(t[-1]), 1e-300)
    angle = (first + 0.5 * pace * t) * t
    return np.sin(angle), (first + pace * t) * np.cos(angle)
