"""What a batch says of its cases: one row for each, by which a thousand machines can be sorted, and a few lines."""

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
    """What became of a case; of one that was set aside there are name, status and sentence only."""

    case: str = described("name of the case, and of its folder")
    status: str = described(f"{DIAGNOSED} or {ASIDE}")
    verdict: str | None = described("adequate or mismatch", default=None)
    mechanisms: str | None = described("what was found, with places; empty where nothing was", default=None)
    probability: float | None = described("least probability of what was found", default=None)
    share_of_drive: float | None = described("largest force of what was found over that of the drive", default=None)
    unexplained_share: float | None = described("rms of the force that is left over that of the drive", default=None)
    heldout_before: float | None = described("held-out error of the nominal model over the response", default=None)
    heldout_after: float | None = described("the same of the model with what was found", default=None)
    noise_floor: float | None = described("the noise over the response", default=None)
    move: Move | None = described("the parameter that moved most, if one did", flat=True, default=None)
    says: str = described("the answer in sentences, or why there is none")


@dataclass(frozen=True)
class Move:
    """The parameter that moved most from the nominal model to the one with what was found."""

    moved: str = described("its name")
    moved_before: float = described("its median in the nominal model, in SI units")
    moved_after: float = described("its median with what was found, in SI units")
    moved_by: float = described("the change over the first of both")


def row_of(name: str, diagnosis: Diagnosis) -> BatchRow:
    """Return the row of a case from its diagnosis."""
    found, fit = diagnosis.found, diagnosis.fit
    return BatchRow(
        case=name,
        status=DIAGNOSED,
        verdict=diagnosis.verdict,
        mechanisms=" + ".join(map(_mechanism, found)),
        probability=min(_known(one.probability for one in found), default=None),
        share_of_drive=max(_known(one.share_of_drive for one in found), default=None),
        unexplained_share=diagnosis.unexplained.share_of_drive,
        heldout_before=fit.before.nrmse,
        heldout_after=fit.after.nrmse,
        noise_floor=fit.noise_floor_nrmse,
        move=_moved(diagnosis.parameters),
        says=" ".join(diagnosis.says),
    )


def row_aside(name: str, said: str) -> BatchRow:
    """Return the row of a case that could not be used, with the sentence that says why."""
    return BatchRow(case=name, status=ASIDE, says=" ".join(said.split()))


def save_rows(path: Path, rows: Sequence[BatchRow]) -> None:
    """Write one line for each case as CSV; what a case does not have stays empty."""
    with whole(path) as spare, spare.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        plain = map(to_plain, rows)
        writer.writerows([_cell(row.get(column)) for column in COLUMNS] for row in plain)


def lines_of(rows: Sequence[BatchRow]) -> list[str]:
    """Return how many cases were diagnosed, and how often each answer was given, the most frequent one first."""
    answers = Counter(row.mechanisms or str(row.verdict) for row in rows if row.status == DIAGNOSED)
    aside = len(rows) - answers.total()
    head = f"{answers.total()} of {len(rows)} cases diagnosed" + (f", {aside} set aside" if aside else "")
    width = len(str(max(answers.values(), default=0)))
    ordered = sorted(answers.items(), key=lambda one: (-one[1], one[0]))
    return [head, *(f"  {count:>{width}}  {answer}" for answer, count in ordered)]


def _mechanism(entry: Mechanism) -> str:
    return f"{entry.mechanism}@{entry.at}" if entry.at else entry.mechanism


def _known(values: Iterable[float | None]) -> list[float]:
    return [value for value in values if value is not None and not math.isnan(value)]


def _moved(parameters: ParameterSets) -> Move | None:
    """Return the parameter that moved most from before to after, as a share of what it was; None if none moved."""
    before, after = ({name: one.median for name, one in of.items()} for of in (parameters.before, parameters.after))
    both = [name for name in before if before[name] and after.get(name) not in (None, before[name])]
    shares = {name: after[name] / before[name] - 1.0 for name in both}
    if not shares:
        return None
    name = max(shares, key=lambda one: abs(shares[one]))
    return Move(name, before[name], after[name], shares[name])


def _cell(value: object) -> object:
    if isinstance(value, float):
        return f"{value:.6g}"
    return "" if value is None else value
