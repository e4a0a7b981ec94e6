"""What a plugin is known to break, with its reason: told by every way of checking, and never hiding anything else."""

import json
import sys
from dataclasses import dataclass

import pytest
from click.testing import CliRunner

from lostmotion import registry, testing
from lostmotion.cli import main
from lostmotion.contracts import Param, Term
from lostmotion.quantities import DAMPING

REASON = "the bearing is preloaded: it drags also when the coefficient is 0"


@dataclass(frozen=True)
class Drag(Term):
    """A drag that is never quite gone."""

    at: str = "ground"
    name = "preloaded_drag"
    physics = "Drag of {coefficient} acts"
    formula = "-coefficient * v - 1"
    paper = "Stokes (1851)"
    params = (Param("coefficient", "drag", DAMPING, low=0.0, null=0.0),)
    known_failures = {"force_is_zero_at_null": REASON}  # noqa: RUF012

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * v - 1.0


@dataclass(frozen=True)
class Mended(Drag):
    """A drag that is gone at its null."""

    name = "mended_drag"

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * v


@pytest.fixture(autouse=True)
def offered():
    registry.default.cache_clear()
    yield registry.default().add(Drag).add(Mended)
    registry.default.cache_clear()


def run(*args, status=0):
    done = CliRunner().invoke(main, args, prog_name="lostmotion")
    assert done.exit_code == status, done.output
    return done.output


def test_a_known_failure_is_told_with_its_reason_and_does_not_count():
    text = " ".join(run("plugins", "check", "preloaded_drag").split())
    assert "known force_is_zero_at_null" in text
    assert f"Known: {REASON}" in text
    assert "0 broken, 1 known to be broken" in text


def test_it_is_told_to_machines_and_shown():
    (checked,) = json.loads(run("plugins", "check", "preloaded_drag", "--json"))["checks"]
    assert {r["rule"]: r["known"] for r in checked["rules"] if not r["ok"]} == {"force_is_zero_at_null": REASON}
    assert f"breaks     force_is_zero_at_null: {REASON}" in run("plugins", "show", "preloaded_drag")


def test_one_that_is_kept_after_all_is_a_failure():
    text = run("plugins", "check", "mended_drag", status=1)
    assert "FAIL  force_is_zero_at_null" in text
    assert "Remove it there" in text
    with pytest.raises(AssertionError, match="Remove it there"):
        testing.assert_conforms(Mended)


def test_python_tells_it_too():
    testing.assert_conforms(Drag)
    (rule,) = [r for r in testing.rules_for("term") if r.name == "force_is_zero_at_null"]
    with pytest.raises(AssertionError, match="the force is"):
        testing.assert_conforms(Drag, rule)
    testing.assert_conforms(Mended, rule)
    cases = {case.id: case for case in testing.parametrize([Drag]).mark.args[1]}
    assert cases["preloaded_drag-force_is_zero_at_null"].marks[0].kwargs == {"reason": REASON, "strict": True}
    assert not cases["preloaded_drag-has_a_null"].marks


def test_show_tells_the_priors_of_a_term_and_the_options_of_a_method():
    text = run("plugins", "show", "lugre_friction")
    assert "prior half-normal of width 1 * drive force" in text
    assert "prior log-normal about 0.1 * rms position / time of the motion" in text
    assert "prior one of " in run("plugins", "show", "excitation_harmonic")
    assert "option     tolerance = 0.02" in run("plugins", "show", "iaaft")


def test_a_slow_import_is_named_and_the_plugin_is_used(tmp_path, monkeypatch):
    monkeypatch.setattr("lostmotion.registry.classes.SLOW", 0.05)
    path = tmp_path / "sleepy_terms.py"
    path.write_text(
        "import time\nfrom tests_drag import Drag as Base\ntime.sleep(0.1)\nclass Sleepy(Base):\n    name = 's'\n"
    )
    monkeypatch.setitem(sys.modules, "tests_drag", sys.modules[__name__])
    done = CliRunner().invoke(main, ["--plugin", str(path), "plugins"], prog_name="lostmotion")
    sys.modules.pop("sleepy_terms", None)
    assert done.exit_code == 0
    assert "lostmotion: warning: plugin file sleepy_terms.py took 0.1 s to import" in done.stderr
    assert "sleepy_terms.py" in done.stdout


def test_an_unfinished_class_of_a_file_is_named(tmp_path):
    path = tmp_path / "half_terms.py"
    path.write_text("from lostmotion.contracts import Term\nclass Half(Term):\n    name = 'half'\n")
    text = run("--plugin", str(path), "plugins", status=2)
    sys.modules.pop("half_terms", None)
    assert "term 'half' of" in text
    assert "is not complete: write the method force of Half" in text


def test_what_others_bring_is_told_by_digest_or_version(tmp_path):
    path = tmp_path / "my_origin_terms.py"
    path.write_text("from tests_origin import Drag as Base\nclass Mine(Base):\n    name = 'mine'\n")
    sys.modules["tests_origin"] = sys.modules[__name__]
    found = registry.Registry.discover().add_file(path).origins()
    for name in ("tests_origin", "my_origin_terms"):
        sys.modules.pop(name)
    assert len(found.pop("my_origin_terms.py")) == 64
    assert "lostmotion" not in found
