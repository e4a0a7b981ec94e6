"""Every rule of the kit for simulators, and findings written back into MJCF."""

from dataclasses import dataclass

import numpy as np
import pytest
from lostmotion_template.simulators import TwoLink

from lostmotion import testing
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


def test_findings_are_written_into_the_file():
    text, notes = MujocoSimulator().write_found(FOUND, {})
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


def test_a_floating_base_is_refused_in_words(tmp_path):
    from lostmotion.errors import CaseError

    file = tmp_path / "floating.xml"
    file.write_text(EXAMPLE.replace(HINGE, '<freejoint name="shoulder"/>'), encoding="utf-8")
    floating = MujocoSimulator(file=str(file))
    with pytest.raises(CaseError, match="its base floats"):
        floating.inverse(*np.zeros((3, 4, len(floating.joints))))
