"""Preparation of a case for the stages: recordings, model and candidate terms."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from lostmotion.case import WRITTEN, CaseFile, check_same_sensors, load_case
from lostmotion.contracts import Machine, Term
from lostmotion.errors import CaseError, ContractError, nearest
from lostmotion.likelihood.observation import Observation, make_observation
from lostmotion.likelihood.sensor_noise import has_clock_noise
from lostmotion.noises import BASIC, Noise
from lostmotion.preparation.candidate_terms import candidates_of
from lostmotion.preparation.vetting import make_plugin, usable_terms
from lostmotion.quantities import ROTATES, quantity_of
from lostmotion.recording import Recording, load_recording
from lostmotion.recording.decimation import thin_recording
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT, Settings
from lostmotion.written import model_of


@dataclass(frozen=True)
class Prepared:
    """A case with its recordings, its model, and every term that can act in that model.

    `origins` are the digests or versions of third-party plugins, `aside` sentences on those that cannot be used.
    """

    case: CaseFile
    recordings: tuple[Recording, ...]
    observations: tuple[Observation, ...]
    model: Machine
    terms: tuple[Term, ...]
    origins: Mapping[str, str] = field(default_factory=dict)
    aside: tuple[str, ...] = ()

    @property
    def inputs(self) -> dict[str, str]:
        """The digests of all inputs, by file name."""
        return {**self.origins, "case": self.case.digest, **{r.name: r.digest for r in self.recordings}}

    @property
    def notes(self) -> tuple[str, ...]:
        """What the case supposes, the warnings about recordings, and the notes on plugins that cannot be used."""
        several = len(self.recordings) > 1
        of_recordings = (f"{r.name}: {n}" if several else n for r in self.recordings for n in r.notes)
        return (*self.case.notes, *of_recordings, *self.aside)


def case_of(path: Path, registry: Registry) -> CaseFile:
    """Return the case at `path` after adding its plugin files and its written model to the registry."""
    case = load_case(path)
    for plugin in case.plugins:
        registry.add_file(case.folder / plugin)
    if case.equations:
        named = {name for name in (*case.known, *case.estimate) if "." not in name}
        registry.add(model_of(case.equations, units=case.units, motion=case.motion, params=named), WRITTEN)
    return case if case.kind == "model" else replace(case, model=find_dynamics(case.model, case.folder, registry))


def find_dynamics(text: str, folder: Path, registry: Registry) -> str:
    """Return the name of a `Dynamics`, given as its name or as `file.py:Class`, after adding its file to the registry.

    The file is relative to a folder. Raises `PluginError` or `CaseError` where there is no such class.
    """
    file, _, word = text.partition(":")
    if not file.endswith(".py"):
        return text
    path = os.path.normpath(folder / file)
    registry.add_file(path)
    here = [e for e in registry.entries() if (e.kind, e.owner) == ("dynamics", path)]
    classes = {entry.target.rpartition(":")[2]: entry.name for entry in here}
    if not word and len(classes) == 1:
        return next(iter(classes.values()))
    if word not in classes:
        known = f"it has {', '.join(classes)}" if classes else "write a subclass of lostmotion.contracts.Dynamics in it"
        near = nearest(word, classes)
        raise CaseError(f"dynamics = {text!r}: {file} has no class {word!r} of the kind Dynamics{near}: {known}")
    return classes[word]


def prepare(path: Path, registry: Registry, settings: Settings = DEFAULT) -> Prepared:
    """Return the case at `path`, ready for the stages; raise an error for anything that cannot be valid."""
    return prepare_case(case_of(path, registry), registry, settings)


def prepare_case(case: CaseFile, registry: Registry, settings: Settings = DEFAULT) -> Prepared:
    """Return a case with its recordings, its model and its terms, loaded from the files of the case."""
    if not case.recordings:
        raise CaseError("the case has no [[recordings]]: add one, with file, time or rate, excitation and response")
    check_same_sensors(tuple(spec.sensors for spec in case.recordings))
    recordings = tuple(load_recording(spec, case.folder, settings.recording) for spec in case.recordings)
    return prepare_loaded(case, recordings, make_plugin(registry, case.kind, case.model), registry, settings)


def prepare_loaded(
    case: CaseFile, loaded: Sequence[Recording], model: Machine, registry: Registry, settings: Settings = DEFAULT
) -> Prepared:
    """Return a case with recordings that are loaded already, a given model, and its terms."""
    recordings = tuple(thin_recording(one, settings.recording) for one in loaded)
    model = resolve_motion(model, case, recordings)

    def make_noise(name: str) -> Noise:
        made: Noise = BASIC[name]() if name in BASIC else make_plugin(registry, "noise", name)
        return made

    observations = tuple(make_observation(r, model, held=r.hold == "step", make_noise=make_noise) for r in recordings)
    for observation in observations:
        _refuse_clock_noise(observation)
    known, aside = usable_terms(registry)
    return Prepared(
        case, recordings, observations, model, candidates_of(model, known, observations), registry.origins(), aside
    )


def _refuse_clock_noise(observation: Observation) -> None:
    """Raise `CaseError` for jitter of the stamps of an accelerometer: its speed, the jerk, is no state of a model.

    The jerk is the derivative of all forces, and forces such as dry friction jump.
    """
    for sensor in observation.sensors:
        wrong = next((noise.name for noise in sensor.noises if has_clock_noise(noise)), "")
        if wrong and quantity_of(sensor.channel) == "acceleration":
            raise CaseError(
                f"{observation.name}: the sensor {sensor.label!r} measures an acceleration, and the noise {wrong!r}"
                " needs the speed of its channel, which jumps with dry friction: use it for a position or a velocity,"
                " and 'white' or 'ar1' here"
            )


def resolve_motion(model: Machine, case: CaseFile, recordings: Sequence[Recording]) -> Machine:
    """Return the model in translation or in rotation, according to the case or to the units of the recordings.

    `CaseError` is raised where units do not fit each other or the model.
    """
    shown = {}
    for recording in recordings:
        for array in (*recording.inputs, *recording.sensors):
            shown[ROTATES[str(array.attrs["units"])]] = f"{array.attrs['long_name']} in {array.attrs['units']}"
    if len(shown) > 1:
        raise CaseError(
            f"the units mix translation and rotation ({' and '.join(shown.values())}): torques belong to angles,"
            " forces to lengths; correct a unit, or give factor"
        )
    found = next(iter(shown))
    if case.motion and case.motion != found:
        raise CaseError(
            f"[model] says motion = {case.motion!r}, but {shown[found]} is of a {found}: correct one of the two"
        )
    if found == model.motion:
        return model
    try:
        return model.turned(found)
    except ContractError as err:
        raise CaseError(f"{shown[found]} does not fit: {err}") from err
