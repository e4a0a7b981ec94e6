"""The command line: one sentence for an error, and what `lostmotion plugins` prints."""

import json
import os
import subprocess
import sys
from types import ModuleType

import click
import pytest
from click.shell_completion import ShellComplete
from click.testing import CliRunner

from lostmotion import __version__, registry
from lostmotion.cli import main
from lostmotion.cli._lazy import LazyGroup
from lostmotion.errors import DataError

FILE = '''"""Terms of my own."""
from __future__ import annotations
from dataclasses import dataclass
from typing import ClassVar
from lostmotion.contracts import Param, Term
from lostmotion.quantities import DAMPING

@dataclass(frozen=True)
class Drag(Term):
    """A drag."""
    at: str = "ground"
    name: ClassVar[str] = "my_drag"
    physics: ClassVar[str] = "Drag of {size} acts"
    formula: ClassVar[str] = "-size * v"
    paper: ClassVar[str] = "Stokes (1851)"
    params = (Param("size", "drag", DAMPING, low=0.0, null=0.0),)
    @staticmethod
    def force(t, x, v, u, p, s):
        return OFFSET - p[0] * v
'''


@pytest.fixture(autouse=True)
def fresh():
    """Forget what a test adds to the registry of this process."""
    registry.default.cache_clear()
    yield
    registry.default.cache_clear()


@pytest.fixture
def file(tmp_path):
    def write(offset):
        path = tmp_path / "my_cli_terms.py"
        path.write_text(FILE.replace("OFFSET", offset))
        return str(path)

    yield write
    sys.modules.pop("my_cli_terms", None)


def run(*args, status=0):
    done = CliRunner().invoke(main, args, prog_name="lostmotion")
    assert done.exit_code == status, done.output
    return done.output


def test_help_names_every_command_and_imports_none():
    text = run("-h")
    for name, (_, line) in main.find_commands(click.Context(main)).items():
        assert f"{name} " in text
        assert line in text
    assert text == run("--help")


def test_version():
    assert run("--version") == f"lostmotion {__version__}\n"


def test_an_unknown_command_is_told_with_the_nearest():
    assert "there is no command 'plugns' (did you mean 'plugins'?)" in run("plugns", status=2)


def test_the_table_shows_kind_name_owner_and_state():
    lines = run("plugins").splitlines()
    assert lines[0].split() == ["kind", "name", "owner", "state"]
    assert ["term", "coulomb_friction", "lostmotion", __version__, "ready"] in [line.split() for line in lines]


def test_json_has_schema_and_provenance():
    content = json.loads(run("plugins", "--json"))
    assert content["schema"] == "lostmotion.plugins/1"
    assert content["provenance"]["lostmotion"] == __version__
    (entry,) = [e for e in content["plugins"] if e["name"] == "lin_backlash"]
    assert entry["kind"] == "model"
    assert entry["state"] == "ready"


def test_what_is_not_ready_is_told_in_sentences(file):
    registry.default().add_file(file("0.0")).add_file(file("0.0"))
    registry.default().add(registry.default().load("term", "my_drag"), "a rival")
    text = run("plugins")
    assert "a rival" in text
    assert text.count("term 'my_drag' is offered by") == 1


def test_show_prints_what_a_model_says_of_itself():
    text = run("plugins", "show", "robot_joint")
    for part in (
        "robot_joint (model of lostmotion",
        "inputs     base_position, base_velocity",
        "channels   position, velocity, acceleration",
        "interface  base: acts on row 1 through m, holds k0, x0",
        "c: viscous damping in the joint in N m s/rad, from 0 to inf, log, also called damping",
        "paper      Tjahjowidodo",
    ):
        assert part in text


def test_show_prints_what_a_term_says_of_itself():
    text = run("plugins", "show", "viscous_damping")
    assert "physics    Viscous damping of {coefficient} slows the motion" in text
    assert "formula    -coefficient * v" in text
    assert "viscous coefficient in N s/m or N m s/rad, from 0 to inf, linear, does nothing at 0" in text


@pytest.mark.parametrize("args", [("--json", "show", "lin_backlash"), ("show", "lin_backlash", "--json")])
def test_show_for_machines(args):
    (sheet,) = json.loads(run("plugins", *args))["plugins"]
    assert sheet["parameters"][0]["units"] == {"translation": "kg", "rotation": "kg m^2"}
    assert sheet["parameters"][0]["high"] is None
    assert sheet["interfaces"][0]["holds"] == ["k0", "x0"]


@pytest.mark.parametrize("command", ["show", "check"])
def test_an_unknown_name_is_one_sentence_and_status_2(command):
    text = run("plugins", command, "coulom_friction", status=2)
    assert text == (
        "lostmotion: no plugin is called 'coulom_friction' (did you mean 'coulomb_friction'?): "
        "`lostmotion plugins` lists them\n"
    )


def test_check_says_ok_for_each_rule(file):
    text = run("--plugin", file("0.0"), "plugins", "check", "my_drag")
    assert "  ok    force_is_zero_at_null\n" in text
    assert "FAIL" not in text


def test_check_fails_with_the_advice_and_status_1(file):
    text = run("--plugin", file("1.0"), "plugins", "check", "my_drag", status=1)
    assert "  FAIL  force_is_zero_at_null\n        the force is 1.0" in text
    assert "Return a force of exactly 0" in " ".join(text.split())
    assert "1 broken" in text


def test_check_for_machines(file):
    content = json.loads(run("--plugin", file("1.0"), "plugins", "check", "my_drag", "--json", status=1))
    broken = [r for r in content["checks"][0]["rules"] if not r["ok"]]
    assert [r["rule"] for r in broken] == ["force_is_zero_at_null"]


def test_a_plugin_file_that_is_not_there_is_one_sentence():
    text = run("--plugin", "nowhere.py", "plugins", status=2)
    assert text.startswith("lostmotion: plugin file 'nowhere.py' does not exist")
    assert len(text.splitlines()) == 1


def completed(*words):
    shell = ShellComplete(main, {}, "lostmotion", "_LOSTMOTION_COMPLETE")
    return {item.value for item in shell.get_completions(list(words[:-1]), words[-1])}


def test_the_tab_key_completes_commands_and_names(file):
    assert completed("pl") == {"plugins"}
    assert completed("plugins", "show", "coulomb") == {"coulomb_friction"}
    assert completed("--plugin", file("0.0"), "plugins", "check", "my_") == {"my_drag"}
    assert completed("--plugin", "nowhere.py", "plugins", "check", "lugre") == {"lugre_friction"}


@pytest.mark.parametrize(
    ("error", "status", "says"),
    [
        (DataError("the file is empty:\n record something"), 2, "lostmotion: the file is empty: record something\n"),
        (KeyboardInterrupt(), 130, "lostmotion: interrupted\n"),
        (click.Abort(), 130, "lostmotion: interrupted\n"),
    ],
)
def test_errors_of_ours_and_ctrl_c(monkeypatch, error, status, says):
    @click.command()
    def stop():
        raise error

    module = ModuleType("command_that_stops")
    module.command = stop
    monkeypatch.setitem(sys.modules, "command_that_stops", module)

    class Commands(LazyGroup):
        table = {"stop": ("command_that_stops:command", "Stop.")}  # noqa: RUF012

    done = CliRunner().invoke(Commands("lostmotion"), ["stop"])
    assert (done.exit_code, done.output) == (status, says)


def test_a_reader_that_goes_away_is_no_error():
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [sys.executable, "-m", "lostmotion", "plugins"], stdout=writer, stderr=subprocess.PIPE, check=False
    )
    os.close(writer)
    assert done.stderr == b""
