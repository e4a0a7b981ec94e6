"""The demo: something is hidden in a simulated robot joint, the whole way is gone, and what was found is judged."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.report.hero import figure_hero
from lostmotion.diagnosis.run import run_diagnosis
from lostmotion.registry import Registry
from lostmotion.results import percent
from lostmotion.results.diagnosis import Diagnosis, Mechanism
from lostmotion_trials.demo.conceal import AMPLITUDE, FREQUENCY, FRICTION, HIDDEN, conceal_joint, write_case

PERIODS = 40
QUICK = 20
"""Recorded periods of the base motion: 26 s, and 13 s for a quick look."""


@dataclass(frozen=True)
class DemoSetting:
    """What is asked of the demo; `clean` hides nothing, `quick` records for half as long."""

    seed: int = 0
    clean: bool = False
    quick: bool = False
    jobs: int = 2


@dataclass(frozen=True)
class Judged:
    """What the demo has to show: sentences for people, and whether the diagnosis was right."""

    lines: tuple[str, ...]
    right: bool


def run_demo(
    out: Path, registry: Registry, setting: DemoSetting, *, say: Callable[[str], None] = lambda _: None
) -> Judged:
    """Return what was hidden, what was found and whether that is right.

    The case goes into `out`/case, the results into `out`, and `out`/hero.png is the picture of the README.
    """
    say("conceal")
    rng = np.random.default_rng(setting.seed)
    periods = QUICK if setting.quick else PERIODS
    concealed = conceal_joint(rng, periods=periods, friction=0.0 if setting.clean else FRICTION)
    case = write_case(concealed, out / "case")
    diagnosis = run_diagnosis(case, out, registry, seed=setting.seed, jobs=setting.jobs, say=say)
    figure_hero(out)
    found = _nothing_hidden(diagnosis) if setting.clean else _hidden(diagnosis)
    lines = (_recorded(concealed.time), *found, _improved(diagnosis))
    return Judged(lines, judge(diagnosis, clean=setting.clean))


def judge(diagnosis: Diagnosis, *, clean: bool) -> bool:
    """Return whether a diagnosis names what was hidden, and nothing else; its interval is shown but not judged.

    One interval in twenty misses the truth, as it should.
    """
    keys = {_key(entry) for entry in diagnosis.found}
    return keys == (set() if clean else {HIDDEN.partition(".")[0]})


def _key(entry: Mechanism) -> str:
    return entry.mechanism if entry.at in ("", "ground") else f"{entry.mechanism}@{entry.at}"


def _recorded(time: Array) -> str:
    motion = f"moved by {AMPLITUDE:g} deg at {FREQUENCY:g} Hz"
    return f"recorded   {time[-1] - time[0]:.0f} s of a robot link that rattles in its backlash, {motion}"


def _nothing_hidden(diagnosis: Diagnosis) -> tuple[str, str]:
    found = ", ".join(map(_key, diagnosis.found)) or "nothing, as it should be"
    return "hidden     nothing", f"found      {found}"


def _hidden(diagnosis: Diagnosis) -> tuple[str, ...]:
    """Return what was hidden, and what was found with its interval and whether that holds the truth."""
    key, _, name = HIDDEN.partition(".")
    told = f"hidden     {key}, {FRICTION:g} N m: the model that is fitted knows nothing of it"
    found = [line for entry in diagnosis.found for line in _entry_lines(entry, key, name)]
    return told, *(found or ["found      nothing: this should not happen"])


def _entry_lines(entry: Mechanism, key: str, name: str) -> list[str]:
    """Return one entry in words; the truth stands beside the parameter that was hidden."""
    mine, lines = _key(entry), []
    for own, q in entry.parameters.items():
        value = f"{q.median:.4g} {q.unit} [{q.low:.4g}, {q.high:.4g}]"
        lines.append(f"found      {mine}, {own} {value}, probability {entry.probability:.3f}")
        if (mine, own) == (key, name):
            lines.append(
                f"truth      {FRICTION:g} {q.unit} lies {'in' if FRICTION in q else 'outside'} the 95 % interval"
            )
    return lines


def _improved(diagnosis: Diagnosis) -> str:
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
