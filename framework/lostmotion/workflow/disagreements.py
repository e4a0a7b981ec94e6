"""Where in time, at which hit and at which drive level the models disagree most, as `diagnosis.json` says it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.disagreement import (
    FEWEST,
    SHORTEST,
    Windows,
    between,
    beyond_chance,
    block_of,
    even_windows,
    hit_windows,
    means_of,
    squares_of,
    trend,
)
from lostmotion.likelihood.observation import Observation
from lostmotion.quantities import unit_of
from lostmotion.report.words import chance
from lostmotion.settings import DEFAULT
from lostmotion.signals.impacts import Hit, hits_of
from lostmotion.stages.diagnose import Diagnosed
from lostmotion.workflow.decays import is_struck

EXPECTED = 1.0


def disagreement_in(d: Diagnosed, rng: np.random.Generator) -> dict[str, Any]:
    """Return what goes into `where`: `over_time` of the recording that is shown, and `by_recording` of several."""
    fits = {"before": d.before, "after": d.after} if d.found else {"before": d.before}
    shown = {name: squares_of(fit, d.shown) for name, fit in fits.items()}
    if not all(np.isfinite(one).any() for one in shown.values()):
        return {}
    level = d.settings.locate.level
    content = {"over_time": over_time(d.shown, shown, rng, level)}
    if d.shown.samples == d.held[0].samples:
        begun = (*d.after.problem.observations, *d.held)
        all_of = {name: [squares_of(fit, one) for one in begun] for name, fit in fits.items()}
        motion = d.after.problem.system.model.motion
        content["by_recording"] = by_recording(begun, all_of, len(d.train), motion, rng, level)
    return content


def over_time(
    observation: Observation,
    squares: Mapping[str, Array],
    rng: np.random.Generator,
    level: float = DEFAULT.locate.level,
) -> dict[str, Any]:
    """Return the disagreement over windows of a recording (over its hits, where a hammer drives it), and a sentence.

    `squares` holds the squared standardised one-step errors (samples,) of the models "before" and, if there is one,
    "after".
    """
    hits = hits_of(observation.excitation, observation.dt) if is_struck(observation) else ()
    windows = _windows(observation, squares, hits)
    edges = [round(float(e), 9) for e in (observation.begin + windows.edges) * observation.dt]
    told = {name: _judged(one, windows, edges, rng, level) for name, one in squares.items()}
    last = told.get("after", told["before"])
    content: dict[str, Any] = {
        "edges": edges,
        "unit": "s",
        "windows": "hits" if windows.aligned else "even",
        "before": told["before"][0],
        "after": last[0],
        "expected": EXPECTED,
        "worst": last[1],
        "worst_before": told["before"][1],
        "says": _says({name: worst for name, (_, worst) in told.items()}, windows.aligned, len(windows)),
    }
    if windows.aligned:
        content["peaks"] = {"values": [hit.peak for hit in hits], "unit": "N"}
    return content


def _windows(observation: Observation, squares: Mapping[str, Array], hits: Sequence[Hit]) -> Windows:
    if len(hits) > 1:
        return hit_windows(observation.samples, [hit.start for hit in hits])
    windows = even_windows(observation.samples, observation.period)
    block = max(block_of(one, windows) for one in squares.values())
    shortest = FEWEST * block
    if observation.samples < FEWEST * shortest:
        return windows
    return even_windows(observation.samples, observation.period, shortest=max(shortest, SHORTEST))


Judged = tuple[list[float | None], dict[str, Any]]


def _judged(squares: Array, windows: Windows, edges: Sequence[float], rng: np.random.Generator, level: float) -> Judged:
    """Return the disagreement in each window, and the window that stands out most with its p-value."""
    means = means_of(squares, windows)
    p = beyond_chance(squares, windows, rng)
    at = int(np.nanargmax(means)) if p is None else _most(means, p)
    worst = {
        "window": at,
        "begin": edges[at],
        "end": edges[at + 1],
        "ratio": float(means[at]),
        "p": None if p is None else float(p[at]),
        "beyond_chance": bool(p is not None and p[at] <= level),
    }
    return [float(m) if math.isfinite(m) else None for m in means], worst


def _most(means: Array, p: Array) -> int:
    """Return the window with the smallest p-value; of several, the one with the largest disagreement."""
    order = sorted(range(len(means)), key=lambda i: (float(p[i]), -float(np.nan_to_num(means[i]))))
    return order[0]


def _says(worst: Mapping[str, Mapping[str, Any]], hits: bool, count: int) -> str:
    """Return where a model disagrees most, the last model first; an empty string where that is not beyond chance."""
    if "after" in worst and worst["after"]["beyond_chance"]:
        return f"The model disagrees most {_place(worst['after'], hits, count)}."
    if not worst["before"]["beyond_chance"]:
        return ""
    if "after" not in worst:
        return f"The model disagrees most {_place(worst['before'], hits, count)}."
    return (
        f"The nominal model disagrees most {_place(worst['before'], hits, count)}; with what was found no stretch"
        " stands out beyond chance."
    )


def _place(worst: Mapping[str, Any], hits: bool, count: int) -> str:
    ratio = f"{worst['ratio']:.2g} times the variance expected, {chance(worst['p'])} over {count}"
    if hits:
        return f"after hit {worst['window'] + 1}, at {worst['begin']:.4g} s ({ratio} hits)"
    return f"between {worst['begin']:.3g} and {worst['end']:.3g} s ({ratio} windows)"


def by_recording(
    recordings: Sequence[Observation],
    squares: Mapping[str, Sequence[Array]],
    fitted: int,
    motion: str,
    rng: np.random.Generator,
    level: float = DEFAULT.locate.level,
) -> dict[str, Any]:
    """Return one row for each recording, the first `fitted` of which went into the fit, and what goes with the level.

    The level of a recording is the rms of its drive about its mean, or of its response where nothing drives it.
    """
    levels = np.array([_level(one) for one in recordings])
    first = recordings[0]
    unit = unit_of(first.channel if first.free else _driver(first), motion)
    last = squares.get("after", squares["before"])
    rows = [
        {
            "name": one.name,
            "level": float(level),
            "unit": unit,
            "fitted": i < fitted,
            "before": float(np.nanmean(squares["before"][i])),
            "after": float(np.nanmean(last[i])),
        }
        for i, (one, level) in enumerate(zip(recordings, levels, strict=True))
    ]
    told = {"after": last, "before": squares["before"]}
    worst = {when: _stands_out(rows, when, between(parts, rng), level) for when, parts in told.items()}
    tends = {when: trend(parts, levels, rng) for when, parts in told.items()}
    return {
        "rows": rows,
        "level_of": "response" if first.free else "drive",
        "expected": EXPECTED,
        "trend": {when: None if t is None else {"correlation": t[0], "p": t[1]} for when, t in tends.items()},
        "says": _level_says(rows, worst, tends, level),
    }


def _stands_out(rows: Sequence[dict[str, Any]], when: str, p: Array | None, level: float) -> int | None:
    """Return the recording in which a model disagrees most beyond chance, after noting all p-values in the rows."""
    if p is None:
        return None
    for row, one in zip(rows, p, strict=True):
        row[f"p_{when}"] = float(one)
    worst = _most(np.array([row[when] for row in rows]), p)
    return worst if p[worst] <= level else None


def _driver(observation: Observation) -> str:
    return observation.driven[0] if observation.driven else "force"


def _level(observation: Observation) -> float:
    return float(np.nanstd(observation.response if observation.free else observation.excitation))


def _level_says(
    rows: Sequence[Mapping[str, Any]],
    worst: Mapping[str, int | None],
    tends: Mapping[str, tuple[float, float] | None],
    level: float,
) -> str:
    """Return in which recording a model disagrees most, the last model first; empty where that is not beyond chance."""
    when = next((name for name in ("after", "before") if worst[name] is not None), None)
    at = worst[when] if when else None
    if when is None or at is None:
        return ""
    row, tend = rows[at], tends[when]
    model = "model" if when == "after" else "nominal model"
    said = (
        f"Of {len(rows)} recordings the {model} disagrees most in {row['name']} (level {row['level']:.3g} {row['unit']}"
        f" rms, {row[when]:.2g} times the variance expected, {chance(row[f'p_{when}'])})"
    )
    if tend and tend[1] <= level:
        said += f"; the disagreement {'grows' if tend[0] > 0.0 else 'falls'} with the level ({chance(tend[1])})"
    return f"{said}."
