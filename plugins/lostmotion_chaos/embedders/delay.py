"""The delay of an embedding from autocorrelation or mutual information, and the Theiler window."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from lostmotion.contracts import Array
from lostmotion_chaos.embedders import _kernels
from lostmotion_chaos.embedders.information import (
    assign_bins,
    bound_by_chance,
    choose_bin_count,
    compute_mutual_information,
    compute_mutual_information_knn,
)

LATEST_MINIMUM = 1.5
"""The first minimum of the mutual information lies below so many times the lag where the autocorrelation is 1/e.

It lies at half that lag for Lorenz' x and for a backlash, and at 1.3 times that lag for a sine in noise; the second
minimum lies beyond."""


@dataclass(frozen=True, eq=False)
class Delay:
    """A delay `lag` (samples), the `method` that chose it, and its curves; `says` is empty where the status is "ok"."""

    lag: int
    method: str
    curves: dict[str, Array]
    status: str = "ok"
    says: str = ""


def clip_outliers(x: Array) -> Array:
    """Return x (n,) with outliers clipped, if there are any: with a single spike all bins but two would be empty.

    There are outliers if all but 2 of 1000 samples lie within a quarter of the range.
    """
    low, high = np.quantile(x, [0.001, 0.999])
    inner = high - low
    if inner == 0.0 or np.ptp(x) <= 4.0 * inner:
        return x
    return np.clip(x, low - 0.5 * inner, high + 0.5 * inner)


def compute_autocorrelation(x: Array, lags: int) -> Array:
    """Return the autocorrelation (lags + 1,) of x, 1 at lag 0, by Fourier transform; each sum is divided by n."""
    centred = x - x.mean()
    size = next_fast_len(len(x) + lags + 1, real=True)
    power = np.abs(rfft(centred, size)) ** 2
    sums: Array = irfft(power, size)[: lags + 1]
    return sums / sums[0] if sums[0] > 0.0 else np.ones(lags + 1)


def find_first_below(curve: Array, level: float) -> int | None:
    """Return the first lag at which the curve is at or below the level, or None."""
    below = np.flatnonzero(curve <= level)
    return int(below[0]) if len(below) else None


def estimate_mean_period(x: Array) -> int:
    """Return the period (samples) that halves the power spectrum of x: half the variance lies at longer periods.

    For a periodic motion this is the period, also with noise whose variance is below that of the motion; for white
    noise it is 4.
    """
    power = np.abs(rfft(x - x.mean())[1:]) ** 2
    total = np.cumsum(power)
    if total[-1] == 0.0:
        return 1
    return max(1, round(len(x) / (1 + int(np.searchsorted(total, 0.5 * total[-1])))))


def choose_theiler_window(x: Array) -> tuple[int, str]:
    """Return a Theiler window (samples), and a sentence where the series is too short for it, else an empty string.

    The window is the longer one of the mean period and the first zero of the autocorrelation. After that time the
    motion has completed a cycle, and points that come close are recurrences, not parts of the same piece of the orbit.
    It is at most a fifth of the series (Theiler, Physical Review A 34 (1986) 2427-2432).
    """
    most = max(1, len(x) // 5)
    zero = find_first_below(compute_autocorrelation(x, min(len(x) - 1, 2 * most)), 0.0)
    window = max(estimate_mean_period(x), zero or len(x))
    if window <= most:
        return window, ""
    return most, (
        f"the series is correlated over {window} samples, more than a fifth of its length: it drifts, or is too "
        f"short; pairs closer than {most} samples are left out; record longer, or remove the drift"
    )


def find_first_minimum(curve: Array, rise: Callable[[int], float]) -> int | None:
    """Return the first lag >= 1 after which the curve rises by more than `rise(lag)` before it falls lower, or None.

    A smaller rise is within the noise of the estimate, and the dip is no minimum.
    """
    for lag in range(1, len(curve) - 1):
        if not curve[lag] < curve[lag - 1] or curve[lag + 1] < curve[lag]:
            continue
        lower = find_first_below(curve[lag + 1 :], float(np.nextafter(curve[lag], -np.inf)))
        ahead = curve[lag + 1 :][:lower]
        if len(ahead) and ahead.max() - curve[lag] > rise(lag):
            return lag
    return None


def choose_longest_lag(x: Array) -> int:
    """Return the last lag (samples) that is examined: two mean periods, at least 100, at most a fifth of the series."""
    return max(1, min(len(x) // 5, max(100, 2 * estimate_mean_period(x))))


def choose_by_autocorrelation(x: Array, lags: int = 0, *, level: float = 1.0 / math.e) -> Delay:
    """Return the lag at which the autocorrelation first falls to the level: 1/e, or 0 for its first zero."""
    lags = lags or choose_longest_lag(x)
    curve = compute_autocorrelation(x, lags)
    found = find_first_below(curve, level)
    curves = {"lag": np.arange(lags + 1.0), "autocorrelation": curve}
    if found is not None:
        return Delay(max(1, found), "autocorrelation", curves)
    lag = max(1, lags // 4)
    return Delay(
        lag,
        "autocorrelation",
        curves,
        "uncertain",
        f"the autocorrelation does not fall to {level:.2g} within {lags} samples: the series drifts, or is sampled "
        f"much too fast; lag {lag} is assumed",
    )


def choose_by_information(
    x: Array, lags: int = 0, *, bins: int = 0, equal_counts: bool = False, prominence: float = 3.0
) -> Delay:
    """Return the first minimum of the binned mutual information that stands out by `prominence` standard errors."""
    lags = lags or choose_longest_lag(x)
    bins = bins or choose_bin_count(len(x))
    codes = assign_bins(x, bins, equal_counts=equal_counts)
    ami = compute_mutual_information(x, lags, bins=bins, corrected=True, equal_counts=equal_counts)
    floor = bound_by_chance(codes, bins)
    return _choose_by_minimum(
        x, ami, floor, lambda lag: float(_kernels.compute_scatter(codes, bins, lag)), prominence=prominence
    )


def choose_by_neighbours(
    x: Array, lags: int = 0, *, rng: np.random.Generator, k: int = 4, most: int = 4000, prominence: float = 3.0
) -> Delay:
    """Return the first minimum of the mutual information by k neighbours that stands out by its standard errors.

    The curves begin at lag 1: at lag 0 it is infinite.
    """
    lags = min(lags or choose_longest_lag(x), max(1, len(x) - k - 1))
    ami, error = compute_mutual_information_knn(x, lags, rng=rng, k=k, most=most)
    floor = 2.0 * float(np.median(error[1:]))
    found = _choose_by_minimum(x, ami, floor, lambda lag: float(error[lag]), prominence=prominence)
    curves = {name: curve[1:] for name, curve in found.curves.items()}
    return replace(found, curves=curves, method="ami_knn" if found.method == "ami" else found.method)


def _choose_by_minimum(
    x: Array, ami: Array, floor: float, error: Callable[[int], float], *, prominence: float
) -> Delay:
    """Return the first minimum above the floor; where there is none, the lag of the autocorrelation, and why.

    Samples closer than the autocorrelation time are not independent, so the minimum must also stand out by the
    standard error of correspondingly fewer samples. A minimum later than `LATEST_MINIMUM` times that time is not the
    first one: an earlier one is hidden in noise.
    """
    lags = len(ami) - 1
    spare = choose_by_autocorrelation(x, lags)
    curves = {**spare.curves, "ami": ami, "ami_floor": np.full(lags + 1, floor)}
    demand = max(prominence, math.sqrt(spare.lag))
    lag = find_first_minimum(ami, lambda at: demand * error(at))
    independent = find_first_below(ami, floor)
    if independent is not None and (lag is None or independent <= lag):
        says = f"the mutual information falls to that of independent samples at lag {independent} without a minimum"
        status = spare.status
    elif lag is None:
        says = f"the mutual information has no minimum that stands out of its noise within {lags} samples"
        status = "uncertain"
    elif lag > LATEST_MINIMUM * spare.lag:
        says = f"the first minimum of the mutual information that stands out of its noise comes late (lag {lag})"
        status = "uncertain"
    else:
        return Delay(lag, "ami", curves)
    says = f"{says}: lag {spare.lag} is where the autocorrelation falls to 1/e"
    return Delay(spare.lag, "autocorrelation", curves, status, spare.says or says)
