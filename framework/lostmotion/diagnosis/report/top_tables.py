"""The tables at the top of the page: the found mechanisms, and the most important numbers."""

from __future__ import annotations

import math

from lostmotion.diagnosis.report.opening import format_horizon
from lostmotion.diagnosis.report.page_data import Evidence
from lostmotion.report.pages import Grid, trim_table
from lostmotion.report.words import (
    DASH,
    figures,
    format_quantity,
    percent,
    probability,
    sentence,
    to_words,
    typeset,
)
from lostmotion.results.diagnosis import Mechanism, OpenTerm


def make_mechanism_table(evidence: Evidence) -> Grid:
    """Return mechanism, state, probability and sentence of the found mechanisms, then of the open terms.

    The sentence includes the doubts because of which a mechanism is not more than likely.
    """
    rows = [
        [_format_mechanism(one), one.state, probability(one.probability), typeset(" ".join([one.says, *one.doubts]))]
        for one in evidence.result.found
    ]
    rows += [
        [_format_mechanism(one), "open", probability(one.probability), typeset(one.says)]
        for one in evidence.result.open
    ]
    return trim_table(["Mechanism", "State", "Probability", "In words"], rows)


def make_number_table(evidence: Evidence) -> Grid:
    """Return the most important numbers: before, after, and the noise floor."""
    result = evidence.result
    fit, missing = result.fit, (result.unexplained_before, result.unexplained)
    shares, scores = [percent(one.share_of_drive) for one in missing], (fit.before, fit.after)
    exponents = [format_quantity(one, result.lyapunov.unit) for one in (result.lyapunov.before, result.lyapunov.after)]
    errors = [percent(one.nrmse) for one in scores]
    rows = [
        [
            "Unexplained force, r.m.s.",
            *_arrange_values(evidence, *(format_quantity(one.rms, one.unit) for one in missing)),
            DASH,
        ],
        [f"Its share of {result.drive.of}", *_arrange_values(evidence, *shares), DASH],
        [f"Prediction error{format_horizon(result)}", *errors, percent(fit.noise_floor_nrmse)],
        ["Held-out log score per sample", *(figures(one.log_score, 4) for one in scores), DASH],
        ["Predictions are valid for", *_format_valid_times(evidence), DASH],
        ["Largest Lyapunov exponent", *exponents, DASH],
    ]
    if not evidence.augmented:
        rows = [[name, before, DASH, floor] for name, before, _, floor in rows]
    return trim_table(["", "Before" if evidence.augmented else "Nominal model", "After", "Noise floor"], rows)


def _format_mechanism(one: Mechanism | OpenTerm) -> str:
    return sentence(to_words(one.mechanism)) + (f" (at the {one.at})" if one.at else "")


def _arrange_values(evidence: Evidence, before: str, after: str) -> list[str]:
    """Return the values before and after; where nothing was added, there is one value of the nominal model."""
    return [before, after] if evidence.augmented else [before if after == DASH else after, DASH]


def _format_valid_times(evidence: Evidence) -> list[str]:
    """Return the times for which predictions are valid, before and after."""
    valid = evidence.result.valid_prediction_time
    times = valid.in_lyapunov_times
    return [
        _format_duration(valid.before, valid.unit, times.before if times else math.nan, more=valid.or_longer.before),
        _format_duration(valid.after, valid.unit, times.after if times else math.nan, more=valid.or_longer.after),
    ]


def _format_duration(time: float, unit: str, in_lyapunov_times: float, *, more: bool) -> str:
    text, times = format_quantity(time, unit), figures(in_lyapunov_times, 2)
    if more:
        return f"more than {text}"
    return text if times == DASH else f"{text} ({times} Lyapunov times)"
