"""What several recordings share: machines moved without our integrator, at several levels; rates of false alarms."""

import json
import math

import numpy as np
import pytest
from scipy.stats import binom, chi2
from several import C, K, M, fitted, least, recorded, rubbed, rubbing

from lostmotion.case import dump_case
from lostmotion.codec import to_plain
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.inference.sharing import (
    adjust_by_holm,
    compare_recordings,
    compute_covariance,
    compute_homogeneity,
    find_odd_recording,
    fit_power,
    measure_levels,
    widen_covariance,
)
from lostmotion.registry import Registry

FORCE = "coulomb_friction.force"


def of(changes, **common):
    """Return what recordings at doubling levels share, each with `changes` of its own."""
    runs = [recorded(f"run {i}", 10 + i, 2.0**i, **common, **own) for i, own in enumerate(changes)]
    return compare_recordings(fitted(runs))


def test_one_value_holds_where_nothing_differs():
    """Seeded; p-values below 0.01 come in 1 of 300 new sets (see the rate below). Values within four errors."""
    found = of([{}, {}, {}])
    assert all(one.holds for one in found.parameters.values())
    assert found.released == ()
    for one, truth in ((found.parameters["c"], C), (found.parameters["k"], K)):
        assert abs(one.common.median - truth) < 2.1 * (one.common.high - one.common.low)
        assert one.common.high - one.common.low < min(v.high - v.low for v in one.values)


def test_the_one_that_differs_is_found_and_the_rest_holds():
    found = of([{}, {"c": 1.5 * C}, {}])
    c = found.parameters["c"]
    assert (c.holds, c.odd, c.power, found.released) == (False, 1, None, ("c",))
    assert c.values[1].median == pytest.approx(1.5 * C, rel=0.03)
    assert found.parameters["k"].holds


def test_values_that_go_with_the_level_say_the_exponent():
    """The true exponent, 0.5, lies within three standard errors; no chance but 0.3 % of new sets."""
    found = of([{"c": C * 2.0 ** (0.5 * i)} for i in range(3)])
    c = found.parameters["c"]
    assert not c.holds
    assert c.told
    assert abs(c.power.exponent - 0.5) < 3.0 * c.power.error < 0.3


def test_dry_friction_holds_at_three_levels():
    """Friction that truly sticks, 1 N at levels of 4 to 16 N; the common value within 5 %."""
    found = compare_recordings(
        rubbing([rubbed(f"run {i}", 50 + i, level, friction=1.0) for i, level in enumerate((4, 8, 16))])
    )
    assert found.parameters[FORCE].holds
    assert found.parameters[FORCE].common.median == pytest.approx(1.0, rel=0.05)
    assert found.levels.of == "drive"
    assert found.levels.values == pytest.approx((4.0, 8.0, 16.0), rel=1e-3)


def test_friction_of_its_own_in_one_recording_is_found():
    """1.4 N in the second of three, 1 N in the others: named, within 5 %, and damping is not blamed."""
    forces = (1.0, 1.4, 1.0)
    runs = [rubbed(f"run {i}", 50 + i, 4.0 * 2**i, friction=force) for i, force in enumerate(forces)]
    found = compare_recordings(rubbing(runs))
    own = found.parameters[FORCE]
    assert not own.told
    assert own.odd == 1
    assert [value.median for value in own.values] == pytest.approx(forces, rel=0.06)
    assert found.parameters["c"].holds
    assert found.parameters["k"].holds


def test_nothing_is_compared_with_one_recording():
    assert compare_recordings(fitted([recorded("alone", 1)])) is None


@pytest.mark.slow
@pytest.mark.parametrize("memory", [0.0, 0.6])
def test_false_alarms_are_as_rare_as_is_said(memory):
    """Fifty sets of three recordings, the force noise as large as the drive: p < 0.05 in any of two parameters.

    At 5 % eight are the 99.9 % point of fifty. `python benchmarks/sharing.py` prints the rates of a hundred sets:
    3 % for memories of 0, 0.6 and 0.9 each, and 0 or 1 % with p < 0.01. The scatter of 1 % that is allowed is small
    against the errors here.
    """
    alarms = sum(least(number, memory) < 0.05 for number in range(50))
    assert alarms <= binom.ppf(0.999, 50, 0.05)


def test_sandwich_sees_a_memory_that_the_usual_covariance_does_not():
    """Noise with a memory that the model takes for white: robust errors are larger, and never smaller."""
    fit = fitted([recorded(f"run {i}", 5 + i, slip=1.0, memory=0.9, samples=2000) for i in range(2)])
    usual = fit.local.covariance[:2, :2]
    robust = compute_covariance(fit, [0, 1])
    assert np.all(np.linalg.eigvalsh(robust - usual) > -1e-9 * np.diag(robust).max())
    assert np.max(np.diag(robust) / np.diag(usual)) > 2.0


def test_widened_is_the_sandwich_where_that_is_larger_in_every_direction():
    a = np.array([[2.0, 0.5], [0.5, 1.0]])
    assert np.allclose(widen_covariance(a, 3.0 * a), 3.0 * a)
    assert np.allclose(widen_covariance(a, 0.3 * a), a)


def test_homogeneity_is_the_weighted_scatter():
    """Independent values: the sum of squares about the weighted mean. Normal draws: chi-square (2000 seeded)."""
    values, sd = np.array([1.0, 2.0, 4.0]), np.array([0.5, 1.0, 2.0])
    mean = np.average(values, weights=sd**-2.0)
    assert compute_homogeneity(values, np.diag(sd**2)) == pytest.approx(float(np.sum(((values - mean) / sd) ** 2)))
    rng, mixed = np.random.default_rng(0), np.array([[2.0, 0.9, 0.2], [0.9, 1.0, 0.3], [0.2, 0.3, 0.5]])
    drawn = [compute_homogeneity(row, mixed) for row in rng.multivariate_normal(np.full(3, 7.0), mixed, 2000)]
    assert abs(np.mean(np.array(drawn) > chi2.ppf(0.95, 2)) - 0.05) < 4.0 * math.sqrt(0.05 * 0.95 / 2000)


def test_holm_by_hand():
    assert adjust_by_holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert adjust_by_holm([]) == []


def test_powers_and_odd_ones_by_hand():
    levels, tight = np.array([1.0, 2.0, 4.0, 8.0]), 1e-4 * np.eye(4)
    power = fit_power(2.0 * np.log(levels) + 1.0, tight, levels)
    assert power is not None
    assert power.exponent == pytest.approx(2.0)
    assert power.error == pytest.approx(0.01 / math.sqrt(np.sum((np.log(levels) - np.log(levels).mean()) ** 2)))
    one = np.array([0.0, 1.0, 0.0, 0.0])
    assert fit_power(one, tight, levels) is None
    assert find_odd_recording(one, tight) == 1
    assert find_odd_recording(np.array([0.0, 1.0, 0.0, 1.0]), tight) is None
    assert fit_power(6.0 * np.log(levels), tight, levels) is None
    assert fit_power(one[:2], tight[:2, :2], levels[:2]) is None
    assert fit_power(one, tight, np.full(4, 2.0)) is None


def test_levels_are_those_of_the_response_where_the_drive_is_the_same():
    same = measure_levels([recorded("a", 1), recorded("b", 2, c=2.0 * C)])
    assert (same.of, same.channel) == ("response", "position")


def case_of(folder, runs):
    """Return the path of a case of an oscillator with the given recordings."""
    tables = []
    for i, run in enumerate(runs):
        np.savez(folder / f"run{i}.npz", t=run.time, F=run.inputs[:, 0], x=run.response)
        drive = {"column": "F", "quantity": "force", "unit": "N"}
        seen = {"column": "x", "quantity": "position", "unit": "m"}
        tables.append({"file": f"run{i}.npz", "time": "t", "excitation": drive, "response": seen})
    wide = {"c": {"low": 0.3, "high": 30.0, "scale": "log"}, "k": {"low": 200.0, "high": 3000.0, "scale": "log"}}
    model = {"name": "linear_oscillator", "known": {"m": M}, "estimate": wide}
    dump_case({"title": "levels", "recordings": tables, "model": model}, folder / "case.toml")
    return folder / "case.toml"


@pytest.mark.slow
@pytest.mark.parametrize("odd", [1.0, 1.4])
def test_a_diagnosis_says_whether_friction_holds(tmp_path, odd):
    """Four recordings, the last held out; friction of 1 N, in the second one 1 N or 1.4 N."""
    forces, levels = (1.0, odd, 1.0, 1.0), (4.0, 8.0, 16.0, 11.0)
    runs = [rubbed(f"run {i}", 50 + i, levels[i], friction=forces[i]) for i in range(4)]
    said = run_diagnosis(case_of(tmp_path, runs), tmp_path / "out", Registry.discover(), propose=False, jobs=1)
    assert json.loads((tmp_path / "out" / "diagnosis.json").read_text())["sharing"] == to_plain(said.sharing)
    first = next(one for one in said.found if one.mechanism == "coulomb_friction")
    assert tuple(row.recording for row in first.by_recording) == said.sharing.recordings
    assert [row.parameters["force"].median for row in first.by_recording] == pytest.approx(forces[:3], rel=0.1)
    assert first.shared.holds is (odd == 1.0)
    assert bool(first.doubts) is (odd != 1.0)
    page = (tmp_path / "out" / "report.html").read_text()
    assert "Parameters in each recording" in page
    assert ("no, differs in" in page) is (odd != 1.0)
