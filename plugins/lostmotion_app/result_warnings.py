"""Warnings of a check and of a diagnosis about the case, with their remedies."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from typing import Any

from lostmotion.diagnosis.states import NAMED
from lostmotion.recording.warnings import BACKWARD
from lostmotion.results import Interval, percent
from lostmotion.results.diagnosis import Diagnosis, Mechanism
from lostmotion.results.expectation import CaseCheck, WrongScale
from lostmotion_app.case_content import Content, multiply_column
from lostmotion_app.desk import Desk
from lostmotion_app.remedies import Remedy, WarnedCase, list_warnings

NEAR, WIDER = 0.005, 100.0
"""A value is at a bound within this share of the range of its prior; a prior is extended by this factor."""
GAINS: Mapping[str, tuple[str, str, float]] = {
    "sensor_gain": ("sensors", "response", -1.0),
    "excitation_gain": ("inputs", "excitation", 1.0),
}
"""Terms of a wrong gain: the keys of their channels in a case, and the power of (1 + error) that repairs the column."""


def list_check_warnings(result: CaseCheck, content: Content) -> Iterator[WarnedCase]:
    """Yield the warnings of a check of the case with their remedies: a factor, or a known value."""
    yield from _list_scales(result.scales, content)
    yield from _list_bounds(result.expected.parameters, content)
    estimated = content["model"].get("estimate", {})
    for pair in result.expected.pairs:
        both = [name for name in (pair.one, pair.other) if name in estimated]
        if len(both) == 2:
            says = f"This recording hardly tells {pair.one} from {pair.other}: a known value of one of them helps."
            yield WarnedCase(says, tuple(Remedy("Set", content, name) for name in both))


def list_result_warnings(result: Diagnosis, desk: Desk) -> Iterator[WarnedCase]:
    """Yield the warnings of a diagnosis of the case of a desk with their remedies.

    They are the scale or the sign of a column, and priors that are too narrow. A gain that was named as the missing
    cause is one of them: the factor corrects the column.
    """
    content = desk.content
    yield from _list_scales(result.scales, content)
    yield from _list_bounds(result.parameters.after, content)
    for one in result.found:
        if one.mechanism in GAINS and one.state == NAMED and (column := find_column(one, content)):
            error = one.parameters["error"].median
            factor = (1.0 + error) ** GAINS[one.mechanism][2]
            says = f"the values of {column} are {percent(abs(factor - 1.0))} too {'small' if factor > 1.0 else 'large'}"
            yield WarnedCase(says, (_make_factor(content, column, factor),))
    if any(BACKWARD in sentence for sentence in result.says):
        yield from (one for one in list_warnings(desk) if BACKWARD in one.says)


def find_column(gain: Mechanism, content: Content) -> str:
    """Return the column of the channel with a wrong gain, empty where the case has several that it may be."""
    several, single, _ = GAINS[gain.mechanism]
    first = content["recordings"][0]
    channels: Sequence[Any] = first.get(several, [first.get(single, {})])
    named = [one for one in channels if gain.at in (one.get("name"), one.get("channel"), one.get("input"))]
    (chosen, *more) = named or channels or [{}]
    return "" if more else str(chosen.get("column", ""))


def _list_scales(scales: Sequence[WrongScale], content: Content) -> Iterator[WarnedCase]:
    """Yield the columns whose scale does not fit the model, each with the factor with which it does."""
    for one in scales:
        says = f"the scale of {one.column} does not fit the model: {one.says}?"
        yield WarnedCase(says, (_make_factor(content, one.column, one.factor),))


def _list_bounds(values: Mapping[str, Interval], content: Content) -> Iterator[WarnedCase]:
    """Yield the parameters whose value is at a bound of their prior, each with a wider one."""
    for name, prior in content["model"].get("estimate", {}).items():
        if name in values and (wider := widen_prior(prior, values[name].median)):
            changed = deepcopy(content)
            changed["model"]["estimate"][name] = wider
            says = f"the prior of {name} may be too narrow: the value is at its bound"
            yield WarnedCase(says, (Remedy(f"{name}: {wider['low']:.4g} to {wider['high']:.4g}", changed),))


def _make_factor(content: Content, column: str, factor: float) -> Remedy:
    return Remedy(f"Multiply {column} by {factor:.4g}", multiply_column(content, column, factor))


def widen_prior(prior: Mapping[str, Any], value: float) -> dict[str, Any]:
    """Return a prior that extends further beyond the bound at which a value is; empty for a value at no bound."""
    if "low" not in prior:
        return {}
    low, high = float(prior["low"]), float(prior["high"])
    if prior.get("scale") == "log":
        near, ends = math.log(high / low) * NEAR, (low / WIDER, high * WIDER)
        away = abs(math.log(value / low)), abs(math.log(value / high))
    else:
        near, ends = (high - low) * NEAR, (low - WIDER * (high - low), high + WIDER * (high - low))
        away = abs(value - low), abs(value - high)
    if min(away) > near:
        return {}
    return {**prior, **({"low": ends[0]} if away[0] < away[1] else {"high": ends[1]})}
