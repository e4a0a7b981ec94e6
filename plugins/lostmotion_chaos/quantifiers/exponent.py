"""The largest Lyapunov exponent of a recording: an estimate with an interval, or a refusal with its reason."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from lostmotion.contracts import Array, Series
from lostmotion.kernels.threads import spread
from lostmotion.results import Estimate, percent
from lostmotion_chaos.quantifiers.divergence import (
    BLOCKS,
    RESOLVED_SAMPLES,
    Pairs,
    Spread,
    States,
    choose_horizon,
    follow_pairs,
    measure_unrelated_distance,
    reconstruct_states,
)
from lostmotion_chaos.quantifiers.divergence_fit import (
    Curves,
    Growth,
    compute_curves,
    fit_drift,
    fit_growth,
    read_rate,
    straighten_curve,
)

Gather = Callable[[States, int, float], Pairs]
Behind = tuple[States, Spread, Curves]
UNIT = "1/s"
MOST_PHASE_DRIFT = 0.05
"""Samples by which the drive phase may drift over the record before the record is resampled. Chosen by experience; no
measurement recorded."""
OTHERS_SHARE = 0.3
"""Share of the references that are used for the other embeddings."""
LEAST_SAMPLES = 500
"""A shorter record is refused. Chosen by experience; no measurement recorded."""
LEAST_WINDOWS = 10
"""A record must be at least so many delay windows and Theiler windows long. Chosen by experience; no measurement
recorded."""
PERIODIC_SHARE = 0.2
"""Without a scaling region, a motion may be periodic where points one drive period apart differ by less than this share
of the motion. Chosen by experience; no measurement recorded."""
UNSEEN_EFOLDS = 0.35
"""Growth by fewer e-folds, over all the time for which pairs are followed, cannot be told from no growth. Chosen by
experience; no measurement recorded."""
BRIEF_EFOLDS = 0.65
"""Growth over fewer e-folds may be that of noise with a long correlation time, which gave 0.35 to 0.65 in 48 tries."""
MOST_NOISY = 0.5
"""With a larger share of pairs within the noise no exponent is read. Chosen by experience; no measurement recorded."""


def refuse(status: str, says: str, kept: tuple[Mapping[str, Array], Mapping[str, float]] | None = None) -> Estimate:
    """Return a refused estimate with its curve and details."""
    curve, details = kept or ({}, {})
    return Estimate.refused(status, says, unit=UNIT, curve=curve, details=details)


def refuse_short(series: Series) -> Estimate | None:
    """Return a refusal if the record is too short, else None."""
    need = max(LEAST_SAMPLES, LEAST_WINDOWS * series.embedding.window, LEAST_WINDOWS * series.embedding.theiler)
    if series.n >= need:
        return None
    return refuse("too_short", f"{series.n} samples are too few to follow the divergence of neighbours, {need} needed.")


def estimate_exponent(series: Series, gather: Gather, *, before: bool = False) -> Estimate:
    """Return the exponent (1/s) from the pairs that `gather(states, steps, share of the references)` finds."""
    if no := refuse_short(series):
        return no
    series = resample_to_period(series)
    made, *rest = prepare_states((series, *vary_embedding(series)))
    away = measure_unrelated_distance(made)
    steps = choose_horizon(made, away)
    pairs = gather(made, steps, 1.0)
    paired = float((pairs.groups[:, 0, 0] >= 0).mean())
    details = {"pairs": float((pairs.groups >= 0).sum()), "repeats": pairs.repeats, "paired": paired}
    if paired < 0.5 or (pairs.groups[:, 0, 0] >= 0).sum() < 5 * BLOCKS:
        return _refuse_unpaired(pairs.repeats, paired, details)
    read = follow_pairs(made, pairs, steps, before=before)
    found = fit_growth(read, made)
    c = compute_curves(read.sums.sum(axis=0), made, away)
    if found is None:
        return _explain_flat((made, read, c), details)
    doubts = _read_rates(rest, gather, steps, before)
    doubt = float(np.std([found.rate, *doubts[np.isfinite(doubts)]]))
    return _estimate_from(found, doubt, (made, read, c), details)


def prepare_states(several: tuple[Series, ...]) -> list[States]:
    """Return the states of each series with their search trees, computed in parallel."""
    made = [reconstruct_states(series) for series in several]

    def work(begin: int, end: int) -> None:
        for k in range(begin, end):
            if not made[k].locked:
                _ = made[k].tree

    spread(work, len(made))
    return made


def resample_to_period(series: Series) -> Series:
    """Return the series with a whole number of samples in a drive period, resampled by cubic splines where needed.

    Otherwise neighbours differ in drive phase by up to half a sample, and a kink in between looks like divergence.
    """
    turn = series.period / series.dt if series.period else 0.0
    whole = round(turn)
    if series.period is None or turn < RESOLVED_SAMPLES or abs(turn / whole - 1.0) * series.n < MOST_PHASE_DRIFT:
        return series
    times = np.arange(int((series.n - 1) * whole / turn) + 1) * turn / whole
    x = CubicSpline(np.arange(series.n), series.x)(times)
    return replace(series, x=x, dt=series.period / whole)


def vary_embedding(series: Series) -> tuple[Series, ...]:
    """Return the series with one more dimension and with a longer delay, to find the error due to the embedding."""
    e = series.embedding
    higher, longer = replace(e, dim=e.dim + 1), replace(e, lag=round(1.5 * e.lag))
    return tuple(replace(series, embedding=c) for c in ((higher, longer) if e.lag > 1 else (higher,)))


def _read_rates(several: list[States], gather: Gather, steps: int, before: bool) -> Array:
    """Return the exponents (1/s) of other embeddings, from fewer references; NaN where there is none."""
    found = np.full(len(several), np.nan)

    def work(begin: int, end: int) -> None:
        for k in range(begin, end):
            pairs = gather(several[k], steps, OTHERS_SHARE)
            if (pairs.groups[:, 0, 0] >= 0).sum() >= 5 * BLOCKS:
                found[k] = read_rate(follow_pairs(several[k], pairs, steps, before=before), several[k])

    spread(work, len(several))
    return found


def _refuse_unpaired(repeats: float, paired: float, details: Mapping[str, float]) -> Estimate:
    """Return the refusal of a recording in which too few points have a neighbour."""
    if repeats > 0.5:
        says = (
            f"{percent(repeats)} of the points repeat exactly: the motion is periodic within the"
            " resolution of the sensor."
        )
        return refuse("regular", says, ({}, details))
    says = (
        f"Only {percent(paired)} of the points have a neighbour at another time: record longer, or lower the dimension."
    )
    return refuse("too_few_neighbours", says, ({}, details))


def _estimate_from(found: Growth, doubt: float, behind: Behind, details: Mapping[str, float]) -> Estimate:
    """Return the estimate with its curves and its error budget."""
    made, read, c = behind
    begin, end = found.domain.begin, found.domain.ends[0]
    middle = 0.5 * (made.smooth - 1)
    straight, intercept = straighten_curve(c, found)
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
    return _make_estimate(found, details, collect_curves(made, c, straight))


def _make_estimate(found: Growth, details: Mapping[str, float], curve: Mapping[str, Array]) -> Estimate:
    """Return the estimate with its interval, or a refusal where most pairs are closer than the noise."""
    low, high = found.interval(details["embedding_error"])
    if found.lost > MOST_NOISY:
        says = (
            f"{percent(found.lost)} of the pairs are closer than the noise: clean the series, or"
            " measure with less noise."
        )
        return refuse("below_noise", says, (curve, details))
    says = _describe_doubt(found.rate, (low, high), details["e_folds"])
    return Estimate(found.rate, low, high, "uncertain" if says else "ok", UNIT, curve, says, details)


def _describe_doubt(rate: float, interval: tuple[float, float], parted: float) -> str:
    """Return why the number is uncertain, or an empty string."""
    if interval[0] <= 0.0:
        return "The divergence of neighbours is not significant: the motion looks regular, or the record is too short."
    if interval[1] - interval[0] > rate:
        return "The interval is wide: more than half the value to either side."
    if parted < BRIEF_EFOLDS:
        return (
            f"Neighbours diverge by only {parted:.1f} e-folds before their distance saturates, as in narrow-band "
            "noise: look at the surrogate test, or record longer."
        )
    return ""


def _explain_flat(behind: Behind, details: Mapping[str, float]) -> Estimate:
    """Return the estimate or refusal for curves without a scaling region: saturated at once, or without divergence."""
    made, read, c = behind
    curve = collect_curves(made, c, c.log[0])
    if made.locked and c.unrelated < PERIODIC_SHARE * made.size:
        share = c.unrelated / made.size
        says = (
            f"The motion repeats with the drive: periods differ by only {percent(share)} of the"
            " motion, as due to noise."
        )
        return refuse("regular", says, (curve, details))
    at = min(made.window, c.far.shape[1] - 1)
    if c.far[0, at] > 0.25 * c.unrelated:
        says = "The distance of neighbours saturates within the delay window, as in noise: there is no scaling region."
        return refuse("no_scaling_region", says, (curve, details))
    rate, error = fit_drift(read, made)
    seen = (c.log.shape[1] - at) * made.dt
    if not abs(rate) * seen < UNSEEN_EFOLDS:
        says = "Neighbours diverge too little in the time for which they can be followed: there is no scaling region."
        return refuse("no_scaling_region", says, (curve, details))
    wide = float(np.hypot(2.1 * error, UNSEEN_EFOLDS / seen))
    says = "Neighbours do not diverge: the motion is regular, periodic or quasiperiodic."
    return Estimate(rate, rate - wide, rate + wide, "regular", UNIT, curve, says, details)


def collect_curves(made: States, c: Curves, divergence: Array) -> Mapping[str, Array]:
    """Return the curves to draw: time (s), mean logarithm of the distance of the nearest pairs, and of all groups."""
    times: Array = (np.arange(float(c.log.shape[1])) + 0.5 * (made.smooth - 1)) * made.dt
    slope = np.gradient(divergence, made.dt) if len(times) > 1 else np.zeros(len(times))
    return {"time": times, "divergence": divergence, "members": c.log, "slope": slope}
