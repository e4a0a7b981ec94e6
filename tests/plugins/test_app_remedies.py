"""Warnings on the page, and the buttons that change the case: each removes its warning, and brings no other one."""

import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.case import dump_case
from lostmotion.errors import CaseError, DataError
from lostmotion.provenance import origin_of
from lostmotion.recording.formats import read_table
from lostmotion.recording.outline import GivenRoles
from lostmotion.recording.warnings import BACKWARD
from lostmotion.registry import default
from lostmotion.results import Interval
from lostmotion.results.diagnosis import Mechanism
from lostmotion.results.expectation import CaseCheck, Expectation, ParameterPair, WrongScale

pytest.importorskip("panel", reason="no page: Panel is absent (the extra `app`)")
sys.path.insert(0, str(Path(__file__).parent))

from lostmotion_app.case_content import list_channels
from lostmotion_app.desk import Desk
from lostmotion_app.folder import WorkFolder
from lostmotion_app.remedies import list_changed_lines, list_warnings
from lostmotion_app.result_warnings import list_check_warnings, list_result_warnings
from lostmotion_app.role_changes import list_role_changes
from lostmotion_app.used_parts import drop_stretch, list_used_parts
from lostmotion_app.warning_list import WarningList

HEAD = "time [s],force [N],position [m]"
RATE, ROWS = 200.0, 1400
NOTHING = GivenRoles()


def simulate():
    """Return time, force and position (rows, 3) of an oscillator, from its transfer function."""
    t, rng = np.arange(ROWS) / RATE, np.random.default_rng(0)
    x = np.zeros(ROWS)
    u = np.zeros(ROWS)
    for size, omega, phase in ((20.0, 37.0, 0.0), (15.0, 61.0, 1.0), (8.0, 83.0, 2.0)):
        wave = size * np.exp(1j * (omega * t + phase))
        u += wave.real
        x += (wave / (4000.0 + 8.0j * omega - omega**2)).real
    return np.stack([t, u, x + 2e-6 * rng.standard_normal(ROWS)], axis=1)


@pytest.fixture
def open_desk(tmp_path):
    """Return a function that writes a table and returns a desk with its recording."""

    def write(rows, head=HEAD, roles=NOTHING, name="run.csv"):
        np.savetxt(tmp_path / name, rows, delimiter=",", header=head, comments="", fmt="%.9g")
        desk = Desk(WorkFolder(tmp_path.resolve()), default(), recording=name)
        try:
            desk.draft(roles, {})
        except DataError:
            if not desk.content:  # else a stretch of the readings may be used
                raise
        return desk

    return write


def change_sign(rows):
    rows[:, 1] *= -1.0
    return rows


def stop_sensor(rows):
    rows[-200:, 2] = rows[-200, 2]
    return rows


def lose_drive(rows):
    rows[:30, 1] = np.nan
    return rows


def mark_lost(rows):
    rows[1390, 2] = -999.0
    return rows


def overflow(rows):
    rows[5, 2] = np.inf
    return rows


def list_notes(desk):
    return [one for one in list_warnings(desk) if not one.says.startswith("Supposed")]


SIGNS = ["force [N]: other sign", "position [m]: other sign"]
FAULTS = {
    "sign": (change_sign, "power flows from the machine", SIGNS),
    "stuck": (stop_sensor, "may have been stuck", ["Use it until 5.995 s"]),
    "lost drive": (lose_drive, "all are needed", ["Use it from 0.15 s"]),
    "marker": (mark_lost, "a glitch, or a marker", ["Use it until 6.945 s"]),
    "infinite": (overflow, "is infinite at sample 5", ["Use it from 0.03 s"]),
}


@pytest.mark.parametrize(("fault", "says", "offered"), FAULTS.values(), ids=FAULTS)
def test_each_remedy_removes_its_warning_and_brings_none(open_desk, fault, says, offered):
    desk = open_desk(fault(simulate()))
    (warned,) = list_notes(desk)
    assert says in warned.says
    assert [one.says for one in warned.remedies] == offered
    before = desk.case.read_text(encoding="utf-8")
    for remedy in warned.remedies:
        desk.change(remedy.content)
        assert list_changed_lines(before, desk.case.read_text(encoding="utf-8"))
        assert list_notes(desk) == []
        assert desk.read_case().recordings[0].warnings == ()
        desk.case.write_text(before, encoding="utf-8")


def test_a_warning_that_no_change_of_the_case_removes_has_no_button(open_desk):
    rows = simulate()
    rows[[300, 700, 1100], 2] = -999.0  # what is left between them is less than half
    notes = list_notes(open_desk(rows))
    assert any("a glitch, or a marker" in one.says for one in notes)
    assert [one for one in notes if one.remedies] == []


def test_a_sound_recording_has_no_warning(open_desk):
    assert list_notes(open_desk(simulate())) == []


def test_units_are_those_of_the_header_and_degrees_are_told_by_a_factor(open_desk):
    desk = open_desk(simulate(), HEAD.replace("[m]", "[mm]"), GivenRoles(units={"position [mm]": "m"}))
    (warned,) = list_notes(desk)
    assert [one.says for one in warned.remedies] == ["position [mm]: unit mm"]
    desk.change(warned.remedies[0].content)
    assert desk.content["recordings"][0]["sensors"][0]["unit"] == "mm"
    rows = simulate()
    rows[:, 2] *= 2000.0
    desk = open_desk(rows, "time [s],torque [N m],angle [rad]", name="turned.csv")
    (warned,) = list_notes(desk)
    assert "are these degrees?" in warned.says
    (remedy,) = warned.remedies
    desk.change(remedy.content)
    assert desk.content["recordings"][0]["sensors"][0]["factor"] == pytest.approx(np.pi / 180.0)
    assert list_notes(desk) == []


def test_priors_follow_the_columns_and_the_values_of_a_user_stay(open_desk):
    desk = open_desk(change_sign(simulate()))
    content = desk.content
    assert content["model"]["name"] == "rigid_drive"  # the sign hides the spring
    (warned,) = list_notes(desk)
    desk.change(warned.remedies[0].content)
    model = desk.content["model"]
    assert model["name"] == "linear_oscillator"
    assert model["estimate"]["k"]["low"] < 4000.0 < model["estimate"]["k"]["high"]
    content = desk.content
    content["model"]["known"] = {"m": 1.0}
    del content["model"]["estimate"]["m"]
    desk.save(content)
    roles = GivenRoles("time [s]", None, "force [N]", "position [m]", {"force [N]": "kN"})
    desk.draft(roles, {"force [N]": -1.0}, "linear_oscillator")
    model = desk.content["model"]
    assert model["known"] == {"m": 1.0}
    assert model["estimate"]["k"]["low"] > 4000.0


def test_a_supposition_is_confirmed_once_and_a_value_is_given(open_desk):
    rows = simulate()
    desk = open_desk(np.stack([rows[:, 0], 1e-4 * rows[:, 1], rows[:, 2]], axis=1), "time [s],base [m],position [m]")
    mass, model = list_warnings(desk)
    assert [(one.says, one.parameter) for one in mass.remedies] == [("Set", "m"), ("Confirm", "")]
    desk.change(mass.remedies[0].fill(2.5))
    assert desk.content["model"]["known"]["m"] == 2.5
    assert list_warnings(desk) == [replace(model, remedies=list_warnings(desk)[0].remedies)]
    desk.change(list_warnings(desk)[0].remedies[0].content)
    assert "guessed" not in desk.content
    desk.draft(NOTHING, {})
    assert list_warnings(desk) == []
    assert desk.content["model"]["known"]["m"] == 2.5


def lose_rows(rows):
    """Return a table without two stretches of 0.5 s and of 5 ms; between them are 1.5, 3 and 1.995 s."""
    return np.delete(rows, [*range(300, 400), 1000], axis=0)


CUT = [{"t_start": 2.0, "t_end": 4.995}, {"t_start": 5.005}, {"t_end": 1.495}]


def list_stretches(desk):
    return [{key: one[key] for key in ("t_start", "t_end") if key in one} for one in desk.content["recordings"]]


def test_a_recording_with_gaps_in_its_time_is_cut_there(open_desk):
    desk = open_desk(lose_rows(simulate()))
    assert list_stretches(desk) == CUT
    assert list_notes(desk) == []
    case = desk.read_case()
    assert [one.n for one in case.recordings] == [600, 399, 300]
    assert desk.list_further() == []
    parts = list_used_parts(desk.content, (0.0, 6.995), 0.3)
    assert [(one.start, one.end, one.held) for one in parts] == [
        (0.0, 1.495, 0.0), (2.0, 4.995, 4.995), (5.005, 6.995, 6.995)
    ]  # fmt: skip
    desk.draft(NOTHING, {}, "linear_oscillator")
    assert list_stretches(desk) == CUT
    table = read_table(desk.folder.find("run.csv"))
    desk.use_stretch(1.2, 4.0, table)
    assert list_stretches(desk) == [{"t_start": 2.0, "t_end": 4.0}]  # 0.3 s before the gap are not enough
    desk.use_stretch(None, None, table)
    assert list_stretches(desk) == CUT
    desk.use_stretch(2.0, 4.0, table)
    (one,) = list_used_parts(desk.content, (0.0, 6.995), 0.25)
    assert (one.start, one.end, one.held) == (2.0, 4.0, 3.5)


def test_gaps_in_the_case_of_a_user_have_a_remedy_and_a_shorter_one(open_desk):
    desk = open_desk(lose_rows(simulate()))
    content = desk.content
    content["recordings"] = [{**drop_stretch(content["recordings"][0]), "name": "monday"}]
    desk.save(content)
    (warned,) = list_notes(desk)
    assert "a gap of 0.505 s in time" in warned.says
    cut, longest = warned.remedies
    assert (cut.says, longest.says) == ("Cut it at its gaps into 3 recordings", "Use it from 2 s until 4.995 s")
    desk.change(cut.content)
    assert list_stretches(desk) == CUT
    assert [one.name for one in desk.read_case().recordings] == ["monday 1", "monday 2", "monday 3"]
    assert list_notes(desk) == []
    desk.save(longest.content)
    assert list_stretches(desk) == CUT[:1]
    assert list_notes(desk) == []


def test_a_fault_behind_a_gap_is_told_once_the_gap_is_cut(open_desk):
    desk = open_desk(change_sign(lose_rows(simulate())))
    (warned,) = list_notes(desk)
    assert "power flows from the machine" in warned.says
    assert [one.says for one in warned.remedies] == SIGNS


def test_what_drives_the_machine_is_asked(open_desk, tmp_path):
    with pytest.raises(CaseError) as told:
        open_desk(simulate(), "t,channel 1,position [m]")
    path = tmp_path / "run.csv"
    ways = list_role_changes(path, NOTHING, {}, str(told.value))
    assert [words for words, _ in ways] == ["channel 1 drives the machine", "Nothing drives the machine"]
    desk = Desk(WorkFolder(tmp_path.resolve()), default(), recording="run.csv")
    desk.draft(ways[0][1], {})
    assert desk.content["recordings"][0]["inputs"][0]["column"] == "channel 1"


def test_uneven_stamps_are_replaced_by_a_rate(open_desk, tmp_path):
    rows = simulate()
    rows[:, 0] = np.floor(rows[:, 0] * 40.0) / 40.0  # five rows have one stamp
    with pytest.raises(DataError) as told:
        open_desk(rows)
    ways = list_role_changes(tmp_path / "run.csv", NOTHING, {}, str(told.value))
    assert len(ways) == 1
    assert ways[0][1].rate == pytest.approx(RATE, rel=0.01)


def test_a_check_offers_the_factor_and_a_known_value(open_desk):
    desk = open_desk(simulate())
    content = desk.content
    pairs = tuple(ParameterPair(one="m", other=name, correlation=0.99) for name in ("k", "x"))
    told = {name: Interval(median, median, median, "1") for name, median in (("m", 1.0), ("c", 0.7))}
    result = CaseCheck(
        title="",
        says=(),
        model="",
        yardstick="the drive",
        expected=Expectation(parameters=told, pairs=pairs, effects=(), unseen=()),
        improvements=(),
        notes=(),
        provenance=origin_of("check", {}, 0, {}),
        scales=(WrongScale(column="force [N]", factor=1000.0, says="the unit with a factor of 1000", left=0.01),),
    )
    content["model"]["estimate"]["c"] = {"low": 0.7, "high": 70.0, "scale": "log"}
    scale, bound, pair = list_check_warnings(result, content)
    (wider,) = bound.remedies
    assert wider.content["model"]["estimate"]["c"] == {"low": pytest.approx(0.007), "high": 70.0, "scale": "log"}
    assert scale.remedies[0].content["recordings"][0]["inputs"][0]["factor"] == 1000.0
    assert [one.parameter for one in pair.remedies] == ["m", "k"]
    filled = pair.remedies[1].fill(4000.0)["model"]
    assert filled["known"] == {"k": 4000.0}
    assert "k" not in filled["estimate"]


def test_a_result_offers_the_factor_of_a_wrong_scale_and_of_a_gain_that_was_named(open_desk):
    desk = open_desk(simulate())
    scale = WrongScale(column="position [m]", factor=0.001, says="thousandths of the unit", left=0.01)

    def name(mechanism, at, error, state="named"):
        found = {"error": Interval(error, error, error, "1")}
        return Mechanism(mechanism=mechanism, at=at, probability=0.99, state=state, parameters=found, says="")

    def list_factors(**made):
        given = {"scales": (), "found": (), "says": (), "parameters": SimpleNamespace(after={}), **made}
        warned = list(list_result_warnings(SimpleNamespace(**given), desk))
        return [(one.says, [remedy.says for remedy in one.remedies]) for one in warned]

    assert list_factors() == []
    says = "the scale of position [m] does not fit the model: thousandths of the unit?"
    assert list_factors(scales=(scale,)) == [(says, ["Multiply position [m] by 0.001"])]
    high = "the values of position [m] are 20 % too large"
    assert list_factors(found=[name("sensor_gain", "position", 0.25)]) == [(high, ["Multiply position [m] by 0.8"])]
    low = "the values of force [N] are 25 % too small"
    assert list_factors(found=[name("excitation_gain", "drive", 0.25)]) == [(low, ["Multiply force [N] by 1.25"])]
    assert (
        list_factors(found=[name("sensor_gain", "position", 0.25, "likely"), name("coulomb_friction", "", 1.0)]) == []
    )
    low = desk.content["model"]["estimate"]["k"]["low"]
    ((says, offered),) = list_factors(parameters=SimpleNamespace(after={"k": Interval(low, low, low, "N/m")}))
    assert says == "the prior of k may be too narrow: the value is at its bound"
    assert len(offered) == 1
    desk = open_desk(change_sign(simulate()))
    ((says, offered),) = list_factors(says=(f"The sign of a column is wrong: {BACKWARD}.",))
    assert "power flows" in says
    assert offered == SIGNS


def test_a_button_shows_what_it_changed_and_undo_restores_it(open_desk):
    desk, told = open_desk(change_sign(simulate())), []
    shown = WarningList(desk, lambda: told.append(desk.content))
    shown.show(list_warnings(desk))
    before = desk.case.read_text(encoding="utf-8")
    buttons = {one.name: one for row in shown.rows[1:] for one in row if type(one).__name__ == "Button"}
    buttons["force [N]: other sign"].clicks += 1
    assert told[-1]["recordings"][0]["inputs"][0]["factor"] == -1.0
    assert "+inputs" in shown.told.object
    assert shown.undo.visible
    shown.undo.clicks += 1
    assert desk.case.read_text(encoding="utf-8") == before
    assert "-inputs" in shown.told.object


def test_the_case_of_a_user_is_not_changed_but_the_change_is_told(open_desk, tmp_path):
    desk = open_desk(change_sign(simulate()))
    content = desk.content
    content["recordings"][0]["file"] = "run.csv"
    dump_case(content, tmp_path / "mine.toml")
    given = Desk(WorkFolder(tmp_path.resolve()), default(), recording="mine.toml")
    shown = WarningList(given, lambda: None)
    shown.show(list_warnings(given))
    text = "".join(row.object for row in shown.rows)
    assert "In the case file: force [N]: other sign" in text
    assert "factor = -1.0" in text


def test_two_angles_in_different_units_but_of_one_size_are_told_apart_by_a_factor(open_desk):
    t, rng = np.arange(ROWS) / RATE, np.random.default_rng(0)
    rows = np.stack([t, np.sin(9.0 * t), 0.9 * np.sin(9.0 * t - 0.4) + 1e-3 * rng.standard_normal(ROWS)], axis=1)
    desk = open_desk(rows, "time [s],base [deg],angle [rad]")
    (warned,) = list_notes(desk)
    assert "are both in one unit?" in warned.says
    assert [one.says for one in warned.remedies] == ["base [deg]: numbers in rad", "angle [rad]: numbers in deg"]
    desk.change(warned.remedies[1].content)
    assert list_notes(desk) == []


def test_a_machine_that_nothing_drives_has_no_channel_of_a_drive():
    response = {"column": "x", "quantity": "position", "unit": "m"}
    content = {"recordings": [{"excitation": "none", "response": response}]}
    assert list_channels(content, "x") == [response]
