"""What identify and analyse write has a meaning for each key, and is read as it was written."""

from __future__ import annotations

import json
import math

import pytest

from lostmotion.codec import from_plain, schema, to_plain
from lostmotion.results import Interval
from lostmotion.results.background import Origin
from lostmotion.results.identification import (
    DriveLevel,
    ExpectedMotion,
    ExpectedRange,
    Identification,
    MeasuredRange,
    Parameter,
    Sampling,
)
from lostmotion_chaos.maps.layout import MapSettings
from lostmotion_chaos.results import Analysis

ORIGIN = Origin("identify", {"python": "3"}, {"terms": ["a"], "thresholds": {"select": {"decisive": 3.0}}}, 0, {})
SAMPLING = Sampling(
    walkers=16, steps=100, burn_in=10, acceptance=0.4, autocorrelation_time=2.0, lacks=("more steps are needed",)
)


def parameter(median=1.0, low=0.9, high=1.1, sd=0.05):
    """Return what is said of a parameter."""
    return Parameter(
        median=median, low=low, high=high, unit="m", sd=sd, at_maximum=1.0, ess=900.0, rhat=1.001, tau=1.5
    )  # fmt: skip


def identification(**told):
    """Return an identification by quantifiers, other than it was `told`."""
    usual = {
        "route": "quantifiers", "converged": True, "says": ("It has converged.",), "ess_min": 900.0,
        "ess_tail_min": 800.0, "rhat_max": 1.001, "parameters": {"x0": parameter()}, "sampling": SAMPLING,
        "log_likelihood_evaluations": 1000, "title": "It", "model": "lin_backlash", "notes": (), "provenance": ORIGIN,
    }  # fmt: skip
    return Identification(**{**usual, **told})


def level(motion):
    """Return a level at which an exponent was measured, and no dimension."""
    return DriveLevel(
        name="60 N", amplitude=60.0, unit="N", omega=40.0, motion=motion,
        lyapunov=MeasuredRange(value=7.0, low=6.0, high=8.0, unit="1/s"),
        predicted=ExpectedMotion(chaotic_share=0.9, d2=ExpectedRange(2.1, 2.3, 2.5)),
    )  # fmt: skip


@pytest.mark.parametrize("kind", [Identification, Analysis, MapSettings])
def test_each_key_has_a_meaning_and_stands_once(kind):
    rows = list(schema(kind))
    assert all(row.doc for row in rows)
    assert len({row.path for row in rows}) == len(rows)


@pytest.mark.parametrize("motion", ["chaotic", "periodic", None])
def test_an_identification_is_read_as_it_was_written(motion):
    made = identification(levels=(level(motion),), derived={"zeta": Interval(0.02, 0.01, 0.03, "1")})
    plain = json.loads(json.dumps(to_plain(made)))
    assert from_plain(Identification, plain) == made
    assert plain["levels"][0]["motion"] == motion
    assert "d2" not in plain["levels"][0]
    assert "modes" not in plain


def test_without_convergence_the_interval_is_null():
    nothing = math.nan
    made = identification(converged=False, parameters={"x0": parameter(nothing, nothing, nothing, nothing)})
    row = to_plain(made)["parameters"]["x0"]
    assert [row[key] for key in ("median", "low", "high", "sd")] == [None] * 4
    assert row["at_maximum"] == 1.0
    again = from_plain(Identification, to_plain(made)).parameters["x0"]
    assert math.isnan(again.median)
    assert math.isnan(again.interval.low)
