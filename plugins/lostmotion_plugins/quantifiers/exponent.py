"""The largest Lyapunov exponent of a recording as an estimate: with an interval, or with the reason for none."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from lostmotion.contracts import Array, Series
from lostmotion.kernels.threads import spread
from lostmotion.results import Estimate
from lostmotion_plugins.quantifiers.divergence import (
    BLOCKS,
    SMOOTH,
    Pairs,
    Spread,
    States,
    followed,
    horizon,
    states,
    strangers,
)
from lostmotion_plugins.quantifiers.divergence_fit import (
    Curves,
    Growth,
    curves,
    drift,
    growth,
    rate,
    straightened,
)

Gather = Callable[[States, int, float], Pairs]
Behind = tuple[States, Spread, Curves]
UNIT = "1/s"
DRIFT = 0.05
"""Samples by which the phase may drift over the record before it is sampled anew."""
FEWER = 0.3
"""Share of the references that other embeddings are tried with."""
LEAST = 500
"""Fewer points are refused."""
WINDOWS = 10
"""Delay windows that must go into a record."""
PERIODIC = 0.2
"""If points one drive period apart differ by less than this share of the motion, it may be periodic."""
UNSEEN = 0.35
"""Growth by fewer e-folds than this, over all the time that pairs are followed for, is none that can be told."""
BRIEF = 0.65
"""Growth over fewer e-folds may be that of noise with a long memory, which gave 0.35 to 0.65 in 48 tries."""
NOISY = 0.5
"""With more pairs than this within the noise nothing can be read."""


def refused(status: str, says: str, kept: tuple[Mapping[str, Array], Mapping[str, float]] | None = None) -> Estimate:
    """Return a refusal with its curve and details."""
    curve, details = kept or ({}, {})
    return Estimate.refused(status, says, unit=UNIT, curve=curve, details=details)


def short(series: Series) -> Estimate | None:
    """Return a refusal if the record is too short, else None."""
    need = max(LEAST, WINDOWS * series.embedding.window, WINDOWS * series.embedding.theiler)
    if series.n >= need:
        return None
    return refused("too_short", f"{series.n} samples are too few to see neighbours part, {need} are wanted.")


def exponent(series: Series, gather: Gather, *, before: bool = False) -> Estimate:
    """Return the exponent (1/s) from the pairs that `gather(states, steps, share of the references)` finds."""
    if no := short(series):
        return no
    series = commensurate(series)
    made, *rest = prepared((series, *others(series)))
    away = strangers(made)
    steps = horizon(made, away)
    pairs = gather(made, steps, 1.0)
    paired = float((pairs.groups[:, 0, 0] >= 0).mean())
    details = {"pairs": float((pairs.groups >= 0).sum()), "repeats": pairs.repeats, "paired": paired}
    if paired < 0.5 or (pairs.groups[:, 0, 0] >= 0).sum() < 5 * BLOCKS:
        return _unpaired(pairs.repeats, paired, details)
    read = followed(made, pairs, steps, before=before)
    found = growth(read, made)
    c = curves(read.sums.sum(axis=0), made, away)
    if found is None:
        return _flat((made, read, c), details)
    doubts = _rates(rest, gather, steps, before)
    doubt = float(np.std([found.rate, *doubts[np.isfinite(doubts)]]))
    return _estimate_from(found, doubt, (made, read, c), details)


def prepared(several: tuple[Series, ...]) -> list[States]:
    """Return the states of each series, with their search trees, made side by side."""
    made = [states(series) for series in several]

    def work(begin: int, end: int) -> None:
        for k in range(begin, end):
            if not made[k].locked:
                _ = made[k].tree

    spread(work, len(made))
    return made


def commensurate(series: Series) -> Series:
    """Return the series with a whole number of samples to a drive period, by cubic splines where it has another.

    Otherwise neighbours at one drive phase are half a sample off it, and a kink in between makes them look parted.
    """
    turn = series.period / series.dt if series.period else 0.0
    whole = round(turn)
    if series.period is None or turn < SMOOTH or abs(turn / whole - 1.0) * series.n < DRIFT:
        return series
    times = np.arange(int((series.n - 1) * whole / turn) + 1) * turn / whole
    x = CubicSpline(np.arange(series.n), series.x)(times)
    return replace(series, x=x, dt=series.period / whole)


def others(series: Series) -> tuple[Series, ...]:
    """Return the series with one more dimension, and with a longer delay: what the embedding might have been."""
    e = series.embedding
    higher, longer = replace(e, dim=e.dim + 1), replace(e, lag=round(1.5 * e.lag))
    return tuple(replace(series, embedding=c) for c in ((higher, longer) if e.lag > 1 else (higher,)))


def _rates(several: list[States], gather: Gather, steps: int, before: bool) -> Array:
    """Return the exponents (1/s) of other embeddings, from fewer references; NaN where there is none."""
    found = np.full(len(several), np.nan)

    def work(begin: int, end: int) -> None:
        for k in range(begin, end):
            pairs = gather(several[k], steps, FEWER)
            if (pairs.groups[:, 0, 0] >= 0).sum() >= 5 * BLOCKS:
                found[k] = rate(followed(several[k], pairs, steps, before=before), several[k])

    spread(work, len(several))
    return found


def _unpaired(repeats: float, paired: float, details: Mapping[str, float]) -> Estimate:
    if repeats > 0.5:
        says = f"{repeats:.0%} of the points repeat exactly: the motion is periodic to the resolution of the sensor."
        return refused("regular", says, ({}, details))
    says = f"Only {paired:.0%} of the points have a neighbour at another time: record longer, or lower the dimension."
    return refused("too_few_neighbours", says, ({}, details))


def _estimate_from(found: Growth, doubt: float, behind: Behind, details: Mapping[str, float]) -> Estimate:
    """Return the estimate that the curves allow."""
    made, read, c = behind
    begin, end = found.domain.begin, found.domain.ends[0]
    middle = 0.5 * (made.smooth - 1)
    straight, intercept = straightened(c, found)
    details = {
        **details,
        "fit_begin": (begin + middle) * made.dt,
        "fit_end": (end - 1 + middle) * made.dt,
        "intercept": intercept - found.rate * middle * made.dt,
        "e_folds": float(c.log[0, end - 1] - c.log[0, begin]),
        "record_error": found.record,
        "window_error": found.windows,
        "embedding_error": doubt,
        "noise_error": abs(found.noise),
        "noise": read.noise,
        "within_noise": found.lost,
    }
    return _answer(found, details, drawn(made, c, straight))


def _answer(found: Growth, details: Mapping[str, float], curve: Mapping[str, Array]) -> Estimate:
    low, high = found.interval(details["embedding_error"])
    if found.lost > NOISY:
        says = f"{found.lost:.0%} of the pairs are closer than the noise: clean the series, or measure with less noise."
        return refused("below_noise", says, (curve, details))
    says = _doubted(found.rate, (low, high), details["e_folds"])
    return Estimate(found.rate, low, high, "uncertain" if says else "ok", UNIT, curve, says, details)


def _doubted(rate: float, interval: tuple[float, float], parted: float) -> str:
    """Return why the number is uncertain, empty if it is not."""
    if interval[0] <= 0.0:
        return "Neighbours part no faster than chance has it: the motion looks regular, or the record is too short."
    if interval[1] - interval[0] > rate:
        return "The interval is wide: more than half the value to either side."
    if parted < BRIEF:
        return (
            f"Neighbours part by {parted:.1f} e-folds only until they are strangers, which noise in a narrow band "
            "does too: look at the surrogate test, or record longer."
        )
    return ""


def _flat(behind: Behind, details: Mapping[str, float]) -> Estimate:
    """Return what is to be said of curves without a region: near strangers at once, or never parting."""
    made, read, c = behind
    curve = drawn(made, c, c.log[0])
    if made.locked and c.strangers < PERIODIC * made.size:
        share = c.strangers / made.size
        says = f"The motion repeats with the drive: periods differ by {share:.1%} of the motion only, as noise has it."
        return refused("regular", says, (curve, details))
    at = min(made.window, c.far.shape[1] - 1)
    if c.far[0, at] > 0.25 * c.strangers:
        says = "Neighbours are strangers as soon as they leave the delay window, as in noise: no straight piece."
        return refused("no_scaling_region", says, (curve, details))
    rate, error = drift(read, made)
    seen = (c.log.shape[1] - at) * made.dt
    if not abs(rate) * seen < UNSEEN:
        says = "Neighbours part, but too little in the time that they can be followed for: no straight piece."
        return refused("no_scaling_region", says, (curve, details))
    wide = float(np.hypot(2.1 * error, UNSEEN / seen))
    says = "Neighbours do not part: the motion is regular, periodic or quasiperiodic."
    return Estimate(rate, rate - wide, rate + wide, "regular", UNIT, curve, says, details)


def drawn(made: States, c: Curves, divergence: Array) -> Mapping[str, Array]:
    """Return the curves to draw: time (s), mean logarithm of the distance of the nearest pairs, and of all groups."""
    times: Array = (np.arange(float(c.log.shape[1])) + 0.5 * (made.smooth - 1)) * made.dt
    slope = np.gradient(divergence, made.dt) if len(times) > 1 else np.zeros(len(times))
    return {"time": times, "divergence": divergence, "members": c.log, "slope": slope}
