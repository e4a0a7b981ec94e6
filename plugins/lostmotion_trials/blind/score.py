"""What the cases of a blind trial say together: rates with their bands, coverage, confusions, targets."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.stats import beta, chi2, ncx2

from lostmotion_trials.blind.bound import alike
from lostmotion_trials.blind.commitment import PLAIN
from lostmotion_trials.blind.judging import FLAWS, HIT, MISNAMED, OUTCOMES, VAGUE
from lostmotion_trials.blind.results import (
    AlarmCount,
    ConfusionCount,
    CoverageRow,
    DiagnosedCase,
    FalseAlarm,
    HeldOutCounts,
    HeldOutJudged,
    JudgedCase,
    JudgedEffect,
    JudgedParameter,
    LikelihoodLimit,
    LostCase,
    MechanismCounts,
    Miss,
    Outcomes,
    ProofSummary,
    Rate,
    ReliabilityBin,
    SizeBin,
    SureCount,
    Target,
)
from lostmotion_trials.blind.sentences import says_of

GAINS = (0.0, 5.0, 15.0, 50.0, 150.0, 500.0, math.inf)
"""Edges of the bins of effect size, in log-likelihood that the true terms gain."""
ALARMS = 0.02
"""False alarms that a clean recording may raise."""
STATED = (0.0, 0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 0.99, 1.0)
COVERED = (0.90, 0.98)
CLOSE, WITHIN = 1.05, 0.9
"""The found model may err on held-out data by so much more than the true one, in this share of cases at the least."""
LEVEL = 0.95
NEAR = 3.0
"""What was named in error cannot be told from the truth if that is better by less than this in log-likelihood."""
ENOUGH = 20
"""With fewer tries a target is not said to be met."""


class HiddenEffect(NamedTuple):
    """A hidden effect, and the case that hides it."""

    effect: JudgedEffect
    of: JudgedCase


def summary(rows: Sequence[JudgedCase], failed: Sequence[DiagnosedCase]) -> ProofSummary:
    """Return what a blind trial found, from what became of each case."""
    lost = {row.case for row in failed}
    effects = [HiddenEffect(effect, row) for row in rows for effect in row.answer.effects]
    clean = [row for row in rows if not row.answer.effects and row.case not in lost]
    found = ProofSummary(
        cases=len(rows),
        clean=len(clean),
        effects=len(effects),
        detection=tuple(_bin(effects, low, high) for low, high in pairwise(GAINS)),
        sizes=tuple((e.gain, float(e.outcome == HIT)) for e, _ in effects if not math.isnan(e.gain)),
        limit=_limit(rows),
        mechanisms=tuple(_mechanisms(effects)),
        confusion=tuple(_confusion(rows)),
        reliability=tuple(_reliability([pair for row in rows for pair in row.answer.stated])),
        coverage=tuple(_coverage([one for row in rows if row.variant == PLAIN for one in row.answer.parameters])),
        heldout=_heldout([row.heldout for row in rows if row.heldout and row.answer.effects]),
        alarms=tuple(_alarms(clean)),
        sure=tuple(_sure([row for row in rows if row.sure is not None])),
        misses=tuple(_miss(effect, of) for effect, of in effects if effect.outcome != HIT),
        false_alarms=tuple(_alarm(row) for row in rows if row.answer.false),
        failed=tuple(LostCase(row.case, row.says) for row in failed),
        unmeasured=tuple(LostCase(row.case, row.bound_status) for row in rows if row.bound_status is not None),
    )
    aimed = replace(found, targets=tuple(_targets(found, effects)))
    return replace(aimed, says=tuple(says_of(aimed)))


def rate(hits: int, of: int) -> Rate:
    """Return a share with its exact 95 % band (Clopper, Pearson 1934); no share of nothing."""
    if not of:
        return Rate(0, 0, math.nan, math.nan, math.nan)
    tail = 0.5 * (1.0 - LEVEL)
    low = float(beta.ppf(tail, hits, of - hits + 1)) if hits else 0.0
    high = float(beta.ppf(1.0 - tail, hits + 1, of - hits)) if hits < of else 1.0
    return Rate(hits, of, hits / of, low, high)


def _bin(effects: Sequence[HiddenEffect], low: float, high: float) -> SizeBin:
    """Return what became of the effects with gains from `low` to below `high`."""
    return SizeBin(low, high, _counts([e for e in effects if low <= e.effect.gain < high]))


def _counts(effects: Sequence[HiddenEffect]) -> Outcomes:
    found = Counter(e.outcome for e, _ in effects)
    close = sum(e.outcome == MISNAMED and of.margin < NEAR for e, of in effects)
    return Outcomes(rate(found[HIT], len(effects)), {name: found[name] for name in OUTCOMES}, close)


def _limit(rows: Sequence[JudgedCase]) -> LikelihoodLimit:
    """Return the chance of the likelihood-ratio test, which knows what to look for, to notice an effect.

    At a gain of g twice the log of the ratio is a non-central chi-square of one degree of freedom about 2 g (Wilks).
    """
    candidates = int(np.median([len(row.answer.stated) for row in rows if row.answer.stated] or [1]))
    gain = np.geomspace(0.3, 2000.0, 81)
    told, many = (ncx2.sf(chi2.isf(share, 1), 1, 2.0 * gain) for share in (ALARMS, ALARMS / candidates))
    return LikelihoodLimit(tuple(gain.tolist()), tuple(told.tolist()), tuple(many.tolist()), candidates, ALARMS)


def _median(values: Sequence[float]) -> float:
    """Return the median, NaN of nothing."""
    return float(np.median(values)) if values else math.nan


def _mechanisms(effects: Sequence[HiddenEffect]) -> Iterator[MechanismCounts]:
    """Yield one row for each mechanism that was hidden."""
    for name in sorted({e.mechanism for e, _ in effects}):
        own = [e for e in effects if e.effect.mechanism == name]
        gains = [e.gain for e, _ in own if not math.isnan(e.gain)]
        status = Counter(e.status for e, _ in own).most_common(1)[0][0]
        yield MechanismCounts(name, _median(gains), status, _counts(own))


def _confusion(rows: Sequence[JudgedCase]) -> list[ConfusionCount]:
    """Return how often each answer was given to each truth; of several effects each counts."""
    pairs: Counter[tuple[str, str]] = Counter()
    for row in rows:
        for truth in [e.mechanism for e in row.answer.effects] or ["nothing"]:
            named, false = ({name.partition("@")[0] for name in own} for own in (row.answer.named, row.answer.false))
            like = {name for name in named if alike(name, truth)}
            other = named - set(FLAWS) if row.sure is not None else false
            pairs.update((truth, answer) for answer in (named & {truth} or like or other or {"nothing"}))
    return [ConfusionCount(t, a, n) for (t, a), n in sorted(pairs.items())]


def _reliability(stated: Sequence[tuple[float, float]]) -> Iterator[ReliabilityBin]:
    """Yield for each range of stated probability how often the mechanism was at work."""
    for low, high in pairwise(STATED):
        own = [(p, at) for p, at in stated if low <= p < high or p == high == 1.0]
        mean = float(np.mean([p for p, _ in own])) if own else math.nan
        yield ReliabilityBin(low, high, mean, rate(int(sum(at for _, at in own)), len(own)))


def _coverage(found: Sequence[JudgedParameter]) -> list[CoverageRow]:
    """Return how many truths the 95 % intervals hold, and how far medians are off: all together, then one by one."""
    names = sorted({one.name for one in found})
    return [_covered("all", found), *(_covered(n, [one for one in found if one.name == n]) for n in names)]


def _covered(name: str, found: Sequence[JudgedParameter]) -> CoverageRow:
    errors = [abs(one.relative_error) for one in found if not math.isnan(one.relative_error)]
    return CoverageRow(name, rate(sum(one.inside for one in found), len(found)), _median(errors))


def _heldout(found: Sequence[HeldOutJudged]) -> HeldOutCounts:
    """Return what was won on held-out data, over what the true model wins, and how near the errors come to its own."""
    shares = [one.share for one in found if not math.isnan(one.share)]
    ratios = [one.ratio for one in found]
    return HeldOutCounts(
        cases=len(found),
        median_share=_median(shares),
        shares=len(shares),
        median_ratio=_median(ratios),
        within=rate(sum(ratio <= CLOSE for ratio in ratios), len(ratios)),
        ratios=tuple(sorted(ratios)),
    )


def _alarms(clean: Sequence[JudgedCase]) -> list[AlarmCount]:
    """Return false alarms on clean cases: all together, then by the kind of measurement noise.

    In an imperfect world each machine lacks something and has noise of its own kind: an alarm is a false sure name.
    """
    rough = any(row.sure is not None for row in clean)
    kinds = [] if rough else sorted({row.variant for row in clean})
    groups = [("all", clean), *((kind, [row for row in clean if row.variant == kind]) for kind in kinds)]
    wrong = [(name, [row.answer.false if rough else row.answer.named for row in rows]) for name, rows in groups]
    return [AlarmCount(name, rate(sum(map(bool, names)), len(names))) for name, names in wrong]


def _sure(rows: Sequence[JudgedCase]) -> Iterator[SureCount]:
    """Yield for each kind of drive in an imperfect world how many of the sure names are there, and what was named.

    Without machines of such a world there are no rows.
    """
    kinds = sorted({str(row.kind) for row in rows})
    groups = [("all", rows), *((kind, [row for row in rows if row.kind == kind]) for kind in kinds)] if rows else []
    for kind, own in groups:
        names = [right for row in own for _, right in row.sure or ()]
        hiding = [row.answer.effects[0] for row in own if row.answer.effects]
        nameable = [effect for effect in hiding if effect.mechanism not in VAGUE]
        tried = [row.worse for row in own if row.worse is not None and not math.isnan(row.worse)]
        yield SureCount(
            kind=kind,
            machines=len(own),
            rate=rate(sum(names), len(names)),
            named=rate(sum(bool(effect.sure) for effect in nameable), len(nameable)),
            worse=rate(sum(rise > 0.0 for rise in tried), len(tried)),
        )


def _miss(effect: JudgedEffect, of: JudgedCase) -> Miss:
    return Miss(
        case=of.case,
        mechanism=effect.mechanism,
        what=effect.what,
        at=effect.at,
        gain=effect.gain,
        status=effect.status,
        outcome=effect.outcome,
        named=of.answer.named,
        margin=of.margin,
        folder=f"cases/{of.case}",
    )


def _alarm(row: JudgedCase) -> FalseAlarm:
    truth = tuple(e.mechanism for e in row.answer.effects)
    return FalseAlarm(row.case, f"cases/{row.case}", truth, row.answer.false)


def _targets(found: ProofSummary, effects: Sequence[HiddenEffect]) -> list[Target]:
    """Return what a diagnosis should reach, what it reached, and whether that is as it should be.

    In an imperfect world no model is true and no effect has a gain: what counts are the names that were sure.
    """
    if found.sure:
        return [_target(f"sure names that are there, {row.kind}", row.rate, LEVEL, 1.0) for row in found.sure]
    plain = next((row.rate for row in found.alarms if row.noise == PLAIN), rate(0, 0))
    near = "cases with a held-out error within 5 % of the true model's"
    return [
        _target("effects named, gain above 50", _named(effects, 50.0, math.inf), 0.95, 1.0),
        _target("effects named, gain 15 to 50", _named(effects, 15.0, 50.0), 0.80, 1.0),
        _target("truths in 95 % intervals", found.coverage[0].rate, *COVERED),
        _target("false alarms on clean cases, white noise", plain, 0.0, ALARMS),
        _target(near, found.heldout.within, WITHIN, 1.0),
    ]


def _named(effects: Iterable[HiddenEffect], low: float, high: float) -> Rate:
    own = [e for e, _ in effects if low < e.gain <= high]
    return rate(sum(e.outcome == HIT for e in own), len(own))


def _target(what: str, found: Rate, low: float, high: float) -> Target:
    """Return a target with what was reached: "met", "missed", or "open" where it may be chance."""
    if not found.of:
        state = "not tried"
    elif low <= found.share <= high:
        state = "met" if found.of >= ENOUGH else "open"
    else:
        state = "open" if found.low <= high and found.high >= low else "missed"
    return Target(what, low, high, state, found)
