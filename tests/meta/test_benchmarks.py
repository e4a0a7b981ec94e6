"""The comparison of speed with the last release: a slower kernel fails it, and a slower machine does not."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

FOLDER = Path(__file__).parents[2] / "benchmarks"


def module(name):
    spec = importlib.util.spec_from_file_location(f"benchmarks_{name}", FOLDER / f"{name}.py")
    found = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = found
    spec.loader.exec_module(found)
    return found


compare, yardstick = module("compare"), module("yardstick")
VALUES = np.random.default_rng(0).normal(size=200_000)


def sorting(times):
    return lambda: [np.sort(VALUES) for _ in range(times)]


def test_a_kernel_twice_as_slow_is_named_and_a_machine_four_times_as_slow_is_not():
    before = {"sort": yardstick.ratio_of(sorting(1), sorting(2))}
    machine = {"sort": yardstick.ratio_of(sorting(4), sorting(8))}
    kernel = {"sort": yardstick.ratio_of(sorting(2), sorting(2))}
    assert compare.slower(before, machine, compare.TOLERANCE) == []
    assert compare.slower(before, kernel, compare.TOLERANCE) == ["sort"]


@pytest.mark.parametrize(("now", "status"), [({"a": 0.5, "b": 9.0}, 0), ({"a": 1.0}, 1), ({"b": 9.0}, 1)])
def test_the_command_says_what_became_slower_or_was_not_measured(tmp_path, monkeypatch, capsys, now, status):
    (tmp_path / "machine").mkdir()
    rows = [{"name": name, "extra_info": {"ratio": ratio}} for name, ratio in now.items()]
    (tmp_path / "machine" / "0001.json").write_text(
        json.dumps({"benchmarks": [*rows, {"name": "plain", "extra_info": {}}]})
    )
    compare.saved(tmp_path / "baseline.json", {"a": 0.5}, "0.1.0")
    monkeypatch.setattr(compare, "last_run", lambda: tmp_path / "machine" / "0001.json")
    monkeypatch.setattr(sys, "argv", ["compare.py", "--against", str(tmp_path / "baseline.json")])
    assert compare.main() == status
    assert f"{status} of 1 slower by more than 60 %, or absent" in capsys.readouterr().out


def test_the_baseline_holds_ratios_of_every_speed_test_and_nothing_of_a_machine():
    content = json.loads((FOLDER / "baseline.json").read_text(encoding="utf-8"))
    assert set(content) == {"release", "ratios"}
    source = "".join(path.read_text(encoding="utf-8") for path in sorted(FOLDER.glob("test_*.py")))
    kept = [name.partition("[") for name in content["ratios"]]
    assert {name for name, _, _ in kept} == set(re.findall(r"def (test_\w+)\(", source))
    assert [label for _, _, label in kept if f'"{label[:-1]}"' not in source and label] == []


def test_benchmarks_measure_although_our_settings_share_tests_out():
    """For a day they did not: a setting for many workers, without any, disables them."""
    line = [sys.executable, "-m", "pytest", str(FOLDER), "-q", "-k", "no_such_name", "-p", "no:cacheprovider"]
    done = subprocess.run(line, capture_output=True, text=True, cwd=FOLDER.parent, env=alone(), check=False)
    assert "deselected" in done.stdout, done.stdout + done.stderr
    assert "disabled" not in done.stdout + done.stderr


def alone():
    """Return the environment of a run that is no part of this one."""
    return {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
