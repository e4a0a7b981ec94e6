"""Where the missing force lives: its curves over position, velocity, drive phase and time, and what each explains."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, Model
from lostmotion.inference.latent import Missing
from lostmotion.inference.tracks import Track, period_samples

BINS = 25
FOLDS = 5


@dataclass(frozen=True)
class Curve:
    """A force over one covariate: bin centres, mean, and the band that holds 95 % of the samples in each bin."""

    center: Array
    mean: Array
    low: Array
    high: Array


def covariates(model: Model, track: Track, missing: Missing) -> dict[str, Array]:
    """Return position, velocity, phase (cycles, when there is a drive period) and time (s) of each sample.

    Where the model has further places than the ground, the relative motion there too: "position at base".
    """
    table = {"position": missing.position, "velocity": missing.velocity}
    for place in model.interfaces:
        if place.name != "ground" and len(model.interfaces) > 1:
            motion = np.array([place.motion(y, u) for y, u in zip(missing.states, track.inputs, strict=True)])
            table[f"position at {place.name}"], table[f"velocity at {place.name}"] = motion.T
    period = period_samples(track)
    if period:
        table["phase"] = ((track.begin + np.arange(track.samples)) / period) % 1.0
    table["time"] = track.time
    return table


def edges_of(values: Array) -> Array:
    """Return the edges of bins that hold about as many samples each; fewer bins where values repeat."""
    return np.unique(np.quantile(values, np.linspace(0.0, 1.0, BINS + 1)))


def curve(values: Array, force: Array, edges: Array | None = None) -> Curve:
    """Return the curve of `force` over the covariate `values`, both (samples,)."""
    edges = edges_of(values) if edges is None else edges
    which = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, len(edges) - 2)
    rows = np.full((4, len(edges) - 1), np.nan)
    for b in range(len(edges) - 1):
        inside = which == b
        if inside.sum() >= 3:
            rows[:, b] = (np.mean(values[inside]), np.mean(force[inside]), *np.quantile(force[inside], [0.025, 0.975]))
    return Curve(*rows)


def explained(values: Array, force: Array) -> float:
    """Return the share of the variance of `force` that a smooth curve over `values` predicts, cross-validated.

    The folds are contiguous blocks of time, so that a slow force does not explain itself; never below zero.
    """
    edges = edges_of(values)
    if len(edges) < 4 or not np.any(force):
        return 0.0
    which = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, len(edges) - 2)
    block = (np.arange(len(force)) * FOLDS * 4 // len(force)) % FOLDS
    left = 0.0
    for fold in range(FOLDS):
        seen, hidden = block != fold, block == fold
        total = np.bincount(which[seen], force[seen], len(edges) - 1)
        count = np.bincount(which[seen], minlength=len(edges) - 1)
        means = (total + np.mean(force[seen])) / (count + 1.0)
        left += float(np.sum((force[hidden] - means[which[hidden]]) ** 2))
    return max(0.0, 1.0 - left / float(np.sum((force - force.mean()) ** 2)))


def shares(table: Mapping[str, Array], force: Array) -> dict[str, float]:
    """Return what each covariate explains of the variance of the force."""
    return {name: round(explained(values, force), 4) for name, values in table.items()}


def parity(found: Curve) -> str:
    """Return "odd", "even" or "neither": how a curve changes when position or velocity is reversed."""
    good = np.isfinite(found.center) & np.isfinite(found.mean)
    if good.sum() < 6:
        return "neither"
    order = np.argsort(found.center[good])
    x, f = found.center[good][order], found.mean[good][order]
    reach = min(-x[0], x[-1])
    if reach <= 0:
        return "neither"
    grid = np.linspace(0.05 * reach, 0.95 * reach, 40)
    right, left = np.interp(grid, x, f), np.interp(-grid, x, f)
    odd, even = np.mean((right - left) ** 2), np.mean((right + left) ** 2)
    share = odd / (odd + even) if odd + even > 0 else 0.5
    return "odd" if share > 0.8 else ("even" if share < 0.2 else "neither")


def summary(table: Mapping[str, Array], force: Array, found: Mapping[str, float]) -> str:
    """Return one sentence on where the force lives."""
    name = max(found, key=lambda k: found[k])
    if found[name] < 0.05:
        return "no structure over position, velocity, phase or time"
    kind = parity(curve(table[name], force)) if name.startswith(("position", "velocity")) else "neither"
    how = "a function of" if kind == "neither" else f"{kind} in"
    absent = [k for k in found if k != name and found[k] < 0.05]
    nothing = f"; nothing of it goes with {' or '.join(absent)}" if absent else ""
    return f"{how} {name}, which explains {found[name]:.0%} of its variance{nothing}"


def autocorrelation(errors: Array, variances: Array, lags: int = 40) -> Array:
    """Return the autocorrelation (lags,) of the standardised innovations from lag 1."""
    e = errors / np.sqrt(variances)
    e = e - e.mean()
    power = float(np.sum(e * e)) or 1.0
    return np.array([float(np.sum(e[k:] * e[:-k])) / power for k in range(1, lags + 1)])


def whiteness(errors: Array, variances: Array, lags: int = 40) -> float:
    """Return the p-value of Ljung and Box (Biometrika 65 (1978) 297-303) for white innovations."""
    from scipy.stats import chi2

    n = len(errors)
    rho = autocorrelation(errors, variances, lags)
    q = n * (n + 2.0) * float(np.sum(rho**2 / (n - np.arange(1, lags + 1))))
    return float(chi2.sf(q, lags)) if math.isfinite(q) else 0.0
