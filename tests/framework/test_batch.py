"""Many cases in one go: folders of their names, what is broken set aside, and only what is new made again."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from answers import answer, entry, interval, plain
from click.testing import CliRunner

from lostmotion.campaigns import batch
from lostmotion.campaigns.campaign import Campaign
from lostmotion.campaigns.summary import format_summary, make_row
from lostmotion.cli import main
from lostmotion.errors import CaseError, DataError, PlaceError
from lostmotion.preparation.prepare import case_of
from lostmotion.provenance import digest, provenance
from lostmotion.settings import DEFAULT
from lostmotion_trials.blind.commitment import Blind, conceal_case

CASE = """
title = "{name}"

[[recordings]]
file = "{name}.csv"
time = "t"
excitation = {{ column = "u", quantity = "force", unit = "N" }}
response = {{ column = "x", quantity = "position", unit = "m" }}

[model]
name = "linear_oscillator"
known = {{ m = 1.0 }}
estimate = {{ c = {{ low = 1.0, high = 2.0 }} }}
"""
PLUGIN = """
from lostmotion.hookspecs import hookimpl

@hookimpl
def lostmotion_terms():
    return {"mine": "mine:Mine"}
"""
FRICTION = entry("coulomb_friction", "ground", share_of_drive=0.03)
PARAMETERS = {
    "before": {"c": interval(10.0), "x0": interval(2.0), "zero": interval(0.0)},
    "after": {"c": interval(8.0), "x0": interval(2.2), "zero": interval(1.0), "force": interval(3.0)},
}
ENOUGH, PATIENCE = 3, 300.0


def content(**changes):
    says = ["Dry friction, it says.", "And more."]
    return plain(**{"found": [FRICTION], "parameters": PARAMETERS, "says": says, **changes})


@pytest.fixture
def calls(monkeypatch):
    """Stub the diagnosis, and make it in this process; return the list of cases that were diagnosed."""
    made = []

    def diagnosis(path, out, registry, *, seed, jobs, settings):
        made.append(path.stem)
        case = case_of(path, registry)
        if (word := (path.parent / case.recordings[0].file).read_text(encoding="utf-8")) in FAILURES:
            raise FAILURES[word]
        out.mkdir(parents=True)
        inputs = {"case": case.digest, path.stem: digest(path.with_suffix(".csv")), **registry.origins()}
        told = {
            **content(),
            "provenance": provenance("diagnose", {"terms": [1], "thresholds": settings.as_dict()}, seed, inputs),
            "jobs": jobs,
        }
        for name in batch.FILES:
            (out / name).write_text(json.dumps(told), encoding="utf-8")

    monkeypatch.setattr(batch, "run_diagnosis", diagnosis)
    monkeypatch.setattr(
        batch, "Campaign", lambda trial, kind, count, identity, **_: Campaign(trial, kind, count, identity)
    )
    return made


FAILURES = {
    "broken": DataError("the recording is\nbroken: mend it"),
    "bug": KeyError("x"),
    "large": MemoryError(),
    "full": PlaceError("the disk is full"),
}


def cases(folder, **recordings):
    """Return the paths of cases, the recordings of which hold these texts."""
    folder.mkdir(exist_ok=True)
    for name, text in recordings.items():
        (folder / f"{name}.toml").write_text(CASE.format(name=name), encoding="utf-8")
        (folder / f"{name}.csv").write_text(text, encoding="utf-8")
    return [folder / f"{name}.toml" for name in recordings]


def diagnose(paths, out, *args):
    line = ["diagnose", *map(str, paths), "--out", str(out), "--jobs", "1", *args]
    return CliRunner().invoke(main, line, prog_name="lostmotion")


def rows_of(out):
    with (out / "summary.csv").open(encoding="utf-8", newline="") as stream:
        return {row["case"]: row for row in csv.DictReader(stream)}


def files(out):
    return {str(p.relative_to(out)): p.read_bytes() for p in sorted(out.rglob("*")) if p.is_file()}


def test_broken_ones_are_set_aside_and_the_rest_is_done(tmp_path, calls):
    done = diagnose(cases(tmp_path / "in", a="1", b="broken", c="bug", d="large", e="2"), tmp_path / "out")
    rows = rows_of(tmp_path / "out")
    assert done.exit_code == 1
    assert [rows[name]["status"] for name in "abcde"] == ["diagnosed", *["set aside"] * 3, "diagnosed"]
    assert "lostmotion: b is set aside: the recording is broken: mend it\n" in done.stderr
    assert "c is set aside: it failed (KeyError: 'x')" in done.stderr
    assert "d is set aside: there is not enough memory" in done.stderr
    assert done.stdout.splitlines()[:2] == ["2 of 5 cases diagnosed, 3 set aside", "  2  coulomb_friction@ground"]
    assert {p.name for p in (tmp_path / "out").iterdir()} == {"a", "e", "summary.csv", ".campaign"}
    assert json.loads((tmp_path / "out" / "a" / "diagnosis.json").read_text())["jobs"] == 1


@pytest.mark.parametrize(("texts", "status"), [("12", 0), (("broken", "broken"), 2), (("1", "full"), 2)])
def test_exit_status_tells_all_from_none(tmp_path, calls, texts, status):
    done = diagnose(cases(tmp_path / "in", a=texts[0], b=texts[1]), tmp_path / "out")
    assert done.exit_code == status, done.output
    assert "Traceback" not in done.output


def test_only_what_is_new_is_made_again_and_the_bytes_are_those_of_one_go(tmp_path, calls):
    paths, out = cases(tmp_path / "in", a="1", b="broken", d="3"), tmp_path / "out"
    diagnose(paths, out)
    diagnose(paths, out)
    assert calls == ["a", "b", "d", "b"]
    (out / "d" / "report.html").unlink()
    more = cases(tmp_path / "in", a="1", b="2", c="5", d="3")
    assert diagnose(more, out).exit_code == 0
    assert calls[4:] == ["b", "c", "d"]
    diagnose(more, tmp_path / "whole")
    assert files(out) == files(tmp_path / "whole")


@pytest.mark.parametrize("what", ["seed", "recording", "plugin", "damaged", "settings"])
def test_a_diagnosis_of_something_else_is_made_again(tmp_path, calls, what):
    paths, out = cases(tmp_path / "in", a="1", b="2"), tmp_path / "out"
    diagnose(paths, out)
    plugin = tmp_path / "mine.py"
    plugin.write_text(PLUGIN, encoding="utf-8")
    if what == "recording":
        cases(tmp_path / "in", b="3")
    if what == "damaged":
        (out / "b" / "diagnosis.json").write_text("{", encoding="utf-8")
    brought = (str(plugin),) if what == "plugin" else ()
    settings = DEFAULT.changed({"select.decisive": 4.0} if what == "settings" else {})
    again = batch.Batch(batch.name_cases(paths), out, brought, int(what == "seed"), settings)
    batch.run_batch(again, jobs=1)
    assert calls[2:] == (["a", "b"] if what in ("seed", "plugin", "settings") else ["b"])


def test_a_case_that_broke_since_loses_its_old_diagnosis_and_nothing_else(tmp_path, calls):
    paths, out = cases(tmp_path / "in", a="1", b="2"), tmp_path / "out"
    diagnose(paths, out)
    (out / "b" / "mine.txt").write_text("kept", encoding="utf-8")
    diagnose(cases(tmp_path / "in", a="1", b="broken"), out)
    assert [p.name for p in (out / "b").iterdir()] == ["mine.txt"]


@pytest.mark.parametrize(
    ("paths", "names"),
    [
        (("/m/a.toml", "/m/b.toml", "/m/a.toml"), ["a", "b"]),
        (("/m/a/case.toml", "/m/b/case.toml", "/m/c.toml"), ["a-case", "b-case", "c"]),
        (("/m/x/a/case.toml", "/m/y/a/case.toml", "/m/a-case.toml"), ["x-a-case", "y-a-case", "m-a-case"]),
        (("/m/a.toml", "/n/A.toml", "/m/.campaign.toml"), ["m-a", "n-A", "m-.campaign"]),
    ],
)
def test_names_that_clash_get_folders_in_front(paths, names):
    assert [name for name, _ in batch.name_cases(list(map(Path, paths)))] == names


def test_names_that_cannot_be_told_apart_are_refused():
    with pytest.raises(CaseError, match=r"a\.toml and another case would share the folder"):
        batch.name_cases([Path("/m/a.toml"), Path("/m/A.toml")])


def test_a_row_tells_what_moved_most_and_an_adequate_case_has_little_to_tell():
    row = make_row("a", answer(found=[FRICTION, entry("random_force", probability=0.8)], parameters=PARAMETERS))
    assert (row.move.moved, row.move.moved_by) == ("c", pytest.approx(-0.2))
    assert (row.mechanisms, row.probability) == ("coulomb_friction@ground + random_force", 0.8)
    plain = make_row("b", answer(verdict="adequate"))
    assert (plain.probability, plain.share_of_drive, plain.move) == (None, None, None)
    assert format_summary([row, plain, plain]) == [
        "3 of 3 cases diagnosed", "  2  adequate", "  1  coulomb_friction@ground + random_force",
    ]  # fmt: skip


@pytest.mark.slow
def test_twelve_real_cases_two_of_them_broken_killed_and_gone_on_with(tmp_path):
    clean = Blind(3, 400, (), True)
    paths = [tmp_path / "cases" / conceal_case(clean, tmp_path, k).case / "case.toml" for k in range(12)]
    (paths[2].parent / "recording.csv").write_text("time,excitation,response\n0,1\n", encoding="utf-8")
    paths[7].write_text(paths[7].read_text(encoding="utf-8").replace("title", "tittle"), encoding="utf-8")
    out = tmp_path / "out"
    line = [sys.executable, "-m", "lostmotion", "diagnose", *map(str, paths), "--out", str(out), "--jobs", "2"]
    process, until = subprocess.Popen(line), time.monotonic() + PATIENCE
    while len(list(out.glob("*/report.html"))) < ENOUGH:
        assert time.monotonic() < until
        time.sleep(0.1)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    whole = {p: p.stat().st_mtime_ns for p in out.glob("*/report.html")}
    done = subprocess.run(line, capture_output=True, text=True)
    assert done.returncode == 1, done.stderr
    assert [name for name, row in rows_of(out).items() if row["status"] == "set aside"] == ["002-case", "007-case"]
    assert {p: p.stat().st_mtime_ns for p in whole} == whole
    for k in (0, 11):
        diagnose([paths[k]], tmp_path / "alone" / str(k))
        assert files(out / f"{k:03d}-case") == files(tmp_path / "alone" / str(k))
