"""A case as an object: recordings, a model, its known values, and the priors of the estimated parameters."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lostmotion.arguments import Rule, checked, describe, instance, list_texts, text
from lostmotion.case import GUESSED, WRITTEN, CaseFile, Experiment, Prior, SensorSpec, check_same_sensors, dump_case
from lostmotion.contracts import Dynamics, Machine
from lostmotion.equations import name_inputs
from lostmotion.errors import CaseError, PluginError, nearest
from lostmotion.notebook.argument_rules import KNOWN, PRIORS, TRIED, modelled
from lostmotion.notebook.models import model
from lostmotion.notebook.robot_objects import make_robot_case, make_robot_recording
from lostmotion.preparation.prepare import Prepared, case_of, prepare_loaded
from lostmotion.preparation.vetting import make_plugin
from lostmotion.recording import Recording, load_recording
from lostmotion.registry import Registry, default
from lostmotion.registry.classes import kind_of
from lostmotion.robots import is_robot_case
from lostmotion.robots.arm_case import RobotCase, load_robot_case
from lostmotion.robots.arm_model import RobotModel
from lostmotion.settings import DEFAULT, Settings, read
from lostmotion.storage import folder_for, save_table
from lostmotion.written import Written, is_equation, model_of

if TYPE_CHECKING:
    from lostmotion.diagnosis.tried_model import TriedPrediction


_RULES: Mapping[str, Rule] = {
    "model": modelled,
    "known": KNOWN,
    "estimate": PRIORS,
    "title": text,
    "truth": KNOWN,
    "sensor": instance(SensorSpec, "a SensorSpec"),
    "experiment": instance(Experiment, "an Experiment"),
}


def _list_recordings(given: Any) -> tuple[Recording, ...]:
    several = (given,) if isinstance(given, Recording) else given if isinstance(given, (list, tuple)) else ()
    if not several or not all(isinstance(one, Recording) for one in several):
        found = "" if several else f", and recordings is {describe(given)}"
        raise CaseError(f"a case needs a Recording, or a list of them{found}: lm.Recording.from_arrays(...) makes one")
    return tuple(several)


@dataclass(frozen=True, eq=False)
class Case:
    """Recordings, a model, known values (SI), and the priors of the estimated parameters.

    `recordings` is one recording or several with the same sensors. `model` is a model, a name, or equations, or the
    simulation of a robot, which needs one recording with the torque and the position of each joint. `truth`
    holds true values, which only appear in figures and tables. `sensor` describes the noise that several recordings
    share. `notes` are sentences on what was supposed. Raises `CaseError` for a case that is not valid.
    """

    recordings: Recording | Sequence[Recording]
    model: Machine | type[Machine] | RobotModel | str | Sequence[str]
    known: Mapping[str, float] = field(default_factory=dict)
    estimate: Mapping[str, Prior] = field(default_factory=dict)
    title: str = "case"
    truth: Mapping[str, float] = field(default_factory=dict)
    sensor: SensorSpec = field(default_factory=SensorSpec)
    experiment: Experiment = field(default_factory=Experiment)
    file: CaseFile | RobotCase | None = field(default=None, repr=False)
    notes: tuple[str, ...] = field(default=(), repr=False)

    def __post_init__(self) -> None:
        several = _list_recordings(self.recordings)
        for name, rule in _RULES.items():
            object.__setattr__(self, name, rule(getattr(self, name), name))
        object.__setattr__(self, "recordings", several)
        check_same_sensors(tuple(_describe_sensors(one) for one in several))
        if both := sorted(set(self.known) & set(self.estimate)):
            raise CaseError(f"{both[0]!r} is both known and estimated: remove it from one of the two")
        if isinstance(self.model, RobotModel):
            self._place_robot(self.model, several)
            return
        made, notes = self._name_inputs(self._make_model())
        object.__setattr__(self, "model", made)
        object.__setattr__(self, "notes", (*self.notes, *notes))
        if isinstance(made, Written):
            object.__setattr__(
                self, "recordings", tuple(_rename_coordinate(one, made.coordinates[0]) for one in several)
            )

    def _place_robot(self, model: RobotModel, several: Sequence[Recording]) -> None:
        """Keep the case of a robot as `file`, made of its recording unless it was read."""
        if len(several) > 1:
            raise CaseError(f"the case has {len(several)} recordings: a robot is diagnosed from one; give the longest")
        if not isinstance(self.file, RobotCase):
            made = make_robot_case(several[0], model, self.known, self.estimate, self.title)
            object.__setattr__(self, "file", made)

    @property
    def robot(self) -> RobotCase | None:
        """The case of a robot; None for any other case."""
        return self.file if isinstance(self.file, RobotCase) else None

    def _make_model(self) -> Machine:
        """Return the model as an instance, from an instance, a class, a name or equations."""
        given = self.model
        if isinstance(given, Machine):
            return given
        if isinstance(given, type):
            return given()
        lines: tuple[str, ...] = (given,) if isinstance(given, str) else tuple(given)  # type: ignore[arg-type]
        named = len(lines) == 1 and not is_equation(lines[0])
        more = {} if named else {"params": [key for key in (*self.known, *self.estimate) if "." not in key]}
        made: Machine = model(lines[0] if named else lines, **more)
        return made

    def _name_inputs(self, made: Machine) -> tuple[Machine, tuple[str, ...]]:
        """Return a model whose equations name the recorded inputs, and a sentence where they did not."""
        if not isinstance(made, Written):
            return made, ()
        recorded = [str(array.attrs["of"]) for one in self._recordings for array in one.inputs]
        texts, units, motion, params = made.origin
        owned = {*params, *(key for key in (*self.known, *self.estimate) if "." not in key)}
        named, notes = name_inputs(texts, recorded, owned)
        if named == texts:
            return made, ()
        cls: Any = model_of(named, units=dict(units), motion=motion, params=owned)
        return cls(), tuple(f"{GUESSED}{says}" for says in notes)

    @classmethod
    def read(
        cls,
        path: str | Path,
        registry: Registry | None = None,
        settings: Settings | Mapping[str, float] | None = None,
    ) -> Case:
        """Return the case of a `case.toml` with loaded recordings; raise `CaseError` or `DataError` if unusable."""
        known = registry or default()
        if is_robot_case(Path(path), known):
            robot = load_robot_case(Path(path), known)
            seen = make_robot_recording(robot)
            return cls(seen, robot.model, robot.known, robot.estimate, robot.title, file=robot)
        file = case_of(Path(path), known)
        loaded = tuple(load_recording(spec, file.folder, read(settings).recording) for spec in file.recordings)
        made = make_plugin(known, file.kind, file.model)
        made = made.turned(file.motion) if file.motion else made
        return cls(
            loaded,
            made,
            file.known,
            file.estimate,
            file.title,
            file.truth,
            file.sensor,
            file.experiment,
            file=file,
            notes=file.notes,
        )

    def write(self, folder: str | Path) -> Path:
        """Write `case.toml` and a table of each recording into a folder, all in SI units, and return the path.

        No file is written where the model cannot be named in a file.
        """
        place = Path(folder)
        model = self._robot_table(self.robot, place) if self.robot is not None else self._model_table(place)
        place = folder_for(place)
        written = self._recordings if self.robot is None else (make_robot_recording(self.robot),)
        entries = [_write_recording(one, place) for one in written]
        content: dict[str, Any] = {"title": self.title, "recordings": entries, "model": model}
        content |= {"guessed": [note.removeprefix(GUESSED) for note in self.notes]} if self.notes else {}
        content |= self._further_tables()
        dump_case(content, place / "case.toml")
        return place / "case.toml"

    def _robot_table(self, robot: RobotCase, folder: Path) -> dict[str, Any]:
        """Return the table `[model]` of a robot; raise `CaseError` for a function that no file holds."""
        made = robot.model
        if not made.source:
            raise CaseError('no file holds the function: write it into a file, and give inverse="my_model.py:inverse"')
        source = Path(os.path.relpath(made.source, folder)).as_posix()
        table = {made.kind: source, "joints": list(made.joints), "torque": made.side, "tolerance": made.tolerance}
        return {**table, "known": dict(self.known), "estimate": {k: _format_prior(p) for k, p in self.estimate.items()}}

    def _further_tables(self) -> dict[str, Any]:
        """Return the tables `[truth]`, `[sensor]` and `[experiment]`, except empty ones."""
        offset, usual = self.sensor.offset, SensorSpec()
        sensor = {
            "noise": None if self.sensor.noise == usual.noise else self.sensor.noise,
            "offset": None if offset is None else _format_prior(offset),
        }
        limits = {"max_level": self.experiment.max_level, "max_frequency": self.experiment.max_frequency}
        tables: dict[str, dict[str, Any]] = {"truth": dict(self.truth), "sensor": sensor, "experiment": limits}
        kept = {name: {k: v for k, v in table.items() if v is not None} for name, table in tables.items()}
        return {name: table for name, table in kept.items() if table}

    def _model_table(self, folder: Path) -> dict[str, Any]:
        """Return the table `[model]`; raise `CaseError` for a model that no file defines."""
        made = self._model
        if isinstance(made, Written):
            table: dict[str, Any] = {"equations": list(made.equations), "motion": made.motion}
            table |= {"units": dict(made.origin[1])} if made.origin[1] else {}
        else:
            try:
                owner = default().entry(kind_of(made), made.name).owner
            except PluginError as err:
                raise CaseError(f"no file defines {made.name}: write it into a file and name that in plugins") from err
            table = {"name": made.name, "motion": made.motion}
            if isinstance(made, Dynamics):
                source = f"{Path(os.path.relpath(owner, folder)).as_posix()}:{type(made).__name__}"
                table = {"dynamics": source if owner.endswith(".py") else made.name, "motion": made.motion}
        return {**table, "known": dict(self.known), "estimate": {k: _format_prior(p) for k, p in self.estimate.items()}}

    @property
    def _recordings(self) -> tuple[Recording, ...]:
        return tuple(self.recordings)  # type: ignore[arg-type]

    @property
    def _model(self) -> Machine:
        return self.model  # type: ignore[return-value]

    def prepare(self, registry: Registry, terms: str | Sequence[str] = "all", settings: Settings = DEFAULT) -> Prepared:
        """Return the prepared case for the stages, with the candidate terms: "all", or names of terms."""
        if isinstance(self.file, RobotCase):
            raise CaseError("the case is that of a robot, whose parameters diagnose estimates: call lm.diagnose(case)")
        file = self.file or self._make_case_file()
        made = self._model
        if isinstance(made, Written) or made.name not in registry.names(kind_of(made)):
            registry.add(
                type(made) if isinstance(made, Written) else made, WRITTEN if isinstance(made, Written) else None
            )
        found = prepare_loaded(file, self._recordings, made, registry, settings)
        return found if terms == "all" else replace(found, terms=_choose_terms(found, terms))

    @checked(**TRIED)
    def predict(
        self,
        values: Mapping[str, float] | None = None,
        terms: str | Sequence[str] = (),
        *,
        begin: float | None = None,
        every: float | None = None,
        registry: Registry | None = None,
    ) -> TriedPrediction:
        """Return how the model would predict the first recording with some `values` (SI), without a fit.

        Estimated parameters without a value are at the middle of their priors. `terms` are keys of terms, whose values
        are named `coulomb_friction.force`. Free runs begin `begin` s after the first sample, by default after a short
        transient, and restart after `every` s, by default some cycles of the motion.
        """
        from lostmotion.diagnosis.tried_model import TriedModel

        tried = TriedModel.of(self.prepare(registry or default()))
        return tried.predict(values or {}, list_texts(terms), begin=begin, every=every)

    def _make_case_file(self) -> CaseFile:
        """Return the case in the form of a case file, with a digest of its content."""
        made = self._model
        content = repr(
            (
                self.title,
                made,
                made.origin if isinstance(made, Written) else (),
                sorted(self.known.items()),
                sorted((k, repr(p)) for k, p in self.estimate.items()),
            )
        )
        return CaseFile(
            title=self.title,
            folder=Path(),
            recordings=(),
            model=made.name,
            kind="dynamics" if isinstance(made, Dynamics) else "model",
            known=dict(self.known),
            estimate=dict(self.estimate),
            truth=dict(self.truth),
            plugins=(),
            digest=hashlib.sha256(content.encode()).hexdigest(),
            sensor=self.sensor,
            experiment=self.experiment,
            equations=made.equations if isinstance(made, Written) else (),
            units=dict(made.origin[1]) if isinstance(made, Written) else {},
            notes=self.notes,
        )

    def __repr__(self) -> str:
        names = ", ".join(one.name for one in self._recordings)
        name = self.model.label if isinstance(self.model, RobotModel) else self._model.name
        return f"<Case {self.title!r}: {name} on {names}; known {[*self.known]}, estimated {[*self.estimate]}>"


def _rename_coordinate(recording: Recording, coordinate: str) -> Recording:
    """Return the recording with the channels of the first coordinate named position, velocity or acceleration."""
    same = {coordinate: "position"} | {f"{coordinate}.{rate}": rate for rate in ("velocity", "acceleration")}
    sensors = tuple(a.assign_attrs(of=same.get(a.attrs["of"], a.attrs["of"])) for a in recording.sensors)
    return replace(recording, sensors=sensors)


def _describe_sensors(recording: Recording) -> tuple[Any, ...]:
    """Return the sensors of a recording in the form of a case file."""
    from lostmotion.recording import Channel

    return tuple(
        Channel("", str(a.attrs["quantity"]), str(a.attrs["units"]), of=str(a.attrs["of"]), name=str(a.attrs["sensor"]))
        for a in recording.sensors
    )


def _choose_terms(found: Prepared, terms: str | Sequence[str]) -> tuple[Any, ...]:
    """Return the terms with these names, each at all its places, or, as NAME@PLACE, at one place."""
    asked = (terms,) if isinstance(terms, str) else tuple(terms)
    names = dict.fromkeys(term.name for term in found.terms)
    keys = {f"{term.name}@{term.at}" for term in found.terms}
    for wanted in asked:
        name, mark, place = wanted.partition("@")
        if name not in names:
            raise CaseError(
                f"no term {name!r} can act in this case{nearest(name, names)}: there are {', '.join(names)}"
            )
        if mark and wanted not in keys:
            places = [term.at for term in found.terms if term.name == name]
            raise CaseError(f"{name} cannot act at {place!r}{nearest(place, places)}: it can at {', '.join(places)}")
    return tuple(term for term in found.terms if {term.name, f"{term.name}@{term.at}"} & set(asked))


def _format_prior(prior: Prior) -> dict[str, Any]:
    """Return a prior in the form of a case file."""
    forms: dict[str, dict[str, Any]] = {
        "uniform": {"low": prior.low, "high": prior.high},
        "log-uniform": {"low": prior.low, "high": prior.high, "scale": "log"},
        "normal": {"mean": prior.mean, "sd": prior.sd},
        "log-normal": {"median": prior.median, "sd_log": prior.sd_log},
        "half-normal": {"half_sd": prior.half_sd},
    }
    return {**forms[prior.kind], **({"each": True} if prior.each else {})}


def _write_recording(recording: Recording, folder: Path) -> dict[str, Any]:
    """Write the table of a recording, and return its entry in the case file."""
    name = re.sub(r"[^\w.-]+", "_", recording.name).strip("._") or "recording"
    first = recording.sensors[0]
    columns = {"time": np.asarray(first["time"], dtype=float)}
    columns |= {f"input {a.attrs['of']}": np.asarray(a) for a in recording.inputs}
    columns |= {str(a.attrs["sensor"] or a.attrs["of"]): np.asarray(a) for a in recording.sensors}
    save_table(folder / f"{name}.csv", columns, {}, {})
    return {
        "file": f"{name}.csv",
        "name": recording.name,
        "time": {"column": "time", "unit": "s"},
        "hold": recording.hold,
        "start": recording.start,
        "inputs": [
            {"input": str(a.attrs["of"]), "column": f"input {a.attrs['of']}", "unit": str(a.attrs["units"])}
            for a in recording.inputs
        ],
        "sensors": [
            {
                "channel": str(a.attrs["of"]),
                "column": str(a.attrs["sensor"] or a.attrs["of"]),
                "unit": str(a.attrs["units"]),
                "noise": str(a.attrs["noise"]),
                "zero": str(a.attrs["zero"]),
                **({"name": str(a.attrs["sensor"])} if a.attrs["sensor"] else {}),
            }
            for a in recording.sensors
        ],
    }
