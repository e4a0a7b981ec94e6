"""What became of each arm of a trial, and the table of all of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from lostmotion.codec import described
from lostmotion.results.robots import RobotDiagnosis
from lostmotion_trials.arms.draw import Truth
from lostmotion_trials.rates import Rate, estimate_rate

SURE = 0.95
"""A mechanism counts as named above this probability."""
CLEAR = 30.0
"""Effects that gain less log evidence than this are not counted as missed."""
RIGHT, MORE, PART, OTHER = "right", "right and more", "in part", "other physics"
WRONG, SILENT, EMPTY, FALSE, FAILED = "wrong joint", "silent", "empty", "false", "failed"


@dataclass(frozen=True)
class JudgedSize:
    """A size of a named effect against its truth."""

    name: str = described("mechanism, place and parameter")
    truth: float = described("true value, in SI units")
    low: float = described("lower end of the 95 % interval")
    median: float = described("median of the posterior")
    high: float = described("upper end of the 95 % interval")
    inside: bool = described("whether the interval holds the truth")


@dataclass(frozen=True)
class JudgedArm:
    """What became of an arm."""

    case: str = described("name of the case")
    hidden: tuple[str, ...] = described("what was hidden, as MECHANISM@PLACE")
    named: tuple[str, ...] = described("what was named with a probability above 0.95")
    outcome: str = described(
        "right, right and more, in part, other physics, wrong joint, silent, empty, false, or failed"
    )
    gain: float = described("log evidence that the true effects alone gain; null where nothing is hidden")
    sizes: tuple[JudgedSize, ...] = described("sizes of what was named rightly")


@dataclass(frozen=True)
class ArmsTarget:
    """A share that should be reached, and what was reached."""

    what: str = described("what is counted")
    at_least: float = described("the smallest share that meets the target")
    at_most: float = described("the largest one")
    rate: Rate = described("what was reached", flat=True)

    @property
    def state(self) -> str:
        """Whether it is met; "open" where the band of the rate does not decide."""
        if not self.rate.of:
            return "not tried"
        if self.at_least <= self.rate.share <= self.at_most:
            return "met"
        return "open" if self.rate.low <= self.at_most and self.rate.high >= self.at_least else "missed"


def judge_outcome(hidden: Sequence[str], named: Sequence[str]) -> str:
    """Return the outcome of an arm from what is hidden and what was named, as MECHANISM@PLACE."""
    pairs, truth = set(named), set(hidden)
    if not truth:
        return FALSE if pairs else EMPTY
    if not pairs:
        return SILENT
    if pairs >= truth:
        return RIGHT if pairs == truth else MORE
    joints = {_find_joint(key) for key in truth}
    if any(_find_joint(key) not in joints for key in pairs):
        return WRONG
    return PART if pairs < truth else OTHER


def _find_joint(key: str) -> str:
    return key.partition("@")[2].partition(".")[0]


def list_named(found: RobotDiagnosis) -> tuple[str, ...]:
    """Return what a diagnosis names, as MECHANISM@PLACE."""
    return tuple(f"{m.mechanism}@{m.at}" for m in found.found if m.probability > SURE)


def judge_sizes(truths: Sequence[Truth], found: RobotDiagnosis) -> Iterator[JudgedSize]:
    """Yield the sizes of effects that were named rightly."""
    named = {(m.mechanism, m.at): m.parameters for m in found.found if m.probability > SURE}
    for truth in truths:
        told = named.get((truth.mechanism, truth.at), {})
        for name, value in truth.values.items():
            if name in told:
                x = told[name]
                key = f"{truth.mechanism}@{truth.at}.{name}"
                yield JudgedSize(key, value, x.low, x.median, x.high, x.low <= value <= x.high)


def count_targets(rows: Sequence[JudgedArm], *, wrong: bool) -> tuple[ArmsTarget, ...]:
    """Return what all arms say together; targets are lower where the inertias of the model are `wrong`."""
    hiding = [row for row in rows if row.hidden]
    clear = [row for row in hiding if row.gain > CLEAR]
    empty = [row for row in rows if not row.hidden]
    sizes = [size for row in hiding for size in row.sizes]

    def count(kept: Sequence[JudgedArm], *outcomes: str) -> Rate:
        return estimate_rate(sum(row.outcome in outcomes for row in kept), len(kept))

    named, elsewhere = f"joint and physics right, of the effects that gain more than {CLEAR:g}", 0.05 if wrong else 0.02
    return (
        ArmsTarget(named, 0.75 if wrong else 0.85, 1.0, count(clear, RIGHT, MORE)),
        ArmsTarget("a name at a wrong joint and none that is right", 0.0, elsewhere, count(hiding, WRONG)),
        ArmsTarget("the right name with a false one beside it", 0.0, 0.05, count(hiding, MORE)),
        ArmsTarget("empty arms with a name", 0.0, 0.025, count(empty, FALSE)),
        ArmsTarget("95 % intervals of named sizes that hold the truth", 0.88, 0.99,
                   estimate_rate(sum(size.inside for size in sizes), len(sizes))),
        ArmsTarget("logs that could not be diagnosed", 0.0, 0.0, count(rows, FAILED)),
    )  # fmt: skip


def count_mechanisms(rows: Sequence[JudgedArm]) -> Mapping[str, Mapping[str, int]]:
    """Return how many arms had each outcome, by what was hidden."""
    found: dict[str, dict[str, int]] = {}
    for row in rows:
        key = " + ".join(sorted(one.partition("@")[0] for one in row.hidden)) or "nothing"
        own = found.setdefault(key, {})
        own[row.outcome] = own.get(row.outcome, 0) + 1
    return dict(sorted(found.items()))
