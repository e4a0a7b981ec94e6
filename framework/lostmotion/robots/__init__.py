"""Machines with many joints, of which the user has a simulation: the physics that it lacks, and the joint.

The simulation is asked once for its inverse dynamics along the recorded path (`tape`). Every likelihood then runs in
compiled code, and terms of the library act as generalised forces at joints.
"""

from __future__ import annotations

from pathlib import Path

from lostmotion.case.reading import parse_case
from lostmotion.registry import Registry
from lostmotion.simulators import INVERSE


def is_robot_case(path: Path, registry: Registry) -> bool:
    """Return whether the model of a case file is a simulation of the user; raise `CaseError` for no valid file."""
    model = parse_case(path).get("model")
    return isinstance(model, dict) and bool({INVERSE, *registry.names("simulator")} & model.keys())
