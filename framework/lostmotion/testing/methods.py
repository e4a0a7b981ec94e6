"""Rules for embedders, quantifiers, surrogates and denoisers: what a host may rely on, tried on small series."""

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


def _beating() -> Array:
    """Return a motion of two frequencies with a little noise: what most recordings look like."""
    t = _DT * np.arange(_N)
    wave: Array = np.sin(2.1 * t) + 0.4 * np.sin(5.3 * t + 1.0)
    return wave + 0.02 * np.random.default_rng(1).normal(size=_N)


def _repeating() -> Array:
    """Return a motion that an encoder of 64 steps saw coming back to the same numbers in each period."""
    wave: Array = np.round(32 * np.sin(2 * np.pi * np.arange(_N) / 24)) / 32
    return wave


def _noise() -> Array:
    return np.random.default_rng(2).normal(size=_N)


SERIES: dict[str, Callable[[], Array]] = {
    "a smooth motion": _beating,
    "an encoder's exact repeats": _repeating,
    "white noise": _noise,
}


def _series(x: Array) -> Series:
    return Series(x - x.mean(), _DT, Embedding(lag=6, dim=3, theiler=20))


@dataclass(frozen=True)
class Spiral:
    """A flow that contracts by the rates -0.2 and -0.5 1/s whatever happens: its exponents are known."""

    period: float = 2.0
    driven: bool = True
    states: tuple[str, ...] = ("position", "velocity")

    @property
    def start(self) -> Array:
        """The state (2,) in which an orbit begins."""
        return np.array([1.0, 0.5])

    def strobe(self, start: Array, *, periods: int, tangents: int) -> Orbit:
        """Return the orbit from `start`, which winds into the origin."""
        rates = np.array([-0.2, -0.5])
        fade = np.exp(np.outer(np.arange(periods + 1), self.period * rates))
        return Orbit(fade * start, np.tile(self.period * rates[:tangents], (periods, 1)))


def _answer(component: Any, series: Series, seed: int = 3) -> Any:
    """Return what a component says of a series, as arrays or numbers that can be compared."""
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
    """Let no recording raise: exact repeats, which every encoder gives, and noise get an answer or a refusal."""
    for what, make in SERIES.items():
        try:
            with np.errstate(divide="raise", invalid="raise"):
                _answer(component, _series(make()))
        except Exception as err:
            return f"on {what} it raised {type(err).__name__}: {err}"
    return ""


@rule(*METHODS)
def same_seed_same_answer(component: Any) -> str:
    """Draw from the generator that is handed in, and from nothing else: the same seed must give the same answer."""
    series = _series(_beating())
    state = _global_state()
    first, second = _answer(component, series), _answer(component, series)
    if not np.array_equal(state, _global_state()):
        return "it draws from NumPy's global generator"
    return "" if np.array_equal(first, second, equal_nan=True) else "the same seed gave two answers"


def _global_state() -> Any:
    """Return the state of NumPy's global generator: it is watched, not used."""
    return np.random.get_state(legacy=True)[1].copy()  # type: ignore[index]  # noqa: NPY002


@rule(*METHODS)
def leaves_its_input_alone(component: Any) -> str:
    """Copy the series before changing it: other methods read the same array."""
    series = _series(_beating())
    kept = series.x.copy()
    _answer(component, series)
    return "" if np.array_equal(kept, series.x) else "it changed the series it was given"


@rule("embedder")
def embedding_is_whole(component: Any) -> str:
    """Return whole numbers: a lag and a dimension of 1 or more, a Theiler window of 0 or more, and a known status."""
    found = component.choose(_beating(), dt=_DT)
    if not isinstance(found, Embedding):
        return f"it returned {type(found).__name__}, and an Embedding was wanted"
    numbers = (found.lag, found.dim, found.theiler)
    good = all(type(v) is int for v in numbers) and found.lag >= 1 and found.dim >= 1 and found.theiler >= 0
    known = found.status in STATUSES
    return "" if good and known else f"it chose lag, dim, theiler {numbers} with status {found.status!r}"


@rule("quantifier")
def estimate_is_sound(component: Any) -> str:
    """Return an `Estimate` in your `unit` with low <= value <= high, a known status, and a sentence for a refusal."""
    for what, make in SERIES.items():
        data = Spiral() if component.reads == "flow" else _series(make())
        found = component.estimate(data, rng=np.random.default_rng(4))
        if wrong := _unsound(component, found):
            return f"on {what} it {wrong}"
    return ""


def _unsound(component: Any, found: Any) -> str:
    if not isinstance(found, Estimate):
        return f"returned {type(found).__name__}"
    if found.unit != component.unit:
        return f"answers in {found.unit!r} and declares {component.unit!r}"
    if found.status not in STATUSES or (found.status != "ok" and not found.says):
        return f"says {found.status!r}: {found.says!r}"
    if found.status == "ok" and not found.low <= found.value <= found.high:
        return f"gives {found.value:g} in [{found.low:g}, {found.high:g}]"
    return ""


@rule("surrogate", declaration=True)
def preserved_things_are_known(component: Any) -> str:
    """Name in `preserves` some of mean, variance, amplitudes, spectrum, cycles: what is claimed is checked."""
    unknown = sorted(set(component.preserves) - set(PRESERVED))
    return f"it says it preserves {unknown[0]!r}" if unknown else ""


@rule("surrogate")
def surrogates_are_surrogates(component: Any) -> str:
    """Return an array (draws, m) of finite numbers, m at most n, in which no draw repeats another or the recording."""
    series = replace(_series(_beating()), period=3.0)
    drawn = component.draw(series, draws=4, rng=np.random.default_rng(5))
    if drawn.ndim != 2 or drawn.shape[0] != 4 or not 0.5 * _N <= drawn.shape[1] <= _N or not np.isfinite(drawn).all():
        return f"it returned an array {drawn.shape}, finite: {bool(np.isfinite(drawn).all())}"
    twins = len(np.unique(drawn, axis=0)) < len(drawn)
    return "two draws are the same" if twins else ""


@rule("surrogate")
def keeps_what_it_preserves(component: Any) -> str:
    """Keep what `preserves` names, up to what cutting the ends changes; claim no more than you keep."""
    series = replace(_series(_beating()), period=3.0)
    drawn = component.draw(series, draws=4, rng=np.random.default_rng(7))
    kept = {"mean": _mean_moves, "variance": _variance_moves, "amplitudes": _amplitudes_move, "spectrum": _powers_move}
    for what in sorted(set(component.preserves) & set(kept)):
        worst = max(kept[what](series.x, x) for x in drawn)
        if worst > 0.15:
            return f"it says it preserves the {what}, and is off by {worst:.2f} of the standard deviation"
    return ""


def _mean_moves(x: Array, y: Array) -> float:
    return abs(float(y.mean() - x.mean())) / float(x.std())


def _variance_moves(x: Array, y: Array) -> float:
    return abs(float(y.std() / x.std()) - 1.0)


def _amplitudes_move(x: Array, y: Array) -> float:
    levels = np.linspace(0.01, 0.99, 50)
    return float(np.abs(np.quantile(x, levels) - np.quantile(y, levels)).mean() / x.std())


def _powers_move(x: Array, y: Array) -> float:
    """Return by how much the roots of the powers in 12 bands move, over the standard deviation."""
    bands = [np.array_split(np.abs(np.fft.rfft(z - z.mean())) / len(z), 12) for z in (x, y)]
    roots = np.array([[np.sqrt(2.0 * np.sum(part**2)) for part in half] for half in bands])
    return float(np.abs(roots[0] - roots[1]).max() / x.std())


@rule("denoiser")
def cleaned_series_is_whole(component: Any) -> str:
    """Return as many samples as came in, all finite, and change them by about as much as the noise, no more."""
    series, noise = _series(_beating()), 0.02
    cleaned = np.asarray(component.clean(series, noise=noise, rng=np.random.default_rng(6)))
    if cleaned.shape != series.x.shape or not np.isfinite(cleaned).all():
        return f"it returned an array {cleaned.shape}, finite: {bool(np.isfinite(cleaned).all())}"
    change = float(np.sqrt(np.mean((cleaned - series.x) ** 2)))
    return f"it moved the samples by {change / noise:.1f} times the noise" if change > 3.0 * noise else ""
