"""How the report opens: the verdict in words, over which horizon it predicts, and what cannot be told apart."""

from __future__ import annotations

from typing import NamedTuple

from lostmotion.report.words import sentence, span, spoken
from lostmotion.results.diagnosis import Diagnosis


class Badge(NamedTuple):
    """Kind of the verdict (a style of the page) and its words."""

    kind: str
    words: str


def badge(result: Diagnosis) -> Badge:
    """Return the verdict: adequate, or a mismatch whose cause is named, likely or open."""
    if result.verdict == "adequate":
        return Badge("adequate", "Adequate")
    states = {one.state for one in result.found}
    if "named" in states:
        return Badge("mismatch", "Mismatch, named")
    return Badge("unknown", "Mismatch, likely" if "likely" in states else "Mismatch, open")


def horizon(result: Diagnosis) -> str:
    """Return ` over 0.5 Lyapunov times`."""
    return f" over {span(result.fit.before.horizon, result.fit.horizon_unit)}"


def confused(result: Diagnosis) -> list[str]:
    """Return one sentence for each mechanism that the recording cannot tell from the one found."""
    return [f"{sentence(spoken(one.mechanism))}: {one.says}" for one in result.confused_with]
