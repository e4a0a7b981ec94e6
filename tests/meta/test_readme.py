"""What the README says is true: its commands are those of the check, its table is the list, its links exist."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from lostmotion.case import load_case
from lostmotion.cli import main

ROOT = Path(__file__).parents[2]
SET_UP = 'python3 -m venv .venv && .venv/bin/pip install -q -e ".[test]" && '
DEMO = SET_UP + ".venv/bin/lostmotion demo"
TESTS = SET_UP + ".venv/bin/pytest -q -n auto"
PAGES = ("README.md", "CHANGELOG.md", "framework/ARCHITECTURE.md", "plugins/template/README.md")
INDEX = re.compile(r"pypi|pythonhosted|index-url|anaconda\.org|/simple\b|badge", re.IGNORECASE)
MACHINE = re.compile(r"(?<![\w.!])/(home|root|work|tmp|Users|opt|usr)/")


def page(name="README.md"):
    return (ROOT / name).read_text(encoding="utf-8")


def blocks(language):
    """Return the code blocks of the README in one language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", page(), flags=re.MULTILINE | re.DOTALL)


def lostmotion(*args):
    """Return what a command prints as JSON."""
    done = CliRunner().invoke(main, [*args, "--json"], prog_name="lostmotion")
    assert done.exit_code == 0, done.output
    return json.loads(done.output)["plugins"]


def table():
    """Return the table of our plugins as the README should have it."""
    ours = [e for e in lostmotion("plugins") if e["owner"] == "lostmotion"]
    rows = [(e["kind"], *said(e["name"])) for e in ours]
    lines = [f"| {kind} | `{name}` | {words} |" for kind, name, words in rows]
    return "\n".join(["| kind | name | what it is |", "|---|---|---|", *lines])


def said(name):
    """Return the name and the law of a plugin: the formula of a term, the first sentence about any other, uncited."""
    (sheet,) = lostmotion("plugins", "show", name)
    words = sheet.get("formula") or re.split(r"\. [A-Z`]|: [A-Z][a-z]+, ", sheet["about"])[0].removesuffix(".")
    return name, words.replace("|", "\\|").replace("*", "\\*")


def test_two_commands_do_all_the_set_up():
    assert [block.strip() for block in blocks("sh") if "venv" in block] == [DEMO, TESTS]


def test_the_check_runs_the_same_command():
    assert f"\n{TESTS} " in page(".ci/run") or f"\n    {TESTS}\n" in page(".ci/run")


def test_opening_is_short_and_has_one_picture():
    opening = page().partition("\n## ")[0]
    assert len(re.findall(r"!\[", opening)) == len(re.findall(r"!\[", page())) == 1
    assert (ROOT / "framework" / "hero.png").stat().st_size < 200_000


def test_table_is_the_list_of_plugins():
    assert f"\n{table()}\n" in page(), f"the table should read\n{table()}"


@pytest.mark.parametrize("name", PAGES)
def test_links_lead_somewhere(name):
    links = re.findall(r"\]\(([^)#]+)[^)]*\)", page(name))
    assert [link for link in links if not (ROOT / name).parent.joinpath(link).exists()] == []


@pytest.mark.parametrize("name", [*PAGES, ".ci/run", "pyproject.toml", ".pre-commit-config.yaml"])
def test_no_address_of_an_index_and_no_path_of_a_machine(name):
    assert not INDEX.search(page(name))
    assert not MACHINE.search(page(name))


def test_term_of_the_readme_keeps_every_rule(tmp_path):
    (code,) = (block for block in blocks("python") if "(Term)" in block)
    (tmp_path / "my_terms.py").write_text(code, encoding="utf-8")
    command = ("-m", "lostmotion", "--plugin", "my_terms.py", "plugins", "check", "magnet")
    done = subprocess.run([sys.executable, *command], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.rstrip().endswith("0 broken")


def test_recording_and_case_of_the_readme_belong_together(tmp_path):
    from lostmotion.registry import Registry
    from lostmotion.workflow.prepare import prepare

    (command,) = (block.split() for block in blocks("sh") if "lostmotion simulate" in block)
    subprocess.run([sys.executable, "-m", *command], cwd=tmp_path, capture_output=True, check=True, env=os.environ)
    path = tmp_path / "case.toml"
    path.write_text(blocks("toml")[0], encoding="utf-8")
    assert load_case(path).model == "lin_backlash"
    (observation,) = prepare(path, Registry.discover()).observations
    assert observation.samples == 3200
    (steps,) = (block for block in blocks("python") if "surrogate_test" in block)
    done = subprocess.run([sys.executable, "-c", steps], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.split()) == 6


def test_levels_of_the_readme_make_a_case(tmp_path):
    (tmp_path / "levels.toml").write_text(blocks("toml")[1], encoding="utf-8")
    periodic, chaotic = load_case(tmp_path / "levels.toml").levels
    assert periodic.motion == "periodic"
    assert chaotic.lyapunov.value == pytest.approx(1.42 * 0.693147, rel=1e-5)


def test_commands_of_the_readme_exist():
    named = re.findall(r"lostmotion (?:--plugin \S+ )?([a-z]+)\b", "\n".join(blocks("sh")))
    assert set(named) <= set(main.table)
