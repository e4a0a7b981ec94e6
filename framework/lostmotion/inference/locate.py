"""On what the missing force depends: its curves over position, velocity, drive phase and time, and a sentence."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc

from lostmotion.contracts import Array, Machine
from lostmotion.inference.odds import LikelihoodRatio, list_likely
from lostmotion.inference.shares import Covariate, Share, list_significant
from lostmotion.likelihood.latent import LatentForce
from lostmotion.likelihood.observation import Observation
from lostmotion.results import join_names, percent
from lostmotion.settings import DEFAULT, LocateSettings

BINS = 25
SHOWN_ERROR = 0.005
"""A standard error of a share below this is not shown: it would read as nothing."""


@dataclass(frozen=True)
class Curve:
    """A force over one covariate: bin centres, mean, and the band that contains 95 % of the samples in each bin."""

    center: Array
    mean: Array
    low: Array
    high: Array


def list_covariates(model: Machine, observation: Observation, missing: LatentForce) -> dict[str, Array]:
    """Return position, velocity, phase (cycles, when there is a drive period) and time (s) of each sample.

    Where the model has further places than the ground, the relative motion there too: "position at base".
    """
    table = {"position": missing.position, "velocity": missing.velocity}
    for place in model.places:
        if place.name != "ground" and len(model.places) > 1:
            moved = place.move(missing.states, observation.inputs, missing.levers.get(place.name, ()))
            table[f"position at {place.name}"], table[f"velocity at {place.name}"] = moved
    period = observation.period
    if period:
        table["phase"] = ((observation.begin + np.arange(observation.samples)) / period) % 1.0
    table["time"] = observation.time
    return table


def choose_edges(values: Array) -> Array:
    """Return the edges of bins with about as many samples each; fewer bins where values repeat."""
    return np.unique(np.quantile(values, np.linspace(0.0, 1.0, BINS + 1)))


def average_curve(values: Array, force: Array, edges: Array | None = None) -> Curve:
    """Return the curve of `force` over the covariate `values`, both (samples,)."""
    edges = choose_edges(values) if edges is None else edges
    which = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, len(edges) - 2)
    rows = np.full((4, len(edges) - 1), np.nan)
    for b in range(len(edges) - 1):
        inside = which == b
        if inside.sum() >= 3:
            rows[:, b] = (np.mean(values[inside]), np.mean(force[inside]), *np.quantile(force[inside], [0.025, 0.975]))
    return Curve(*rows)


def classify_parity(found: Curve, least: float = DEFAULT.locate.parity) -> str:
    """Return "odd", "even" or "neither": the symmetry of a curve when position or velocity is reversed."""
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
    return "odd" if share > least else ("even" if share < 1.0 - least else "neither")


def list_further_covariates(
    model: Machine, observation: Observation, missing: LatentForce, plays: Mapping[str, float] | None = None
) -> dict[str, Covariate]:
    """Return further covariates of a force: sign of velocity, contact, history, at each place of the model.

    `plays` are the half gaps by place. History is the position a quarter of a natural period earlier; only its
    contribution beyond position and velocity counts.
    """
    found = {}
    for place in model.places:
        x, v = (
            (missing.position, missing.velocity)
            if place.name == "ground"
            else place.move(missing.states, observation.inputs, missing.levers.get(place.name, ()))
        )
        tail = "" if place.name == "ground" or len(model.places) == 1 else f" at {place.name}"
        found[f"sign of velocity{tail}"] = Covariate((np.sign(v),), classes=True)
        play = (plays or {}).get(place.name, 0.0)
        if play > 0.0:
            found[f"contact{tail}"] = Covariate((np.asarray(np.abs(x) > play, dtype=float),), classes=True)
        found[f"history{tail}"] = Covariate((x, v, _delay_quarter(x, v, observation.dt)))
    return found


def _delay_quarter(x: Array, v: Array, dt: float) -> Array:
    """Return the position (samples,) a quarter of the natural period earlier; before that the first one."""
    lag = round(0.5 * math.pi * float(np.std(x)) / max(float(np.std(v)), 1e-300) / dt)
    lag = min(max(lag, 1), len(x) - 1)
    return np.concatenate([np.full(lag, x[0]), x[:-lag]])


def describe_location(
    table: Mapping[str, Array],
    force: Array,
    found: Mapping[str, Share],
    odds: Mapping[str, LikelihoodRatio] | None = None,
    limits: LocateSettings = DEFAULT.locate,
) -> str:
    """Return one sentence on the dependence of the force, with the significant covariates only.

    Log likelihood ratios (`odds`) decide which these are and their order; without them the shares do.
    """
    level, least = limits.level, limits.told
    known = list_likely(odds, level) if odds else [k for k in list_significant(found, level) if found[k].value >= least]
    if not known:
        asked = [name for name in ("position", "velocity", "phase", "time") if name in table]
        return f"no significant structure over {', '.join(asked[:-1])} or {asked[-1]}"
    tied = [k for k in known[1:] if odds and odds[known[0]].log - odds[k].log < limits.tied]
    name = known[0] if odds else _prefer_sign(known[0], found, limits.signed)
    bent = name in table and name.startswith(("position", "velocity"))
    kind = classify_parity(average_curve(table[name], force), limits.parity) if bent else "neither"
    how = "a function of" if kind == "neither" else f"{kind} in"
    others = [k for k in known if k != name and k not in tied and found[k].value >= least]
    more = [_format_share(k, found) for k in others if odds or _are_unrelated(k, name)]
    also = f"; further significant covariates: {join_names(more)}" if more else ""
    open_ = f"; it cannot be distinguished from a function of {join_names(tied)}" if tied else ""
    absent = [k for k in table if k not in known and k not in name]
    nothing = f"; no significant dependence on {' or '.join(absent)}" if absent else ""
    return f"{how} {name}, {_describe_share(name, found, odds, least)}{open_}{also}{nothing}"


def _describe_share(
    name: str, found: Mapping[str, Share], odds: Mapping[str, LikelihoodRatio] | None, least: float
) -> str:
    """Return the share of a force that a covariate explains, and its log likelihood ratio."""
    share = found[name]
    error = f" +- {percent(share.error)}" if share.error >= SHOWN_ERROR else ""
    explains = f"which explains {percent(share.value)}{error} of its variance"
    if not odds:
        return explains
    if share.value < least:
        explains = f"which explains less than {percent(least)} of the variance of the smoothed force"
    return f"{explains} (log likelihood ratio {odds[name].log:.0f})"


def _format_share(name: str, found: Mapping[str, Share]) -> str:
    return f"{name} ({percent(found[name].value)})"


def _prefer_sign(name: str, found: Mapping[str, Share], as_much: float) -> str:
    """Return the sign of the velocity in place of the velocity where it explains as much."""
    sign = name.replace("velocity", "sign of velocity")
    close = name.startswith("velocity") and sign in found and found[sign].value > as_much * found[name].value
    return sign if close else name


def _are_unrelated(one: str, other: str) -> bool:
    """Return whether two names are not those of a velocity and its sign."""
    return one not in other and other not in one


def compute_autocorrelation(errors: Array, variances: Array, lags: int = 40) -> Array:
    """Return the autocorrelation (lags,) of the standardised innovations from lag 1."""
    e = errors / np.sqrt(variances)
    e = e - e.mean()
    power = float(np.sum(e * e)) or 1.0
    return np.array([float(np.sum(e[k:] * e[:-k])) / power for k in range(1, lags + 1)])


def compute_whiteness(errors: Array, variances: Array, lags: int = 40) -> float:
    """Return the p-value of Ljung and Box (Biometrika 65 (1978) 297-303) for white innovations."""
    n = len(errors)
    rho = compute_autocorrelation(errors, variances, lags)
    q = n * (n + 2.0) * float(np.sum(rho**2 / (n - np.arange(1, lags + 1))))
    return float(chdtrc(lags, q)) if math.isfinite(q) else 0.0
