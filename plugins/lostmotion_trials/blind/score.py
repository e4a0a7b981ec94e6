"""Summarises the cases of a blind trial: rates with their confidence intervals, coverage, confusions, targets."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.stats import chi2, ncx2

from lostmotion_trials.blind.bound import are_equivalent
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
    ReliabilityBin,
    SizeBin,
    SureCount,
    Target,
)
from lostmotion_trials.blind.sentences import write_sentences
from lostmotion_trials.rates import LEVEL, Rate, estimate_rate

GAIN_EDGES = (0.0, 5.0, 15.0, 50.0, 150.0, 500.0, math.inf)
"""Edges of the bins of effect size: gain in log-likelihood of the true terms."""
MOST_ALARMS = 0.02
"""Target: at most this share of clean recordings has a false alarm. Set by choice; no measurement recorded."""
STATED_EDGES = (0.0, 0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 0.99, 1.0)
"""Edges of the bins of the stated probability, narrow near 0 and 1."""
COVERAGE_LIMITS = (0.90, 0.98)
"""Target: the share of truths that the 95 % intervals contain lies between these. Set by choice; no measurement
recorded."""
CLOSE_RATIO, LEAST_CLOSE = 1.05, 0.9
"""Target: the held-out error of the found model is at most 1.05 times that of the true one in 90 % of the cases. Set by
choice; no measurement recorded."""
EQUAL_MARGIN = 3.0
"""A wrong model cannot be distinguished from the true one whose log-likelihood is higher by less than this: a
likelihood ratio of exp(3) = 20. Chosen by experience; no measurement recorded."""
LEAST_TRIES = 20
"""With fewer tries a target is not said to be met. Chosen by experience; no measurement recorded."""


class HiddenEffect(NamedTuple):
    """A hidden effect, and the case that hides it."""

    effect: JudgedEffect
    of: JudgedCase


def summarise(rows: Sequence[JudgedCase], failed: Sequence[DiagnosedCase]) -> ProofSummary:
    """Return the summary of a blind trial from the judged cases and the cases that failed."""
    lost = {row.case for row in failed}
    effects = [HiddenEffect(effect, row) for row in rows for effect in row.answer.effects]
    clean = [row for row in rows if not row.answer.effects and row.case not in lost]
    found = ProofSummary(
        cases=len(rows),
        clean=len(clean),
        effects=len(effects),
        detection=tuple(_count_bin(effects, low, high) for low, high in pairwise(GAIN_EDGES)),
        sizes=tuple((e.gain, float(e.outcome == HIT)) for e, _ in effects if not math.isnan(e.gain)),
        limit=_compute_limit(rows),
        mechanisms=tuple(_count_mechanisms(effects)),
        confusion=tuple(_count_confusion(rows)),
        reliability=tuple(_count_reliability([pair for row in rows for pair in row.answer.stated])),
        coverage=tuple(_count_coverage([one for row in rows if row.variant == PLAIN for one in row.answer.parameters])),
        heldout=_count_heldout([row.heldout for row in rows if row.heldout and row.answer.effects]),
        alarms=tuple(_count_alarms(clean)),
        sure=tuple(_count_sure([row for row in rows if row.sure is not None])),
        misses=tuple(_make_miss(effect, of) for effect, of in effects if effect.outcome != HIT),
        false_alarms=tuple(_make_alarm(row) for row in rows if row.answer.false),
        failed=tuple(LostCase(row.case, row.says) for row in failed),
        unmeasured=tuple(LostCase(row.case, row.bound_status) for row in rows if row.bound_status is not None),
    )
    aimed = replace(found, targets=tuple(_judge_targets(found, effects)))
    return replace(aimed, says=tuple(write_sentences(aimed)))


def _count_bin(effects: Sequence[HiddenEffect], low: float, high: float) -> SizeBin:
    """Return the outcomes of the effects with gains from `low` to below `high`."""
    return SizeBin(low, high, _count_outcomes([e for e in effects if low <= e.effect.gain < high]))


def _count_outcomes(effects: Sequence[HiddenEffect]) -> Outcomes:
    """Return the number of effects of each outcome, and of wrong names that are nearly as likely as the truth."""
    found = Counter(e.outcome for e, _ in effects)
    close = sum(e.outcome == MISNAMED and of.margin < EQUAL_MARGIN for e, of in effects)
    return Outcomes(estimate_rate(found[HIT], len(effects)), {name: found[name] for name in OUTCOMES}, close)


def _compute_limit(rows: Sequence[JudgedCase]) -> LikelihoodLimit:
    """Return the power of the likelihood-ratio test over the gain, for one known term and for one of many terms.

    At a gain of g, twice the log of the ratio has a non-central chi-square distribution with one degree of freedom and
    non-centrality 2 g (Wilks).
    """
    candidates = int(np.median([len(row.answer.stated) for row in rows if row.answer.stated] or [1]))
    gain = np.geomspace(0.3, 2000.0, 81)
    shares = (MOST_ALARMS, MOST_ALARMS / candidates)
    one, many = (tuple(ncx2.sf(chi2.isf(share, 1), 1, 2.0 * gain).tolist()) for share in shares)
    return LikelihoodLimit(tuple(gain.tolist()), one, many, candidates, MOST_ALARMS)


def _take_median(values: Sequence[float]) -> float:
    """Return the median, or NaN without values."""
    return float(np.median(values)) if values else math.nan


def _count_mechanisms(effects: Sequence[HiddenEffect]) -> Iterator[MechanismCounts]:
    """Yield the counts of each mechanism that was hidden."""
    for name in sorted({e.mechanism for e, _ in effects}):
        own = [e for e in effects if e.effect.mechanism == name]
        gains = [e.gain for e, _ in own if not math.isnan(e.gain)]
        status = Counter(e.status for e, _ in own).most_common(1)[0][0]
        yield MechanismCounts(name, _take_median(gains), status, _count_outcomes(own))


def _count_confusion(rows: Sequence[JudgedCase]) -> list[ConfusionCount]:
    """Return how often each answer was given for each truth; every effect of a case counts."""
    pairs: Counter[tuple[str, str]] = Counter()
    for row in rows:
        for truth in [e.mechanism for e in row.answer.effects] or ["nothing"]:
            named, false = ({name.partition("@")[0] for name in own} for own in (row.answer.named, row.answer.false))
            like = {name for name in named if are_equivalent(name, truth)}
            other = named - set(FLAWS) if row.sure is not None else false
            pairs.update((truth, answer) for answer in (named & {truth} or like or other or {"nothing"}))
    return [ConfusionCount(t, a, n) for (t, a), n in sorted(pairs.items())]


def _count_reliability(stated: Sequence[tuple[float, float]]) -> Iterator[ReliabilityBin]:
    """Yield for each range of the stated probability how often the mechanism was present."""
    for low, high in pairwise(STATED_EDGES):
        own = [(p, at) for p, at in stated if low <= p < high or p == high == 1.0]
        mean = float(np.mean([p for p, _ in own])) if own else math.nan
        yield ReliabilityBin(low, high, mean, estimate_rate(int(sum(at for _, at in own)), len(own)))


def _count_coverage(found: Sequence[JudgedParameter]) -> list[CoverageRow]:
    """Return the coverage of the 95 % intervals and the error of the medians: of all parameters, then of each."""
    names = sorted({one.name for one in found})
    return [_count_covered("all", found), *(_count_covered(n, [one for one in found if one.name == n]) for n in names)]


def _count_covered(name: str, found: Sequence[JudgedParameter]) -> CoverageRow:
    """Return the coverage of the 95 % intervals of some parameters and the median relative error of their medians."""
    errors = [abs(one.relative_error) for one in found if not math.isnan(one.relative_error)]
    return CoverageRow(name, estimate_rate(sum(one.inside for one in found), len(found)), _take_median(errors))


def _count_heldout(found: Sequence[HeldOutJudged]) -> HeldOutCounts:
    """Return the improvement on held-out data over that of the true model, and the ratio of the errors."""
    shares = [one.share for one in found if not math.isnan(one.share)]
    ratios = [one.ratio for one in found]
    return HeldOutCounts(
        cases=len(found),
        median_share=_take_median(shares),
        shares=len(shares),
        median_ratio=_take_median(ratios),
        within=estimate_rate(sum(ratio <= CLOSE_RATIO for ratio in ratios), len(ratios)),
        ratios=tuple(sorted(ratios)),
    )


def _count_alarms(clean: Sequence[JudgedCase]) -> list[AlarmCount]:
    """Return false alarms on clean cases: of all cases, then by the kind of measurement noise.

    In an imperfect world each machine has flaws and its own kind of noise: an alarm is a sure name that is false.
    """
    rough = any(row.sure is not None for row in clean)
    kinds = [] if rough else sorted({row.variant for row in clean})
    groups = [("all", clean), *((kind, [row for row in clean if row.variant == kind]) for kind in kinds)]
    wrong = [(name, [row.answer.false if rough else row.answer.named for row in rows]) for name, rows in groups]
    return [AlarmCount(name, estimate_rate(sum(map(bool, names)), len(names))) for name, names in wrong]


def _count_sure(rows: Sequence[JudgedCase]) -> Iterator[SureCount]:
    """Yield for each kind of drive in an imperfect world how many sure names are present and how many were named.

    There are no rows if the trial has no machines with flaws.
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
            rate=estimate_rate(sum(names), len(names)),
            named=estimate_rate(sum(bool(effect.sure) for effect in nameable), len(nameable)),
            worse=estimate_rate(sum(rise > 0.0 for rise in tried), len(tried)),
        )


def _make_miss(effect: JudgedEffect, of: JudgedCase) -> Miss:
    """Return the row of an effect that was not named."""
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


def _make_alarm(row: JudgedCase) -> FalseAlarm:
    """Return the row of a case with names that are not present."""
    truth = tuple(e.mechanism for e in row.answer.effects)
    return FalseAlarm(row.case, f"cases/{row.case}", truth, row.answer.false)


def _judge_targets(found: ProofSummary, effects: Sequence[HiddenEffect]) -> list[Target]:
    """Return the targets of a diagnosis, the rates that were reached, and whether each target is met.

    In an imperfect world no model is true and no effect has a gain: the targets concern the sure names only.
    """
    if found.sure:
        return [_judge_target(f"sure names that are there, {row.kind}", row.rate, LEVEL, 1.0) for row in found.sure]
    plain = next((row.rate for row in found.alarms if row.noise == PLAIN), estimate_rate(0, 0))
    near = "cases with a held-out error within 5 % of the true model's"
    return [
        _judge_target("effects named, gain above 50", _count_named(effects, 50.0, math.inf), 0.95, 1.0),
        _judge_target("effects named, gain 15 to 50", _count_named(effects, 15.0, 50.0), 0.80, 1.0),
        _judge_target("truths in 95 % intervals", found.coverage[0].rate, *COVERAGE_LIMITS),
        _judge_target("false alarms on clean cases, white noise", plain, 0.0, MOST_ALARMS),
        _judge_target(near, found.heldout.within, LEAST_CLOSE, 1.0),
    ]


def _count_named(effects: Iterable[HiddenEffect], low: float, high: float) -> Rate:
    """Return the rate of named effects among those with gains above `low` up to `high`."""
    own = [e for e, _ in effects if low < e.gain <= high]
    return estimate_rate(sum(e.outcome == HIT for e in own), len(own))


def _judge_target(what: str, found: Rate, low: float, high: float) -> Target:
    """Return a target with its state: "met", "missed", "not tried", or "open" if the rate does not decide."""
    if not found.of:
        state = "not tried"
    elif low <= found.share <= high:
        state = "met" if found.of >= LEAST_TRIES else "open"
    else:
        state = "open" if found.low <= high and found.high >= low else "missed"
    return Target(what, low, high, state, found)
