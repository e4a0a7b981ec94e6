"""A case file: what it may say, and what it is told when it says something else."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from lostmotion.case import CaseFile, Measured, Prior, SensorSpec, dump_case, load_case
from lostmotion.errors import CaseError
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry
from lostmotion_chaos.analysis.source import WantedChannel, load_source

GOOD = """
title = "Link 2, 1.54 Hz"
plugins = ["mine.py"]

[[recordings]]
file = "recording.csv"
time = "time"
hold = "step"
t_start = 1
excitation = { column = "force", quantity = "force", unit = "N", factor = 35.0 }
response = { column = "position", quantity = "position", unit = "m" }

[[recordings]]
file = "recording.csv"
rate = 1000.0
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }

[model]
name = "lin_backlash"

[model.known]
m = 1
k0 = 40000.0

[model.estimate]
c = { low = 0.8, high = 80.0, scale = "log" }
x0 = { low = 5e-4, high = 5e-2 }
k1 = { mean = 1.0, sd = 0.1 }

[truth]
c = 8.0
"""


def case(folder: Path, text: str = GOOD) -> CaseFile:
    (folder / "mine.py").touch()
    (folder / "case.toml").write_text(text)
    return load_case(folder / "case.toml")


def test_a_case_is_read(tmp_path: Path) -> None:
    got = case(tmp_path)
    assert (got.title, got.folder, got.model, got.plugins) == (
        "Link 2, 1.54 Hz", tmp_path, "lin_backlash", ("mine.py",))  # fmt: skip
    assert got.known == {"m": 1.0, "k0": 40000.0}
    assert got.truth == {"c": 8.0}
    assert got.estimate["c"] == Prior(0.8, 80.0, "log")
    assert got.estimate["x0"].scale == "linear"
    first, second = got.recordings
    assert (first.time, first.rate, first.hold, first.t_start, first.inputs[0].factor) == ("time", None, "step", 1, 35)
    assert (second.time, second.rate, second.hold, second.t_end) == (None, 1000.0, "smooth", None)
    assert [r.label for r in got.recordings] == ["recording", "recording 2"]
    assert re.fullmatch("[0-9a-f]{64}", got.digest)


@pytest.mark.real
def test_the_contract_is_read(shared: Path) -> None:
    got = load_case(shared / "contracts/case.toml")
    assert list(got.estimate) == ["c", "x0"]
    assert got.recordings[0].sensors[0].column == "position"


def test_a_minimal_case(tmp_path: Path) -> None:
    text = GOOD[GOOD.index("[[rec") : GOOD.index("[model.known]")]
    got = case(tmp_path, text)
    assert (got.title, got.known, got.estimate, got.truth, got.plugins) == ("case", {}, {}, {}, ())


CHANNEL = 'quantity = "force", unit = "N", factor = 35.0'
WRONG = [
    ("[truth]", "[thruth]", ["'thruth'", "did you mean 'truth'"]),
    ("[[recordings]]", "[[recording]]", ["'recording'", "did you mean 'recordings'"]),
    ('hold = "step"', 'hodl = "step"', ["recordings[0]", "'hodl'", "did you mean 'hold'"]),
    ('hold = "step"', 'hold = "steps"', ["recordings[0]", "did you mean 'step'", "smooth, step"]),
    (CHANNEL, CHANNEL.replace("unit", "units"), ["recordings[0].excitation", "did you mean 'unit'"]),
    (CHANNEL, CHANNEL.replace("force", "forse"), ["did you mean 'force'", "torque, base_position"]),
    (CHANNEL, CHANNEL.replace('"force"', '"position"'), ["'position'", "force, torque, base_position"]),
    (CHANNEL, CHANNEL.replace('"N"', '"m"'), ["recordings[0].excitation", "wrong unit", "'m'", "'N'"]),
    (CHANNEL, CHANNEL.replace('"N"', '"newtonz"'), ["wrong unit", "'newtonz'", "not known"]),
    (CHANNEL, CHANNEL.replace('"N"', '"V"'), ["volts need factor"]),
    (CHANNEL, CHANNEL.replace("35.0", "0"), ["factor", "other than zero"]),
    (CHANNEL, 'quantity = "force"', ["lacks 'unit'"]),
    ('column = "force", ', "", ["lacks 'column'"]),
    ('column = "force"', "column = 3", ["a number (3)", "'column'", "text"]),
    ('file = "recording.csv"', "", ["recordings[0]", "lacks 'file'"]),
    ('time = "time"', "", ["recordings[0]", "neither time nor rate"]),
    ('time = "time"', 'time = "time"\nrate = 10', ["both time and rate"]),
    ("rate = 1000.0", "rate = -1", ["recordings[1]", "'rate'", "positive"]),
    ("rate = 1000.0", 'rate = "1000"', ["recordings[1]", "'1000'", "without quotes"]),
    ("rate = 1000.0", "rate = true", ["true or false", "number"]),
    ("rate = 1000.0", "rate = inf", ["finite"]),
    ("t_start = 1", "t_start = 1\nt_end = 0.5", ["t_start must lie before t_end"]),
    ("m = 1\n", 'm = "1"\n', ["model.known", "'m'"]),
    ("k0 =", "c =", ["model", "'c' both known and estimated"]),
    ("low = 0.8", "low = 90.0", ["model.estimate.c", "low = 90", "high = 80", "below"]),
    ("low = 0.8", "low = 80.0", ["below"]),
    ("low = 0.8", "low = 0.0", ["model.estimate.c", "log scale", "positive"]),
    ("low = 0.8", "lo = 0.8", ["'lo'", "did you mean 'low'"]),
    ("low = 0.8, ", "", ["neither low and high nor mean and sd nor median and sd_log nor half_sd"]),
    ("low = 0.8", "each = 1, low = 0.8", ["model.estimate.c", "a number (1)", "'each'", "true or false"]),
    ("mean = 1.0, sd = 0.1", "half_sd = -1.0", ["model.estimate.k1", "half_sd = -1", "positive"]),
    ("mean = 1.0, sd = 0.1", "half_sd = 1.0, sd = 1.0", ["gives one of mean and sd"]),
    ("mean = 1.0, sd = 0.1", "mean = 1.0, sd = 0.1, half_sd = 1.0", ["mean besides half_sd", "or the other"]),
    ("mean = 1.0, sd = 0.1", "median = 0.0, sd_log = 1.0", ["median = 0", "positive"]),
    ("mean = 1.0, sd = 0.1", "median = 1.0, sd_log = 1.0, high = 3.0", ["median besides low, high or scale"]),
    ("mean = 1.0, sd = 0.1", "median = 1.0, sdlog = 1.0", ["'sdlog'", "did you mean 'sd_log'"]),
    ("[truth]", '[sensor]\nnoise = "eech"\n[truth]', ["sensor", "did you mean 'each'", "each, shared"]),
    ("[truth]", "[sensor]\nzero = 1\n[truth]", ["sensor", "unknown key 'zero'", "noise, offset"]),
    ("[truth]", "[sensor]\noffset = 1.0\n[truth]", ["sensor", "'offset'", "a table"]),
    ("[truth]", "[sensor]\noffset = { sd = 1.0 }\n[truth]", ["sensor.offset", "neither low and high"]),
    ("[truth]", "[sensor]\noffset = { half_sd = 1.0, each = true }\n[truth]", ["sensor.offset", "'each'"]),
    ('scale = "log"', 'scale = "logg"', ["did you mean 'log'"]),
    ("sd = 0.1", "sd = 0", ["model.estimate.k1", "sd = 0", "positive"]),
    ("sd = 0.1", "sd = 0.1, low = 0", ["either one pair or the other"]),
    ("{ mean = 1.0, sd = 0.1 }", "1.0", ["model.estimate", "'k1'", "a table"]),
    ("[model.known]", "[model.knwon]", ["'knwon'", "did you mean 'known'"]),
    ('name = "lin_backlash"', "", ["model", "lacks 'name'"]),
    ('plugins = ["mine.py"]', 'plugins = ["other.py"]', ["'other.py'", "does not exist"]),
    ('plugins = ["mine.py"]', 'plugins = "mine.py"', ["plugins", "a list of texts"]),
    ('title = "Link', "title = Link", ["not valid TOML", "line 2"]),
    ('title = "Link 2, 1.54 Hz"', "title = 3", ["the case", "'title'"]),
]


@pytest.mark.parametrize(("old", "new", "words"), WRONG, ids=lambda v: str(v)[:30])
def test_refusals_are_sentences(tmp_path: Path, old: str, new: str, words: list[str]) -> None:
    assert old in GOOD
    with pytest.raises(CaseError) as caught:
        case(tmp_path, GOOD.replace(old, new, 1))
    message = str(caught.value)
    assert [w for w in ["case.toml", *words] if w not in message] == [], message
    assert "\n" not in message
    assert str(tmp_path) not in message


@pytest.mark.parametrize("empty", ["recordings = []", "recordings = 3", "recordings = [1]", "recordings = {}"])
def test_recordings_must_be_there(tmp_path: Path, empty: str) -> None:
    with pytest.raises(CaseError, match=r"recordings"):
        case(tmp_path, empty + '\n[model]\nname = "a"')


def test_a_case_may_be_without_recordings_until_they_are_needed(tmp_path: Path) -> None:
    got = case(tmp_path, '[model]\nname = "lin_backlash"')
    assert (got.recordings, got.levels, got.sensor) == ((), (), SensorSpec("each", None))
    for needs in (lambda path: prepare(path, Registry()), lambda path: load_source(path, WantedChannel(), Registry())):
        with pytest.raises(CaseError, match=r"has no \[\[recordings\]\]: add one"):
            needs(tmp_path / "case.toml")


def test_two_recordings_of_one_name(tmp_path: Path) -> None:
    text = GOOD.replace("t_start = 1", 'name = "a"').replace("rate =", 'name = "a"\nrate =')
    with pytest.raises(CaseError, match="two recordings are named 'a'"):
        case(tmp_path, text)


def test_what_is_no_file_of_text(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "gone.toml"):
        with pytest.raises(CaseError, match="cannot be read"):
            load_case(path)
    (tmp_path / "b.toml").write_bytes(b"\xff\xfe\x00\x01\xc3")
    with pytest.raises(CaseError, match="not text"):
        load_case(tmp_path / "b.toml")


def test_what_is_dumped_is_read_back(tmp_path: Path) -> None:
    channel = {"column": 'a "b" \\ µ', "quantity": "force", "unit": "N", "factor": np.float64(2)}
    content = {
        "recordings": [{"file": "r.csv", "time": None, "rate": 1e3, "excitation": channel,
                        "response": {"column": "x", "quantity": "position", "unit": "m"}}],
        "title": "Demo",
        "model": {"name": "m", "known": {"k": 1e-7, "odd key": 3}, "estimate": {
            "c": {"low": 1, "high": 2.5, "each": True}, "d": {"low": 1.0, "high": 2.0, "scale": "log", "each": False},
            "k1": {"mean": 0.0, "sd": 2}, "x0": {"median": 1e-3, "sd_log": 0.7}, "f": {"half_sd": 3.0, "each": True}}},
        "sensor": {"noise": "shared", "offset": {"mean": 0.0, "sd": 1e-4}},
        "levels": [
            {"amplitude": 50, "unit": "N", "frequency": 2.0, "name": "one", "motion": "chaotic",
             "lyapunov": {"value": 2.0, "sd": 0.1, "unit": "bit/s"}, "d2": {"value": 2.5, "low": 2.4, "high": 2.6}},
            {"amplitude": 0.1, "unit": "rad", "omega": 2.0, "motion": "periodic"}],
        "truth": {"c": 2},
    }  # fmt: skip
    dump_case(content, tmp_path / "case.toml")
    got = load_case(tmp_path / "case.toml")
    assert got.recordings[0].inputs[0].column == channel["column"]
    assert got.recordings[0].inputs[0].factor == 2.0
    assert got.known == {"k": 1e-7, "odd key": 3.0}
    assert got.estimate == {
        "c": Prior(1.0, 2.5, each=True), "d": Prior(1.0, 2.0, "log"), "k1": Prior(mean=0.0, sd=2.0),
        "x0": Prior(median=1e-3, sd_log=0.7), "f": Prior(half_sd=3.0, each=True),
    }  # fmt: skip
    assert got.sensor == SensorSpec("shared", Prior(mean=0.0, sd=1e-4))
    one, two = got.levels
    assert (one.name, one.amplitude, one.omega, one.motion) == ("one", 50.0, pytest.approx(4.0 * math.pi), "chaotic")
    assert one.lyapunov == Measured(2.0 * math.log(2.0), 0.1 * math.log(2.0))
    assert one.d2 == Measured(2.5, pytest.approx(0.2 / 3.919928))
    assert (two.name, two.unit, two.omega, two.lyapunov, two.motion) == ("0.1 rad", "rad", 2.0, None, "periodic")
    assert got.truth == {"c": 2.0}


def test_a_short_form_keeps_its_quantity(tmp_path):
    (tmp_path / "case.toml").write_text(
        '[[recordings]]\nfile = "a.csv"\ntime = "t"\nexcitation = "none"\n'
        'response = { column = "v", quantity = "velocity", unit = "m/s" }\n[model]\nname = "lin_backlash"\n'
    )
    (sensor,) = load_case(tmp_path / "case.toml").recordings[0].sensors
    assert sensor.target == "velocity"
