"""The registry survives broken, clashing and misspelt plugins, and says so."""

import importlib
import re
import sys
from types import ModuleType, SimpleNamespace

import pytest
from click.testing import CliRunner

from lostmotion import contracts, hookspecs, registry
from lostmotion.cli import main
from lostmotion.contracts import Model, Term
from lostmotion.errors import PluginError
from lostmotion.offers import ALL_KINDS, COMMAND
from lostmotion.registry import Entry, Registry
from lostmotion_plugins.models.lin import LinBacklash

HOOK = "from lostmotion.hookspecs import hookimpl\n"
TERMS = HOOK + "@hookimpl\ndef lostmotion_terms():\n    return {}\n"
DRAG = '''
from __future__ import annotations
from dataclasses import dataclass
from typing import ClassVar
from lostmotion.contracts import Term

@dataclass(frozen=True)
class Drag(Term):
    """A drag."""
    at: str = "ground"
    name: ClassVar[str] = "NAME"
    @staticmethod
    def force(t, x, v, u, p, s):
        return 0.0
'''


def drag(name):
    return DRAG.replace("NAME", name)


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """Return a function that installs a package of one module: its source, and its entry points by name."""
    monkeypatch.syspath_prepend(tmp_path)

    def install(owner, source, **points):
        (tmp_path / f"{owner}.py").write_text(source)
        info = tmp_path / f"{owner}-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {owner}\nVersion: 1.0\n")
        lines = [f"{name} = {target}" for name, target in (points or {"main": owner}).items()]
        (info / "entry_points.txt").write_text("[lostmotion.v1]\n" + "\n".join(lines) + "\n")
        importlib.invalidate_caches()

    yield install
    for name in [n for n, m in sys.modules.items() if str(tmp_path) in str(getattr(m, "__file__", ""))]:
        del sys.modules[name]


@pytest.fixture
def file(tmp_path):
    """Return a function that writes a plugin file and gives its path."""

    def write(name, source):
        (tmp_path / name).write_text(source)
        return tmp_path / name

    yield write
    for name in [n for n, m in sys.modules.items() if str(tmp_path) in str(getattr(m, "__file__", ""))]:
        del sys.modules[name]


def offering(name, **kinds):
    """Return a module that answers hooks: `offering("m", terms={...})`."""
    module = ModuleType(name)
    for kind, offer in kinds.items():
        setattr(module, f"lostmotion_{kind}", hookspecs.hookimpl(answering(offer)))
    return module


def answering(offer):
    return lambda: offer


def aside(owner):
    (entry,) = [e for e in Registry.discover().entries() if e.owner == owner]
    assert entry.kind == "package"
    return entry


def test_the_built_in_plugins_are_found_through_their_entry_point():
    found = Registry.discover()
    assert {"lin_backlash", "rigid_drive", "linear_oscillator", "robot_joint"} <= set(found.names("model"))
    assert {"coulomb_friction", "lugre_friction"} <= set(found.names("term"))
    assert issubclass(found.load("model", "lin_backlash"), Model)


def test_kinds_and_hooks_agree_with_the_contracts():
    assert set(registry.KINDS) == set(contracts.KINDS)
    assert {f"lostmotion_{kind.removesuffix('s')}s" for kind in ALL_KINDS} == {
        name for name in vars(hookspecs) if name.startswith("lostmotion_")
    }


def test_a_good_package_is_ready(installed):
    installed("good_one", TERMS.replace("{}", '{"good_drag": "good_one_terms:Drag"}'))
    found = Registry.discover()
    assert Entry("term", "good_drag", "good_one", "1.0", "good_one_terms:Drag") in found.entries()


@pytest.mark.parametrize(
    ("source", "state", "why"),
    [
        ("import nowhere_at_all", "broken", "it could not be imported: ModuleNotFoundError: No module named 'nowhere"),
        ("raise SystemExit(3)", "broken", "it could not be imported: SystemExit: 3"),
        ("def (", "broken", "it could not be imported: SyntaxError"),
        (TERMS.replace("_terms", "_term"), "misspelt hook", "'lostmotion_term' is not known .*'lostmotion_terms'"),
        (TERMS.replace("return {}", "raise KeyError('a')"), "broken", "hook 'lostmotion_terms' failed: KeyError: 'a'"),
        (TERMS.replace("{}", "['drag']"), "broken", "hook 'lostmotion_terms' returned list: return {"),
        (TERMS.replace("{}", "{'drag': int}"), "broken", "returned {'drag': <class 'int'>}: return {"),
        (TERMS.replace("{}", "{'drag': 'my.mod.Drag'}"), "broken", "returned {'drag': 'my.mod.Drag'}: return {"),
        (TERMS.replace("terms()", "terms(config)"), "broken", "has arguments"),
        (TERMS, "broken", "offers no name"),
    ],
)
def test_a_bad_package_is_kept_aside_with_the_reason(installed, source, state, why):
    installed("bad_one", source)
    entry = aside("bad_one")
    assert entry.state == state
    assert re.search(why, entry.why), entry.why
    assert "coulomb_friction" in Registry.discover().names("term")


def test_a_misspelt_hook_takes_the_good_ones_of_its_package_with_it(installed):
    source = TERMS.replace("{}", '{"half_drag": "x:Y"}') + "@hookimpl\ndef lostmotion_modles():\n    return {}\n"
    installed("half_right", source)
    assert (
        aside("half_right").why
        == "hook 'lostmotion_modles' is not known (did you mean 'lostmotion_models'?): rename it"
    )


def test_a_second_entry_point_of_the_same_name_is_not_lost(installed):
    for owner in ("one_owner", "two_owner"):
        installed(owner, TERMS.replace("{}", f'{{"{owner}_drag": "x:Y"}}'), builtin=owner)
    assert {"one_owner_drag", "two_owner_drag", "coulomb_friction"} <= set(Registry.discover().names("term"))


def test_an_unknown_name_tells_what_was_kept_aside(installed):
    installed("bad_two", "raise RuntimeError")
    with pytest.raises(PluginError, match="not usable: bad_two"):
        Registry.discover().load("term", "my_drag")


def test_a_clash_is_raised_only_when_the_name_is_used(installed):
    installed("rival", TERMS.replace("{}", '{"coulomb_friction": "rival:X", "rival_drag": "rival:X"}'))
    found = Registry.discover()
    assert "rival_drag" in found.names("term")
    assert "coulomb_friction" not in found.names("term")
    assert {e.state for e in found.entries() if e.name == "coulomb_friction"} == {"clash"}
    assert found.load("term", "viscous_damping").name == "viscous_damping"
    with pytest.raises(PluginError, match=r"'coulomb_friction' is offered by lostmotion .* and rival 1.0: remove one"):
        found.load("term", "coulomb_friction")


def test_one_owner_may_not_offer_a_name_twice(installed):
    body = TERMS.replace("{}", '{"twice_drag": "%s:X"}')
    installed("twice", body % "a", a="twice", b="twice_more")
    installed("twice_more", body % "b", c="twice")
    assert {e.state for e in Registry.discover().entries() if e.name == "twice_drag"} == {"clash"}


@pytest.mark.parametrize(
    ("kind", "name", "sentence"),
    [
        (
            "term",
            "coulom_friction",
            r"no term is called 'coulom_friction' \(did you mean 'coulomb_friction'\?\): there are",
        ),
        ("model", "coulomb_friction", "'coulomb_friction' is a term, and a model was expected"),
        ("modle", "lin_backlash", r"no kind 'modle' of plugin \(did you mean 'model'\?\)"),
        ("denoiser", "schreiber", "no denoiser is called 'schreiber'"),
    ],
)
def test_a_name_that_cannot_be_used_is_told(kind, name, sentence):
    with pytest.raises(PluginError, match=sentence):
        Registry.discover().load(kind, name)


@pytest.mark.parametrize(
    ("target", "sentence"),
    [
        ("nowhere_at_all:X", "could not be imported from nowhere_at_all: ModuleNotFoundError"),
        ("lostmotion_plugins.terms.viscous:ViscousDampin", "there is no such class .*ViscousDamping"),
        ("lostmotion_plugins.models.lin:LinBacklash", "which is a model: subclass Term"),
        ("lostmotion.contracts:Param", "which is no plugin class: subclass Term"),
        ("lostmotion.contracts:Term", "is not complete: write the method force"),
        ("lostmotion_plugins.terms.viscous:ViscousDamping", "is called 'viscous_damping' in ViscousDamping: let both"),
    ],
)
def test_a_target_that_is_no_class_of_the_kind_is_told(target, sentence):
    found = Registry().add(offering("mine", terms={"my_drag": target}))
    with pytest.raises(PluginError, match=f"term 'my_drag' of mine .*{sentence}"):
        found.load("term", "my_drag")


def test_make_returns_an_instance_and_tells_wrong_options():
    found = Registry.discover()
    assert found.make("term", "viscous_damping", at="base").at == "base"
    with pytest.raises(PluginError, match=r"has no option 'ta' \(did you mean 'at'\?\): it has at"):
        found.make("term", "viscous_damping", ta="base")


def test_a_class_is_added_and_may_be_written_again():
    first, second = load_drag("own_drag"), load_drag("own_drag")
    found = Registry().add(first)
    assert found.add(second).load("term", "own_drag") is second
    assert [e.state for e in found.entries()] == ["ready"]
    assert found.add(first, "somebody else").entries()[0].state == "clash"


def test_an_instance_is_added_and_made_again():
    mine = load_drag("own_drag")(at="base")
    found = Registry().add(mine)
    assert found.make("term", "own_drag") is mine
    assert found.make("term", "own_drag", at="ground").at == "ground"
    assert found.load("term", "own_drag") is type(mine)


def test_further_names_that_are_no_texts_are_told():
    wrong = type("Weighed", (LinBacklash,), {"aliases": {"weight": 1.0}})
    with pytest.raises(PluginError, match=r"declares aliases = .*: write a mapping of texts to names of parameters"):
        Registry().add(wrong).load("model", wrong.name)


def load_drag(name):
    module = ModuleType("drag_module")
    sys.modules["drag_module"] = module
    try:
        exec(drag(name), vars(module))  # noqa: S102
    finally:
        del sys.modules["drag_module"]
    return module.Drag


def test_what_cannot_be_added_is_refused_at_once():
    found = Registry()
    with pytest.raises(PluginError, match="plugin SimpleNamespace cannot be used: it offers no name"):
        found.add(SimpleNamespace())
    with pytest.raises(PluginError, match="plugin mine cannot be used: hook 'lostmotion_terms' returned int"):
        found.add(offering("mine", terms=3))
    with pytest.raises(PluginError, match="has no name"):
        found.add(type("Nameless", (Term,), {"force": staticmethod(lambda t, x, v, u, p, s: 0.0)}))
    assert found.entries() == ()


def test_a_module_is_added_once():
    module = offering("mine", terms={"my_drag": "x:Y"})
    assert len(Registry().add(module).add(module).entries()) == 1


def test_a_file_gives_the_classes_written_in_it(file):
    path = file("my_own_terms.py", drag("file_drag") + "from lostmotion_plugins.terms.viscous import ViscousDamping\n")
    found = Registry().add_file(path).add_file(path)
    assert [(e.name, e.owner, e.state) for e in found.entries()] == [("file_drag", str(path), "ready")]
    assert found.make("term", "file_drag").at == "ground"


def test_a_file_may_have_hooks_of_its_own(file):
    hook = TERMS.replace("{}", '{"file_drag": f"{__name__}:Drag"}')
    found = Registry().add_file(file("json.py", drag("file_drag") + hook))
    assert found.load("term", "file_drag").name == "file_drag"


@pytest.mark.parametrize(
    ("name", "source", "sentence"),
    [
        ("empty_terms.py", "x = 1", "contains no plugin: write a subclass"),
        ("wrong_terms.py", "x = ", "could not be loaded: SyntaxError"),
        ("my terms.py", "1 / 0", "could not be loaded: ZeroDivisionError"),
        ("my_terms.txt", "", "does not exist or is no .py file"),
    ],
)
def test_a_file_that_cannot_be_used_is_refused(file, name, source, sentence):
    with pytest.raises(PluginError, match=sentence):
        Registry().add_file(file(name, source))


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(PluginError, match="does not exist"):
        Registry().add_file(tmp_path / "no.py")


def test_the_default_registry_is_made_once():
    assert registry.default() is registry.default()


GREETING = """
import click

@click.command()
def greet():
    click.echo("good day")
"""
COMMANDS = HOOK + "@hookimpl\ndef lostmotion_commands():\n    return {}\n"


def test_a_package_adds_a_command(installed):
    installed("polite", COMMANDS.replace("{}", '{"greet": ("polite_words:greet", "Say good day.")}'))
    added = Registry.discover().offered(COMMAND)
    assert added["greet"] == Entry("command", "greet", "polite", "1.0", "polite_words:greet", about="Say good day.")
    assert {"analyse", "calibrate", "demo", "map", "prove", "reproduce"} <= set(added)


@pytest.fixture
def forgetful():
    """Let this process forget what was added to its registry."""
    registry.default.cache_clear()
    yield
    registry.default.cache_clear()


@pytest.mark.usefixtures("forgetful")
def test_a_command_in_a_file_runs_and_a_name_of_ours_stays_ours(file):
    answer = '{"greet": ("rude:greet", "Say good day."), "simulate": ("rude:greet", "Draw.")}'
    rude = str(file("rude.py", COMMANDS.replace("{}", answer) + GREETING))
    run = CliRunner()
    assert run.invoke(main, ["--plugin", rude, "greet"]).output == "good day\n"
    assert "Simulate MODEL, and write" in run.invoke(main, ["--plugin", rude, "simulate", "--help"]).output
    assert "greet      Say good day." in run.invoke(main, ["--plugin", rude, "--help"]).output


@pytest.mark.usefixtures("forgetful")
def test_a_command_of_two_owners_is_told_as_a_clash(file):
    answer = '{"greet": ("twice_one:greet", "Say good day.")}'
    files = [str(file(f"{name}.py", COMMANDS.replace("{}", answer) + GREETING)) for name in ("twice_one", "twice_two")]
    done = CliRunner().invoke(main, ["--plugin", files[0], "--plugin", files[1], "greet"])
    assert done.exit_code == 2
    assert "command 'greet' is offered by" in done.output


@pytest.mark.usefixtures("forgetful")
@pytest.mark.parametrize("target", ["rude_two:nothing", "rude_two:HOOK"])
def test_a_command_that_is_none_is_told_in_a_sentence(file, target):
    answer = f'{{"grunt": ("{target}", "Grunt.")}}'
    rude = str(file("rude_two.py", COMMANDS.replace("{}", answer) + "HOOK = 3\n"))
    done = CliRunner().invoke(main, ["--plugin", rude, "grunt"])
    assert done.exit_code == 2
    assert f"points to {target}, and there is no such Command" in done.output


@pytest.mark.parametrize("answer", ['{"a": "m:a"}', '{"a": ("m:a",)}', '{"a": ("m:a", 3)}', '{"a": ("m", "b")}', "[1]"])
def test_a_wrong_answer_about_commands_is_refused(installed, answer):
    installed("odd_one", COMMANDS.replace("{}", answer))
    assert "hook 'lostmotion_commands' returned" in aside("odd_one").why
