"""Levels and priors of a case file."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from lostmotion.case import CaseFile, Measured, Prior, load_case
from lostmotion.errors import CaseError

LEVELS = """
[[levels]]
amplitude = 50.0
unit = "kN"
frequency = 10.0
name = "low"
motion = "periodic"

[[levels]]
amplitude = 90.0
unit = "deg"
omega = 3.5
lyapunov = { value = 2.0, sd = 0.5, unit = "bit/s" }
d2 = { value = 2.4, low = 2.2, high = 2.7 }

[[levels]]
amplitude = 90.0
unit = "deg"
omega = 4.5
lyapunov = { value = -1.0, sd = 0.5 }

[model]
name = "lin_backlash"
"""
WRONG_LEVELS = [
    ('unit = "kN"', "", ["levels[0]", "lacks 'unit'"]),
    ("amplitude = 50.0", "amplitude = -50.0", ["levels[0]", "'amplitude'", "positive"]),
    ('"kN"', '"kg"', ["levels[0]", "'kg'", "force", "base motion", "deg"]),
    ("frequency = 10.0", "frequenzy = 10.0", ["levels[0]", "did you mean 'frequency'"]),
    ("frequency = 10.0", "frequency = 10.0\nomega = 62.8", ["both frequency and omega"]),
    ("omega = 3.5", "", ["levels[1]", "neither frequency nor omega", "Hz"]),
    ('"periodic"', '"cyclic"', ["levels[0]", "motion = 'cyclic'", "periodic, chaotic"]),
    ('motion = "periodic"', "", ["levels[0]", "none of motion, lyapunov and d2"]),
    (', unit = "bit/s"', ', unit = "bits"', ["levels[1].lyapunov", "did you mean 'bit/s'"]),
    (", sd = 0.5, unit", ", unit", ["levels[1].lyapunov", "no error", "sd, or low and high"]),
    (", low = 2.2, high", ", high", ["levels[1].d2", "has high besides the value", "95 %"]),
    ("low = 2.2,", "low = 2.2, sd = 1.0,", ["levels[1].d2", "has sd, low, high besides the value"]),
    ("low = 2.2", "low = 2.5", ["levels[1].d2", "low = 2.5", "lie between them"]),
    ("value = 2.4", "value = -2.4", ["levels[1].d2", "not negative"]),
    ("value = 2.4", "valeu = 2.4", ["levels[1].d2", "did you mean 'value'"]),
    ("sd = 0.5 }", "sd = 0 }", ["levels[2].lyapunov", "'sd'", "positive"]),
    ("[[levels]]", "[[level]]", ["did you mean 'levels'"]),
]


def case(folder: Path, text: str) -> CaseFile:
    (folder / "case.toml").write_text(text)
    return load_case(folder / "case.toml")


@pytest.mark.parametrize(("old", "new", "words"), WRONG_LEVELS, ids=lambda v: str(v)[:30])
def test_refusals_of_levels_are_sentences(tmp_path: Path, old: str, new: str, words: list[str]) -> None:
    assert old in LEVELS
    changed = LEVELS.replace(old, new, 1 if old != "[[levels]]" else -1)
    with pytest.raises(CaseError) as caught:
        case(tmp_path, changed)
    message = str(caught.value)
    assert [w for w in ["case.toml", *words] if w not in message] == [], message
    assert "\n" not in message


def test_levels_are_read_in_si_units(tmp_path: Path) -> None:
    low, middle, high = case(tmp_path, LEVELS).levels
    assert (low.name, low.amplitude, low.unit, low.motion) == ("low", pytest.approx(5e4), "N", "periodic")
    assert low.omega == pytest.approx(62.8318531)
    assert (low.lyapunov, low.d2, middle.motion) == (None, None, None)
    assert (middle.name, high.name) == ("90 deg", "90 deg 2")
    assert (middle.amplitude, middle.unit, middle.omega) == (pytest.approx(math.pi / 2), "rad", 3.5)
    assert middle.lyapunov is not None
    assert (middle.lyapunov.value, middle.lyapunov.sd) == pytest.approx((1.38629436, 0.34657359))
    assert middle.d2 is not None
    assert (middle.d2.value, middle.d2.sd) == pytest.approx((2.4, 0.5 / 3.919928))
    assert high.lyapunov == Measured(-1.0, 0.5)


PRIORS = [
    Prior(0.8, 80.0, "log"),
    Prior(-1.0, 3.0),
    Prior(mean=2.0, sd=0.1),
    Prior(median=2.0, sd_log=0.5, each=True),
    Prior(half_sd=3.0),
]


@pytest.mark.parametrize("prior", PRIORS, ids=lambda p: p.kind)
def test_a_prior_is_a_density(prior: Prior) -> None:
    grid = np.linspace(prior.quantile(1e-7), prior.quantile(1.0 - 1e-7), 20001)
    density = np.exp([prior.log_density(v) for v in grid])
    assert np.trapezoid(density, grid) == pytest.approx(1.0, rel=1e-5)
    assert prior.log_density(math.nan) == -math.inf
    assert prior.log_density(math.inf) == -math.inf
    below = prior.support[0] - 1e-9
    assert prior.kind == "normal" or prior.log_density(below) == -math.inf


@pytest.mark.parametrize("prior", PRIORS, ids=lambda p: p.kind)
def test_the_quantile_of_a_prior_inverts_its_distribution(prior: Prior) -> None:
    for share in (0.01, 0.3, 0.5, 0.9):
        grid = np.linspace(prior.quantile(1e-9), prior.quantile(share), 20001)
        density = np.exp([prior.log_density(v) for v in grid])
        assert np.trapezoid(density, grid) == pytest.approx(share, abs=1e-5)
    assert (prior.quantile(0.0), prior.quantile(1.0)) == pytest.approx(prior.support)


def test_the_kinds_of_priors() -> None:
    assert [p.kind for p in PRIORS] == ["log-uniform", "uniform", "normal", "log-normal", "half-normal"]


def test_a_prior_starts_in_its_middle() -> None:
    assert Prior(0.5, 50.0, "log").start() == pytest.approx(5.0)
    assert Prior(-1.0, 3.0).start() == 1.0
    normal = Prior(mean=2.0, sd=0.1)
    assert (normal.start(), normal.low, normal.high) == (2.0, -math.inf, math.inf)
    assert Prior(0.0, 1.0).log_density(1.5) == -math.inf
    assert Prior(median=3.0, sd_log=2.0).start() == pytest.approx(3.0)
    assert Prior(half_sd=2.0).start() == pytest.approx(2.0 * 0.67448975)
