"""The demo: something is hidden in a simulated robot joint, the whole way is gone, and what was found is judged."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.codec import to_plain
from lostmotion.contracts import Array
from lostmotion.registry import Registry
from lostmotion.report import figure_hero
from lostmotion.workflow.diagnose import run_diagnosis
from lostmotion_trials.demo.conceal import AMPLITUDE, FREQUENCY, FRICTION, HIDDEN, conceal_joint, write_case

PERIODS = 40
QUICK = 20
"""Recorded periods of the base motion: 26 s, and 13 s for a quick look."""


@dataclass(frozen=True)
class Setting:
    """What is asked of the demo; `clean` hides nothing, `quick` records for half as long."""

    seed: int = 0
    clean: bool = False
    quick: bool = False
    jobs: int = 2


@dataclass(frozen=True)
class Judged:
    """What the demo has to show: sentences for people, the content of `diagnosis.json`, and whether it was right."""

    lines: tuple[str, ...]
    content: Mapping[str, Any]
    right: bool


def run_demo(out: Path, registry: Registry, setting: Setting, *, say: Callable[[str], None] = lambda _: None) -> Judged:
    """Return what was hidden, what was found and whether that is right.

    The case goes into `out`/case, the results into `out`, and `out`/hero.png is the picture of the README.
    """
    say("conceal")
    rng = np.random.default_rng(setting.seed)
    periods = QUICK if setting.quick else PERIODS
    concealed = conceal_joint(rng, periods=periods, friction=0.0 if setting.clean else FRICTION)
    case = write_case(concealed, out / "case")
    content = to_plain(run_diagnosis(case, out, registry, seed=setting.seed, jobs=setting.jobs, say=say))
    figure_hero(out)
    lines = (_recorded(concealed.time), *(_nothing_hidden(content) if setting.clean else _hidden(content)))
    return Judged((*lines, _improved(content)), content, judge(content, clean=setting.clean))


def judge(content: Mapping[str, Any], *, clean: bool) -> bool:
    """Return whether a diagnosis names what was hidden, and nothing else; its interval is shown but not judged.

    One interval in twenty misses the truth, as it should.
    """
    keys = {_key(entry) for entry in content["found"]}
    return keys == (set() if clean else {HIDDEN.partition(".")[0]})


def _key(entry: Mapping[str, Any]) -> str:
    return str(entry["mechanism"]) if entry.get("at", "ground") == "ground" else f"{entry['mechanism']}@{entry['at']}"


def _recorded(time: Array) -> str:
    motion = f"moved by {AMPLITUDE:g} deg at {FREQUENCY:g} Hz"
    return f"recorded   {time[-1] - time[0]:.0f} s of a robot link that rattles in its backlash, {motion}"


def _nothing_hidden(content: Mapping[str, Any]) -> tuple[str, str]:
    found = ", ".join(_key(entry) for entry in content["found"]) or "nothing, as it should be"
    return "hidden     nothing", f"found      {found}"


def _hidden(content: Mapping[str, Any]) -> tuple[str, ...]:
    """Return what was hidden, and what was found with its interval and whether that holds the truth."""
    key, _, name = HIDDEN.partition(".")
    told = f"hidden     {key}, {FRICTION:g} N m: the model that is fitted knows nothing of it"
    found = [line for entry in content["found"] for line in _told(entry, key, name)]
    return told, *(found or ["found      nothing: this should not happen"])


def _told(entry: Mapping[str, Any], key: str, name: str) -> list[str]:
    """Return one entry in words; the truth stands beside the parameter that was hidden."""
    mine, lines = _key(entry), []
    for own, q in entry["parameters"].items():
        unit = q["unit"]
        value = f"{q['median']:.4g} {unit} [{q['low']:.4g}, {q['high']:.4g}]"
        lines.append(f"found      {mine}, {own} {value}, probability {entry['probability']:.3f}")
        if (mine, own) == (key, name):
            within = q["low"] <= FRICTION <= q["high"]
            lines.append(f"truth      {FRICTION:g} {unit} lies {'in' if within else 'outside'} the 95 % interval")
    return lines


def _improved(content: Mapping[str, Any]) -> str:
    fit = content["fit"]
    before, after = (fit[when]["heldout_nrmse"] for when in ("before", "after"))
    over = f"{fit['after']['horizon']:g} {fit['horizon_unit']}"
    floor = f"noise {fit['noise_floor_nrmse']:.1%}"
    if not content["found"]:
        return f"held out   error {after:.1%} of the response over {over} ({floor})"
    ratio = f", {before / after:.0f} times less" if after > 0 and math.isfinite(before) and before > 2 * after else ""
    return f"held out   error falls from {before:.1%} to {after:.1%} of the response over {over}{ratio} ({floor})"
