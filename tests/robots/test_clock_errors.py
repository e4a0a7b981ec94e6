"""Errors of time stamps are found from the readings of several joints, and nothing else is taken for them."""

import numpy as np
import pytest

from lostmotion.robots.clock_errors import correct_stamps, find_clock_errors
from lostmotion_trials.integrators.arm import plan_motion

DT, JITTER, NOISE = 0.001, 2e-4, 1e-5


def draw(joints, seed=0, jitter=JITTER, noise=NOISE, samples=6000, uneven=0.0):
    """Return late stamps, true ones and readings of a smooth motion, some samples of which are lost.

    True times are even but for a share `uneven` of the step.
    """
    rng = np.random.default_rng(seed)
    pairs = [plan_motion(rng, samples, DT)[0] for _ in range(-(-joints // 2))]
    q = np.concatenate(pairs, axis=1)[:, :joints]
    kept = rng.random(samples) > 0.05
    times = DT * (np.arange(samples) + uneven * rng.random(samples))
    true = times[kept]
    q = np.stack([np.interp(times, DT * np.arange(samples), column) for column in q.T], axis=1)
    # the waits before stamps are correlated, as those of a queue, and do not reorder samples
    waits = np.abs(np.convolve(rng.standard_normal(len(true)), np.full(4, 0.5), mode="same")) * jitter
    stamps = np.maximum.accumulate(true + np.minimum(waits, 0.9 * DT)) + 1e-9 * np.arange(len(true))
    return stamps, true, q[kept] + noise * rng.standard_normal((len(true), joints))


@pytest.mark.parametrize("joints", [2, 3, 7])
def test_stamps_are_corrected_by_what_all_joints_show(joints):
    stamps, true, readings = draw(joints)
    corrected, notes = correct_stamps(stamps, readings)
    assert np.std(corrected - true) < 0.1 * np.std(stamps - true)
    assert np.all(np.diff(corrected) > 0.0)
    assert "same errors of the time stamps" in notes[0]
    assert "even clock, every 1 ms" in notes[1]


def test_a_clock_that_is_not_even_is_corrected_by_the_readings_alone():
    stamps, true, readings = draw(7, uneven=0.5)
    corrected, notes = correct_stamps(stamps, readings)
    before, after = (np.std(np.diff(x - true)) for x in (stamps, corrected))
    assert after < 0.35 * before
    assert len(notes) == 1


def test_the_size_of_the_errors_is_told():
    stamps, true, readings = draw(7)
    found = find_clock_errors(stamps, readings)
    assert found.clear
    assert np.std(found.late) == pytest.approx(np.std(stamps - true), rel=0.15)


def test_noise_of_encoders_is_no_clock():
    """The stamps jitter, and the readings were taken at them. Five seeds, no chance is quoted."""
    for seed in range(5):
        stamps, _, _ = draw(2, seed)
        rng = np.random.default_rng(seed)
        q = np.stack([np.sin(7.0 * stamps), np.cos(5.0 * stamps)], axis=1)
        same, notes = correct_stamps(stamps, q + 1e-4 * rng.standard_normal(q.shape))
        assert same is stamps
        assert notes == ()


def test_joints_that_vibrate_together_are_no_clock():
    """A vibration of the base moves all joints by the same angle, whatever their speeds."""
    stamps, _, _ = draw(3)
    q = np.stack([np.sin(w * stamps) for w in (7.0, 5.0, 3.0)], axis=1) + 1e-3 * np.sin(250.0 * stamps)[:, None]
    assert not find_clock_errors(stamps, q).clear


def test_a_joint_that_rests_has_no_vote():
    stamps, true, readings = draw(3)
    readings[:, 1] = 1e-5 * np.random.default_rng(0).standard_normal(len(stamps))
    corrected, _ = correct_stamps(stamps, readings)
    assert np.std(corrected - true) < 0.1 * np.std(stamps - true)


def test_even_stamps_and_single_joints_stay():
    even = DT * np.arange(4000)
    _, _, readings = draw(2, samples=4000)
    same, notes = correct_stamps(even[: len(readings)], readings)
    assert same is not None
    assert notes == ()
    assert find_clock_errors(even[: len(readings)], readings[:, :1]) is None


def test_the_log_of_a_case_is_read_with_corrected_stamps(tmp_path, registry):
    from lostmotion.robots.arm_case import load_robot_case

    stamps, true, readings = draw(2, noise=1e-6)
    columns = np.column_stack([stamps, np.sin(true), np.cos(true), readings])
    np.savetxt(tmp_path / "log.csv", columns, "%.12g", ",", header="t,u1,u2,q1,q2", comments="")
    (tmp_path / "own.py").write_text("def inverse(q, v, a):\n    return a\n")
    entries = [("inputs", "input", "u", "N m", ".torque"), ("sensors", "channel", "q", "rad", "")]
    lists = "\n".join(
        f"{key} = ["
        + ", ".join(f'{{ {word} = "j{i}{end}", column = "{c}{i}", unit = "{unit}" }}' for i in (1, 2))
        + "]"
        for key, word, c, unit, end in entries
    )
    model = '[model]\ninverse = "own.py:inverse"\njoints = ["j1", "j2"]\ntorque = "motor"\n'
    (tmp_path / "case.toml").write_text(f'[[recordings]]\nfile = "log.csv"\ntime = "t"\n{lists}\n{model}')
    log = load_robot_case(tmp_path / "case.toml", registry).log
    grid = log.dt * np.arange(log.samples)
    errors = [
        np.std(np.diff(x - np.interp(grid, true - true[0], readings[:, 0])[: len(x)], 2))
        for x in (np.interp(grid, stamps - stamps[0], readings[:, 0]), log.readings[:, 0])
    ]
    assert errors[1] < 0.2 * errors[0]
    assert any("stamps are corrected" in note for note in log.notes)
