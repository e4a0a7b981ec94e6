"""Every rule of the kit for simulators, and findings written back into MJCF."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from lostmotion_template.simulators import TwoLink

from lostmotion import testing
from lostmotion.robots.law_text import write_law, write_rate
from lostmotion.simulators import FoundMechanism

mujoco = pytest.importorskip("mujoco", reason="MJCF and URDF need the extra mujoco")
from lostmotion_plugins.simulators.mujoco import EXAMPLE, MujocoSimulator, UrdfSimulator  # noqa: E402

HINGE = '<joint name="shoulder" axis="0 -1 0" armature="0.3" damping="0.5"/>'
FOUND = (
    FoundMechanism("coulomb_friction", "elbow", {"force": 0.3}, "Dry friction."),
    FoundMechanism("viscous_damping", "shoulder", {"coefficient": 0.2}, "Damping."),
    FoundMechanism("payload", "tip", {"mass": 0.15}, "A mass."),
    FoundMechanism("inertia_change", "elbow", {"change": 0.02}, "An armature."),
    FoundMechanism("cogging", "elbow", {"cosine": 0.1}, "A ripple."),
)


@testing.parametrize([MujocoSimulator, UrdfSimulator, TwoLink])
def test_conforms(component, rule):
    testing.assert_conforms(component, rule)


@dataclass(frozen=True)
class Skew(TwoLink):
    """An arm whose second row is wrong."""

    def inverse(self, q, v, a):
        found = TwoLink.inverse(self, q, v, a)
        found[:, 1] += 0.1 * a[:, 0]
        return found


@dataclass(frozen=True)
class Damped(TwoLink):
    """An arm with damping that is not taken out."""

    def inverse(self, q, v, a):
        return TwoLink.inverse(self, q, v, a) + 0.1 * v


@pytest.mark.parametrize(
    ("wrong", "rule"), [(Skew, "mass_matrix_is_symmetric_and_positive"), (Damped, "closed_path_needs_no_work")]
)
def test_a_wrong_simulator_breaks_one_rule(wrong, rule):
    assert {f.rule for f in testing.check(wrong) if not f.ok} == {rule}


def test_two_ways_to_the_same_arm_agree():
    rng = np.random.default_rng(0)
    q, v, a = rng.standard_normal((3, 20, 2))
    assert np.allclose(MujocoSimulator().inverse(q, v, a), TwoLink().inverse(q, v, a), atol=1e-10)
    heavy = MujocoSimulator().changed({"tip.payload": 0.3}).inverse(q, v, a)
    assert np.allclose(heavy, TwoLink(payload=0.3).inverse(q, v, a), atol=1e-9)


def test_a_payload_turns_the_axes_of_the_inertia(tmp_path):
    file = tmp_path / "arm.xml"
    file.write_text(EXAMPLE.replace('"0.03 0.03 0.03"', '"0.045 0.03 0.02"'), encoding="utf-8")
    q, v, a = np.random.default_rng(0).standard_normal((3, 20, 2))
    heavy = MujocoSimulator(file=str(file)).changed({"tip.payload": 0.3}).inverse(q, v, a)
    assert np.allclose(heavy, TwoLink(payload=0.3).inverse(q, v, a), atol=1e-9)


def test_a_first_moment_moves_the_centre_of_mass(tmp_path):
    file, more = tmp_path / "arm.xml", 1e-5
    file.write_text(EXAMPLE.replace('pos="0.15 0 0"', f'pos="0.15 0 {more / 2.0}"'), encoding="utf-8")
    q, v, a = np.random.default_rng(0).standard_normal((3, 20, 2))
    plain, other = MujocoSimulator().inverse(q, v, a), MujocoSimulator(file=str(file)).inverse(q, v, a)
    moved = MujocoSimulator().changed({"fore.moment_z": more}).inverse(q, v, a)
    assert np.allclose(moved - plain, other - plain, rtol=1e-3, atol=1e-9)
    assert set(MujocoSimulator().inertial) >= {"upper.moment_x", "fore.inertia_yy", "fore.inertia_xz"}


def test_a_finer_step_is_closer_to_the_exact_motion():
    rng = np.random.default_rng(0)
    q, v = rng.standard_normal((2, 50, 2))
    torque = 3.0 * rng.standard_normal((50, 5, 2))
    exact = MujocoSimulator().roll(q, v, torque, 0.002)
    off = [np.std(MujocoSimulator().roll(q, v, torque, 0.002, step=h)[0] - exact[0]) for h in (2e-3, 1e-3, 5e-4)]
    assert off[1] == pytest.approx(0.5 * off[0], rel=0.1)
    assert off[2] == pytest.approx(0.25 * off[0], rel=0.1)


def test_soft_friction_is_told_with_its_solref():
    (says,) = MujocoSimulator().describe_friction(np.array([-1.5, 0.0]), {"elbow": 0.3})
    assert "solref 0.02 1 and steps of 2 ms, as in the file, elbow creeps at" in says
    assert "a step leaves 81 % of a small speed" in says


def test_findings_are_written_into_the_file():
    text, notes, _ = MujocoSimulator().write_found(FOUND, {})
    model = mujoco.MjModel.from_xml_string(text)
    assert np.allclose(model.dof_frictionloss, [0.0, 0.3])
    assert np.allclose(model.dof_damping, [0.7, 0.3])
    assert np.allclose(model.dof_armature, [0.3, 0.12])
    assert sum(model.body_mass) == pytest.approx(5.15)
    assert any("MJCF has no such law: A ripple" in note for note in notes)
    assert "found by lostmotion" in text


def test_a_gear_becomes_two_hinges():
    found = (FoundMechanism("joint_elasticity", "elbow.gear", {"stiffness": 2e4, "damping_ratio": 0.05}, "A gear."),)
    model = mujoco.MjModel.from_xml_string(MujocoSimulator().write_found(found, {})[0])
    assert model.nv == 3
    assert model.jnt_stiffness.max() == pytest.approx(2e4)


def test_hysteresis_in_a_gear_is_a_spring_with_dry_friction():
    values = {"stiffness": 3e2, "damping_ratio": 0.05, "force": 0.7, "travel": 2e-3}
    loop = FoundMechanism("bouc_wen_hysteresis", "elbow.gear", values, "A loop.")
    files = MujocoSimulator().write_found((loop,), {})
    model = mujoco.MjModel.from_xml_string(files.model)
    gear = int(np.argmax(model.jnt_stiffness))
    assert model.nv == 3
    assert model.dof_frictionloss[model.jnt_dofadr[gear]] == pytest.approx(0.7)
    assert any("MJCF has no hysteresis" in note for note in files.notes)


def test_friction_through_bristles_is_a_callback_with_a_memory(registry):
    """A joint that is pushed by less than the friction moves by the bend of the bristles, and stays there.

    With the force F of the bristles and their travel d, a push P bends them by d log(1 / (1 - P / F)) (Dahl, 1976).
    """
    force, travel, push = 2.0, 2e-3, 1.0
    term = registry.make("term", "dahl_friction")
    values = {"force": force, "deflection": travel}
    dahl = FoundMechanism("dahl_friction", "elbow", values, "Bristles.", write_law(term), term.needs, write_rate(term))
    hanging = np.array([[-0.5 * np.pi, 0.0]])
    steps = np.linspace(0.0, 1.0, 1000)
    torque = np.zeros((1, 1500, 2))
    torque[0, :, 1] = push * np.concatenate([steps, np.ones(500)])
    held = FoundMechanism("viscous_damping", "elbow", {"coefficient": 200.0}, "Slow.")
    machine = MujocoSimulator().with_found((dahl, held), {})
    for _ in range(2):  # the bristles of a second run are straight again
        q, _v = machine.roll(hanging, np.zeros((1, 2)), torque, 0.002, step=5e-4)
        gravity = 9.81 * 2.0 * 0.15
        bent = float(q[0, -1, 1])
        left = push - gravity * np.sin(bent)
        assert bent == pytest.approx(travel * np.log(1.0 / (1.0 - left / force)), rel=0.05)


def test_a_floating_base_is_refused_in_words(tmp_path):
    from lostmotion.errors import CaseError

    file = tmp_path / "floating.xml"
    file.write_text(EXAMPLE.replace(HINGE, '<freejoint name="shoulder"/>'), encoding="utf-8")
    floating = MujocoSimulator(file=str(file))
    with pytest.raises(CaseError, match="its base floats"):
        floating.inverse(*np.zeros((3, 4, len(floating.joints))))


def test_a_law_that_mjcf_lacks_is_a_callback_that_acts_as_its_force(registry):
    """A constant force found at the elbow is one more torque there; the written file needs nothing of ours."""
    term = registry.make("term", "offset_force")
    push = FoundMechanism("offset_force", "elbow", {"force": 0.7}, "A constant\nforce.", write_law(term))
    files = MujocoSimulator().write_found((push,), {})
    assert "lostmotion_" not in files.callback
    assert any("in arm_found.py" in note for note in files.notes)
    q, v, torque = np.array([[-1.2, 0.3]]), np.zeros((1, 2)), np.zeros((1, 50, 2))
    plain, pushed = MujocoSimulator().with_found((), {}), MujocoSimulator().with_found((push,), {})
    moved, _ = pushed.roll(q, v, torque, 0.002, step=5e-4)
    told, _ = plain.roll(q, v, torque + np.array([0.0, 0.7]), 0.002, step=5e-4)
    free, _ = plain.roll(q, v, torque, 0.002, step=5e-4)
    assert np.abs(moved - told).max() < 1e-9 < 1e-3 < np.abs(moved - free).max()


def test_the_text_of_a_law_is_its_force(registry):
    """Each law that can be written gives the forces of its term; friction that sticks does with what it needs."""
    rng, written = np.random.default_rng(0), []
    for name in registry.names("term"):
        term = registry.make("term", name)
        text = write_law(term)
        if not text:
            continue
        made = {"math": math}
        exec("from __future__ import annotations\n" + text, made)  # noqa: S102 - the text that is tested
        for _ in range(20):
            p = tuple(rng.uniform(0.1, 1.0, len(term.params) + len(term.needs)))
            x, v = rng.standard_normal(2)
            given = (0.3, x, v, np.zeros(1), p, np.ones(3))
            assert made[name](*given) == pytest.approx(term.force(*given))
        written.append(name)
    assert {"cogging", "offset_force", "quadratic_damping", "cubic_stiffness"} <= set(written)
