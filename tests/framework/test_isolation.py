"""A plugin of other people that breaks takes nothing else down: a sentence names it, its contract and the remedy."""

import os
import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest
import third_party
from click.testing import CliRunner

from lostmotion import registry
from lostmotion.cli import main
from lostmotion.contracts import Series
from lostmotion.diagnosis import diagnosis_run as diagnose
from lostmotion.errors import ContractError, PluginWarning
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import Prepared
from lostmotion.preparation.vetting import MethodWatch, find_raising_terms, usable_terms
from lostmotion.registry import Registry
from lostmotion.results import Embedding
from lostmotion_chaos.analysis import run as analyse
from lostmotion_chaos.analysis.period import BasePeriod

pytestmark = pytest.mark.filterwarnings("ignore::lostmotion.errors.PluginWarning")
ALL = [*third_party.GOOD, *(cls for cls, _ in (*third_party.TERMS, *third_party.METHODS))]


@pytest.fixture
def known():
    """Return the default registry with all guests in it, which is forgotten afterwards."""
    registry.default.cache_clear()
    found = registry.default()
    for cls in ALL:
        found.add(cls, "guests")
    yield found
    registry.default.cache_clear()


def run(*args, status=0):
    done = CliRunner().invoke(main, [str(a) for a in args], prog_name="lostmotion")
    assert done.exit_code == status, done.output
    return done


def one_sentence(text):
    return len(text.strip().splitlines()) == 1 and text.startswith("lostmotion: ") and "Traceback" not in text


def test_terms_are_set_aside_one_by_one_and_the_good_one_stays():
    mine = Registry()
    for cls in (third_party.Drag, *(cls for cls, _ in third_party.TERMS)):
        mine.add(cls, "guests")
    with pytest.warns(PluginWarning, match="Set aside"):
        terms, aside = usable_terms(mine)
    assert terms == [third_party.Drag]
    for (cls, why), said in zip(sorted(third_party.TERMS, key=lambda pair: pair[0].name), aside, strict=True):
        assert f"term '{cls.name}' of guests" in said
        assert why in said
        assert f"`lostmotion plugins check {cls.name}` lists all rules" in said


def test_a_package_that_does_not_import_is_among_what_was_set_aside(tmp_path, monkeypatch):
    folder = tmp_path / "broken-1.0.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: broken\nVersion: 1.0\n")
    (folder / "entry_points.txt").write_text("[lostmotion.v1]\nbroken = broken_guest\n")
    (tmp_path / "broken_guest.py").write_text("import nothing_of_that_name\n")
    monkeypatch.syspath_prepend(tmp_path)
    _, aside = usable_terms(Registry.discover())
    assert any("could not be imported: ModuleNotFoundError" in said for said in aside)


@pytest.mark.slow
@pytest.mark.parametrize(("cls", "why"), third_party.METHODS, ids=[cls.name for cls, _ in third_party.METHODS])
def test_a_method_is_set_aside_and_its_samples_are_as_they_were(known, cls, why):
    x = np.sin(0.3 * np.arange(1200.0)) + 0.1 * np.random.default_rng(0).normal(size=1200)
    series = Series(x.copy(), 0.05, Embedding(8, 3, 10))
    watch, request, base = MethodWatch(known), analyse.AnalysisRequest(draws=19), BasePeriod(None, "none")
    if issubclass(cls, third_party.Crest):
        found = analyse._SeriesMeasurer(series, watch, request, base, print)(cls.name, "others")
        assert (found.status, found.says) == ("failed", watch.said[0])
    elif issubclass(cls, third_party.Pair):
        assert analyse._embed_series(series.x, watch, cls.name, 0.05, base).embedding.methods != ("given", "given")
    elif issubclass(cls, third_party.Shuffle):
        assert [
            t.method for t in analyse._run_tests(series, watch, replace(request, surrogates=(cls.name,)), print)
        ] == ["iaaft"]
    else:
        denoised, how = analyse._reduce_noise(series, watch, replace(request, denoiser=cls.name))
        assert (denoised.series, how) == (series, "none")
    (said,) = watch.said
    assert why in said
    assert f"of guests {why.split('(')[0].split(',')[0] if why.startswith('raised') else ''}".strip() in said
    assert f"`lostmotion plugins check {cls.name}` shows the errors" in said
    assert np.array_equal(series.x, x)


@pytest.mark.slow
def test_good_methods_are_used(known):
    x = np.sin(0.3 * np.arange(1200.0)) + 0.1 * np.random.default_rng(0).normal(size=1200)
    watch, base = MethodWatch(known), BasePeriod(None, "none")
    series = analyse._embed_series(x, watch, "guest_pair", 0.05, base)
    assert (series.embedding.lag, series.embedding.dim) == (8, 3)
    request = analyse.AnalysisRequest(denoiser="guest_mean", surrogates=("guest_shuffle",), draws=19)
    assert analyse._reduce_noise(series, watch, request)[1] == "guest_mean"
    (test,) = analyse._run_tests(series, watch, request, print)
    assert test.method == "guest_shuffle"
    assert watch.said == []


@pytest.mark.slow
def test_a_map_goes_on_without_a_quantifier_that_breaks(known, tmp_path):
    done = run(
        "map", "--model", "lin_backlash", "--x", "alpha=0.2:0.4:2", "--set", "zeta=0.02", "--periods", 40, "--starts",
        1, "--quantifier", "guest_crest", "--quantifier", "guest_reach", "--quantifier", "guest_q_raises",
        "--quantifier", "guest_q_nan", "--out", tmp_path / "map.nc", "--quiet",
    )  # fmt: skip
    assert "quantifier 'guest_q_raises' failed in a cell of the map (ZeroDivisionError: all is lost)" in done.stderr
    assert "guest_q_nan has no value for 2 of 2 motions" in done.stderr
    assert "`lostmotion plugins check guest_q_nan`" in done.stderr
    assert "guest_crest" not in done.stderr
    from lostmotion_chaos.maps.store import load

    table = load(tmp_path / "map.nc")
    assert np.isfinite(table["guest_crest"]).all()
    assert np.isfinite(table["guest_reach"]).all()
    assert np.isnan(table["guest_q_raises"]).all()


MOVED = ("--drive", "harmonic:amplitude=1,omega=1", "--duration", 1, "--rate", 100, "--out")


@pytest.mark.parametrize("method", ["rhs", "observe"])
def test_a_broken_model_is_one_sentence_and_status_2(known, tmp_path, method):
    known.add(
        third_party.spoiled(third_party.Cart, f"guest_bad_{method}", **{method: staticmethod(third_party.raises)}),
        "guests",
    )
    done = run("simulate", f"guest_bad_{method}", "--set", "m=1,c=1,k=1", *MOVED, tmp_path / "x.csv", status=2)
    assert f"model 'guest_bad_{method}' of guests cannot be used, because it breaks the rule {method}_" in done.stderr
    assert one_sentence(done.stderr)


def test_a_broken_term_that_is_asked_for_is_one_sentence_and_status_2(known, tmp_path):
    done = run("simulate", "linear_oscillator", "--set", "m=1,c=1,k=1", "--term", "guest_nan:size=1", *MOVED,
               tmp_path / "x.csv", status=2)  # fmt: skip
    assert "term 'guest_nan' of guests cannot be used" in done.stderr
    assert one_sentence(done.stderr)


def late(t, x, v, u, p, s):
    if t > 0.5:
        raise ValueError("too late")
    return -p[0] * v


def test_the_term_that_raises_along_the_recording_is_found():
    guest, at_fault = (
        third_party.Drag(),
        third_party.spoiled(third_party.Drag, "guest_late", force=staticmethod(late))(),
    )
    observation = Observation.of("run", np.sin(np.arange(200) * 0.1), np.zeros((200, 1)), 0.01, "position")
    assert find_raising_terms([guest, at_fault], [observation]) == {"guest_late"}
    assert find_raising_terms([guest, at_fault], [observation.part(0, 40)]) == set()


def test_what_a_term_raises_while_it_runs_becomes_a_sentence():
    system = System(
        third_party.Cart(), (third_party.spoiled(third_party.Drag, "guest_late", force=staticmethod(late))(),)
    )
    full, time = system.vector({"m": 1.0, "guest_late.size": 1.0}), np.ones(1)
    with pytest.raises(ContractError, match=r"a model or term raised ValueError \(too late\)"):
        system.compute_derivatives(
            system.everything, system.pack(full[None], 0.01), np.ones((1, 2)), np.ones((1, 1)), time
        )


@dataclass(frozen=True)
class Nothing:
    """A case, as far as a diagnosis that never begins reads it."""

    digest: str = ""
    notes: tuple[str, ...] = ()


@pytest.mark.parametrize(("plugin", "left"), [("guest_drag", {"guest_drag"}), ("", {"guest_drag", "guest_more"})])
def test_a_diagnosis_begins_anew_without_the_term_that_broke_down(known, monkeypatch, plugin, left):
    more = third_party.spoiled(third_party.Drag, "guest_more")
    known.add(more, "guests")
    ours = known.make("term", "coulomb_friction")
    prepared = Prepared(Nothing(), (), (), third_party.Cart(), (ours, third_party.Drag(), more()))
    tried = []

    def fails_at_first(case, observations, system, *, rng):
        tried.append((system.keys, float(rng.random())))
        if len(tried) == 1:
            raise ContractError("the force is not a finite number along the recorded motion", plugin)
        return "diagnosis"

    monkeypatch.setattr(diagnose, "diagnose", fails_at_first)
    found, kept, _ = diagnose._run_search(prepared, known, 3, diagnose.diagnose)
    assert found == "diagnosis"
    assert set(tried[0][0]) - set(tried[1][0]) == left
    assert tried[0][1] == tried[1][1]
    assert "coulomb_friction" in tried[1][0]
    assert all(name in kept.notes[-1] for name in left)

    def fails(*_args, **_options):
        raise ContractError("one of ours", "coulomb_friction")

    monkeypatch.setattr(diagnose, "diagnose", fails)
    with pytest.raises(ContractError, match="one of ours"):
        diagnose._run_search(prepared, known, 3, diagnose.diagnose)


CASE = """
plugins = ["{file}"]
[model]
name = "guest_cart"
[[recordings]]
file = "recording.csv"
time = "time"
excitation = {{ column = "force", quantity = "force", unit = "N" }}
response = {{ column = "position", quantity = "position", unit = "m" }}
[model.estimate]
c = {{ low = 0.1, high = 10.0 }}
"""


@pytest.mark.parametrize("file", ["nowhere.py", "case.toml", "."])
@pytest.mark.parametrize("command", ["diagnose", "identify", "analyse"])
def test_a_plugin_file_of_a_case_that_is_none_is_one_sentence_and_status_2(tmp_path, command, file):
    case = tmp_path / "case.toml"
    case.write_text(CASE.format(file=file))
    done = run(command, case, "--out", tmp_path / "out", status=2)
    assert file in done.stderr
    assert one_sentence(done.stderr)


def test_a_plugin_file_that_does_not_import_is_one_sentence_and_status_2(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "guest_broken.py").write_text("import nothing_of_that_name\n")
    (tmp_path / "sub" / "case.toml").write_text(CASE.format(file="../guest_broken.py"))
    done = run("diagnose", tmp_path / "sub" / "case.toml", "--out", tmp_path / "out", status=2)
    assert "guest_broken.py could not be loaded: ModuleNotFoundError" in done.stderr
    assert "correct the file" in done.stderr
    assert one_sentence(done.stderr)
    assert "guest_broken" not in sys.modules
    assert not os.path.exists(tmp_path / "out")
