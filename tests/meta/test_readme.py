"""What the README says is true: its commands are those of the check, its counts are right, its links exist."""

import json
import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import click
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


def counts():
    """Return how many of our plugins there are: models, terms, and methods of the laboratory."""
    kinds = Counter(e["kind"] for e in lostmotion("plugins") if e["owner"] == "lostmotion")
    methods = sum(kinds[kind] for kind in ("embedder", "quantifier", "surrogate", "denoiser"))
    return f"{kinds['model']} models, {kinds['term']} terms and {methods} methods"


def test_two_commands_do_all_the_set_up():
    assert [block.strip() for block in blocks("sh") if "venv" in block] == [DEMO, TESTS]


def test_the_check_runs_the_same_command():
    assert f"\n{TESTS} " in page(".ci/run") or f"\n    {TESTS}\n" in page(".ci/run")


def test_opening_is_short_and_has_one_picture():
    opening = page().partition("\n## ")[0]
    assert len(re.findall(r"!\[", opening)) == len(re.findall(r"!\[", page())) == 1
    assert (ROOT / "framework" / "hero.png").stat().st_size < 200_000


def test_the_library_is_as_large_as_it_says():
    assert counts() in page()


def test_it_is_read_in_a_few_minutes():
    assert len(page().splitlines()) < 200


@pytest.mark.parametrize("name", PAGES)
def test_links_lead_somewhere(name):
    links = re.findall(r"\]\(([^)#]+)[^)]*\)", page(name))
    assert [link for link in links if not (ROOT / name).parent.joinpath(link).exists()] == []


@pytest.mark.parametrize("name", [*PAGES, ".ci/run", "pyproject.toml", ".pre-commit-config.yaml"])
def test_no_address_of_an_index_and_no_path_of_a_machine(name):
    assert not INDEX.search(page(name))
    assert not MACHINE.search(page(name))


def test_recording_and_case_of_the_readme_belong_together(tmp_path):
    from lostmotion.preparation.prepare import prepare
    from lostmotion.registry import Registry

    (command,) = (block.split() for block in blocks("sh") if "lostmotion simulate" in block)
    subprocess.run([sys.executable, "-m", *command], cwd=tmp_path, capture_output=True, check=True, env=os.environ)
    path = tmp_path / "case.toml"
    path.write_text(blocks("toml")[0], encoding="utf-8")
    assert load_case(path).model == "lin_backlash"
    (observation,) = prepare(path, Registry.discover()).observations
    assert observation.samples == 3200


def test_objects_of_the_readme_make_a_case(tmp_path):
    (code,) = blocks("python")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("<Case 'case': equations on recording; known ['m'], estimated ['c', 'k']>")


def test_commands_of_the_readme_exist():
    named = re.findall(r"lostmotion (?:--plugin \S+ )?([a-z]+)\b", "\n".join(blocks("sh")))
    assert set(named) <= set(main.find_commands(click.Context(main)))
