"""Arms with two joints: a simulator in NumPy, and logs from an integrator that shares no code with it."""

import sys
from pathlib import Path

import numpy as np
import pytest

from lostmotion.registry import Registry
from lostmotion.robots.arm_preparation import SearchOptions, make_arm, prepare_search
from lostmotion.robots.log import RobotLog
from lostmotion.robots.user import FunctionSimulator
from lostmotion_trials.integrators.arm import Arm, record_motion

sys.path.insert(0, str(Path(__file__).parents[2] / "plugins" / "template" / "src"))
sys.path.insert(0, str(Path(__file__).parent))
JOINTS = ("shoulder", "elbow")
ARMATURE, DAMPING = (0.3, 0.1), (0.5, 0.3)


class OwnArm(FunctionSimulator):
    """The inverse dynamics of the integrator's own arm, without armature and damping."""

    @property
    def taken(self):
        found = {f"{j}.armature": x for j, x in zip(JOINTS, ARMATURE, strict=True)}
        return found | {f"{j}.damping": x for j, x in zip(JOINTS, DAMPING, strict=True)}


def make_simulator():
    plain = Arm(armature=np.zeros(2), damping=np.zeros(2))
    return OwnArm(plain.torque, JOINTS)


def record(arm, seed=0, samples=3000):
    """Return the log of an arm whose controller knows the usual one."""
    log = record_motion(arm, Arm(), np.random.default_rng(seed), samples=samples)
    return RobotLog("log", JOINTS, 0.002, log.torque, log.encoder, ((0, 0), (1, 0)))


@pytest.fixture(scope="session")
def registry():
    return Registry.discover()


@pytest.fixture(scope="session")
def terms(registry):
    return [registry.make("term", name) for name in registry.names("term")]


@pytest.fixture
def search_of(terms):
    """Return a function that searches for what an arm lacks."""

    def search(log, names=None, most=2):
        simulator = make_simulator()
        kept = [t for t in terms if names is None or t.name in names]
        found, start = prepare_search(make_arm(simulator, log), simulator, kept, {}, SearchOptions(most=most))
        return found.run(start)

    return search


@pytest.fixture(scope="session")
def helpers():
    """Return the functions of this file, which test modules cannot import."""
    return sys.modules[__name__]
