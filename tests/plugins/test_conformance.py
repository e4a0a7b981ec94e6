"""Our own plugins keep every rule that a third party's must keep."""

from importlib.util import find_spec

import pytest

from lostmotion import testing
from lostmotion.registry import KINDS, Registry

REGISTRY = Registry.discover()
OURS = [e for e in REGISTRY.entries() if e.owner == "lostmotion" and e.kind in KINDS]
NEED_MUJOCO = {"mujoco", "urdf"}


def test_all_of_ours_are_ready():
    assert [e for e in OURS if e.state != "ready"] == []
    assert {e.kind for e in OURS} >= {"model", "term"}


@testing.parametrize([REGISTRY.load(e.kind, e.name) for e in OURS])
def test_conforms(component, rule):
    if component.name in NEED_MUJOCO and find_spec("mujoco") is None:
        pytest.skip("MJCF and URDF need the extra mujoco")
    testing.assert_conforms(component, rule)
