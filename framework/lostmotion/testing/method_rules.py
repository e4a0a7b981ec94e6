"""Rules for embedders, quantifiers, surrogates and denoisers, checked on short series."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lostmotion.contracts import Array, Orbit, Series
from lostmotion.results import STATUSES, Embedding, Estimate
from lostmotion.testing.rules import rule

METHODS = ("embedder", "quantifier", "surrogate", "denoiser")
PRESERVED = ("mean", "variance", "amplitudes", "spectrum", "cycles")
_N, _DT = 1200, 0.05


def _make_beating() -> Array:
    """Return a motion with two frequencies and a little noise, similar to most recordings."""
    t = _DT * np.arange(_N)
    wave: Array = np.sin(2.1 * t) + 0.4 * np.sin(5.3 * t + 1.0)
    return wave + 0.02 * np.random.default_rng(1).normal(size=_N)


def _make_repeating() -> Array:
    """Return a motion as recorded by an encoder of 64 steps: the same numbers occur in each period."""
    wave: Array = np.round(32 * np.sin(2 * np.pi * np.arange(_N) / 24)) / 32
    return wave


def _make_noise() -> Array:
    return np.random.default_rng(2).normal(size=_N)


SERIES: dict[str, Callable[[], Array]] = {
    "a smooth motion": _make_beating,
    "exact repeats of an encoder": _make_repeating,
    "white noise": _make_noise,
}


def _make_series(x: Array) -> Series:
    return Series(x - x.mean(), _DT, Embedding(lag=6, dim=3, theiler=20))


@dataclass(frozen=True)
class Spiral:
    """A flow that contracts with the constant rates -0.2 and -0.5 1/s, which are its exponents."""

    period: float = 2.0
    driven: bool = True
    states: tuple[str, ...] = ("position", "velocity")

    @property
    def start(self) -> Array:
        """The state (2,) in which an orbit begins."""
        return np.array([1.0, 0.5])

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from `start`, which converges to the origin."""
        rates = np.array([-0.2, -0.5])
        fade = np.exp(np.outer(np.arange(periods + 1), self.period * rates))
        return Orbit(fade * start, np.tile(self.period * rates[:tangents], (periods, 1)))


def _run(component: Any, series: Series, seed: int = 3) -> Any:
    """Return the result of a component for a series as an array that can be compared."""
    rng = np.random.default_rng(seed)
    if hasattr(component, "choose"):
        found = component.choose(series.x, dt=series.dt)
        return np.array([found.lag, found.dim, found.theiler])
    if hasattr(component, "draw"):
        return component.draw(series, draws=3, rng=rng)
    if hasattr(component, "clean"):
        return component.clean(series, noise=0.02 * float(np.std(series.x)), rng=rng)
    data = Spiral() if component.reads == "flow" else series
    found = component.estimate(data, rng=rng)
    return np.array([found.value, found.low, found.high])


@rule(*METHODS)
def answers_every_series(component: Any) -> str:
    """Raise no error for a series: exact repeats, as from an encoder, and noise need a result or a refusal."""
    for what, make in SERIES.items():
        try:
            with np.errstate(divide="raise", invalid="raise"):
                _run(component, _make_series(make()))
        except Exception as err:
            return f"on {what} it raised {type(err).__name__}: {err}"
    return ""


@rule(*METHODS)
def same_seed_same_answer(component: Any) -> str:
    """Draw only from the generator that is passed: the same seed must give the same result."""
    series = _make_series(_make_beating())
    state = _read_global_state()
    first, second = _run(component, series), _run(component, series)
    if not np.array_equal(state, _read_global_state()):
        return "it draws from NumPy's global generator"
    return "" if np.array_equal(first, second, equal_nan=True) else "the same seed gave different results"


def _read_global_state() -> Any:
    """Return the state of NumPy's global generator, which is only compared and not used."""
    return np.random.get_state(legacy=True)[1].copy()  # type: ignore[index]  # noqa: NPY002


@rule(*METHODS)
def leaves_its_input_alone(component: Any) -> str:
    """Copy the series before changing it: other methods read the same array."""
    series = _make_series(_make_beating())
    kept = series.x.copy()
    _run(component, series)
    return "" if np.array_equal(kept, series.x) else "it changed its input series"


@rule("embedder")
def embedding_is_whole(component: Any) -> str:
    """Return integers: a lag and a dimension of 1 or more, a Theiler window of 0 or more; and a known status."""
    found = component.choose(_make_beating(), dt=_DT)
    if not isinstance(found, Embedding):
        return f"it returned {type(found).__name__}, where an Embedding is expected"
    numbers = (found.lag, found.dim, found.theiler)
    good = all(type(v) is int for v in numbers) and found.lag >= 1 and found.dim >= 1 and found.theiler >= 0
    known = found.status in STATUSES
    return "" if good and known else f"it chose lag, dim, theiler {numbers} with status {found.status!r}"


@rule("quantifier")
def estimate_is_sound(component: Any) -> str:
    """Return an `Estimate` in `unit` with low <= value <= high and a known status; `says` explains a refusal."""
    for what, make in SERIES.items():
        data = Spiral() if component.reads == "flow" else _make_series(make())
        found = component.estimate(data, rng=np.random.default_rng(4))
        if wrong := _find_fault(component, found):
            return f"on {what} it {wrong}"
    return ""


def _find_fault(component: Any, found: Any) -> str:
    if not isinstance(found, Estimate):
        return f"returned {type(found).__name__}"
    if found.unit != component.unit:
        return f"returns the unit {found.unit!r} and declares {component.unit!r}"
    if found.status not in STATUSES or (found.status != "ok" and not found.says):
        return f"returns the status {found.status!r}: {found.says!r}"
    if found.status == "ok" and not found.low <= found.value <= found.high:
        return f"returns {found.value:g} in [{found.low:g}, {found.high:g}]"
    return ""


@rule("surrogate", declaration=True)
def preserved_things_are_known(component: Any) -> str:
    """List in `preserves` some of mean, variance, amplitudes, spectrum, cycles; this is checked."""
    unknown = sorted(set(component.preserves) - set(PRESERVED))
    return f"preserves contains {unknown[0]!r}" if unknown else ""


@rule("surrogate")
def surrogates_are_surrogates(component: Any) -> str:
    """Return an array (draws, m) of finite numbers, m at most n, with draws that differ from each other."""
    series = replace(_make_series(_make_beating()), period=3.0)
    drawn = component.draw(series, draws=4, rng=np.random.default_rng(5))
    if drawn.ndim != 2 or drawn.shape[0] != 4 or not 0.5 * _N <= drawn.shape[1] <= _N or not np.isfinite(drawn).all():
        return f"it returned an array {drawn.shape}, finite: {bool(np.isfinite(drawn).all())}"
    twins = len(np.unique(drawn, axis=0)) < len(drawn)
    return "two draws are equal" if twins else ""


@rule("surrogate")
def keeps_what_it_preserves(component: Any) -> str:
    """Preserve the properties in `preserves`, except for effects of removed ends; list no others."""
    series = replace(_make_series(_make_beating()), period=3.0)
    drawn = component.draw(series, draws=4, rng=np.random.default_rng(7))
    kept = {
        "mean": _mean_change,
        "variance": _variance_change,
        "amplitudes": _amplitude_change,
        "spectrum": _power_change,
    }
    for what in sorted(set(component.preserves) & set(kept)):
        worst = max(kept[what](series.x, x) for x in drawn)
        if worst > 0.15:
            return f"preserves names the {what}, which differs by {worst:.2f} standard deviations"
    return ""


def _mean_change(x: Array, y: Array) -> float:
    return abs(float(y.mean() - x.mean())) / float(x.std())


def _variance_change(x: Array, y: Array) -> float:
    return abs(float(y.std() / x.std()) - 1.0)


def _amplitude_change(x: Array, y: Array) -> float:
    levels = np.linspace(0.01, 0.99, 50)
    return float(np.abs(np.quantile(x, levels) - np.quantile(y, levels)).mean() / x.std())


def _power_change(x: Array, y: Array) -> float:
    """Return the largest change of the rms in 12 frequency bands over the standard deviation."""
    bands = [np.array_split(np.abs(np.fft.rfft(z - z.mean())) / len(z), 12) for z in (x, y)]
    roots = np.array([[np.sqrt(2.0 * np.sum(part**2)) for part in half] for half in bands])
    return float(np.abs(roots[0] - roots[1]).max() / x.std())


@rule("denoiser")
def cleaned_series_is_whole(component: Any) -> str:
    """Return as many samples as in the input, all finite, and change them by no more than about the noise."""
    series, noise = _make_series(_make_beating()), 0.02
    cleaned = np.asarray(component.clean(series, noise=noise, rng=np.random.default_rng(6)))
    if cleaned.shape != series.x.shape or not np.isfinite(cleaned).all():
        return f"it returned an array {cleaned.shape}, finite: {bool(np.isfinite(cleaned).all())}"
    change = float(np.sqrt(np.mean((cleaned - series.x) ** 2)))
    return f"it changed the samples by {change / noise:.1f} times the noise" if change > 3.0 * noise else ""
