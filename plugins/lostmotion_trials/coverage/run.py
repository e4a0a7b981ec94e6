"""Calibration by simulation: whether the intervals of `identify` hold the truth as often as they say."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path

import numpy as np

from lostmotion.campaigns.campaign import Campaign, Say
from lostmotion.codec import to_plain
from lostmotion.contracts import Array
from lostmotion.provenance import provenance
from lostmotion.storage import folder_for, save_json, whole
from lostmotion_trials.coverage import ranks
from lostmotion_trials.coverage.design import Design, make_workshop
from lostmotion_trials.coverage.page import write_calibration
from lostmotion_trials.coverage.results import (
    FAILED,
    OK,
    UNCONVERGED,
    BarBand,
    CalibrationResult,
    CalibrationSummary,
    Coverage,
    CurveBand,
    HardMachine,
    LostMachine,
    MachineTrial,
    ParameterCheck,
    RankBands,
    Sought,
)
from lostmotion_trials.coverage.sentences import FEW_MACHINES, write_sentences
from lostmotion_trials.coverage.trials import make_maps, run_trial

TEST_LEVEL = 0.01
"""The level of the tests, for all drawn parameters together."""
SHARES = (50, 90, 95)
"""Intervals that are looked at, in per cent."""
MOST_LOST = 0.05
"""Largest share of machines without a posterior, about which a calibration says nothing. Chosen by experience; no
measurement recorded."""
HARDEST_LISTED = 8
"""The number of machines with the largest errors that are listed."""
COLUMNS = ("truth", "low", "median", "high", "sd", "rank", "z")


def run_calibration(
    design: Design, out: Path, *, machines: int, jobs: int, say: Say = lambda _done, _of: None, fresh: bool = False
) -> CalibrationResult:
    """Return the content of `calibration.json` after writing it, `machines.csv` and `report.html` into `out`.

    The trials are kept in `out`/trials, and a campaign that was killed goes on with those that are missing.
    """
    shop = make_workshop(design)
    if design.route == "quantifiers" and not design.maps:
        design = replace(design, maps=make_maps(shop, folder_for(out), jobs))
    origin = provenance("calibrate", _list_settings(design), design.seed, design.inputs)
    rows = Campaign(partial(run_trial, design), MachineTrial, machines, origin).run(out, jobs, say, fresh=fresh)
    content = CalibrationResult(
        schema="lostmotion.calibration/1",
        title=shop.case.title,
        model=" + ".join([shop.case.model, *sorted(design.terms)]),
        route=design.route,
        moved_by=shop.moved_by,
        hidden=shop.hidden,
        summary=summarise(rows),
        provenance={**origin, "settings": {**origin["settings"], "machines": machines}},
    )
    save_json(out / "calibration.json", to_plain(content))
    _save_csv(out / "machines.csv", rows)
    write_calibration(out)
    return content


def _list_settings(design: Design) -> dict[str, object]:
    given = asdict(design)
    return {**given.pop("bench"), **given.pop("plan"), **{k: v for k, v in given.items() if k not in ("case", "seed")}}


def summarise(rows: Sequence[MachineTrial]) -> CalibrationSummary:
    """Return what the trials say together: ranks, coverage, and whether all of it is as it should be."""
    good = [row for row in rows if row.status == OK]
    names = list(dict.fromkeys(name for row in good for name in row.parameters))
    found = {name: check_parameter([row.parameters[name] for row in good]) for name in names}
    wrong = [name for name, row in found.items() if row.drawn and not is_sound(row, _share_level(found))]
    made = CalibrationSummary(
        machines=len(rows),
        unconverged=_list_lost(rows, UNCONVERGED),
        failed=_list_lost(rows, FAILED),
        parameters=found,
        bands=_compute_bands(len(good)),
        hardest=_find_hardest(good),
        level=TEST_LEVEL,
        passes=bool(found) and len(rows) - len(good) <= MOST_LOST * len(rows) and not wrong,
        few=len(good) < FEW_MACHINES,
    )
    return replace(made, says=write_sentences(made, wrong))


def check_parameter(sought: Sequence[Sought]) -> ParameterCheck:
    """Return what is said of one parameter: tests of its ranks where it was drawn from a prior, and its coverage."""
    drawn, places = sought[0].drawn, [one.standing for one in sought if one.standing]
    found = np.array([one.rank for one in places], dtype=np.int64)
    z, below = np.array([one.z for one in places]), np.array([one.below for one in places])
    spread = np.array([one.sd / abs(one.median) for one in places if one.median])
    return ParameterCheck(
        unit=places[0].unit,
        drawn=drawn,
        chi2_p=ranks.compute_chi_square_p(found) if drawn else math.nan,
        ecdf_p=ranks.compute_ecdf_p(found) if drawn else math.nan,
        coverage={str(share): _count_coverage(below, share) for share in SHARES},
        mean_z=float(np.mean(z)),
        rms_z=float(np.sqrt(np.mean(z**2))),
        median_relative_sd=float(np.median(spread)) if spread.size else math.nan,
        histogram=tuple(ranks.count_ranks(found, ranks.choose_bin_count(len(found))).tolist()),
        ecdf=tuple(ranks.count_below(found).tolist()),
    )


def _count_coverage(below: Array, share: int) -> Coverage:
    """Return how many truths lie in the central interval of so many per cent, and the limits of that number."""
    tail = 0.5 * (1.0 - 0.01 * share)
    low, high = ranks.compute_coverage_limits(len(below), 0.01 * share)
    inside = int(np.sum((below >= tail) & (below <= 1.0 - tail)))
    return Coverage(inside, len(below), low, high)


def _list_lost(rows: Sequence[MachineTrial], status: str) -> tuple[LostMachine, ...]:
    return tuple(LostMachine(row.machine, row.says) for row in rows if row.status == status)


def _compute_bands(machines: int) -> RankBands:
    """Return what uniform ranks leave with a probability of 1 %: single bins of the histogram, and the whole ECDF."""
    if not machines:
        return RankBands()
    bins = ranks.choose_bin_count(machines)
    low, high = ranks.compute_histogram_band(machines, bins)
    band = ranks.compute_ecdf_band(machines)
    columns = (tuple(column.tolist()) for column in (band.at, band.middle, band.low, band.high))
    return RankBands(BarBand(bins, machines / bins, low, high), CurveBand(*columns))


def _find_hardest(good: Sequence[MachineTrial]) -> tuple[HardMachine, ...]:
    """Return the machines whose truth lies farthest out, in standard deviations of the posterior."""
    places = [
        HardMachine(row.machine, name, at.z, one.truth, at.median, at.sd, at.unit)
        for row in good
        for name, one in row.parameters.items()
        if one.drawn and (at := one.standing)
    ]
    return tuple(sorted(places, key=lambda one: -abs(one.z))[:HARDEST_LISTED])


def _share_level(found: Mapping[str, ParameterCheck]) -> float:
    """Return the level of each test, so that all together have that of one."""
    return TEST_LEVEL / max(1, sum(row.drawn for row in found.values()))


def is_sound(row: ParameterCheck, level: float) -> bool:
    """Return whether the ranks of one parameter stay in their band and its intervals cover within their limits.

    Of perfect campaigns with two parameters 4.6 % are refused (20,000 simulated), mostly for the limits of coverage.
    """
    covered = all(one.low <= one.inside <= one.high for one in row.coverage.values())
    return row.ecdf_p >= level and covered


def _save_csv(path: Path, rows: Sequence[MachineTrial]) -> None:
    """Write one line for each machine; what a machine does not have stays empty."""
    names = list(dict.fromkeys(name for row in rows for name in row.parameters))
    head = ["machine", "status", *(f"{name}.{column}" for name in names for column in COLUMNS)]
    with whole(path) as spare, spare.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(head)
        for row in rows:
            plain = to_plain(row.parameters)
            cells = [plain.get(name, {}).get(column, "") for name in names for column in COLUMNS]
            writer.writerow([row.machine, row.status, *cells])
