"""A campaign that is killed goes on and ends with the same bytes, and its summary tells good posteriors from bad."""

import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from toy_campaign import COUNT, Fate, Maker, buried, campaign, deadly, placed, whoami

from lostmotion.campaigns.campaign import Campaign
from lostmotion.case import Prior
from lostmotion.codec import to_plain
from lostmotion.errors import DataError
from lostmotion.storage import save_json
from lostmotion_trials.coverage.design import Design, make_workshop
from lostmotion_trials.coverage.machines import Stand
from lostmotion_trials.coverage.page import write_calibration
from lostmotion_trials.coverage.ranks import DRAWS, compute_coverage_limits, compute_ecdf_band, count_below
from lostmotion_trials.coverage.results import CalibrationResult, Coverage, LostMachine, MachineTrial
from lostmotion_trials.coverage.run import _save_csv, is_sound, summarise

PERFECT = 2000
TOY = """
import sys
from pathlib import Path
sys.path.insert(0, {here!r})
from toy_campaign import campaign
if __name__ == "__main__":
    campaign(gate=Path({gate!r})).run(Path({out!r}), {jobs})
"""
PATIENCE = 240.0
"""Seconds that a busy machine may take to begin or to end a few processes."""


def files(folder):
    return {p.name: p.read_bytes() for p in sorted(folder.glob("trials/*"))}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A campaign that nothing disturbed, on one core."""
    out = tmp_path_factory.mktemp("whole")
    campaign().run(out, 1)
    return out


def heard():
    """Hear an interrupt: a shell lets what it runs in the background ignore it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def began(tmp_path, jobs):
    """Return a campaign in a process of its own that has finished a few trials."""
    script = tmp_path / "toy.py"
    told = {"here": str(Path(__file__).parent), "out": str(tmp_path / "out"), "gate": str(tmp_path / "gate")}
    script.write_text(TOY.format(**told, jobs=jobs))
    process = subprocess.Popen([sys.executable, str(script)], env=os.environ, start_new_session=True, preexec_fn=heard)
    soon(lambda: len(list((tmp_path / "out" / "trials").glob("0*.json"))) >= 2)
    return process


def soon(holds):
    """Wait until something holds."""
    until = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < until
        time.sleep(0.02)


def gone(group):
    """Return whether no process is left of a group."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return True
    return False


@pytest.mark.parametrize(
    ("jobs", "how"),
    [
        (2, signal.SIGKILL),
        (2, signal.SIGINT),
        pytest.param(1, signal.SIGKILL, marks=pytest.mark.slow),
    ],
)
def test_a_killed_campaign_goes_on_with_the_same_bytes(tmp_path, whole, jobs, how):
    process, out = began(tmp_path, jobs), tmp_path / "out"
    os.kill(process.pid, how)
    (tmp_path / "gate").touch()
    process.wait(PATIENCE)
    soon(lambda: gone(process.pid))
    left = [name for name in files(out) if not name.startswith(".")]
    assert 2 <= len(left) < COUNT
    told = []
    campaign().run(out, 1, lambda done, of: told.append((done, of)))
    assert told[0] == (len(left), COUNT)
    assert told[-1] == (COUNT, COUNT)
    assert files(out) == files(whole)


@pytest.mark.slow
def test_the_number_of_processes_changes_no_byte(tmp_path, whole):
    campaign().run(tmp_path, 2)
    assert files(tmp_path) == files(whole)


def test_a_campaign_can_be_enlarged(tmp_path, whole):
    campaign(count=5).run(tmp_path, 1)
    campaign().run(tmp_path, 1)
    assert files(tmp_path) == files(whole)


def test_another_campaign_is_refused_unless_fresh(tmp_path):
    campaign(count=3).run(tmp_path, 1)
    other = campaign(count=2, identity={"settings": {"noise": 2.0}, "seed": 3})
    with pytest.raises(DataError, match=r"made otherwise \(noise 1.0, now 2.0\).*--fresh to start over"):
        other.run(tmp_path, 1)
    other.run(tmp_path, 1, fresh=True)
    assert len(files(tmp_path)) == 2


def test_what_is_none_of_ours_is_left_alone(tmp_path):
    (tmp_path / "trials").mkdir()
    (tmp_path / "trials" / "mine.txt").write_text("dear")
    for fresh in (False, True):
        with pytest.raises(DataError, match="not a campaign"):
            campaign().run(tmp_path, 1, fresh=fresh)
    (tmp_path / "campaign.json").write_text("{}")
    with pytest.raises(DataError, match="not a campaign"):
        campaign().run(tmp_path, 1, fresh=True)
    assert (tmp_path / "trials" / "mine.txt").read_text() == "dear"


def broken(number):
    raise TypeError("a slip")


def test_a_slip_of_the_code_is_no_failed_machine(tmp_path):
    with pytest.raises(TypeError, match="a slip"):
        Campaign(broken, Fate, 3, {}).run(tmp_path, 1)


@pytest.mark.slow
def test_trials_whose_process_is_killed_are_lost_and_no_others(tmp_path):
    """What ran beside them is made again, and they are tried once more by themselves."""
    told = []
    made = Campaign(deadly, Fate, 7, {}, lost=buried).run(tmp_path, 2, lambda done, of: told.append(done))
    assert [row.number for row in made] == list(range(7))
    assert [row.number for row in made if row.lost] == [2, 5]
    assert told == list(range(8))


@pytest.mark.slow
def test_processes_are_renewed_so_that_memory_does_not_grow(tmp_path, monkeypatch):
    monkeypatch.setattr("lostmotion.campaigns.campaign.RENEWED", 2)
    made = Campaign(whoami, Maker, 9, {}).run(tmp_path, 2)
    assert [row.number for row in made] == list(range(9))
    makers = [{row.process for row in made[k : k + 4]} for k in (0, 4, 8)]
    assert not makers[0] & makers[1]
    assert not makers[1] & makers[2]


def test_without_a_word_for_the_lost_a_killed_process_ends_the_campaign(tmp_path):
    with pytest.raises(DataError, match="killed, perhaps for lack of memory"):
        Campaign(deadly, Fate, 7, {}).run(tmp_path, 2)


def rows(machines, *, width=1.0, shift=0.0, seed=0):
    """Return trials whose posteriors are N(shift, width^2) where N(0, 1) is right."""
    rng = np.random.default_rng(seed)
    truths = rng.standard_normal(machines)
    return [placed(k, t, shift + width * rng.standard_normal((4, 250))) for k, t in enumerate(truths)]


def test_a_right_posterior_passes():
    content = summarise(rows(200))
    assert content.passes is True
    assert content.parameters["a"].rms_z == pytest.approx(1.0, abs=0.15)
    assert content.says == (
        "The intervals are calibrated, tested with 200 machines: ranks are uniform, and intervals cover.",
    )


@pytest.mark.parametrize(
    ("wrong", "word"),
    [({"width": 0.6}, "too narrow"), ({"width": 1.8}, "too wide"), ({"shift": 0.6}, "biased.*below")],
)
def test_a_bad_posterior_does_not_pass(wrong, word):
    content = summarise(rows(200, **wrong))
    assert content.passes is False
    assert "not calibrated" in content.says[0]
    assert re.search(word, content.says[1])


def test_verdict_refuses_few_perfect_parameters():
    """The false alarms of the verdict on one parameter, at the level of one of two, are 3 % at the most."""
    rng = np.random.default_rng(8)
    below = rng.uniform(size=(PERFECT, 200))
    band = compute_ecdf_band(200, 0.005)
    counts = np.stack([count_below((b * (DRAWS + 1)).astype(int)) for b in below])
    wrong = ((counts < band.low) | (counts > band.high)).any(axis=1)
    for share in (0.5, 0.9, 0.95):
        low, high = compute_coverage_limits(200, share)
        inside = np.sum(np.abs(below - 0.5) <= 0.5 * share, axis=1)
        wrong |= (inside < low) | (inside > high)
    assert 0.005 < wrong.mean() < 0.03


def test_lost_machines_are_told_and_not_counted():
    lost = [MachineTrial(200 + k, "failed", "no", {}) for k in range(3)]
    content = summarise([*rows(200), *lost])
    assert content.passes is True
    assert content.failed == tuple(LostMachine(200 + k, "no") for k in range(3))
    assert "Of 203 machines 3 failed" in content.says[1]
    many = [MachineTrial(200 + k, "unconverged", "ESS", {}) for k in range(20)]
    content = summarise([*rows(200), *many])
    assert content.passes is False
    assert "have no posterior" in content.says[0]
    assert summarise(many).says[0] == "None of the machines has a posterior."
    assert summarise(many).passes is False


def test_page_shows_what_was_found(tmp_path):
    found = [*rows(60), MachineTrial(60, "failed", "the <motion> left", {})]
    head = CalibrationResult("s", "T & co", "m", "trajectory", "hand", {}, summarise(found), {})
    save_json(tmp_path / "calibration.json", to_plain(head))
    _save_csv(tmp_path / "machines.csv", found)
    page = write_calibration(tmp_path).read_text(encoding="utf-8")
    for words in (
        "T &amp; co",
        "No fault found",
        "Are the ranks uniform?",
        "Hardest machines",
        "The &lt;motion&gt; left",
    ):
        assert words in page
    assert "<script" not in page
    assert len((tmp_path / "machines.csv").read_text().splitlines()) == 62
    save_json(tmp_path / "calibration.json", to_plain(replace(head, summary=summarise(found[-1:]))))
    _save_csv(tmp_path / "machines.csv", found[-1:])
    assert "Not calibrated" in write_calibration(tmp_path).read_text(encoding="utf-8")


FORCE = "harmonic:amplitude=100,omega=40"
CASE = """
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 40000.0
[model.estimate]
c = { low = 2.0, high = 32.0, scale = "log" }
gap = { mean = 0.005, sd = 0.004 }
"""
BENCH = Stand((FORCE, "harmonic:amplitude=80,omega=40"), 1.0, 600.0, 0.01)


def design(tmp_path, text=CASE, **more):
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    return Design(path, BENCH, **more)


def test_machines_come_from_the_priors(tmp_path):
    shop = make_workshop(design(tmp_path, hide=("coulomb_friction:force=1",)))
    drawn = [shop.draw(np.random.default_rng(k)) for k in range(400)]
    c = np.array([one.truth["c"] for one in drawn])
    assert np.mean(c < 8.0) == pytest.approx(0.5, abs=0.1)
    x0 = np.array([one.truth["x0"] for one in drawn])
    assert x0.min() >= 0.0
    assert np.median(x0) == pytest.approx(0.0055, abs=5e-4)
    assert drawn[0].drawn == {"c", "x0"}
    assert drawn[0].truth["coulomb_friction.force"] == 1.0
    assert all(full[shop.system.index["coulomb_friction.force"]] == 1.0 for full in drawn[0].fulls)
    assert all(full[shop.system.index["x0"]] == drawn[0].truth["x0"] for full in drawn[0].fulls)


def test_each_recording_may_have_its_own(tmp_path):
    text = (
        CASE.replace('scale = "log" }', 'scale = "log", each = true }')
        + "[sensor]\noffset = { mean = 0.0, sd = 1e-3 }\n"
    )
    one = make_workshop(design(tmp_path, text)).draw(np.random.default_rng(0))
    assert set(one.truth) == {"c[drive1]", "c[drive2]", "x0", "offset[drive1]", "offset[drive2]"}
    assert one.truth["c[drive1]"] != one.truth["c[drive2]"]
    assert one.offsets == (one.truth["offset[drive1]"], one.truth["offset[drive2]"])


@pytest.mark.parametrize(
    ("text", "more", "sentence"),
    [
        (CASE.split("[model.estimate]")[0], {}, "estimates nothing"),
        (CASE, {"route": "telepathy"}, "no route 'telepathy'"),
        (CASE, {"hide": ("coulomb_frictoin:force=1",)}, "did you mean 'coulomb_friction'"),
        (CASE, {"hide": ("coulomb_friction",)}, "coulomb_friction.force has no value"),
        (CASE, {"terms": ("coulomb_friction@base",)}, "base"),
        (CASE.replace("k0 = 40000.0", ""), {}, "needs k0"),
        (CASE + '"coulomb_friction.force" = { half_sd = 1.0 }', {"hide": ("coulomb_friction:force=1",)}, "keep one"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, text, more, sentence):
    with pytest.raises(Exception, match=sentence) as caught:
        make_workshop(design(tmp_path, text, **more))
    assert caught.type.__module__ == "lostmotion.errors"


def test_prior_and_verdict_are_what_they_say():
    assert Prior(low=2.0, high=32.0, scale="log").quantile(0.5) == pytest.approx(8.0)
    (made,) = summarise(rows(20)).parameters.values()
    row = replace(made, ecdf_p=0.5, coverage={"50": Coverage(inside=2, of=4, low=1, high=3)})
    assert is_sound(row, 0.01)
    assert not is_sound(replace(row, ecdf_p=0.001), 0.01)
    assert not is_sound(replace(row, coverage={"50": Coverage(inside=2, of=4, low=3, high=4)}), 0.01)
