"""What an unknown table looks like: time, units, roles; and the case that is made of it."""

import tomllib

import numpy as np
import pytest

from lostmotion.errors import CaseError, DataError
from lostmotion.preparation.beginning import scales_of, write_first_case
from lostmotion.recording.outline import GivenRoles, outline_table
from lostmotion.registry import Registry

N, RATE = 800, 200.0
T = np.arange(N) / RATE
M, C, K = 1.5, 2.0, 400.0


def recorded(seed=0):
    """Return force (N) and position (m) of an oscillator in its steady state: each tone by its own response."""
    rng = np.random.default_rng(seed)
    omega, turn = 2.0 * np.pi * np.arange(2, 30) / T[-1], rng.uniform(0.0, 2.0 * np.pi, 28)
    drive = 3.0 * np.exp(1j * (np.multiply.outer(T, omega) + turn))
    moved = drive / (K - M * omega**2 + 1j * C * omega)
    return drive.real.sum(axis=1), moved.real.sum(axis=1) + 1e-5 * rng.standard_normal(N)


def table(folder, head, *columns, name="run.csv"):
    rows = "\n".join(",".join(f"{v:.9g}" for v in row) for row in zip(*columns, strict=True))
    (folder / name).write_text(f"{head}\n{rows}\n", encoding="utf-8")
    return folder / name


def test_units_tell_what_columns_measure_and_names_where_there_are_none(tmp_path):
    force, x = recorded()
    path = table(tmp_path, "Time,Shaker,Laser,acc,strange\nms,N,mm,,", 1e3 * T, force, 1e3 * x, x, x)
    found = outline_table(path, GivenRoles())
    assert (found.time, found.time_unit, found.samples) == ("Time", "ms", N)
    assert found.dt == pytest.approx(1.0 / RATE)
    assert {c.name: (c.kind, c.sure) for c in found.columns} == {
        "Shaker": ("force", True),
        "Laser": ("position", True),
        "acc": ("acceleration", False),
        "strange": ("", False),
    }
    assert (found.drive.name, found.response.name, found.base_driven) == ("Shaker", "Laser", False)


def test_a_foot_drives_where_the_force_is_read_by_a_load_cell(tmp_path):
    force, x = recorded()
    found = outline_table(table(tmp_path, "t,Load cell [N],Table [deg],arm [deg]", T, force, x, 2.0 * x), GivenRoles())
    assert (found.drive.name, found.response.name, found.base_driven) == ("Table [deg]", "arm [deg]", True)
    assert found.response.turns


def test_wishes_come_first(tmp_path):
    force, x = recorded()
    path = table(tmp_path, "t,a,b", T, force, x)
    found = outline_table(path, GivenRoles(drive="a", response="b", units={"a": "kN", "b": "um"}))
    assert (found.drive.stated_unit, found.drive.kind, found.response.stated_unit) == ("kN", "force", "um")
    bare = outline_table(path, GivenRoles(rate=50.0, drive="none", response="b"))
    assert (bare.time, bare.dt, bare.drive) == (None, 0.02, None)


@pytest.mark.parametrize(
    ("head", "wishes", "says"),
    [
        ("a,b,c", GivenRoles(drive="d"), "has no column 'd'"),
        ("t,b,c", GivenRoles(time="nothing"), "has no column 'nothing'"),
        ("t,b,c", GivenRoles(units={"b": "V"}), "measures none of force, position"),
    ],
)
def test_what_cannot_be_told_is_refused_with_what_is_there(tmp_path, head, wishes, says):
    force, x = recorded()
    with pytest.raises(DataError, match=says):
        outline_table(table(tmp_path, head, T, force, x), wishes)


def test_a_table_without_time_asks_for_the_rate(tmp_path):
    force, x = recorded()
    with pytest.raises(DataError, match=r"--time COLUMN, or --rate HZ"):
        outline_table(table(tmp_path, "F,x", force, x), GivenRoles())


def test_the_line_through_the_spectra_finds_mass_damping_and_stiffness(tmp_path):
    force, x = recorded()
    found = outline_table(table(tmp_path, "t,F [N],x [mm]", T, force, 1e3 * x), GivenRoles())
    straight = scales_of(found, {}).straight
    assert straight["m"] == pytest.approx(M, rel=0.1)
    assert straight["k"] == pytest.approx(K, rel=0.1)
    assert straight["c"] == pytest.approx(C, rel=1.0)


@pytest.mark.parametrize("factor", [1.0, 0.25])
def test_the_case_can_be_read_and_its_priors_hold_the_truth(tmp_path, factor):
    force, x = recorded()
    table(tmp_path, "t,F,x", T, force / factor, x)
    draft = write_first_case(
        tmp_path / "run.csv",
        tmp_path / "case.toml",
        GivenRoles(units={"F": "N"}),
        Registry.discover(),
        "",
        {"F": factor},
    )
    case = tomllib.loads(draft.text)
    assert case["model"]["name"] == "linear_oscillator"
    for name, true in (("m", M), ("c", C), ("k", K)):
        prior = case["model"]["estimate"][name]
        assert prior["low"] < true < prior["high"]
    assert case["recordings"][0]["inputs"][0].get("factor") == factor
    assert "the file gives no unit: m and position are guesses" in draft.text


def test_without_a_force_the_inertia_has_to_be_known(tmp_path):
    _, x = recorded()
    table(tmp_path, "t,base [rad],q [rad]", T, x, 2.0 * x)
    draft = write_first_case(tmp_path / "run.csv", tmp_path / "case.toml", GivenRoles(), Registry.discover())
    case = tomllib.loads(draft.text)
    assert case["model"]["name"] == "robot_joint"
    assert case["model"]["known"] == {"m": 1.0, "mgl": 0.0}
    assert "only ratios to it can be determined" in draft.text


def test_a_model_without_the_channel_is_refused(tmp_path):
    force, x = recorded()
    table(tmp_path, "t,base [m],q [m]", T, force, x)
    with pytest.raises(CaseError, match="lin_backlash has no input 'base_position'"):
        write_first_case(
            tmp_path / "run.csv", tmp_path / "case.toml", GivenRoles(), Registry.discover(), "lin_backlash"
        )


def test_volts_keep_their_unit_in_a_remark(tmp_path):
    force, x = recorded()
    table(tmp_path, "t [s],drive [V],x [m]", T, force, x)
    draft = write_first_case(tmp_path / "run.csv", tmp_path / "case.toml", GivenRoles(), Registry.discover())
    assert "the unit in the file is V, which may need a factor: N and force are guesses" in draft.text
    assert any("drive [V] (V, taken for N)" in line for line in draft.found)


def test_a_short_drive_that_repeats_is_said_to_repeat(tmp_path):
    force = 5.0 * np.cos(2.0 * np.pi * 2.07 * T)
    path = table(tmp_path, "t,F,x\ns,N,mm", T, force, np.roll(force, 9))
    found = write_first_case(path, tmp_path / "case.toml", GivenRoles(), Registry.discover()).found
    assert "the drive repeats every 0.4831 s" in found


def test_a_column_without_a_unit_is_shown_with_what_it_is_taken_for(tmp_path):
    force, x = recorded()
    found = write_first_case(
        table(tmp_path, "t,F,qm", T, force, x), tmp_path / "case.toml", GivenRoles(), Registry.discover()
    ).found
    assert any("qm (no unit, taken for m): position" in line and "-> response" in line for line in found)
