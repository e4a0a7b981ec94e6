"""Figs. 11 to 16: what noise does to the tools on Case 3, and what noise reduction does to the noise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion_trials.paper.cases import CASES
from lostmotion_trials.paper.chain import Slopes, cleaned, first_minimum, size, slopes, unfolded
from lostmotion_trials.paper.drawings import (
    CleanedMapsDrawing,
    NoisyCaoDrawing,
    NoisyInformationDrawing,
    NoisyMapsDrawing,
    SlopesDrawing,
)
from lostmotion_trials.paper.lab import Lab, SampledFlow
from lostmotion_trials.paper.outcome import PaperOutcome, verdict_of
from lostmotion_trials.paper.portraits import shared

LEVELS = (0.0, 0.01, 0.05, 0.1)
"""Standard deviation of the noise over that of the motion: so "1 %, 5 % and 10 % of the mean square" is read."""
NAMES = ("without noise", "1 % noise", "5 % noise", "10 % noise")
DELAY = 0.08
"""The delay (s) of Fig. 12."""
PAPER_LAG = 0.102
PERIOD_LOOKS = 40


@dataclass(frozen=True, eq=False)
class Noisy:
    """The motion of Case 3 without noise `true` (n,), and with noise at the four levels, embedded."""

    true: Array
    dt: float
    period: float
    series: tuple[Series, ...]


def _begun(lab: Lab) -> tuple[SampledFlow, Array]:
    """Return the flow of Case 3 and a state on its chaotic attractor."""
    found = shared(lab, 3)
    return CASES[3].flow(lab), found.states[int(np.argmax(found.chaotic)), -1]


def _made(lab: Lab, periods: int, looks: int) -> Noisy:
    flow, start = _begun(lab)
    x = flow.sample(start, periods=periods, looks=looks)[:-1, 0]
    true, dt, rng = x - x.mean(), flow.period / looks, lab.rng("noise")
    noisy = [true + level * size(true) * rng.standard_normal(len(true)) for level in LEVELS]
    return Noisy(true, dt, flow.period, tuple(unfolded(lab, y, dt, flow.period) for y in noisy))


def recorded(lab: Lab) -> Noisy:
    """Return the recordings for delay, dimension and surrogates."""
    return lab.once("noisy", lambda: _made(lab, *lab.pick((300, 80), (120, 60))))


def long(lab: Lab) -> Noisy:
    """Return longer recordings with fewer samples a period, for Poincare maps."""
    return lab.once("long", lambda: _made(lab, lab.pick(2500, 500), PERIOD_LOOKS))


def fig11(lab: Lab) -> PaperOutcome:
    """Return the motion of Case 3 and its mutual information at four noise levels."""
    made = recorded(lab)
    curves = [s.embedding.curves for s in made.series]
    lags = [first_minimum(c, 0.05 * made.period) for c in curves]
    heights = [float(np.interp(lags[0], c["lag"], c["ami"])) for c in curves]
    says = (
        f"The first minimum lies at {lags[0]:.3f} s without noise and at {lags[1]:.3f}, {lags[2]:.3f} and "
        f"{lags[3]:.3f} s with 1, 5 and 10 % (paper: {PAPER_LAG} s for all); noise lowers the whole curve, as the "
        "paper says. The minimum is broad: where it is lowest depends on bins and sampling."
    )
    shown = np.arange(len(made.true)) * made.dt < 12.0
    both = [c["lag"] for c in curves], [c["ami"] for c in curves]
    data = NoisyInformationDrawing(made.dt * np.flatnonzero(shown).astype(float), made.true[shown], NAMES, *both)
    numbers = {f"lag_{100 * level:g}": lag for level, lag in zip(LEVELS, lags, strict=True)}
    lower = bool(np.all(np.diff(heights) < 0.0))
    same = max(lags) - min(lags) < 0.015
    return PaperOutcome(verdict_of(abs(lags[0] - PAPER_LAG) < 0.012, same, lower), says, numbers, data)


def _map(lab: Lab, x: Array, dt: float) -> Array:
    """Return x and x a delay later (periods, 2), once a period."""
    lag = round(DELAY / dt)
    return np.column_stack([x[:-lag:PERIOD_LOOKS], x[lag::PERIOD_LOOKS]])


def fig12(lab: Lab) -> PaperOutcome:
    """Return Poincare maps at four noise levels."""
    made = long(lab)
    maps = [_map(lab, s.x, made.dt) for s in made.series]
    width = float(np.ptp(maps[0][:, 0])) / size(made.true)
    says = (
        f"The clean map is a thin fractal curve, {width:.2f} standard deviations of the motion wide; one per cent of "
        f"noise blurs it and ten per cent, {0.1 / width:.1f} times its width, hides it, as the paper shows."
    )
    numbers = {"width_over_std": width}
    return PaperOutcome(verdict_of(0.0 < width < 0.1, width > 0.01), says, numbers, NoisyMapsDrawing(NAMES, maps))


def fig13(lab: Lab) -> PaperOutcome:
    """Return Cao's E1 at four noise levels."""
    dims = [s.embedding.dim for s in recorded(lab).series]
    says = (
        f"E1 asks for {dims[0]} dimensions without noise and {dims[1]}, {dims[2]} and {dims[3]} with 1, 5 and 10 % "
        "(paper: 3 without, 6 with 10 %): more noise, more dimensions."
    )
    curves = [s.embedding.curves for s in recorded(lab).series]
    data = NoisyCaoDrawing(NAMES, [c["dim"] for c in curves], [c["e1"] for c in curves])
    numbers = {f"dim_{100 * level:g}": float(d) for level, d in zip(LEVELS, dims, strict=True)}
    rising = bool(np.all(np.diff(dims) >= 0) and dims[-1] > dims[0])
    return PaperOutcome(verdict_of(rising, abs(dims[0] - 3) <= 1, abs(dims[-1] - 6) <= 2), says, numbers, data)


def fig14(lab: Lab) -> PaperOutcome:
    """Return slopes of the correlation sum over dimension, with those of surrogates, at four noise levels."""
    found: list[Slopes] = [
        slopes(lab, s, lab.pick(20, 4), f"surrogates {k}") for k, s in enumerate(recorded(lab).series)
    ]
    differs = [f.differs for f in found]
    seen = [name for name, yes in zip(NAMES, differs, strict=True) if yes]
    says = (
        f"The recording lies beyond three standard deviations of its surrogates at most dimensions: "
        f"{', '.join(seen) or 'at no level'} (paper: at all four). The motion is all but periodic, so surrogates with "
        "the same spectrum keep its cycles: only the small distances tell them apart, and noise hides these first."
    )
    numbers = {f"apart_{100 * level:g}": float(np.median(f.apart[2:])) for level, f in zip(LEVELS, found, strict=True)}
    numbers |= {f"slope_{100 * level:g}": float(f.recorded[4]) for level, f in zip(LEVELS, found, strict=True)}
    return PaperOutcome(verdict_of(*differs), says, numbers, SlopesDrawing(found, NAMES))


def _reduced(lab: Lab) -> tuple[list[Array], list[float]]:
    """Return the cleaned recordings, and what is left of the noise over what there was."""

    def make() -> tuple[list[Array], list[float]]:
        made = long(lab)
        noise = [level * size(made.true) for level in LEVELS]
        clean = [cleaned(lab, s, n) if n else s.x for s, n in zip(made.series, noise, strict=True)]
        left = [size(c - made.true) / n if n else math.nan for c, n in zip(clean, noise, strict=True)]
        return clean, left

    return lab.once("reduced", make)


def _maps(lab: Lab, window: Array | None = None) -> CleanedMapsDrawing:
    made, (clean, _) = long(lab), _reduced(lab)
    noisy, cleaned = ([_map(lab, x, made.dt) for x in xs] for xs in ([s.x for s in made.series], clean))
    return CleanedMapsDrawing(NAMES, noisy, cleaned, window)


def fig15(lab: Lab) -> PaperOutcome:
    """Return Poincare maps behind simple non-linear noise reduction."""
    _, left = _reduced(lab)
    says = (
        f"Simple noise reduction leaves {left[1]:.2f}, {left[2]:.2f} and {left[3]:.2f} of the noise at 1, 5 and 10 % "
        "(its level being known here): it does well below 10 %, as the paper says."
    )
    numbers = {f"left_{100 * level:g}": x for level, x in zip(LEVELS[1:], left[1:], strict=True)}
    return PaperOutcome(verdict_of(left[1] < 0.6, left[2] < 0.6), says, numbers, _maps(lab))


def fig16(lab: Lab) -> PaperOutcome:
    """Return a part of the maps, enlarged: a window around the middle of the clean map."""
    clean, (reduced, _) = _map(lab, long(lab).true, long(lab).dt), _reduced(lab)
    low, high = clean.min(axis=0), clean.max(axis=0)
    room = 0.6 * (high - low)
    window = np.column_stack([low - room, high + room])
    off = [_off(_map(lab, x, long(lab).dt), clean) / float(np.linalg.norm(high - low)) for x in reduced]
    says = (
        f"Enlarged, the distance of a cleaned point from the clean curve is {100 * off[1]:.1f} % of its length at 1 % "
        f"of noise, {100 * off[2]:.1f} % at 5 % and {100 * off[3]:.1f} % at 10 % (medians)."
    )
    numbers = {f"off_{100 * level:g}": x for level, x in zip(LEVELS[1:], off[1:], strict=True)}
    return PaperOutcome(verdict_of(off[1] < 0.02, off[2] < 0.1), says, numbers, _maps(lab, window))


def _off(points: Array, curve: Array) -> float:
    """Return the median distance of `points` (n, 2) from the nearest point of `curve` (m, 2)."""
    some = points[:: max(len(points) // 400, 1)]
    return float(np.median(np.sqrt(((some[:, None] - curve[None]) ** 2).sum(axis=2)).min(axis=1)))
