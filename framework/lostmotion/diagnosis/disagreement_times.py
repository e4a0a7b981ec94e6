"""The times, hits and recordings with the largest one-step errors, as `diagnosis.json` states them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.free_decays import is_struck
from lostmotion.diagnosis.stages import SearchResult
from lostmotion.inference.disagreement import (
    FEWEST,
    SHORTEST,
    Windows,
    average_windows,
    choose_block,
    compute_recording_p,
    compute_squares,
    compute_trend,
    compute_window_p,
    make_even_windows,
    make_hit_windows,
)
from lostmotion.likelihood.observation import Observation
from lostmotion.quantities import unit_of
from lostmotion.report.words import chance
from lostmotion.results import rounded
from lostmotion.results.mismatch import (
    BothTrends,
    ByRecording,
    DisagreementOverTime,
    LevelTrend,
    Peaks,
    RecordingMismatch,
    WorstWindow,
)
from lostmotion.settings import DEFAULT
from lostmotion.signals.impacts import Hit, hits_of

EXPECTED = 1.0


def describe_disagreement(
    d: SearchResult, rng: np.random.Generator
) -> tuple[DisagreementOverTime | None, ByRecording | None]:
    """Return the disagreement over the time of the shown recording, and by recording if there are several.

    Both are None if no one-step error is finite.
    """
    fits = {"before": d.before, "after": d.after} if d.found else {"before": d.before}
    shown = {name: compute_squares(fit, d.shown) for name, fit in fits.items()}
    if not all(np.isfinite(one).any() for one in shown.values()):
        return None, None
    level = d.settings.locate.level
    over = compare_over_time(d.shown, shown, rng, level)
    if d.shown.samples != d.held[0].samples:
        return over, None
    begun = (*d.after.posterior.observations, *d.held)
    all_of = {name: [compute_squares(fit, one) for one in begun] for name, fit in fits.items()}
    motion = d.after.posterior.system.model.motion
    return over, compare_by_recording(begun, all_of, len(d.train), motion, rng, level)


def compare_over_time(
    observation: Observation,
    squares: Mapping[str, Array],
    rng: np.random.Generator,
    level: float = DEFAULT.locate.level,
) -> DisagreementOverTime:
    """Return the disagreement in windows of a recording (after each hit, if a hammer drives it), and a sentence.

    `squares` holds the squared standardised one-step errors (samples,) of the models "before" and, if there is one,
    "after".
    """
    hits = hits_of(observation.excitation, observation.dt) if is_struck(observation) else ()
    windows = _make_windows(observation, squares, hits)
    edges = [round(float(e), 9) for e in (observation.begin + windows.edges) * observation.dt]
    found = {name: _find_worst_window(one, windows, edges, rng, level) for name, one in squares.items()}
    last = found.get("after", found["before"])
    return DisagreementOverTime(
        edges=tuple(edges),
        unit="s",
        windows="hits" if windows.aligned else "even",
        before=found["before"][0],
        after=last[0],
        expected=EXPECTED,
        worst=last[1],
        worst_before=found["before"][1],
        says=_describe_worst({name: worst for name, (_, worst) in found.items()}, windows.aligned, len(windows)),
        peaks=Peaks(tuple(hit.peak for hit in hits), "N") if windows.aligned else None,
    )


def _make_windows(observation: Observation, squares: Mapping[str, Array], hits: Sequence[Hit]) -> Windows:
    if len(hits) > 1:
        return make_hit_windows(observation.samples, [hit.start for hit in hits])
    windows = make_even_windows(observation.samples, observation.period)
    block = max(choose_block(one, windows) for one in squares.values())
    shortest = FEWEST * block
    if observation.samples < FEWEST * shortest:
        return windows
    return make_even_windows(observation.samples, observation.period, shortest=max(shortest, SHORTEST))


def _find_worst_window(
    squares: Array, windows: Windows, edges: Sequence[float], rng: np.random.Generator, level: float
) -> tuple[tuple[float, ...], WorstWindow]:
    """Return the disagreement in each window, and the most significant window with its p-value."""
    means = average_windows(squares, windows)
    p = compute_window_p(squares, windows, rng)
    at = int(np.nanargmax(means)) if p is None else _find_most_significant(means, p)
    chance_of_it = math.nan if p is None else float(p[at])
    worst = WorstWindow(at, edges[at], edges[at + 1], float(means[at]), chance_of_it, chance_of_it <= level)
    return tuple(means.tolist()), worst


def _find_most_significant(means: Array, p: Array) -> int:
    """Return the window with the smallest p-value; of several, the one with the largest disagreement."""
    order = sorted(range(len(means)), key=lambda i: (float(p[i]), -float(np.nan_to_num(means[i]))))
    return order[0]


def _describe_worst(worst: Mapping[str, WorstWindow], hits: bool, count: int) -> str:
    """Return a sentence on the most significant window, of the last model first; empty if it is not significant."""
    if "after" in worst and worst["after"].beyond_chance:
        return f"The model disagrees most {_describe_place(worst['after'], hits, count)}."
    if not worst["before"].beyond_chance:
        return ""
    if "after" not in worst:
        return f"The model disagrees most {_describe_place(worst['before'], hits, count)}."
    return (
        f"The nominal model disagrees most {_describe_place(worst['before'], hits, count)}; with the found terms, no"
        f" {'hit' if hits else 'window'} is significant."
    )


def _describe_place(worst: WorstWindow, hits: bool, count: int) -> str:
    ratio = f"{rounded(worst.ratio)} times the variance expected, {chance(worst.p)} over {count}"
    if hits:
        return f"after hit {worst.window + 1}, at {rounded(worst.begin, 4)} s ({ratio} hits)"
    return f"between {rounded(worst.begin, 3)} and {rounded(worst.end, 3)} s ({ratio} windows)"


def compare_by_recording(
    recordings: Sequence[Observation],
    squares: Mapping[str, Sequence[Array]],
    fitted: int,
    motion: str,
    rng: np.random.Generator,
    level: float = DEFAULT.locate.level,
) -> ByRecording:
    """Return one row for each recording, the first `fitted` of which were fitted, and the trend with the level.

    The level of a recording is the rms of its drive about its mean, or of its response if nothing drives it.
    """
    levels = np.array([_compute_level(one) for one in recordings])
    first = recordings[0]
    unit = unit_of(first.channel if first.free else _name_driver(first), motion)
    last = squares.get("after", squares["before"])
    p_after, p_before = compute_recording_p(last, rng), compute_recording_p(squares["before"], rng)
    measured = zip(recordings, levels, _compute_means(squares["before"]), _compute_means(last), strict=True)
    rows = tuple(
        RecordingMismatch(
            name=one.name,
            level=float(strength),
            unit=unit,
            fitted=i < fitted,
            before=float(before),
            after=float(after),
            p_after=_get_at(p_after, i),
            p_before=_get_at(p_before, i),
        )
        for i, (one, strength, before, after) in enumerate(measured)
    )
    trends = BothTrends(after=_make_trend(last, levels, rng), before=_make_trend(squares["before"], levels, rng))
    says = _describe_levels(rows, "after", p_after, trends, level) or _describe_levels(
        rows, "before", p_before, trends, level
    )
    return ByRecording(rows, "response" if first.free else "drive", EXPECTED, trends, says)


def _compute_means(parts: Sequence[Array]) -> Array:
    return np.array([np.nanmean(part) for part in parts])


def _get_at(values: Array | None, index: int) -> float | None:
    return None if values is None else float(values[index])


def _make_trend(parts: Sequence[Array], levels: Array, rng: np.random.Generator) -> LevelTrend | None:
    found = compute_trend(parts, levels, rng)
    return LevelTrend(*found) if found else None


def _name_driver(observation: Observation) -> str:
    return observation.driven[0] if observation.driven else "force"


def _compute_level(observation: Observation) -> float:
    return float(np.nanstd(observation.response if observation.free else observation.excitation))


def _describe_levels(
    rows: Sequence[RecordingMismatch], when: str, p: Array | None, tends: BothTrends, level: float
) -> str:
    """Return a sentence on the recording with the largest errors of a model; empty if it is not significant."""
    if p is None:
        return ""
    means = np.array([row.after if when == "after" else row.before for row in rows])
    at = _find_most_significant(means, p)
    if p[at] > level:
        return ""
    row, tend = rows[at], tends.after if when == "after" else tends.before
    model = "model" if when == "after" else "nominal model"
    said = (
        f"Of {len(rows)} recordings the {model} disagrees most in {row.name} (level {rounded(row.level, 3)} {row.unit}"
        f" rms, {rounded(means[at])} times the variance expected, {chance(float(p[at]))})"
    )
    if tend and tend.p <= level:
        said += f"; the disagreement {'grows' if tend.correlation > 0.0 else 'falls'} with the level ({chance(tend.p)})"
    return f"{said}."
