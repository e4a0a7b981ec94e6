"""Draws of the parameters after a diagnosis, from a mixture over all probable explanations (model averaging).

If two explanations fit equally well, for instance a wrong gain of the drive and a wrong gain of the sensor, each leads
to different parameters of the machine: an interval from one of them alone is too narrow.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.diagnosis.findings import draw_parameters
from lostmotion.diagnosis.search import SearchResult, list_physical_keys
from lostmotion.inference.fit import Fit
from lostmotion.inference.origin import shift_origin
from lostmotion.inference.other_shapes import LARGEST, find_modes, refit_complete
from lostmotion.inference.setup import polish_fit

REACH = 4.0
"""Maxima of the posterior with a log evidence lower than that of the best by no more than this are in the mixture."""
MOST = 3
"""The largest number of alternative explanations in the mixture."""


def draw_mixture(diagnosis: SearchResult, rng: np.random.Generator, stretches: Array | None = None) -> Array:
    """Return draws (draws, keys) of the parameters of the model after the diagnosis.

    Those of the machine are a mixture over the chosen set and its rivals, weighted by posterior probability (Hoeting et
    al., Statistical Science 14 (1999) 382-417); those of the terms are from the maxima of the chosen set.
    Deviations of the chosen set are multiplied by `stretches`, as `measure_stretches` returns them.
    """
    chosen = diagnosis.after
    made = draw_parameters(chosen, rng, stretches)
    if diagnosis.learned:
        return made
    made = shift_origin(chosen, mix_modes(chosen, made, rng), list_physical_keys(chosen), rng)
    rivals = _list_rivals(diagnosis)
    keys = list_physical_keys(chosen)
    parts = _divide_rows(len(made), [share for _, share in rivals], rng)
    for (terms, _), rows in zip(rivals, parts, strict=True):
        fit = polish_fit(diagnosis.selection.fitted_sets[terms].fit)
        other = draw_parameters(fit, rng)
        columns = {key: i for i, key in enumerate(list_physical_keys(fit))}
        for i, key in enumerate(keys):
            if key in columns and "." not in key:
                made[rows, i] = other[rows, columns[key]]
    return made


def mix_modes(chosen: Fit, made: Array, rng: np.random.Generator) -> Array:
    """Return draws from the maxima of a posterior, each with the share of its evidence; `made` are those of the fit.

    Half of the prior of an amplitude with a greatest value is at that value, where the law is complete: a drive that
    saturates passes nothing more. The evidence decides between it and a value below.
    """
    modes = [mode for mode in find_modes(chosen, reach=REACH) if mode is not chosen] + refit_complete(chosen)
    weights = np.exp([min(mode.log_evidence - chosen.log_evidence, LARGEST) for mode in modes])
    parts = _divide_rows(len(made), weights / (1.0 + weights.sum()), rng)
    for mode, rows in zip(modes, parts, strict=True):
        made[rows] = _draw_all(mode, list_physical_keys(chosen), rng)[: len(rows)]
    return made


def _draw_all(fit: Fit, keys: Sequence[str], rng: np.random.Generator) -> Array:
    """Return draws (draws, keys) of parameters of a fit; those that it holds have their values."""
    drawn, own = draw_parameters(fit, rng), list_physical_keys(fit)
    known, index = fit.problem.known, fit.problem.system.index
    columns = [drawn[:, own.index(k)] if k in own else np.full(len(drawn), known[index[k]]) for k in keys]
    return np.stack(columns, axis=1)


def _divide_rows(count: int, shares: Iterable[float], rng: np.random.Generator) -> list[NDArray[np.intp]]:
    """Return random rows out of `count` for each share; no row is in two parts."""
    ends = np.cumsum([0, *(round(float(share) * count) for share in shares)])
    order = rng.permutation(count)
    return [order[begin:end] for begin, end in itertools.pairwise(ends)]


def _list_rivals(diagnosis: SearchResult) -> list[tuple[frozenset[str], float]]:
    """Return the other sets of terms with a share of the posterior, most probable first."""
    shares = diagnosis.selection.probabilities()
    here, least = diagnosis.selection.chosen.problem.active, diagnosis.settings.name.mixed
    others = [(terms, p) for terms, p in shares.items() if terms != here and p > least]
    return sorted(others, key=lambda pair: -pair[1])[:MOST]
