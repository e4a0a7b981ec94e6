"""The commands as functions: what a notebook has added to a registry is used by each of them."""

import json

import numpy as np
import pytest
import third_party

import lostmotion
from lostmotion.registry import Registry

CASE = """
[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }

[model]
name = "guest_cart"
known = { m = 1.0 }

[model.estimate]
c = { low = 0.05, high = 5.0, scale = "log" }
k = { low = 5.0, high = 500.0, scale = "log" }
"""


@pytest.fixture(scope="module")
def known():
    found = Registry.discover()
    for cls in third_party.GOOD:
        found.add(cls if cls is not third_party.Pair else third_party.Pair(), "guests")
    return found


@pytest.fixture(scope="module")
def place(tmp_path_factory, known):
    """Return a folder with a recording of a guest's machine with a guest's term, and its case."""
    folder = tmp_path_factory.mktemp("doors")
    table = lostmotion.simulate(
        "guest_cart", values={"m": 1.0, "c": 0.2, "k": 50.0}, terms="guest_drag:size=0.6", duration=15.0, rate=40.0,
        drives=["harmonic:amplitude=1,omega=5", "harmonic:amplitude=1,omega=8"], noise=0.01, registry=known,
        out=folder / "recording.csv",
    )  # fmt: skip
    assert list(table.columns) == ["time", "force", "position", "velocity"]
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    return folder


def test_the_doors_open_when_they_are_used():
    assert set(lostmotion.__all__) >= {"simulate", "diagnose", "identify", "analyse", "map", "Case", "Recording"}
    for name in lostmotion.__all__:
        door = getattr(lostmotion, name)
        assert door.__doc__
        assert isinstance(door, type) or door.__doc__.startswith("Return ")
    assert lostmotion.LostmotionError is lostmotion.LostMotionError
    assert lostmotion.registry.default() is lostmotion.registry.default()
    assert lostmotion.testing.check
    with pytest.raises(AttributeError, match="it has Case, HalfNormal"):
        lostmotion.nothing  # noqa: B018


@pytest.mark.slow
def test_identify_finds_the_damping_of_both_together(place, known):
    done = lostmotion.identify(
        place / "case.toml", out=place / "posterior", registry=known, ess=50, max_steps=400, seed=1, progress=False
    )
    assert abs(done.parameters["c"].median / 0.8 - 1.0) < 0.1
    assert abs(done.to_dict()["parameters"]["c"]["median"] / 0.8 - 1.0) < 0.1
    assert lostmotion.load(place / "posterior").result == done.result
    assert (place / "posterior" / "report.html").exists()


@pytest.mark.slow
def test_a_map_of_it(place, known):
    table = lostmotion.map(
        "guest_cart", place / "map.nc", axes="c=0.6:0.8:2", sets=("m=1", "k=50"), drive="harmonic:amplitude=1,omega=5",
        quantities=("guest_crest", "guest_reach"), periods=40, transient=20, starts=1, registry=known, jobs=1,
    )  # fmt: skip
    assert np.allclose(table["guest_crest"], np.sqrt(2.0), rtol=0.02)
    assert (table["lyapunov_max"] < 0.0).all()


@pytest.mark.slow
def test_diagnose_knows_the_term(place, known):
    asked = {"select.decisive": 4.0}
    found = lostmotion.diagnose(place / "case.toml", out=place / "result", registry=known, settings=asked)
    said = found.to_dict()
    assert said["provenance"]["settings"]["thresholds"]["select"]["decisive"] == 4.0
    assert "guest_drag@ground" in said["provenance"]["settings"]["terms"]
    assert json.loads((place / "result" / "diagnosis.json").read_text())["title"] == "case"


@pytest.mark.slow
def test_analyse_uses_every_method(place, known):
    said = lostmotion.analyse(
        place / "recording.csv", out=place / "motion", columns="position", embedder="guest_pair", denoiser="guest_mean",
        quantifiers="guest_crest", surrogates="guest_shuffle", draws=19, registry=known,
    ).to_dict()  # fmt: skip
    assert said["others"][-1]["name"] == "guest_crest"
    assert said["others"][-1]["status"] == "ok"
    assert [test["method"] for test in said["surrogates"]] == ["guest_shuffle"]
    assert said["noise"]["method"] == "guest_mean"
    assert said["delay"]["samples"] == 8
