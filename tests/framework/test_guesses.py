"""Guesses of a first case: an unlikely one stops, and the others stand in the answer."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion.case import load_case
from lostmotion.cli import main
from lostmotion.errors import CaseError
from lostmotion.preparation.beginning import write_first_case
from lostmotion.preparation.guessed import compute_coherent_share, falls
from lostmotion.recording.outline import GivenRoles
from lostmotion.registry import Registry

T = np.arange(2000) / 100.0
TONES = sum(np.cos(2.0 * np.pi * (0.3 + 0.37 * k) * T + k * k) for k in range(9))
KERNEL = np.exp(-T[:200] / 0.2) * np.sin(12.0 * T[:200])
MOVED = np.convolve(TONES, KERNEL)[: T.size]
DECAY = np.exp(-T / 4.0) * np.cos(12.0 * T)


def first_case(folder, head, *columns, **roles):
    rows = "\n".join(",".join(f"{v:.9g}" for v in row) for row in zip(*columns, strict=True))
    (folder / "run.csv").write_text(f"{head}\n{rows}\n", encoding="utf-8")
    return write_first_case(folder / "run.csv", folder / "case.toml", GivenRoles(**roles), Registry.discover())


@pytest.mark.parametrize(
    ("head", "columns", "asks"),
    [
        ("t [s],Voltage [V],Speed [rad/s]", (T, TONES, MOVED), r"\(Voltage \[V\] may drive it\).*--drive 'Voltage"),
        ("t [s],amps [A],x [mm]", (T, TONES, MOVED), r"\(amps \[A\] may drive it\)"),
        ("t [s],x [mm]", (T, MOVED), r"\(nothing else moves\).*--drive COLUMN"),
        ("t [s],pwm,acc [g]", (T, TONES, MOVED), r"\(pwm may drive it\)"),
    ],
)
def test_a_response_that_does_not_decay_is_no_free_decay(tmp_path, head, columns, asks):
    with pytest.raises(CaseError, match=asks):
        first_case(tmp_path, head, *columns)
    assert not (tmp_path / "case.toml").exists()


def test_a_decay_is_a_guess_that_stands_in_the_answer_until_it_is_removed(tmp_path):
    draft = first_case(tmp_path, "t [s],x [mm]", T, DECAY)
    says = "nothing drives the machine, and x [mm] is its free decay"
    assert says in draft.notes
    assert f"guessed: {says}" in load_case(tmp_path / "case.toml").notes
    kept = "\n".join(line for line in draft.text.splitlines() if "free decay" not in line)
    (tmp_path / "case.toml").write_text(kept, encoding="utf-8")
    assert not [note for note in load_case(tmp_path / "case.toml").notes if "decay" in note]


def test_a_user_may_say_that_nothing_drives_the_machine(tmp_path):
    assert "inputs = []" in first_case(tmp_path, "t [s],x [mm]", T, MOVED, drive="none").text


@pytest.mark.parametrize(
    ("values", "kind", "right"),
    [
        (DECAY, "position", True),
        (3.0 + np.exp(-T / 3.0), "position", True),
        (np.exp(-T / 3.0), "velocity", True),
        (np.exp(-T / 60.0) * np.cos(12.0 * T), "acceleration", True),
        (1.0 - np.exp(-T / 3.0), "velocity", False),
        (MOVED, "position", False),
        (np.cos(12.0 * T), "velocity", False),
    ],
)
def test_what_falls_may_be_a_free_decay(values, kind, right):
    assert falls(values + 1e-4 * np.random.default_rng(0).standard_normal(T.size), kind, 0.01) == right


def test_a_drive_is_coherent_and_noise_is_not():
    noise = np.random.default_rng(1).standard_normal(T.size)
    assert compute_coherent_share(TONES, MOVED) > 0.8
    assert compute_coherent_share(noise, MOVED) < 0.3
    assert compute_coherent_share(np.ones(T.size), MOVED) == 0.0


@pytest.mark.parametrize(
    ("head", "scale", "says"),
    [
        ("t [s],F [N],travel", 1e3, "travel has values up to .* in m that is not possible"),
        ("t [s],F [N],speed", 1e5, "speed has values up to"),
        ("t [s],F,x [mm]", None, "F has values up to"),
    ],
)
def test_an_absurd_size_of_a_column_without_a_unit_is_asked_about(tmp_path, head, scale, says):
    force, moved = (TONES, scale * MOVED) if scale else (1e8 * TONES, MOVED)
    with pytest.raises(CaseError, match=f"{says}.*--unit"):
        first_case(tmp_path, head, T, force, moved)


def test_units_that_are_guessed_stand_in_the_answer(tmp_path):
    draft = first_case(tmp_path, "t [s],drive [V],x", T, TONES, 0.1 * MOVED)
    said = load_case(tmp_path / "case.toml").notes
    assert "guessed: drive [V] has the unit V and is taken for a force in N" in said
    assert "guessed: x has no unit and is taken for a position in m" in said
    assert any(note.startswith("guessed: the model is") for note in said)
    assert "remove each one that you have checked" in draft.text


def test_the_command_stops_with_one_sentence(shared_cases, tmp_path):
    run = str(shared_cases / "i04_dc_motor_voltage" / "run.csv")
    result = CliRunner().invoke(main, ["diagnose", run, "--out", str(tmp_path)])
    assert result.exit_code == 2
    assert "Speed [rpm] does not decay, so it is no free decay (Voltage [V] and Current [A] may drive it)" in (
        result.output
    )
    assert "for a motor write a case with the model dc_motor" in result.output
    assert result.output.count("\n") == 1
