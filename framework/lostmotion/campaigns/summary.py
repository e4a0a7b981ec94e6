"""The summary of a batch: one row for each case, by which many machines can be sorted, and a few lines."""

from __future__ import annotations

import csv
import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from lostmotion.codec import described, to_plain
from lostmotion.results.diagnosis import Diagnosis, Mechanism, ParameterSets
from lostmotion.storage import whole

SUMMARY = "summary.csv"
DIAGNOSED, ASIDE = "diagnosed", "set aside"
COLUMNS = (
    "case", "status", "verdict", "mechanisms", "probability", "share_of_drive", "unexplained_share",
    "heldout_before", "heldout_after", "noise_floor", "moved", "moved_before", "moved_after", "moved_by", "says",
)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class BatchRow:
    """The result of one case; a case that was set aside has only name, status and sentence."""

    case: str = described("name of the case, and of its folder")
    status: str = described(f"{DIAGNOSED} or {ASIDE}")
    verdict: str | None = described("adequate or mismatch", default=None)
    mechanisms: str | None = described(
        "the mechanisms that were found, with places; empty where there are none", default=None
    )
    probability: float | None = described("smallest probability of the found mechanisms", default=None)
    share_of_drive: float | None = described("largest force of a found mechanism over that of the drive", default=None)
    unexplained_share: float | None = described(
        "rms of the remaining missing force over that of the drive", default=None
    )
    heldout_before: float | None = described("held-out error of the nominal model over the response", default=None)
    heldout_after: float | None = described("the same error of the model with the found mechanisms", default=None)
    noise_floor: float | None = described("the noise over the response", default=None)
    move: Move | None = described("the parameter that moved most, if one did", flat=True, default=None)
    says: str = described("the answer in sentences, or the reason why there is none")


@dataclass(frozen=True)
class Move:
    """The parameter that changed most from the nominal model to the one with the found mechanisms."""

    moved: str = described("its name")
    moved_before: float = described("its median in the nominal model, in SI units")
    moved_after: float = described("its median with the found mechanisms, in SI units")
    moved_by: float = described("the change over the first median")


def make_row(name: str, diagnosis: Diagnosis) -> BatchRow:
    """Return the row of a case from its diagnosis."""
    found, fit = diagnosis.found, diagnosis.fit
    return BatchRow(
        case=name,
        status=DIAGNOSED,
        verdict=diagnosis.verdict,
        mechanisms=" + ".join(map(_format_mechanism, found)),
        probability=min(_drop_missing(one.probability for one in found), default=None),
        share_of_drive=max(_drop_missing(one.share_of_drive for one in found), default=None),
        unexplained_share=diagnosis.unexplained.share_of_drive,
        heldout_before=fit.before.nrmse,
        heldout_after=fit.after.nrmse,
        noise_floor=fit.noise_floor_nrmse,
        move=_find_move(diagnosis.parameters),
        says=" ".join(diagnosis.says),
    )


def make_aside_row(name: str, said: str) -> BatchRow:
    """Return the row of a case that could not be used, with the reason in a sentence."""
    return BatchRow(case=name, status=ASIDE, says=" ".join(said.split()))


def save_rows(path: Path, rows: Sequence[BatchRow]) -> None:
    """Write one line for each case as CSV; missing values are empty cells."""
    with whole(path) as spare, spare.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        plain = map(to_plain, rows)
        writer.writerows([_format_cell(row.get(column)) for column in COLUMNS] for row in plain)


def format_summary(rows: Sequence[BatchRow]) -> list[str]:
    """Return lines with the number of diagnosed cases and the frequency of each answer, the most frequent one first."""
    answers = Counter(row.mechanisms or str(row.verdict) for row in rows if row.status == DIAGNOSED)
    aside = len(rows) - answers.total()
    head = f"{answers.total()} of {len(rows)} cases diagnosed" + (f", {aside} set aside" if aside else "")
    width = len(str(max(answers.values(), default=0)))
    ordered = sorted(answers.items(), key=lambda one: (-one[1], one[0]))
    return [head, *(f"  {count:>{width}}  {answer}" for answer, count in ordered)]


def _format_mechanism(entry: Mechanism) -> str:
    return f"{entry.mechanism}@{entry.at}" if entry.at else entry.mechanism


def _drop_missing(values: Iterable[float | None]) -> list[float]:
    return [value for value in values if value is not None and not math.isnan(value)]


def _find_move(parameters: ParameterSets) -> Move | None:
    """Return the parameter with the largest relative change from before to after; None if none changed."""
    before, after = ({name: one.median for name, one in of.items()} for of in (parameters.before, parameters.after))
    both = [name for name in before if before[name] and after.get(name) not in (None, before[name])]
    shares = {name: after[name] / before[name] - 1.0 for name in both}
    if not shares:
        return None
    name = max(shares, key=lambda one: abs(shares[one]))
    return Move(name, before[name], after[name], shares[name])


def _format_cell(value: object) -> object:
    if isinstance(value, float):
        return f"{value:.6g}"
    return "" if value is None else value
