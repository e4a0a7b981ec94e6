"""Where the missing force lives: its curves over position, velocity, drive phase and time, and a sentence on it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc

from lostmotion.contracts import Array, Model
from lostmotion.inference.odds import Ratio, likely
from lostmotion.inference.shares import Covariate, Share, significant
from lostmotion.likelihood.latent import Missing
from lostmotion.likelihood.observation import Observation
from lostmotion.results import percent
from lostmotion.settings import DEFAULT, LocateSettings

BINS = 25
SHOWN_ERROR = 0.005
"""A standard error of a share below this is not shown: it would read as nothing."""


@dataclass(frozen=True)
class Curve:
    """A force over one covariate: bin centres, mean, and the band that holds 95 % of the samples in each bin."""

    center: Array
    mean: Array
    low: Array
    high: Array


def covariates(model: Model, observation: Observation, missing: Missing) -> dict[str, Array]:
    """Return position, velocity, phase (cycles, when there is a drive period) and time (s) of each sample.

    Where the model has further places than the ground, the relative motion there too: "position at base".
    """
    table = {"position": missing.position, "velocity": missing.velocity}
    for place in model.interfaces:
        if place.name != "ground" and len(model.interfaces) > 1:
            moved = observation.motion_at(place, missing.states, missing.levers.get(place.name, ()))
            table[f"position at {place.name}"], table[f"velocity at {place.name}"] = moved
    period = observation.period
    if period:
        table["phase"] = ((observation.begin + np.arange(observation.samples)) / period) % 1.0
    table["time"] = observation.time
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


def further(
    model: Model, observation: Observation, missing: Missing, plays: Mapping[str, float] | None = None
) -> dict[str, Covariate]:
    """Return what else a force may depend on: sign of velocity, contact, history, at each place of the model.

    `plays` are the half gaps by place. History is where the body was a quarter of a natural period ago, and counts for
    what it adds to position and velocity.
    """
    found = {}
    for place in model.interfaces:
        x, v = (
            (missing.position, missing.velocity)
            if place.name == "ground"
            else observation.motion_at(place, missing.states, missing.levers.get(place.name, ()))
        )
        tail = "" if place.name == "ground" or len(model.interfaces) == 1 else f" at {place.name}"
        found[f"sign of velocity{tail}"] = Covariate((np.sign(v),), classes=True)
        play = (plays or {}).get(place.name, 0.0)
        if play > 0.0:
            found[f"contact{tail}"] = Covariate((np.asarray(np.abs(x) > play, dtype=float),), classes=True)
        found[f"history{tail}"] = Covariate((x, v, _earlier(x, v, observation.dt)))
    return found


def _earlier(x: Array, v: Array, dt: float) -> Array:
    """Return the position (samples,) a quarter of the natural period earlier; before that the first one."""
    lag = round(0.5 * math.pi * float(np.std(x)) / max(float(np.std(v)), 1e-300) / dt)
    lag = min(max(lag, 1), len(x) - 1)
    return np.concatenate([np.full(lag, x[0]), x[:-lag]])


def summary(
    table: Mapping[str, Array],
    force: Array,
    found: Mapping[str, Share],
    odds: Mapping[str, Ratio] | None = None,
    limits: LocateSettings = DEFAULT.locate,
) -> str:
    """Return one sentence on where the force lives: of covariates only those that are beyond chance.

    Log likelihood ratios (`odds`) decide what is, and what comes first; without them the shares do.
    """
    level, least = limits.level, limits.told
    known = likely(odds, level) if odds else [k for k in significant(found, level) if found[k].value >= least]
    if not known:
        asked = [name for name in ("position", "velocity", "phase", "time") if name in table]
        return f"no structure over {', '.join(asked[:-1])} or {asked[-1]} beyond chance"
    tied = [k for k in known[1:] if odds and odds[known[0]].log - odds[k].log < limits.tied]
    name = known[0] if odds else _signed(known[0], found, limits.signed)
    bent = name in table and name.startswith(("position", "velocity"))
    kind = parity(curve(table[name], force)) if bent else "neither"
    how = "a function of" if kind == "neither" else f"{kind} in"
    others = [k for k in known if k != name and k not in tied and found[k].value >= least]
    more = [_with_share(k, found) for k in others if odds or _apart(k, name)]
    also = f"; with it go {listed(more)}" if more else ""
    open_ = f"; it cannot be told from a function of {listed(tied)}" if tied else ""
    absent = [k for k in table if k not in known and k not in name]
    nothing = f"; nothing beyond chance goes with {' or '.join(absent)}" if absent else ""
    return f"{how} {name}, {_sure(name, found, odds, least)}{open_}{also}{nothing}"


def _sure(name: str, found: Mapping[str, Share], odds: Mapping[str, Ratio] | None, least: float) -> str:
    """Return how much of a force goes with a covariate, and how likely that is beside nothing."""
    share = found[name]
    error = f" +- {percent(share.error)}" if share.error >= SHOWN_ERROR else ""
    explains = f"which explains {percent(share.value)}{error} of its variance"
    if not odds:
        return explains
    if share.value < least:
        explains = f"which explains less than {percent(least)} of the variance of the smoothed force"
    return f"{explains} (log likelihood ratio {odds[name].log:.0f})"


def _with_share(name: str, found: Mapping[str, Share]) -> str:
    return f"{name} ({percent(found[name].value)})"


def _signed(name: str, found: Mapping[str, Share], as_much: float) -> str:
    """Return the sign of the velocity in place of the velocity where it explains as much."""
    sign = name.replace("velocity", "sign of velocity")
    close = name.startswith("velocity") and sign in found and found[sign].value > as_much * found[name].value
    return sign if close else name


def _apart(one: str, other: str) -> bool:
    """Return whether two names are not those of a velocity and its sign."""
    return one not in other and other not in one


def listed(names: Sequence[str]) -> str:
    """Return names as they stand in a sentence: "a, b and c"."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def autocorrelation(errors: Array, variances: Array, lags: int = 40) -> Array:
    """Return the autocorrelation (lags,) of the standardised innovations from lag 1."""
    e = errors / np.sqrt(variances)
    e = e - e.mean()
    power = float(np.sum(e * e)) or 1.0
    return np.array([float(np.sum(e[k:] * e[:-k])) / power for k in range(1, lags + 1)])


def whiteness(errors: Array, variances: Array, lags: int = 40) -> float:
    """Return the p-value of Ljung and Box (Biometrika 65 (1978) 297-303) for white innovations."""
    n = len(errors)
    rho = autocorrelation(errors, variances, lags)
    q = n * (n + 2.0) * float(np.sum(rho**2 / (n - np.arange(1, lags + 1))))
    return float(chdtrc(lags, q)) if math.isfinite(q) else 0.0
