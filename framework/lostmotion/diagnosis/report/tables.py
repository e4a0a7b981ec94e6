"""The tables at the head of the page: what was found, and the numbers that carry the answer."""

from __future__ import annotations

import math

from lostmotion.diagnosis.report.evidence import Evidence
from lostmotion.diagnosis.report.opening import horizon
from lostmotion.report.pages import Grid, trimmed
from lostmotion.report.words import DASH, figures, measured, percent, probability, sentence, spoken, typeset
from lostmotion.results.diagnosis import Mechanism, OpenTerm


def mechanisms(evidence: Evidence) -> Grid:
    """Return mechanism, state, probability, and what is said of it; then what stays open.

    What is said of a mechanism has the doubts that make it no more than likely.
    """
    rows = [
        [_named(one), one.state, probability(one.probability), typeset(" ".join([one.says, *one.doubts]))]
        for one in evidence.result.found
    ]
    rows += [[_named(one), "open", probability(one.probability), typeset(one.says)] for one in evidence.result.open]
    return trimmed(["Mechanism", "State", "Probability", "In words"], rows)


def key_numbers(evidence: Evidence) -> Grid:
    """Return the numbers that carry the answer: before, after, and the noise floor."""
    result = evidence.result
    fit, missing = result.fit, (result.unexplained_before, result.unexplained)
    shares, scores = [percent(one.share_of_drive) for one in missing], (fit.before, fit.after)
    exponents = [measured(one, result.lyapunov.unit) for one in (result.lyapunov.before, result.lyapunov.after)]
    errors = [percent(one.nrmse) for one in scores]
    rows = [
        ["Unexplained force, r.m.s.", *_placed(evidence, *(measured(one.rms, one.unit) for one in missing)), DASH],
        [f"Its share of {result.drive.of}", *_placed(evidence, *shares), DASH],
        [f"Prediction error{horizon(result)}", *errors, percent(fit.noise_floor_nrmse)],
        ["Held-out log score per sample", *(figures(one.log_score, 4) for one in scores), DASH],
        ["Predictions are valid for", *_valid(evidence), DASH],
        ["Largest Lyapunov exponent", *exponents, DASH],
    ]
    if not evidence.augmented:
        rows = [[name, before, DASH, floor] for name, before, _, floor in rows]
    return trimmed(["", "Before" if evidence.augmented else "Model as it stands", "After", "Noise floor"], rows)


def _named(one: Mechanism | OpenTerm) -> str:
    return sentence(spoken(one.mechanism)) + (f" (at the {one.at})" if one.at else "")


def _placed(evidence: Evidence, before: str, after: str) -> list[str]:
    """Return what is unexplained before and after; where nothing was added, what is left is left by the one model."""
    return [before, after] if evidence.augmented else [before if after == DASH else after, DASH]


def _valid(evidence: Evidence) -> list[str]:
    """Return how long predictions hold, before and after."""
    valid = evidence.result.valid_prediction_time
    times = valid.in_lyapunov_times
    return [
        _lasting(valid.before, valid.unit, times.before if times else math.nan, more=valid.or_longer.before),
        _lasting(valid.after, valid.unit, times.after if times else math.nan, more=valid.or_longer.after),
    ]


def _lasting(time: float, unit: str, in_lyapunov_times: float, *, more: bool) -> str:
    text, times = measured(time, unit), figures(in_lyapunov_times, 2)
    if more:
        return f"more than {text}"
    return text if times == DASH else f"{text} ({times} Lyapunov times)"
