"""The case of a recording in a file, as `init` would write it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from lostmotion.case import Prior
from lostmotion.contracts import Machine
from lostmotion.errors import CaseError
from lostmotion.notebook.case import Case
from lostmotion.preparation.beginning import write_first_case
from lostmotion.recording.outline import GivenRoles
from lostmotion.registry import Registry
from lostmotion.robots.arm_model import RobotModel
from lostmotion.settings import Settings


def read_recorded_case(
    path: Path,
    given: Machine | type[Machine] | RobotModel | str | Sequence[str] | None,
    known: Mapping[str, float],
    estimate: Mapping[str, Prior],
    registry: Registry,
    limits: Settings,
) -> Case:
    """Return the case of a recording in a file, with the guesses of `init`, which stand in the notes of the recording.

    `known` and `estimate` replace guesses.
    """
    if isinstance(given, (Machine, RobotModel, type)):
        raise CaseError("beside the file of a recording the model is a name or equations: make a Recording for others")
    words = given if isinstance(given, str) else ";".join(given or ())
    with TemporaryDirectory() as spare:
        draft = write_first_case(path.absolute(), Path(spare) / "case.toml", GivenRoles(), registry, words)
        made = Case.read(Path(spare) / "case.toml", registry, limits)
    notes = tuple(line.strip() for line in draft.found)
    recordings = tuple(replace(one, notes=(*notes, *one.notes)) for one in tuple(made.recordings))  # type: ignore[arg-type]
    fixed = {name: value for name, value in made.known.items() if name not in estimate}
    priors = {name: prior for name, prior in made.estimate.items() if name not in known}
    return Case(recordings, made.model, {**fixed, **known}, {**priors, **estimate}, path.stem)
