"""Where the package of chaos is absent, everything else works, and a sentence names the package."""

import math

import numpy as np
import pytest
from click.testing import CliRunner

import lostmotion
from lostmotion import registry
from lostmotion.case import load_case
from lostmotion.cli import main
from lostmotion.diagnosis.show import refuse_attractors
from lostmotion.diagnosis.show_words import ABSENT
from lostmotion.errors import PluginError
from lostmotion.identification.identification_run import identify_case
from lostmotion.identification.routes import IdentificationRequest
from lostmotion.likelihood.observation import Observation

LEVELS = """
[model]
name = "lin_backlash"
[model.known]
m = 1.0
[model.estimate]
c = { low = 1.0, high = 20.0 }
[[levels]]
name = "one"
amplitude = 40.0
unit = "N"
omega = 40.0
motion = "periodic"
"""
ABSENCE = "no installed package offers the {}: it belongs to lostmotion_chaos"


@pytest.fixture
def bare(monkeypatch):
    """The registry of a process in which the package of chaos is not installed."""
    every = registry.metadata.entry_points
    kept = lambda **how: [point for point in every(**how) if point.name != "chaos"]  # noqa: E731
    monkeypatch.setattr(registry.metadata, "entry_points", kept)
    registry.default.cache_clear()
    yield registry.default()
    registry.default.cache_clear()


def test_functions_of_the_package_are_absent_with_a_sentence(bare):
    assert not hasattr(lostmotion, "analyse")
    for error in (PluginError, AttributeError):
        with pytest.raises(error, match=ABSENCE.format("function 'map'")):
            _ = lostmotion.map
    assert lostmotion.simulate


def test_a_command_of_the_package_is_absent_with_a_sentence(bare):
    done = CliRunner().invoke(main, ["analyse", "recording.csv"])
    assert done.exit_code == 2
    assert ABSENCE.format("command 'analyse'") in done.output
    assert "diagnose" in CliRunner().invoke(main, ["--help"]).output


def test_the_route_of_levels_is_absent_with_a_sentence(bare, tmp_path):
    (tmp_path / "case.toml").write_text(LEVELS)
    with pytest.raises(PluginError, match=ABSENCE.format("route 'quantifiers'")):
        identify_case(load_case(tmp_path / "case.toml"), None, tmp_path, bare, IdentificationRequest())


def test_a_diagnosis_says_that_attractors_were_not_measured(bare):
    time = 0.01 * np.arange(400)
    shown = Observation.of("driven", np.sin(time), np.cos(time)[:, None], 0.01, "position")
    found = refuse_attractors(shown, bare)
    assert {one.status for one in (*found.distances.values(), *found.dimensions.values())} == {ABSENT}
    assert math.isnan(found.distances["before"].value)
    assert ABSENCE.format("measure 'attractors'") in found.dimensions["recorded"].says


def test_a_file_may_offer_a_function_a_route_and_a_result(tmp_path, bare):
    (tmp_path / "guest_doors.py").write_text("""
from lostmotion.hookspecs import hookimpl
@hookimpl
def lostmotion_functions():
    return {"twice": ("guest_doors:twice", "Return twice a number."), "simulate": ("guest_doors:twice", "Never.")}
@hookimpl
def lostmotion_results():
    return {"guest.json": ("guest_doors:read", "The result of a guest.")}
def twice(number):
    return 2 * number
def read(folder):
    return (folder / "guest.json").read_text()
""")
    bare.add_file(tmp_path / "guest_doors.py")
    assert lostmotion.twice(21) == 42
    assert lostmotion.simulate.__module__ == "lostmotion.notebook.models"
    (tmp_path / "guest.json").write_text("{}")
    assert lostmotion.load(tmp_path) == "{}"
