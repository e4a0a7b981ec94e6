"""A case in degrees is told in degrees: sentences, tables and figures; files stay in SI units."""

from __future__ import annotations

import math
import re

import pytest
import report_fixture as fixture

from lostmotion.diagnosis.gather_facts import find_angle_unit
from lostmotion.diagnosis.report.diagnosis_page import render
from lostmotion.recording.spec import Channel, RecordingSpec
from lostmotion.report.words import angles_in, choose_scale
from lostmotion.results import Interval

SI = {"position": "rad", "velocity": "rad/s", "force": "N m", "time": "s"}


def words_of(page):
    """Return the text of a page without its figures' shapes and its style."""
    return re.sub(r"<[^>]+>", " ", re.sub(r"<(style|script).*?</\1>", "", page, flags=re.DOTALL))


def test_angles_are_degrees_within_the_context():
    assert choose_scale(0.01, "rad") == (1e3, "mrad")
    with angles_in("deg"):
        assert choose_scale(0.01, "rad") == (180.0 / math.pi, "deg")
        assert choose_scale(0.01, "m") == (1e3, "mm")
        assert choose_scale(5.0, "N m/rad").unit == "N m/rad"
    assert choose_scale(1.0, "rad") == (1.0, "rad")


def test_an_interval_turns_into_degrees_and_others_stay():
    assert str(Interval(math.pi, 0.0, 2 * math.pi, "rad").with_angles_in("deg")) == "180.0 deg [0.0, 360.0]"
    assert Interval(1.0, 0.0, 2.0, "rad").with_angles_in("rad").unit == "rad"
    assert Interval(1.0, 0.0, 2.0, "N m").with_angles_in("deg").unit == "N m"


def test_a_page_of_a_case_in_degrees_shows_no_angle_in_rad():
    facts = fixture.mismatch()
    facts["units"] = {"position": "rad", "velocity": "rad/s", "force": "N m", "time": "s", "angle": "deg"}
    facts["parameters"]["after"]["x0"] = fixture.band(5e-3, 1e-5, "rad")
    shown, plain = (words_of(render(fixture.evidence(one))) for one in (facts, {**facts, "units": SI}))
    assert "0.2865 [" in shown
    assert " deg " in shown
    assert not re.search(r"(?<!/)\bm?rad\b", shown)
    assert re.search(r"(?<!/)\bm?rad\b", plain)


@pytest.mark.parametrize(("unit", "told"), [("deg", "deg"), ("degrees", "deg"), ("rad", "rad"), ("m", "rad")])
def test_a_case_with_a_column_in_degrees_is_one_in_degrees(unit, told):
    seen = RecordingSpec("run.csv", "t", None, (), (Channel("angle", "position", unit),))
    assert find_angle_unit((seen,)) == told
