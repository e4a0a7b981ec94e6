"""How the report opens: the verdict and the answer in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from lostmotion.report.evidence import Evidence
from lostmotion.report.words import DASH, measured, percent, sentence, span, spoken

UNNAMED = ("unknown", "random_force")
"""What stands for a force that no mechanism of the library explains."""
ADEQUATE = "Nothing is missing that this recording can show."


class Badge(NamedTuple):
    """Kind of the verdict (a style of the page) and its words."""

    kind: str
    words: str


def badge(evidence: Evidence) -> Badge:
    """Return the verdict: adequate, or a mismatch whose cause is named, likely or open."""
    if evidence.fact("verdict") == "adequate":
        return Badge("adequate", "Adequate")
    if evidence.fact("verdict") != "mismatch":
        return Badge("unknown", "No verdict")
    states = {entry.get("state") or _state(entry) for entry in found(evidence)}
    if "named" in states:
        return Badge("mismatch", "Mismatch, named")
    return Badge("unknown", "Mismatch, likely" if "likely" in states else "Mismatch, open")


def _state(entry: Mapping[str, Any]) -> str:
    """Return the state of an entry that says none: what has a name is named."""
    return "open" if entry.get("mechanism") in UNNAMED else "named"


def found(evidence: Evidence) -> list[Mapping[str, Any]]:
    """Return the mechanisms that were found."""
    return list(evidence.fact("found") or [])


def answer(evidence: Evidence) -> list[str]:
    """Return the opening sentences: the diagnosis's own, or such as its numbers allow."""
    says = evidence.fact("says")
    given = [says] if isinstance(says, str) else [str(part) for part in says or []]
    return [part for part in given if part] or _composed(evidence)


def _composed(evidence: Evidence) -> list[str]:
    if evidence.fact("verdict") == "adequate":
        return [ADEQUATE]
    said = [_of_mechanism(entry) for entry in found(evidence)]
    return (said or ["Something is missing, and no mechanism of the library explains it."]) + _gain_in_words(evidence)


def _of_mechanism(entry: Mapping[str, Any]) -> str:
    if entry.get("mechanism") == "unknown":
        depends = " and ".join(spoken(str(name)) for name in entry.get("depends_on") or [])
        opening = "Something is missing that no mechanism of the library explains"
        return opening + (f": a force that depends on {depends}, modelled by a learnt curve." if depends else ".")
    return str(entry.get("says") or f"{sentence(spoken(str(entry.get('mechanism', '?'))))} was left out.")


def _gain_in_words(evidence: Evidence) -> list[str]:
    """Return one sentence on what the found term is worth, or none where the numbers are absent."""
    parts = []
    force = _force(evidence, "unexplained_before"), _force(evidence, "unexplained")
    if DASH not in force:
        parts.append(f"the unexplained force falls from {force[0]} to {force[1]}")
    error = [percent(evidence.number("fit", when, "heldout_nrmse")) for when in ("before", "after")]
    if DASH not in error:
        over = f"the free-running prediction error{horizon(evidence)}"
        parts.append(f"{over} goes from {error[0]} to {error[1]} of the response")
    return ["With it " + ", and ".join(parts) + "."] if parts else []


def horizon(evidence: Evidence) -> str:
    """Return ` over 0.5 Lyapunov times`, or an empty string where no horizon is given."""
    length = evidence.number("fit", "before", "horizon")
    if length != length:
        return ""
    chaotic = any(evidence.number("lyapunov", when) > 0 for when in ("before", "after"))
    unit = evidence.fact("fit", "horizon_unit") or ("Lyapunov times" if chaotic else "drive periods")
    return f" over {span(length, str(unit))}"


def confused(evidence: Evidence) -> list[str]:
    """Return one sentence for each mechanism that the recording cannot tell from the one found."""
    return [_confusion(entry) for entry in evidence.fact("confused_with") or []]


def _confusion(entry: Any) -> str:
    if not isinstance(entry, Mapping):
        return sentence(spoken(str(entry)))
    rest = entry.get("says") or entry.get("excitation") or entry.get("would_tell") or ""
    return sentence(spoken(str(entry.get("mechanism", "?")))) + (f": {rest}" if rest else "")


def _force(evidence: Evidence, key: str) -> str:
    return measured(evidence.number(key, "rms"), str(evidence.fact(key, "unit") or ""))
