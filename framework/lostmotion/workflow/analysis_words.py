"""What an analysis says, as it stands in `analysis.json`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from lostmotion.results import Estimate
from lostmotion.stages.surrogates import SurrogateTest
from lostmotion.workflow.signs import Sign

if TYPE_CHECKING:
    from lostmotion.workflow.analyse import Analysis

SHARE = "share of the signal's standard deviation"


def statement(analysis: Analysis) -> dict[str, Any]:
    """Return the content of `analysis.json`, provenance left out."""
    clean, denoised, embedding = analysis.clean, analysis.denoised, analysis.clean.embedding
    how = embedding.methods
    return {
        "schema": "lostmotion.analysis/1",
        "title": analysis.source.title,
        "verdict": analysis.verdict.motion,
        "strength": analysis.verdict.strength,
        "says": analysis.verdict.says,
        "signs": [signed(sign) for sign in analysis.verdict.signs],
        "because": list(analysis.verdict.because),
        "delay": {"samples": embedding.lag, "seconds": embedding.lag * clean.dt, "method": how[0]},
        "dimension": {"value": embedding.dim, "method": how[1], "theiler": embedding.theiler},
        "noise": {
            "before": denoised.before.value,
            "after": denoised.after.value,
            "unit": SHARE,
            "before_interval": [denoised.before.low, denoised.before.high],
            "method": analysis.denoiser,
        },
        "lyapunov": entry(analysis.exponent, analysis.exponent_method),
        "d2": entry(analysis.dimension, "grassberger_procaccia"),
        "k2": entry(analysis.entropy, "grassberger_procaccia"),
        "others": [{"name": name, **entry(found, name)} for name, found in analysis.others.items()],
        "surrogates": [tested(test) for test in analysis.tests],
        "drive": _drive(analysis),
        "notes": list(notes(analysis)),
    }


def entry(found: Estimate, method: str) -> dict[str, Any]:
    """Return one number with its interval, method, status and the sentence where it is refused."""
    return {
        "value": found.value,
        "low": found.low,
        "high": found.high,
        "unit": found.unit,
        "method": method,
        "status": found.status,
        "says": found.says,
        "details": dict(found.details),
    }


def signed(sign: Sign) -> dict[str, Any]:
    """Return one sign of chaos: its state (for, against, silent), the sentence why, and its numbers."""
    return {
        "sign": sign.key,
        "name": sign.name,
        "state": sign.state,
        "says": sign.says,
        "excludes": sign.excludes,
        "figures": dict(sign.figures),
    }


def tested(test: SurrogateTest) -> dict[str, Any]:
    """Return one surrogate test."""
    return {
        "null": test.null,
        "method": test.method,
        "statistic": test.statistic,
        "draws": len(test.values),
        "p": test.p,
        "sided": test.sided,
        "original": test.original,
        "says": test.says,
    }


def _drive(analysis: Analysis) -> dict[str, Any]:
    beat = analysis.beat
    return {
        "period": beat.period,
        "samples_per_period": None if beat.period is None else beat.period / analysis.source.dt,
        "source": beat.source,
    }


def notes(analysis: Analysis) -> list[str]:
    """Return what a reader should doubt."""
    source, embedding = analysis.source, analysis.clean.embedding
    said = [*source.notes, *analysis.beat.notes, *analysis.aside]
    if embedding.status != "ok":
        said.append(embedding.says)
    for what, found in (("exponent", analysis.exponent), ("correlation dimension", analysis.dimension)):
        if found.status == "uncertain" or (found.ok and found.says):
            said.append(f"On the {what}: {found.says}")
    periods = math.nan if analysis.beat.period is None else len(source.x) * source.dt / analysis.beat.period
    if periods < 50:
        said.append(
            f"The recording holds {periods:.0f} periods: exponents and dimensions want some hundreds, so record longer."
        )
    return list(dict.fromkeys(said))
