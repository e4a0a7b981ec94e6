"""The template is a living package: built, installed beside ours, listed, checked."""

import json
import math
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

TEMPLATE = Path(__file__).parents[2] / "plugins" / "template"
NAMES = ("driven_pendulum", "flicker_noise", "maxwell_element", "two_joint_arm", "two_link")


def run(*command, cwd, python=sys.executable):
    done = subprocess.run([python, *command], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def renamed(folder):
    """Return a copy of the template, renamed as its README says."""
    shutil.copytree(TEMPLATE, folder, ignore=shutil.ignore_patterns("dist", "__pycache__", ".*"))
    (folder / "src" / "lostmotion_template").rename(folder / "src" / "lostmotion_mine")
    for path in (p for p in folder.rglob("*") if p.suffix in (".py", ".toml")):
        text = path.read_text(encoding="utf-8").replace("lostmotion_template", "lostmotion_mine")
        path.write_text(text.replace("lostmotion-template", "lostmotion-mine"), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    """Return the Python of a new environment: the wheel of a copy is installed in it, all else is looked up in ours."""
    home = tmp_path_factory.mktemp("template")
    source = renamed(home / "source")
    run("-m", "build", "--wheel", "--no-isolation", "--outdir", home / "dist", source, cwd=home)
    (wheel,) = (home / "dist").glob("*.whl")
    run("-m", "venv", "--without-pip", home / "fresh", cwd=home)
    python = home / "fresh" / "bin" / "python"
    site = Path(run("-c", "import sysconfig; print(sysconfig.get_path('purelib'))", cwd=home, python=python).strip())
    # Nothing is downloaded: packages of the environment that runs the tests are found behind those of the new one.
    (site / "beside.pth").write_text(f"import site; site.addsitedir({sysconfig.get_path('purelib')!r})\n")
    pip = ("-m", "pip", "--python", python, "install", "--quiet", "--disable-pip-version-check")
    run(*pip, "--no-deps", "--no-index", wheel, cwd=home)
    assert (site / "lostmotion_mine").is_dir()
    return python


@pytest.fixture
def ours(fresh, tmp_path):
    """Return a function that runs `lostmotion` in the new environment, far from the source."""
    return lambda *words: run("-m", "lostmotion", *words, cwd=tmp_path, python=fresh)


def test_its_names_are_listed(ours):
    listing = json.loads(ours("plugins", "--json"))
    mine = {e["name"]: e for e in listing["plugins"] if e["owner"] == "lostmotion-mine"}
    assert set(mine) == {*NAMES, "crest", "power", "readings"}
    assert {e["state"] for e in mine.values()} == {"ready"}
    assert {e["version"] for e in mine.values()} == {"0.1.0"}
    assert "lin_backlash" in {e["name"] for e in listing["plugins"]}


def test_its_command_runs(ours, tmp_path):
    """The crest factor of a sine is the root of two."""
    rows = [f"{k / 100.0},{math.sin(0.3 * k)}" for k in range(4000)]
    (tmp_path / "sine.csv").write_text("\n".join(["time,x", *rows]), encoding="utf-8")
    assert "crest" in ours("--help")
    assert "crest factor 1.41" in ours(
        "crest", "sine.csv", "--time", "time", "--sensor", "position=x", "--unit", "position=mm"
    )


def test_it_keeps_every_rule(ours):
    text = ours("plugins", "check", *NAMES)
    assert "FAIL" not in text
    assert text.rstrip().endswith("0 broken")


CASE = """
[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N m" }
response = { column = "position", quantity = "position", unit = "rad" }

[model]
name = "driven_pendulum"
known = { m = 1.0 }

[model.estimate]
c = { low = 0.02, high = 2.0, scale = "log" }
mgl = { low = 0.5, high = 50.0, scale = "log" }
"""


def simulated(ours, samples):
    """Return what `simulate` says of the template's machine with the template's term."""
    duration = ("--duration", samples / 20.0, "--rate", 20, "--noise", 0.01, "--out", "recording.csv")
    term = ("--term", "maxwell_element:stiffness=3,relaxation=0.5")
    drive = ("--drive", "harmonic:amplitude=2,omega=2", "--drive", "harmonic:amplitude=1,omega=3.1")
    return ours("simulate", "driven_pendulum", "--set", "m=1,c=0.2,mgl=5", *term, *drive, *map(str, duration))


def test_it_is_simulated(ours, tmp_path):
    assert "100 samples of driven_pendulum + maxwell_element" in simulated(ours, 100)
    assert (tmp_path / "recording.csv").read_text().startswith("time,force,position,velocity\n")


@pytest.mark.slow
def test_its_term_is_found_in_its_model(ours, tmp_path):
    simulated(ours, 1200)
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    ours("diagnose", "case.toml", "--out", "result", "--quiet")
    said = json.loads((tmp_path / "result" / "diagnosis.json").read_text(encoding="utf-8"))
    assert "maxwell_element@ground" in said["provenance"]["settings"]["terms"]
    assert said["provenance"]["inputs"]["lostmotion-mine"] == "0.1.0"
    assert [found["mechanism"] for found in said["found"]] == ["maxwell_element"]


def test_its_own_tests_pass(fresh, tmp_path):
    source = renamed(tmp_path / "source")
    options = ("-q", "-p", "no:cacheprovider", "-k", "compiles or zero")
    assert "4 passed" in run("-m", "pytest", *options, source / "tests", cwd=source, python=fresh)


def test_the_root_wheel_leaves_it_out(tmp_path):
    root = TEMPLATE.parents[1]
    run("-m", "build", "--wheel", "--no-isolation", "--outdir", tmp_path, root, cwd=tmp_path)
    (wheel,) = tmp_path.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert "lostmotion/registry/__init__.py" in names
    assert [n for n in names if "lostmotion_template" in n or n.startswith("template")] == []
