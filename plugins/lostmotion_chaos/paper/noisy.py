"""Figs. 11 to 16: the effect of noise on the methods for Case 3, and of noise reduction on the noise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion_chaos.paper.cases import CASES
from lostmotion_chaos.paper.chain import (
    Slopes,
    clean_recording,
    compute_std,
    embed_recording,
    find_first_minimum,
    measure_slopes,
)
from lostmotion_chaos.paper.drawings import (
    CleanedMapsDrawing,
    NoisyCaoDrawing,
    NoisyInformationDrawing,
    NoisyMapsDrawing,
    SlopesDrawing,
)
from lostmotion_chaos.paper.lab import Lab, SampledFlow
from lostmotion_chaos.paper.outcome import PaperOutcome, judge_claims
from lostmotion_chaos.paper.portraits import follow_case

LEVELS = (0.0, 0.01, 0.05, 0.1)
"""Standard deviation of the noise over that of the motion: our reading of "1 %, 5 % and 10 % of the mean square"."""
NAMES = ("without noise", "1 % noise", "5 % noise", "10 % noise")
DELAY = 0.08
"""The delay (s) of Fig. 12."""
PAPER_LAG = 0.102
"""The delay (s) that the paper takes from the mutual information."""
PERIOD_LOOKS = 40
"""Samples per drive period of the long recordings."""


@dataclass(frozen=True, eq=False)
class Noisy:
    """The motion of Case 3 without noise, `true` (n,) in m, and with noise at the four levels, embedded."""

    true: Array
    dt: float
    period: float
    series: tuple[Series, ...]


def _find_start(lab: Lab) -> tuple[SampledFlow, Array]:
    """Return the flow of Case 3 and a state on its chaotic attractor."""
    found = follow_case(lab, 3)
    return CASES[3].make_flow(lab), found.states[int(np.argmax(found.chaotic)), -1]


def _make_recordings(lab: Lab, periods: int, looks: int) -> Noisy:
    """Return recordings of Case 3 at the four noise levels, with `looks` samples per drive period."""
    flow, start = _find_start(lab)
    x = flow.sample(start, periods=periods, looks=looks)[:-1, 0]
    true, dt, rng = x - x.mean(), flow.period / looks, lab.make_rng("noise")
    noisy = [true + level * compute_std(true) * rng.standard_normal(len(true)) for level in LEVELS]
    return Noisy(true, dt, flow.period, tuple(embed_recording(lab, y, dt, flow.period) for y in noisy))


def make_recordings(lab: Lab) -> Noisy:
    """Return the recordings for delay, dimension and surrogates."""
    return lab.compute_once("noisy", lambda: _make_recordings(lab, *lab.pick((300, 80), (120, 60))))


def make_long_recordings(lab: Lab) -> Noisy:
    """Return longer recordings with fewer samples per period, for Poincare maps."""
    return lab.compute_once("long", lambda: _make_recordings(lab, lab.pick(2500, 500), PERIOD_LOOKS))


def fig11(lab: Lab) -> PaperOutcome:
    """Return the motion of Case 3 and its mutual information at four noise levels."""
    made = make_recordings(lab)
    curves = [s.embedding.curves for s in made.series]
    lags = [find_first_minimum(c, 0.05 * made.period) for c in curves]
    heights = [float(np.interp(lags[0], c["lag"], c["ami"])) for c in curves]
    says = (
        f"The first minimum lies at {lags[0]:.3f} s without noise and at {lags[1]:.3f}, {lags[2]:.3f} and "
        f"{lags[3]:.3f} s with 1, 5 and 10 % (paper: {PAPER_LAG} s for all); noise lowers the whole curve, as the "
        "paper says. The minimum is broad: its exact place depends on bins and sampling."
    )
    shown = np.arange(len(made.true)) * made.dt < 12.0
    both = [c["lag"] for c in curves], [c["ami"] for c in curves]
    data = NoisyInformationDrawing(made.dt * np.flatnonzero(shown).astype(float), made.true[shown], NAMES, *both)
    numbers = {f"lag_{100 * level:g}": lag for level, lag in zip(LEVELS, lags, strict=True)}
    lower = bool(np.all(np.diff(heights) < 0.0))
    same = max(lags) - min(lags) < 0.015
    return PaperOutcome(judge_claims(abs(lags[0] - PAPER_LAG) < 0.012, same, lower), says, numbers, data)


def _make_map(lab: Lab, x: Array, dt: float) -> Array:
    """Return x and x after the delay (periods, 2) in m, once per drive period."""
    lag = round(DELAY / dt)
    return np.column_stack([x[:-lag:PERIOD_LOOKS], x[lag::PERIOD_LOOKS]])


def fig12(lab: Lab) -> PaperOutcome:
    """Return Poincare maps at four noise levels."""
    made = make_long_recordings(lab)
    maps = [_make_map(lab, s.x, made.dt) for s in made.series]
    width = float(np.ptp(maps[0][:, 0])) / compute_std(made.true)
    says = (
        f"The map without noise is a thin fractal curve, {width:.2f} standard deviations of the motion wide. 1 % noise "
        f"blurs it; 10 % noise, {0.1 / width:.1f} times its width, makes it invisible, as the paper shows."
    )
    numbers = {"width_over_std": width}
    return PaperOutcome(judge_claims(0.0 < width < 0.1, width > 0.01), says, numbers, NoisyMapsDrawing(NAMES, maps))


def fig13(lab: Lab) -> PaperOutcome:
    """Return Cao's E1 at four noise levels."""
    dims = [s.embedding.dim for s in make_recordings(lab).series]
    says = (
        f"E1 gives {dims[0]} dimensions without noise and {dims[1]}, {dims[2]} and {dims[3]} with 1, 5 and 10 % noise "
        "(paper: 3 without, 6 with 10 %): the dimension rises with the noise."
    )
    curves = [s.embedding.curves for s in make_recordings(lab).series]
    data = NoisyCaoDrawing(NAMES, [c["dim"] for c in curves], [c["e1"] for c in curves])
    numbers = {f"dim_{100 * level:g}": float(d) for level, d in zip(LEVELS, dims, strict=True)}
    rising = bool(np.all(np.diff(dims) >= 0) and dims[-1] > dims[0])
    return PaperOutcome(judge_claims(rising, abs(dims[0] - 3) <= 1, abs(dims[-1] - 6) <= 2), says, numbers, data)


def fig14(lab: Lab) -> PaperOutcome:
    """Return slopes of the correlation sum over dimension at four noise levels, of recordings and surrogates."""
    found: list[Slopes] = [
        measure_slopes(lab, s, lab.pick(20, 4), f"surrogates {k}") for k, s in enumerate(make_recordings(lab).series)
    ]
    differs = [f.differs for f in found]
    seen = [name for name, yes in zip(NAMES, differs, strict=True) if yes]
    says = (
        f"The recording lies beyond three standard deviations of its surrogates at most dimensions: "
        f"{', '.join(seen) or 'at no level'} (paper: at all four). The motion is nearly periodic, so surrogates with "
        "the same spectrum keep its cycles: they differ from the recording at small distances only, and noise hides "
        "these first."
    )
    numbers = {
        f"apart_{100 * level:g}": float(np.median(f.separation[2:])) for level, f in zip(LEVELS, found, strict=True)
    }
    numbers |= {f"slope_{100 * level:g}": float(f.recorded[4]) for level, f in zip(LEVELS, found, strict=True)}
    return PaperOutcome(judge_claims(*differs), says, numbers, SlopesDrawing(found, NAMES))


def _reduce_noise(lab: Lab) -> tuple[list[Array], list[float]]:
    """Return the cleaned recordings, and for each the remaining noise over the original noise."""

    def make() -> tuple[list[Array], list[float]]:
        made = make_long_recordings(lab)
        noise = [level * compute_std(made.true) for level in LEVELS]
        clean = [clean_recording(lab, s, n) if n else s.x for s, n in zip(made.series, noise, strict=True)]
        left = [compute_std(c - made.true) / n if n else math.nan for c, n in zip(clean, noise, strict=True)]
        return clean, left

    return lab.compute_once("reduced", make)


def _make_maps_drawing(lab: Lab, window: Array | None = None) -> CleanedMapsDrawing:
    """Return the Poincare maps before and after noise reduction."""
    made, (clean, _) = make_long_recordings(lab), _reduce_noise(lab)
    noisy, cleaned = ([_make_map(lab, x, made.dt) for x in xs] for xs in ([s.x for s in made.series], clean))
    return CleanedMapsDrawing(NAMES, noisy, cleaned, window)


def fig15(lab: Lab) -> PaperOutcome:
    """Return Poincare maps after simple non-linear noise reduction."""
    _, left = _reduce_noise(lab)
    says = (
        f"Simple noise reduction leaves {left[1]:.2f}, {left[2]:.2f} and {left[3]:.2f} of the noise at 1, 5 and 10 % "
        "(the noise level is known here): it works well below 10 %, as the paper says."
    )
    numbers = {f"left_{100 * level:g}": x for level, x in zip(LEVELS[1:], left[1:], strict=True)}
    return PaperOutcome(judge_claims(left[1] < 0.6, left[2] < 0.6), says, numbers, _make_maps_drawing(lab))


def fig16(lab: Lab) -> PaperOutcome:
    """Return an enlarged window of the maps, centred on the clean map."""
    made, (reduced, _) = make_long_recordings(lab), _reduce_noise(lab)
    clean = _make_map(lab, made.true, made.dt)
    low, high = clean.min(axis=0), clean.max(axis=0)
    room = 0.6 * (high - low)
    window = np.column_stack([low - room, high + room])
    length = float(np.linalg.norm(high - low))
    off = [_measure_distance(_make_map(lab, x, made.dt), clean) / length for x in reduced]
    says = (
        f"The median distance of a cleaned point from the noise-free curve is {100 * off[1]:.1f} % of the length of "
        f"the curve at 1 % noise, {100 * off[2]:.1f} % at 5 % and {100 * off[3]:.1f} % at 10 %."
    )
    numbers = {f"off_{100 * level:g}": x for level, x in zip(LEVELS[1:], off[1:], strict=True)}
    return PaperOutcome(judge_claims(off[1] < 0.02, off[2] < 0.1), says, numbers, _make_maps_drawing(lab, window))


def _measure_distance(points: Array, curve: Array) -> float:
    """Return the median distance of `points` (n, 2) from the nearest point of `curve` (m, 2)."""
    some = points[:: max(len(points) // 400, 1)]
    return float(np.median(np.sqrt(((some[:, None] - curve[None]) ** 2).sum(axis=2)).min(axis=1)))
