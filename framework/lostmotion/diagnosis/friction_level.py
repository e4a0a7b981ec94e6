"""Dry friction that changes during a recording: its level over the time, with a 95 % band, from the found term."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lostmotion.contracts import Array, Term
from lostmotion.diagnosis.outcome import Outcome
from lostmotion.diagnosis.stages import SearchResult, list_physical_keys
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.system import Slot
from lostmotion.storage import StoredArray

POINTS, DRAWN = 200, 400
"""The most times at which the level is computed, and the most draws of the posterior."""
_SLIDING = 1.0
"""A velocity (m/s or rad/s) at which friction slides; with no width of sticking, its size does not matter."""


def list_levels(outcome: Outcome, unit: str) -> tuple[dict[str, StoredArray], dict[str, StoredArray]]:
    """Return median and bounds of the level of the first changing friction that was found, and their times (s)."""
    d = outcome.diagnosis
    key = next((key for key in d.found if is_changing_friction(*find_term(d.after.posterior, key))), None)
    if key is None or not len(outcome.draws_after):
        return {}, {}
    time, levels = compute_levels(d, key, outcome.draws_after[:DRAWN])
    low, middle, high = np.quantile(levels, [0.025, 0.5, 0.975], axis=0)
    meaning = f"level of {key} over time"
    bands = {"": middle, "_low": low, "_high": high}
    table = {f"friction_level{end}": StoredArray(("level_time",), v, unit, meaning) for end, v in bands.items()}
    return table, {"level_time": StoredArray(("level_time",), time, "s", "time from the start of the recording")}


def is_changing_friction(term: Term, slots: list[Slot]) -> bool:
    """Return whether a term is dry friction whose level changes during a recording."""
    changes = any(slot.param.prior.lasting for slot in slots) or "travelled" in term.states
    return term.acts == "motion" and term.needs == ("mobility",) and changes


def compute_levels(d: SearchResult, key: str, draws: Array) -> tuple[Array, Array]:
    """Return times (points,) of the shown recording and the level (draws, points) of a changing friction."""
    term, slots = find_term(d.after.posterior, key)
    shown, velocity = d.shown, d.located.missing.velocity
    chosen = np.unique(np.linspace(0, shown.samples - 1, min(POINTS, shown.samples)).astype(int))
    travelled = np.cumsum(np.abs(velocity)) * shown.dt
    values = _list_values(d.after.values, list_physical_keys(d.after), slots, draws)
    unused = np.zeros(len(d.after.posterior.system.model.inputs))
    time = np.asarray(shown.time, dtype=float)[chosen]
    levels = [
        [-term.force(t, 0.0, _SLIDING, unused, (*row, 0.0), (s,)) for t, s in zip(time, travelled[chosen], strict=True)]
        for row in values.tolist()
    ]
    return time, np.array(levels, dtype=float)


def _list_values(known: Mapping[str, float], keys: list[str], slots: list[Slot], draws: Array) -> Array:
    """Return the parameters of a term (draws, parameters); one that was not drawn has its fitted value."""
    columns = [draws[:, keys.index(s.key)] if s.key in keys else np.full(len(draws), known[s.key]) for s in slots]
    return np.stack(columns, axis=1)
