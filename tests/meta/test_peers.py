"""The comparison with other tools (`benchmarks/beside_peers.py`), without them: error measure, free runs and names."""

import importlib
import json
from pathlib import Path

import numpy as np
import pytest

from lostmotion.registry import Registry

FOLDER = Path(__file__).parents[2] / "benchmarks"
DT, PACE = 0.01, 5.0


@pytest.fixture(autouse=True)
def _beside(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))


def load(name):
    return importlib.import_module(name)


@pytest.fixture
def track():
    """The resonant motion x = t sin(wt) of a driven oscillator, with its last 30 % held out."""
    time = DT * np.arange(2000)
    motion, drive = time * np.sin(PACE * time), 2.0 * PACE * np.cos(PACE * time)
    return load("peer_tracks").Track(motion, drive, DT, 1400, ("u", "v", "x"), False, (1.0, 2.0 * np.pi / PACE))


def test_the_error_is_that_of_free_runs_over_the_deviation_of_the_held_out_part(track):
    measure = load("peer_tracks").measure_error
    size = np.std(track.position[1400:])

    def roll(shift, starts, samples):
        assert starts.min() == 1400
        assert samples == 127
        return track.position[np.add.outer(starts, np.arange(samples))] + shift

    assert measure(track, lambda *at: roll(0.1 * size, *at)) == (pytest.approx(0.1), 0.0)
    error, wild = measure(track, lambda *at: roll(np.nan, *at))
    assert wild == 1.0
    assert error > 100.0


def test_free_runs_of_the_true_equation_follow_the_recording_and_those_of_a_wrong_one_do_not(track):
    sindy, measure = load("peers_sindy"), load("peer_tracks").measure_error
    speed = np.gradient(track.position, DT)
    motion = sindy.Motion(track.position, speed, track.drive, np.gradient(speed, DT), (1.0, 1.0, 1.0, 1.0))
    laws = tuple(sindy.LAWS[name][0] for name in ("x", "u"))
    errors = [
        measure(track, sindy.Runs(sindy.Equation(("x", "u"), np.array([-k, 1.0]), laws, 0.0, 0.0), motion, track))[0]
        for k in (PACE**2, 1.1 * PACE**2)
    ]
    assert errors[0] < 1e-4
    assert errors[1] > 0.02


def hide(*accept):
    return {"mechanism": "hidden", "accept": accept}


@pytest.mark.parametrize(
    ("terms", "hidden", "found"),
    [
        (["u", "v", "d", "sign(v)"], [hide("coulomb_friction")], (1, 1, [])),
        (["sign(v)", "x"], [hide("bouc_wen_hysteresis", "dahl_friction")], (1, 1, ["x"])),
        (["x", "1"], [hide("coulomb_friction"), hide("offset_force")], (1, 2, ["x"])),
        (["v**2 x**1", "x**3", "v"], [hide("excitation_delay")], (0, 1, [])),
        (["x^3"], [hide("unknown")], (0, 0, ["x^3"])),
    ],
)
def test_a_term_stands_for_the_laws_it_may_be(terms, hidden, found):
    assert load("beside_peers").judge_terms(terms, {"effects": hidden}) == found


def test_the_laws_of_the_peers_are_those_of_the_library():
    known = set(Registry.discover().names("term"))
    assert {name for _, names in load("peers_sindy").LAWS.values() for name in names} <= known


def test_an_absent_peer_is_refused_with_what_to_install():
    with pytest.raises(SystemExit, match=r"no-such-peer is not installed: pip install 'lostmotion\[peers\]'"):
        load("beside_peers").find_version("no-such-peer")


def test_the_simplest_of_the_nearly_best_models_is_chosen():
    choose = load("peer_tracks").choose_simplest
    assert choose([(1.0, 9, "large"), (1.04, 3, "small"), (1.2, 1, "poor")]) == "small"


def test_rows_of_a_run_become_a_table(tmp_path, monkeypatch):
    results, store = load("validation_results"), load("validation_store")
    monkeypatch.setattr(store, "RESULTS", tmp_path / "results")
    row = {"set": "small", "key": "0", "tool": "lostmotion", "version": "abc", "hidden": ["cogging"], "found": 1,
           "of": 1, "false": [], "terms": ["cogging"], "error": 0.01, "wild": 0.0, "cpu": 30.0,
           "setting": ""}  # fmt: skip
    peer = {**row, "tool": "PySINDy, laws", "version": "2", "found": 0, "false": ["x"], "terms": ["x"], "wild": 0.5}
    lost = {**peer, "tool": "SysIdentPy", "error": None, "terms": []}
    (tmp_path / "peers.jsonl").write_text("\n".join(map(json.dumps, (row, peer, lost))))
    result = results.read_results(store.store(tmp_path, "peers-small", {}).parent)[0]
    assert (result.code, result.note, result.judged) == ("abc", "PySINDy 2, SysIdentPy 2", False)
    tables = load("validation_peers").PEER_TABLES
    summary = tables["peers"]([result], {})
    assert "| lostmotion | 1 of 1 | 0 of 1 | 1 % | 1 % | 0 | 30, 30 |" in summary
    assert "| PySINDy, laws | 0 of 1 | 1 of 1 | 1 % | 1 % | 1 | 30, 30 |" in summary
    cells = tables["peererrors"]([result], {}).splitlines()[-1]
    assert cells == "| 0 | cogging | 1 %: cogging | 1 % (diverges): *linear stiffness* | failed (diverges) |"
