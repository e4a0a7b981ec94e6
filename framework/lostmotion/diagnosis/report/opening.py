"""Texts at the top of the report: the verdict, the prediction horizon, and mechanisms that cannot be distinguished."""

from __future__ import annotations

from typing import NamedTuple

from lostmotion.report.words import sentence, span, to_words
from lostmotion.results.diagnosis import Diagnosis


class Badge(NamedTuple):
    """Kind of the verdict (a style of the page) and its words."""

    kind: str
    words: str


def make_badge(result: Diagnosis) -> Badge:
    """Return the verdict: adequate, or a mismatch whose cause is named, likely or open."""
    if result.verdict == "adequate":
        return Badge("adequate", "Adequate")
    states = {one.state for one in result.found}
    if "named" in states:
        return Badge("mismatch", "Mismatch, named")
    return Badge("unknown", "Mismatch, likely" if "likely" in states else "Mismatch, open")


def format_horizon(result: Diagnosis) -> str:
    """Return the prediction horizon as text, such as ` over 0.5 Lyapunov times`."""
    return f" over {span(result.fit.before.horizon, result.fit.horizon_unit)}"


def write_confusions(result: Diagnosis) -> list[str]:
    """Return one sentence for each mechanism that the recording cannot distinguish from the found one."""
    return [f"{sentence(to_words(one.mechanism))}: {one.says}" for one in result.confused_with]
