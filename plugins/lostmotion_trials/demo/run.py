"""The demo: friction is hidden in a simulated robot joint, the case is diagnosed, and the result is judged."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.diagnosis.report.hero import save_hero
from lostmotion.registry import Registry
from lostmotion.results import percent
from lostmotion.results.diagnosis import Diagnosis, Mechanism
from lostmotion_trials.demo.conceal import AMPLITUDE, FREQUENCY, FRICTION, HIDDEN, conceal_joint, write_case

PERIODS = 40
QUICK = 20
"""Recorded periods of the base motion: 26 s, and 13 s with `--quick`."""


@dataclass(frozen=True)
class DemoSetting:
    """Options of the demo; `clean` hides nothing, `quick` makes the recording half as long."""

    seed: int = 0
    clean: bool = False
    quick: bool = False
    jobs: int = 2


@dataclass(frozen=True)
class DemoResult:
    """The result of the demo: lines to print, and whether the diagnosis was right."""

    lines: tuple[str, ...]
    right: bool


def run_demo(
    out: Path, registry: Registry, setting: DemoSetting, *, say: Callable[[str], None] = lambda _: None
) -> DemoResult:
    """Return what was hidden, what was found and whether that is right.

    The case is written into `out`/case, the results into `out`, and `out`/hero.png is the picture of the README.
    """
    say("conceal")
    rng = np.random.default_rng(setting.seed)
    periods = QUICK if setting.quick else PERIODS
    concealed = conceal_joint(rng, periods=periods, friction=0.0 if setting.clean else FRICTION)
    case = write_case(concealed, out / "case")
    diagnosis = run_diagnosis(case, out, registry, seed=setting.seed, jobs=setting.jobs, say=say)
    save_hero(out)
    found = _describe_clean(diagnosis) if setting.clean else _describe_hidden(diagnosis)
    lines = (_describe_recording(concealed.time), *found, _describe_improvement(diagnosis))
    return DemoResult(lines, judge(diagnosis, clean=setting.clean))


def judge(diagnosis: Diagnosis, *, clean: bool) -> bool:
    """Return whether a diagnosis names what was hidden, and nothing else; its interval is shown but not judged.

    A 95 % interval misses the truth in one of twenty cases.
    """
    keys = {_format_key(entry) for entry in diagnosis.found}
    return keys == (set() if clean else {HIDDEN.partition(".")[0]})


def _format_key(entry: Mechanism) -> str:
    return entry.mechanism if entry.at in ("", "ground") else f"{entry.mechanism}@{entry.at}"


def _describe_recording(time: Array) -> str:
    motion = f"moved by {AMPLITUDE:g} deg at {FREQUENCY:g} Hz"
    return f"recorded   {time[-1] - time[0]:.0f} s of a robot link that rattles in its backlash, {motion}"


def _describe_clean(diagnosis: Diagnosis) -> tuple[str, str]:
    found = ", ".join(map(_format_key, diagnosis.found)) or "nothing, as it should be"
    return "hidden     nothing", f"found      {found}"


def _describe_hidden(diagnosis: Diagnosis) -> tuple[str, ...]:
    """Return lines about what was hidden, and what was found, with its interval and whether that holds the truth."""
    key, _, name = HIDDEN.partition(".")
    told = f"hidden     {key}, {FRICTION:g} N m: the model of the case does not contain it"
    found = [line for entry in diagnosis.found for line in _describe_entry(entry, key, name)]
    return told, *(found or ["found      nothing: this should not happen"])


def _describe_entry(entry: Mechanism, key: str, name: str) -> list[str]:
    """Return the lines about one entry; the true value follows the parameter that was hidden."""
    mine, lines = _format_key(entry), []
    for own, q in entry.parameters.items():
        value = f"{q.median:.4g} {q.unit} [{q.low:.4g}, {q.high:.4g}]"
        lines.append(f"found      {mine}, {own} {value}, probability {entry.probability:.3f}")
        if (mine, own) == (key, name):
            lines.append(
                f"truth      {FRICTION:g} {q.unit} lies {'in' if FRICTION in q else 'outside'} the 95 % interval"
            )
    return lines


def _describe_improvement(diagnosis: Diagnosis) -> str:
    fit = diagnosis.fit
    before, after = fit.before.nrmse, fit.after.nrmse
    over = f"{fit.after.horizon:g} {fit.horizon_unit}"
    floor = f"noise {percent(fit.noise_floor_nrmse)}"
    if not diagnosis.found:
        return f"held out   error {percent(after)} of the response over {over} ({floor})"
    ratio = f", {before / after:.0f} times less" if after > 0 and math.isfinite(before) and before > 2 * after else ""
    return (
        f"held out   error falls from {percent(before)} to {percent(after)} of the response over"
        f" {over}{ratio} ({floor})"
    )
