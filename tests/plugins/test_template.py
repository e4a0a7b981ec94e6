"""The template is a living package: built, installed beside ours, listed, checked."""

import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

TEMPLATE = Path(__file__).parents[2] / "plugins" / "template"
NAMES = ("driven_pendulum", "maxwell_element")


def run(*command, cwd, **env):
    done = subprocess.run(
        [sys.executable, *command], cwd=cwd, env=os.environ | env, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Return a folder into which the wheel of a copy of the template has been installed."""
    home = tmp_path_factory.mktemp("template")
    shutil.copytree(TEMPLATE, home / "src", ignore=shutil.ignore_patterns("dist", "__pycache__", ".*"))
    run("-m", "build", "--wheel", "--no-isolation", "--outdir", home / "dist", home / "src", cwd=home)
    (wheel,) = (home / "dist").glob("*.whl")
    pip = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--no-index")
    run(*pip, "--target", home / "site", wheel, cwd=home)
    return home / "site"


def test_its_names_are_listed(installed):
    listing = json.loads(run("-m", "lostmotion", "plugins", "--json", cwd=installed, PYTHONPATH=str(installed)))
    mine = {e["name"]: e for e in listing["plugins"] if e["owner"] == "lostmotion-template"}
    assert set(mine) == set(NAMES)
    assert {e["state"] for e in mine.values()} == {"ready"}
    assert {e["version"] for e in mine.values()} == {"0.1.0"}


def test_it_keeps_every_rule(installed):
    text = run("-m", "lostmotion", "plugins", "check", *NAMES, cwd=installed, PYTHONPATH=str(installed))
    assert "FAIL" not in text
    assert text.rstrip().endswith("0 broken")


def test_its_own_tests_pass(installed, tmp_path):
    tests = shutil.copytree(TEMPLATE / "tests", tmp_path / "tests")
    shutil.copy(TEMPLATE / "pyproject.toml", tmp_path)
    options = ("-q", "-p", "no:cacheprovider", "-k", "compiles or zero")
    text = run("-m", "pytest", *options, tests, cwd=tmp_path, PYTHONPATH=str(installed))
    assert "3 passed" in text


def test_the_root_wheel_leaves_it_out(tmp_path):
    root = TEMPLATE.parents[1]
    run("-m", "build", "--wheel", "--no-isolation", "--outdir", tmp_path, root, cwd=tmp_path)
    (wheel,) = tmp_path.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert "lostmotion/registry/__init__.py" in names
    assert [n for n in names if "lostmotion_template" in n or n.startswith("template")] == []
