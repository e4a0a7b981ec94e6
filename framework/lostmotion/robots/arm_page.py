"""The page of a diagnosis of a robot: sections, their figures and their tables."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from lostmotion.codec import to_plain
from lostmotion.report import style
from lostmotion.report.pages import Grid, PageSection, draw_sections, load_template, write_page
from lostmotion.report.words import percent, probability, split_headline, to_words, typeset
from lostmotion.results.robots import RobotDiagnosis
from lostmotion.storage import load_arrays, load_result

if TYPE_CHECKING:
    import xarray as xr

HINT = "run lostmotion diagnose again"
SHOWN = 12
SECONDS = 2.0
"""The length of the held-out data that are drawn (s)."""


RANKED = (
    "The probability of a mechanism is the sum over the sets that contain it. A law that contains a simpler one, and"
    " explains hardly more than it, counts as the simpler one there."
)
"""How the probabilities of sets and those of the answer belong together."""


@dataclass(frozen=True, eq=False)
class RobotEvidence:
    """The result and the arrays of a page."""

    result: RobotDiagnosis
    arrays: xr.Dataset


def write_robot_report(folder: Path) -> Path:
    """Return the path of `report.html`, written from `diagnosis.json` and `arrays.nc` in the folder."""
    result = load_result(RobotDiagnosis, folder / "diagnosis.json", "a diagnosis of a robot")
    evidence = RobotEvidence(result, load_arrays(folder / "arrays.nc", "a diagnosis of a robot"))
    return write_page(folder / "report.html", lambda: render(evidence), HINT)


def render(evidence: RobotEvidence) -> str:
    """Return the page as one self-contained HTML text."""
    result = evidence.result
    with style.use_style("rad"):
        sections = list(draw_sections(SECTIONS, evidence))
    words = "Nothing is missing" if result.verdict == "adequate" else "Something is missing"
    return load_template("page.html.j2", "lostmotion.robots").render(
        title=typeset(result.title),
        kind=result.verdict if not _is_unknown(result) else "unknown",
        words=words,
        answer=split_headline(result.says),
        model=result.model,
        sections=sections,
        notes=result.notes,
        confused=[one.says for one in result.confused_with],
        provenance=json.dumps(to_plain(result.provenance), indent=2),
    )


def _is_unknown(result: RobotDiagnosis) -> bool:
    return any(m.mechanism == "unknown" for m in result.found)


def make_joint_table(evidence: RobotEvidence) -> Grid:
    """Return the table of the joints."""
    rows = [
        [
            row.joint,
            ", ".join(to_words(name) for name in row.found) or "nothing",
            f"{row.torque:.3g} {row.unit}",
            f"{row.random_before:.3g}",
            f"{row.random_after:.3g}",
            percent(row.nrmse_before),
            percent(row.nrmse_after),
            f"{row.white_before:.2f}",
            f"{row.white_after:.2f}",
        ]
        for row in evidence.result.joints
    ]
    head = [
        "joint", "missing there", "torque (sd)", "random torque before", "after", "error of free runs before", "after",
        "variance of one-step errors (1 is expected) before", "after",
    ]  # fmt: skip
    return Grid(head, rows)


def make_found_table(evidence: RobotEvidence) -> Grid:
    """Return the table of what was found."""
    rows = []
    for m in evidence.result.found:
        numbers = "; ".join(f"{to_words(name)} {value}" for name, value in m.parameters.items())
        rows.append([to_words(m.mechanism), m.at, probability(m.probability), numbers])
    return Grid(["mechanism", "place", "probability", "parameters"], rows)


def make_check_table(evidence: RobotEvidence) -> Grid:
    """Return the table of what was looked at before any fit."""
    rows = [[c.name, c.joint, "yes" if c.passed else "no", c.says] for c in evidence.result.checks]
    return Grid(["check", "joint", "passed", "what was found"], rows)


def make_ranking_table(evidence: RobotEvidence) -> Grid:
    """Return the table of the sets that were fitted."""
    rows = [
        [to_words(one.mechanism), one.at, f"{one.log_evidence_gain:.1f}", probability(one.probability)]
        for one in evidence.result.ranking[:SHOWN]
    ]
    return Grid(["set of mechanisms", "places", "gain in log evidence", "probability"], rows)


def draw_missing(evidence: RobotEvidence) -> Figure:
    """Return the missing torque of each joint over its position and its velocity."""
    arrays = evidence.arrays
    joints = [row.joint for row in evidence.result.joints]
    units = [row.unit for row in evidence.result.joints]
    figure = style.make_figure(0.3 + 1.5 * len(joints))
    axes = figure.subplots(len(joints), 2, squeeze=False)
    for j, joint in enumerate(joints):
        y = arrays["missing_torque"].values[:, j]
        for k, (name, unit) in enumerate((("position", "rad"), ("velocity", "rad/s"))):
            unit = unit if units[j] == "N m" else unit.replace("rad", "m")
            axes[j, k].plot(arrays[name].values[:, j], y, ".", ms=2.5, color=f"C{k}", rasterized=True)
            axes[j, k].axhline(0.0, lw=0.6, color="0.5")
            axes[j, k].set_xlabel(f"{name} of {joint} ({unit})")
            style.few_ticks(axes[j, k])
        axes[j, 0].set_ylabel(f"{joint} ({units[j]})")
    return figure


def caption_missing(evidence: RobotEvidence) -> str:
    """Return the caption of the figure of the missing torque."""
    return (
        "Recorded torque less that of the model along the recorded motion, averaged over 0.05 s, for each joint: over"
        f" its position (left) and its velocity (right). {evidence.result.where.summary}"
    )


def draw_prediction(evidence: RobotEvidence) -> Figure:
    """Return errors of free runs over held-out data, before and after, for each position."""
    arrays = evidence.arrays
    names = [str(x) for x in arrays["reading"].values]
    kept = [i for i, name in enumerate(names) if name.endswith(".position")]
    time = arrays["time"].values
    part = time <= time[0] + SECONDS
    figure = style.make_figure(0.4 + 1.2 * len(kept))
    axes = figure.subplots(len(kept), 1, sharex=True, squeeze=False)[:, 0]
    for axis, i in zip(axes, kept, strict=True):
        z = arrays["recorded"].values[part, i]
        for name, colour in (("before", "C1"), ("after", "C0")):
            error = np.array(arrays[name].values[part, i] - z)
            axis.plot(time[part], 1e3 * error, color=colour, lw=1.0, label=name)
        axis.set_ylabel(f"{names[i].removesuffix('.position')} (1e-3)")
        style.few_ticks(axis)
    axes[-1].set_xlabel("time (s)")
    axes[0].legend(loc="upper right", ncols=2)
    return figure


def caption_prediction(evidence: RobotEvidence) -> str:
    """Return the caption of the figure of predictions."""
    fit = evidence.result.fit
    return (
        f"Errors of free runs under the recorded torques over data that no fit has seen, begun again every"
        f" {fit.before.horizon:g} s. Before, they are {percent(fit.before.nrmse)} of the motion, and after"
        f" {percent(fit.after.nrmse)}; the noise of the encoders alone is {percent(fit.noise_floor_nrmse)}."
    )


SECTIONS: tuple[PageSection[RobotEvidence], ...] = (
    PageSection("found", "What was found", table=make_found_table, look="told"),
    PageSection("joints", "Joint by joint", table=make_joint_table),
    PageSection("missing", "The torque that the model does not explain", draw_missing, caption_missing),
    PageSection("prediction", "Predictions of held-out data", draw_prediction, caption_prediction),
    PageSection("ranking", "Sets of mechanisms that were fitted", table=make_ranking_table, words=lambda _: RANKED),
    PageSection("checks", "Before any fit", table=make_check_table, look="told"),
)
