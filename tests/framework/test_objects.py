"""Recordings and cases that are put together in Python: what is taken, and what is refused with a sentence."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
import xarray as xr

import lostmotion as lm
from lostmotion.case import Experiment, SensorSpec, load_case
from lostmotion.registry import Registry

N = 400
T = np.arange(N) / 100.0
RNG = np.random.default_rng(0)
U, X = np.sin(5.0 * T) + 0.01 * RNG.standard_normal(N), np.cos(5.0 * T) + 0.01 * RNG.standard_normal(N)
UNITS = {"force": "N", "position": "mm"}


def recording(**more):
    return lm.Recording.from_arrays(T, inputs={"force": U}, sensors={"position": X}, units=UNITS, **more)


class Frame:
    """What a recording needs of a data frame."""

    def __init__(self, columns, index):
        self.held, self.columns, self.index = columns, list(columns), index

    def __getitem__(self, name):
        return Column(self.held[name])


class Column:
    def __init__(self, values):
        self.values, self.name = values, None

    def to_numpy(self):
        return self.values


def test_arrays_are_turned_into_si_units():
    found = recording(name="run")
    assert found.rate == pytest.approx(100.0)
    assert np.allclose(found.to_xarray()["position"], 1e-3 * X)
    assert found.to_xarray()["position"].attrs["units"] == "m"
    assert "run" in repr(found)


def test_a_frame_a_dataset_and_a_file_are_the_same_recording(tmp_path):
    columns = {"t_ms": 1e3 * T, "F": U, "x": X}
    units = {"t_ms": "ms", "F": "N", "x": "mm"}
    which = {"inputs": {"force": "F"}, "sensors": {"position": "x"}}
    np.savetxt(tmp_path / "run.csv", np.c_[T, U, X], delimiter=",", header="t,F,x", comments="")
    data = xr.Dataset(
        {"F": ("time", U, {"units": "N"}), "x": ("time", X, {"units": "mm"})}, {"time": ("time", T, {"units": "s"})}
    )
    made = [
        lm.Recording.from_pandas(Frame(columns, Column(T)), time="t_ms", units=units, **which),
        lm.Recording.from_pandas(Frame({"F": U, "x": X}, Column(T)), units=units, **which),
        lm.Recording.from_xarray(data, **which),
        lm.Recording.read(tmp_path / "run.csv", time="t", units=units, **which),
    ]
    for one in made:
        assert np.allclose(one.sensors[0], 1e-3 * X, atol=1e-12)
        assert one.dt == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"units": {"force": "N"}}, "the sensor 'position' has no unit"),
        ({"units": {**UNITS, "positon": "m"}}, "units names 'positon'.*did you mean 'position'"),
        ({"units": {"force": "N", "position": "kg"}}, "does not measure position"),
        ({"rate": 100.0}, "both time and rate"),
        ({"inputs": {"force": U[:-1]}}, "differ in length"),
        ({"inputs": {"push": U}, "units": {"push": "N", "position": "mm"}}, "is no input of a model"),
        ({"sensors": {}}, "has no sensor"),
        ({"sensors": {"position": np.stack([X, X])}}, "one number for each sample"),
        ({"sensors": {"position": ["a"] * N}}, "instead of numbers"),
    ],
)
def test_what_cannot_be_used_is_refused(change, says):
    given = {"inputs": {"force": U}, "sensors": {"position": X}, "units": UNITS}
    with pytest.raises(lm.LostmotionError, match=says):
        lm.Recording.from_arrays(T, **{**given, **change})


def test_a_case_is_written_and_read_again(tmp_path):
    made = lm.Case(
        [recording(name="a"), recording(name="b")],
        "m*x'' + c*x' + k*x = force",
        known={"m": 1.0},
        estimate={"c": lm.LogNormal(2.0, 0.5), "k": lm.Normal(25.0, 3.0, each=True)},
        title="two runs",
        truth={"c": 2.0},
    )
    path = made.write(tmp_path)
    case, again = load_case(path), lm.Case.read(path)
    assert (case.title, case.known, dict(case.truth)) == ("two runs", {"m": 1.0}, {"c": 2.0})
    assert again.estimate == made.estimate
    assert [one.name for one in again.recordings] == ["a", "b"]
    assert all(np.allclose(p.sensors[0], q.sensors[0]) for p, q in zip(made.recordings, again.recordings, strict=True))
    assert again.model.equations == made.model.equations


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"model": "lin_backlas"}, "did you mean 'lin_backlash'"),
        ({"model": "m*x'' + = force"}, "at character"),
        ({"known": {"m": 1.0, "c": 1.0}}, "both known and estimated"),
        ({"estimate": {"c": (1, 2)}}, "expected lm.LogUniform"),
        ({"recordings": []}, "needs a Recording"),
    ],
)
def test_a_case_that_cannot_be_meant_is_refused(change, says):
    given = {"recordings": recording(), "model": "linear_oscillator", "known": {"m": 1.0}}
    given["estimate"] = {"c": lm.LogUniform(0.1, 10.0)}
    with pytest.raises(lm.LostMotionError, match=says):
        lm.Case(**{**given, **change})


def test_the_first_coordinate_of_an_equation_is_the_position():
    run = lm.Recording.from_arrays(T, inputs={"force": U}, sensors={"x1": X}, units={"force": "N", "x1": "mm"})
    (sensor,) = lm.Case(run, "m*x1'' + k*x1 = force", {"m": 1.0}, {"k": lm.Uniform(1, 99)}).recordings[0].sensors
    assert (sensor.attrs["of"], sensor.attrs["sensor"]) == ("position", "x1")


def test_a_model_of_ones_own_makes_a_case(tmp_path):
    from third_party import Cart

    case = lm.Case(
        recording(), Cart(), known={"m": 1.0}, estimate={"c": lm.LogUniform(0.1, 9.0), "k": lm.Uniform(1, 99)}
    )
    assert case.prepare(Registry.discover()).model == Cart()
    with pytest.raises(lm.LostMotionError, match="no file defines"):
        case.write(tmp_path / "folder")
    assert not (tmp_path / "folder").exists()


def test_terms_are_chosen_by_name():
    case = lm.Case(recording(), "linear_oscillator", {"m": 1.0}, {"c": lm.LogUniform(0.1, 9.0), "k": lm.Uniform(1, 99)})
    found = case.prepare(Registry.discover(), ["coulomb_friction", "offset_force"])
    assert {term.name for term in found.terms} == {"coulomb_friction", "offset_force"}
    (one,) = case.prepare(Registry.discover(), ["coulomb_friction@ground"]).terms
    assert (one.name, one.at) == ("coulomb_friction", "ground")
    with pytest.raises(lm.LostMotionError, match="coulomb_friction cannot act at 'base': it can at ground"):
        case.prepare(Registry.discover(), ["coulomb_friction@base"])
    with pytest.raises(lm.LostMotionError, match="did you mean 'coulomb_friction'"):
        case.prepare(Registry.discover(), "coulomb_frction")


def test_a_recording_and_a_model_are_a_case_with_wide_priors():
    from lostmotion.notebook.doors import make_case

    case = make_case(recording(), "m*x'' + c*x' + k*x = force", {"m": 1.0}, None, Registry.discover())
    assert set(case.estimate) == {"c", "k"}
    assert all(prior.kind == "log-uniform" for prior in case.estimate.values())
    with pytest.raises(lm.LostMotionError, match="a recording alone is no case"):
        make_case(recording(), None, None, None, Registry.discover())


def test_a_folder_without_a_result_is_refused(tmp_path):
    with pytest.raises(lm.LostMotionError, match="contains no result"):
        lm.load(tmp_path)


@pytest.mark.parametrize("name", lm.__all__)
def test_no_option_hides_behind_stars(name):
    door = getattr(lm, name)
    if not isinstance(door, type) and name != "model":
        kinds = [one.kind for one in inspect.signature(door).parameters.values()]
        assert inspect.Parameter.VAR_KEYWORD not in kinds


def test_a_column_that_is_not_there_is_named(tmp_path):
    np.savetxt(tmp_path / "run.csv", np.c_[T, U, X], delimiter=",", header="t,F,x", comments="")
    which = {"sensors": {"position": "x"}, "units": {"x": "mm"}}
    with pytest.raises(lm.LostmotionError, match=r"no column 'G', which inputs asks for: it has t, F, x"):
        lm.Recording.read(tmp_path / "run.csv", time="t", inputs={"force": "G"}, **which)


def test_what_a_case_says_beside_its_model_is_written_too(tmp_path):
    limits, sensor = Experiment(max_level=5.0), SensorSpec("shared", lm.Normal(0.0, 1e-3))
    model = lm.model("linear_oscillator")
    priors = {"c": lm.LogUniform(0.1, 10.0), "k": lm.Normal(25.0, 5.0)}
    case = lm.Case(recording(), model, {"m": 1.0}, priors, experiment=limits, sensor=sensor)
    again = lm.Case.read(case.write(tmp_path / "folder"))
    assert (again.experiment, again.sensor) == (limits, sensor)
    assert repr(again.estimate["k"]) == "Normal(25.0, 5.0)"


def test_a_prior_that_cannot_be_meant_is_refused_in_a_sentence():
    with pytest.raises(lm.LostmotionError, match="the prior has low = 3 and high = 2"):
        lm.LogUniform(3.0, 2.0)


def test_an_equation_shows_itself_as_a_model():
    assert repr(lm.model("m*x'' + c*x' = force")) == "<model m*x'' + c*x' = force (translation)>"


def test_a_map_without_a_place_leaves_no_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    few = {"periods": 40, "transient": 5, "starts": 1}
    found = lm.map("lin_backlash", axes="alpha=0.3:0.4:2", sets=("zeta=0.05",), **few)
    assert found.sizes["alpha"] == 2
    assert not list(tmp_path.iterdir())
