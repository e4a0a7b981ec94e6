"""`lostmotion simulate`: drives with their exact derivative, tables that are whole, and sentences for mistakes."""

import json

import numpy as np
import pytest
import xarray
from click.testing import CliRunner

import lostmotion
from lostmotion import storage
from lostmotion.cli import main
from lostmotion.contracts import Assembly
from lostmotion.errors import CaseError, ContractError, DataError
from lostmotion.registry import default
from lostmotion.simulation.drive_signals import KINDS, signal_of
from lostmotion.simulation.simulated_machine import Plan, assembly_of, simulate

LIN = ("lin_backlash", "--set", "m=1,c=8,k0=4e4", "--set", "x0=0.005", "--duration", "2", "--rate", "500")
DRIVE = ("--drive", "harmonic:amplitude=100,omega=40")
DRIVES = {
    "harmonic": "harmonic:amplitude=2,frequency=3,phase=0.4,harmonics=0.2/0.1",
    "sweep": "sweep:amplitude=2,start=1,stop=6",
    "multisine": "multisine:rms=2,low=1,high=5",
    "step": "step:size=2,at=0.4,rise=0.2",
    "noise": "noise:rms=2,bandwidth=5",
}


def run(*args):
    """Return the outcome of the command line."""
    return CliRunner().invoke(main, ["simulate", *args], prog_name="lostmotion")


def plan(model="linear_oscillator", terms=(), **settings):
    """Return the plan of a machine that is easily solved by hand."""
    assembly, values = assembly_of(default(), model, terms)
    values |= settings.pop("values", {"m": 2.0, "c": 3.0, "k": 50.0})
    return Plan(assembly, values, **{"drives": (DRIVES["harmonic"],), "duration": 2.0, "rate": 200.0, **settings})


@pytest.mark.parametrize("kind", KINDS)
def test_slope_is_the_derivative(kind):
    signal = signal_of(DRIVES[kind], duration=2.0, rng=np.random.default_rng(1))
    t, d = np.linspace(0.01, 1.9, 400), 1e-6
    slope = (signal.value(t + d) - signal.value(t - d)) / (2.0 * d)
    np.testing.assert_allclose(signal.slope(t), slope, atol=1e-6 * np.abs(slope).max())


@pytest.mark.parametrize("kind", ["multisine", "noise"])
def test_random_drives_have_their_size_and_their_seed(kind):
    t = np.linspace(0.0, 50.0, 20001)
    one, again, other = (
        signal_of(DRIVES[kind], duration=50.0, rng=np.random.default_rng(seed)).value(t) for seed in (1, 1, 2)
    )
    assert one.std() == pytest.approx(2.0, rel=0.15)
    np.testing.assert_array_equal(one, again)
    assert np.std(one - other) > 1.0


def test_drives_add_up():
    one, two = "harmonic:amplitude=2,omega=3", "step:size=1"
    both, first, second = (simulate(plan(drives=d)).columns["position"] for d in ((one, two), (one,), (two,)))
    np.testing.assert_allclose(both, first + second, atol=1e-12)


def test_steady_motion_of_a_linear_oscillator():
    omega = 4.0
    table = simulate(plan(drives=(f"harmonic:amplitude=5,omega={omega}",), duration=40.0))
    t, x = table.columns["time"], table.columns["position"]
    answer = 5.0 / (50.0 - 2.0 * omega**2 + 3.0j * omega)
    late = t > 30.0
    np.testing.assert_allclose(x[late], np.real(answer * np.exp(1j * omega * t[late])), atol=1e-8)


def test_channels_obey_the_equation_of_motion():
    table = simulate(plan(terms=["coulomb_friction:force=0.5"])).columns
    moving = np.abs(table["velocity"]) > 1e-2
    forces = table["force"] - 3.0 * table["velocity"] - 50.0 * table["position"] - 0.5 * np.sign(table["velocity"])
    np.testing.assert_allclose(2.0 * table["acceleration"][moving], forces[moving], atol=1e-12)


def test_base_moves_with_its_exact_velocity():
    values = {"m": 0.05, "c": 0.15, "k0": 180.0, "x0": 0.013}
    table = simulate(plan("robot_joint", drives=("harmonic:amplitude=0.05,omega=10",), values=values))
    t = table.columns["time"]
    np.testing.assert_allclose(table.columns["base_position"], 0.05 * np.cos(10.0 * t), atol=1e-15)
    np.testing.assert_allclose(table.columns["base_velocity"], -0.5 * np.sin(10.0 * t), atol=1e-15)
    seen = ["position", "velocity", "acceleration", "force"]
    assert list(table.columns) == ["time", "base_position", "base_velocity", *seen]
    np.testing.assert_allclose(table.columns["force"], 0.05 * table.columns["acceleration"], atol=1e-12)
    assert table.units["base_velocity"] == "rad/s"


def test_noise_is_a_share_of_each_channel_and_leaves_the_drive_alone():
    clean, noisy = (simulate(plan(duration=20.0, noise=share, seed=5)).columns for share in (0.0, 0.02))
    for name in ("position", "velocity", "acceleration"):
        assert np.std(noisy[name] - clean[name]) == pytest.approx(0.02 * clean[name].std(), rel=0.05)
    np.testing.assert_array_equal(noisy["force"], clean["force"])


def test_terms_are_written_with_place_and_parameters():
    assembly, values = assembly_of(default(), "robot_joint", ["coulomb_friction@base:force=0.03", "viscous_damping"])
    assert [(t.name, t.at) for t in assembly.terms] == [("coulomb_friction", "base"), ("viscous_damping", "ground")]
    assert values == {"coulomb_friction@base.force": 0.03}


def test_a_stiff_machine_takes_more_steps():
    soft, hard = (simulate(plan(values={"m": 1.0, "c": 1.0, "k": k})).nsub for k in (1e2, 1e6))
    assert soft == 4
    assert hard == pytest.approx(1e3 / 200.0 / 0.02, rel=0.02)


def test_motion_that_explodes_is_a_sentence():
    explosive = plan(values={"m": 1.0, "c": 0.0, "k": 0.0}, terms=["cubic_stiffness:coefficient=-1e9"], duration=5.0)
    with pytest.raises(CaseError, match="diverged after"):
        simulate(explosive)


def test_model_without_terms_is_an_assembly_too():
    assert assembly_of(default(), "rigid_drive", [])[0] == Assembly(default().make("model", "rigid_drive"))


def test_csv_has_the_columns_of_the_contract(tmp_path):
    done = run(*LIN, *DRIVE, "--initial", "position=0.004", "--out", str(tmp_path / "a.csv"))
    assert done.exit_code == 0, done.output
    table = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True)
    assert table.dtype.names == ("time", "force", "position", "velocity", "acceleration")
    assert (len(table), table["time"][-1], table["position"][0]) == (1000, 1.998, 0.004)
    assert "1000 samples of lin_backlash" in done.output


def test_netcdf_says_units_and_origin(tmp_path):
    done = run(*LIN, *DRIVE, "--term", "coulomb_friction:force=3", "--out", str(tmp_path / "a.nc"))
    assert done.exit_code == 0, done.output
    with xarray.open_dataset(tmp_path / "a.nc") as data:
        assert {name: data[name].attrs["units"] for name in ("time", "force", "velocity")} == {
            "time": "s", "force": "N", "velocity": "m/s",
        }  # fmt: skip
        assert data.sizes == {"time": 1000}
        origin = json.loads(data.attrs["provenance"])
    assert origin["settings"]["values"]["coulomb_friction.force"] == 3.0
    assert origin["seed"] == 0


@pytest.mark.parametrize("ending", ["csv", "nc"])
def test_same_seed_same_bytes(tmp_path, ending):
    outs = [tmp_path / f"{name}.{ending}" for name in "ab"]
    for out in outs:
        run(*LIN, "--drive", DRIVES["noise"], "--noise", "0.01", "--seed", "7", "--out", str(out))
    assert outs[0].read_bytes() == outs[1].read_bytes()


WRONG = {
    "missing": (
        ("lin_backlash", "--set", "m=1"),
        "lacks c (viscous damping, N s/m), k0 (stiffness of the contact, N/m)",
    ),
    "parameter": ((*LIN, "--set", "gapp=1"), "no parameter 'gapp'"),
    "twice": ((*LIN, "--set", "m=1"), "gives m twice"),
    "word": ((*LIN, "--set", "k1=stiff"), "k1 of --set is 'stiff': expected a finite number"),
    "no pair": ((*LIN, "--set", "k1"), "has 'k1': write key=value"),
    "bounds": (("lin_backlash", "--set", "m=1,c=-8,k0=1,x0=1"), "c (viscous damping) is -8: expected a value from 0"),
    "inertia": (("lin_backlash", "--set", "m=0,c=8,k0=1,x0=1"), "m (mass) is 0: expected a value above 0 kg"),
    "state": ((*LIN, "--initial", "positon=1"), "did you mean 'position'?"),
    "term": ((*LIN, "--term", "coulomb_fricton:force=1"), "did you mean 'coulomb_friction'?"),
    "term parameter": ((*LIN, "--term", "coulomb_friction:forse=1"), "did you mean 'force'?"),
    "term value": ((*LIN, "--term", "coulomb_friction"), "lacks coulomb_friction.force (friction force, N)"),
    "place": ((*LIN, "--term", "coulomb_friction@base:force=1"), "acts at 'base', but lin_backlash has ground"),
    "samples": ((*LIN, "--rate", "0.1"), "is 0.2 samples: expected 2 to 2500000"),
    "rate": ((*LIN, "--rate", "-5"), "the rate is -5: expected"),
    "size": ((*LIN, "--duration", "1e9"), "is 5e+11 samples: expected 2 to"),
    "noise": ((*LIN, "--noise", "-1"), "the noise is -1: expected a share"),
    "stiff": (("lin_backlash", "--set", "m=1,c=8,k0=4e16,x0=0.005"), "is too stiff: 2e+08 rad/s ask for"),
    "huge": ((*LIN, "--drive", "step:size=1e300"), "the drive reaches 1e+300: check its unit"),
    "fast": (
        (*LIN, "--drive", "noise:rms=1,bandwidth=300"),
        "reaches 300 Hz, which 500 samples per second cannot show",
    ),
    "endless": ((*LIN, "--drive", "noise:rms=1,bandwidth=1e200"), "drive noise up to 1e+200 Hz for 2 s is too long"),
    "lines": ((*LIN, "--drive", "multisine:rms=1,low=1,high=2,lines=1e9"), "expected a whole number up to 10000"),
}


@pytest.mark.parametrize("name", WRONG)
def test_mistakes_are_sentences(name, tmp_path):
    args, says = WRONG[name]
    base = () if "--rate" in args else ("--duration", "2", "--rate", "500")
    done = run(*base, *args, *DRIVE, "--out", str(tmp_path / "a.csv"))
    assert (done.exit_code, says in done.output) == (2, True), done.output
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("drive", "says"),
    [
        ("harmonics:amplitude=1", "did you mean 'harmonic'?"),
        ("harmonic:amplitude=1,omeg=1", "did you mean 'omega'?"),
        ("harmonic:amplitude=1", "neither omega nor frequency"),
        ("harmonic:amplitude=1,omega=1,frequency=1", "both omega and frequency"),
        ("harmonic:omega=1", "lacks amplitude: write harmonic:amplitude=..."),
        ("harmonic:amplitude=big,omega=1", "amplitude of drive harmonic is 'big'"),
        ("harmonic:amplitude=1,omega=1,harmonics=a/b", "harmonics of drive harmonic is 'a'"),
        ("multisine:rms=1,low=5,high=1", "low must be below high"),
        ("multisine:rms=1,low=1,high=5,lines=2.5", "expected a whole number"),
        ("step:size=1,rise=0", "rise of drive step is 0: expected more than zero"),
    ],
)
def test_mistakes_in_a_drive_are_sentences(drive, says):
    with pytest.raises(CaseError) as caught:
        signal_of(drive, duration=1.0, rng=np.random.default_rng(0))
    assert says in str(caught.value)


def test_other_endings_are_refused(tmp_path):
    assert "a table is written as .csv or .nc" in run(*LIN, *DRIVE, "--out", str(tmp_path / "a.xls")).output


def test_a_broken_write_leaves_the_old_file(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("old")
    with pytest.raises(ValueError, match="zip"):
        storage.save_table(path, {"time": np.zeros(3), "x": np.zeros(2)}, {}, {})
    assert [p.name for p in tmp_path.iterdir()] == ["a.csv"]
    assert path.read_text() == "old"


def test_a_folder_that_is_not_there_is_a_sentence(tmp_path):
    with pytest.raises(DataError, match="cannot be written"):
        storage.save_table(tmp_path / "none" / "a.csv", {"time": np.zeros(3)}, {}, {})


def test_help_shows_examples():
    done = run("--help")
    assert done.exit_code == 0
    assert "coulomb_friction@base:force=0.03" in done.output


def test_a_model_is_simulated_in_its_other_motion():
    wheels = {"m1": 0.02, "m2": 0.3, "ratio": 2.5, "c": 0.05, "k0": 400.0, "x0": 0.01}
    asked = {"drives": "harmonic:amplitude=1,omega=9", "duration": 2.0, "rate": 50.0, "values": wheels}
    tables = {m: lostmotion.simulate("gear_pair", motion=m, **asked) for m in ("translation", "rotation")}
    assert tables["rotation"].units["second_acceleration"] == "rad/s^2"
    assert tables["translation"].units["force"] == "N"
    assert json.loads(tables["rotation"].attrs["provenance"])["settings"]["motion"] == "rotation"
    for name, column in tables["translation"].columns.items():
        np.testing.assert_array_equal(tables["rotation"].columns[name], column)
    with pytest.raises(ContractError, match="robot_joint is of rotation, not of translation: ask for rotation"):
        lostmotion.simulate("robot_joint", motion="translation", **asked)
