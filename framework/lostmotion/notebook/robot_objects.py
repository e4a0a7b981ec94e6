"""Robots as objects: their recordings, and the result of a diagnosis with the model that was found."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from lostmotion.case import Prior
from lostmotion.errors import CaseError, DataError
from lostmotion.notebook.answers import DiagnosisAnswer, format_answer
from lostmotion.recording import Recording
from lostmotion.report import style
from lostmotion.results.diagnosis import Candidate
from lostmotion.results.robots import Check, RobotDiagnosis
from lostmotion.robots.arm_case import RobotCase
from lostmotion.robots.arm_model import RobotModel
from lostmotion.robots.arm_page import RobotEvidence, draw_missing, draw_prediction, render
from lostmotion.robots.arm_run import FOUND_CALLBACK, FOUND_MODEL, save_robot
from lostmotion.robots.log import RobotLog, measure_clock, resample
from lostmotion.simulators import FoundFiles
from lostmotion.storage import folder_for, load_arrays, load_result, save_text

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

RERUN_HINT = "run `lostmotion diagnose` again"
QUANTITIES = ("position", "velocity")


def make_robot_case(
    recording: Recording, model: RobotModel, known: Mapping[str, float], estimate: Mapping[str, Prior], title: str
) -> RobotCase:
    """Return the case of a recording with a torque and a position of each joint of a model.

    Raises `CaseError` for a joint without either, and for an input or a sensor that no robot has.
    """
    columns: dict[tuple[str, str], np.ndarray[Any, Any]] = {}
    for array in (*recording.inputs, *recording.sensors):
        place = str(array.attrs["of"])
        joint, _, quantity = (place, "", "position") if place in model.joints else place.rpartition(".")
        if joint not in model.joints or quantity not in ("force", *QUANTITIES, "acceleration"):
            raise CaseError(
                f"{recording.name} has {place!r}, and the joints are {', '.join(model.joints)}: an input is"
                f" '{model.joints[0]}.torque', a sensor '{model.joints[0]}' or '{model.joints[0]}.velocity'"
            )
        columns[joint, quantity] = np.asarray(array, dtype=float)
    for quantity, word in (("force", "torque"), ("position", "position")):
        if missing := [joint for joint in model.joints if (joint, quantity) not in columns]:
            raise CaseError(
                f"{recording.name} has no {word} of {missing[0]}: add it, or leave the joint out of joints = [...]"
            )
    clock = measure_clock(np.asarray(recording.sensors[0]["time"], dtype=float), recording.name, model.side)
    time = np.asarray(recording.sensors[0]["time"], dtype=float)
    torque = np.stack([columns[joint, "force"] for joint in model.joints], axis=1)
    picks = [(j, o) for o, q in enumerate(QUANTITIES) for j, joint in enumerate(model.joints) if (joint, q) in columns]
    readings = np.stack([columns[model.joints[j], QUANTITIES[o]] for j, o in picks], axis=1)
    hold = "step" if "step" in (model.hold, recording.hold) else "smooth"
    u, _ = resample(time, torque, clock, step=hold == "step")
    z, _ = resample(time, readings, clock, step=False)
    notes = (*recording.notes, *clock.write_notes())
    log = RobotLog(recording.name, model.joints, clock.step, u, z, tuple(picks), hold, notes)
    content = repr((title, repr(model), sorted(known.items()), sorted((k, repr(p)) for k, p in estimate.items())))
    inputs = {"case": hashlib.sha256(content.encode()).hexdigest(), recording.name: recording.digest}
    return RobotCase(title, log, model, known, estimate, inputs)


def make_robot_recording(case: RobotCase) -> Recording:
    """Return the log of a case as a recording, on the even grid that a diagnosis uses."""
    import xarray

    log, moves = case.log, dict(zip(case.model.joints, case.model.simulator.moves, strict=True))
    time = ("time", log.dt * np.arange(log.samples), {"units": "s", "long_name": "time"})

    def make_array(values: Any, joint: str, quantity: str) -> xr.DataArray:
        turns = moves[joint] == "rotation"
        units = {"force": ("N", "N m"), "position": ("m", "rad"), "velocity": ("m/s", "rad/s")}
        attrs = {"units": units[quantity][turns], "quantity": quantity, "noise": "white"}
        attrs["of"] = joint if quantity == "position" else f"{joint}.{quantity}"
        more = {
            "sensor": "" if quantity == "force" else attrs["of"].replace(".", " "),
            "zero": "known",
            "long_name": joint,
        }
        return xarray.DataArray(values, dims="time", coords={"time": time}, attrs=attrs | more)

    inputs = tuple(make_array(u, joint, "force") for u, joint in zip(log.torque.T, log.joints, strict=True))
    sensors = tuple(
        make_array(z, log.joints[j], QUANTITIES[order]) for z, (j, order) in zip(log.readings.T, log.picks, strict=True)
    )
    sha = case.inputs[log.name]
    hold = "step" if log.hold == "step" else "smooth"
    return Recording(log.name, inputs, sensors, log.dt, sha, log.name, hold, log.notes)  # type: ignore[arg-type]


def _refuse(what: str, instead: str) -> NoReturn:
    raise CaseError(f"{what} does not apply to a robot: {instead}")


@dataclass(frozen=True, eq=False)
class FoundRobot:
    """The user's model with what was found in it; `files` is None for a function of inverse dynamics."""

    label: str
    files: FoundFiles | None = field(repr=False)

    @property
    def text(self) -> str | None:
        """The text of its file."""
        return None if self.files is None else self.files.model

    def write_mjcf(self, path: str | Path) -> Path:
        """Write the model with what was found as an MJCF file, and return its path.

        What MJCF cannot express is written beside it, as a Python file with a callback of the same name.
        """
        if self.files is None:
            raise CaseError(
                f"{self.label} has no MJCF file: only models of mujoco = and urdf = are written; the parameters of what"
                " was found are in .found"
            )
        if self.files.callback:
            save_text(Path(path).with_suffix(".py"), self.files.callback.replace("arm_found", Path(path).stem))
        return save_text(Path(path), self.files.model)

    def simulate(self, *_: Any, **__: Any) -> NoReturn:
        """Raise `CaseError`: a robot is simulated by the simulator of its model."""
        _refuse("simulate", "write the model with .write_mjcf('arm_found.xml'), and step it in MuJoCo")


@dataclass(frozen=True, eq=False)
class RobotPlots:
    """The figures of a diagnosis of a robot; each method returns a matplotlib figure."""

    evidence: RobotEvidence

    def __repr__(self) -> str:
        return "<figures of a diagnosis of a robot: .prediction(), .missing_force()>"

    def __call__(self) -> Figure:
        """Return the errors of free runs over held-out data, before and after."""
        return self.prediction()

    def prediction(self) -> Figure:
        """Return the errors of free runs over held-out data, before and after."""
        with style.use_style("rad"):
            return draw_prediction(self.evidence)

    def missing_force(self) -> Figure:
        """Return the torque of each joint that the model does not explain, over its position and its velocity."""
        with style.use_style("rad"):
            return draw_missing(self.evidence)

    def __getattr__(self, name: str) -> NoReturn:
        if name in ("ranking", "parameters", "sections", "learned_force"):
            _refuse(f"plot.{name}", "there are plot.prediction() and plot.missing_force(); .ranking holds the numbers")
        raise AttributeError(f"there is no figure {name!r}: there are prediction and missing_force")


@dataclass(frozen=True, eq=False)
class RobotResult(DiagnosisAnswer[RobotDiagnosis]):
    """The result of `lostmotion.diagnose` for a robot; its representation is the answer in words.

    `result` is the diagnosis with the content of `diagnosis.json`, `arrays` the dataset behind it, `written` the text
    of the model with what was found.
    """

    written: FoundFiles | None = field(repr=False)

    @property
    def checks(self) -> tuple[Check, ...]:
        """What was looked at before any fit."""
        return self.result.checks

    @property
    def ranking(self) -> tuple[Candidate, ...]:
        """Every set of mechanisms that was fitted, the most probable first."""
        return self.result.ranking

    @property
    def model(self) -> FoundRobot:
        """The model with what was found: `.write_mjcf("arm_found.xml")` writes it."""
        return FoundRobot(self.result.model.before, self.written)

    @cached_property
    def evidence(self) -> RobotEvidence:
        """The result and its arrays in the form that the figures use."""
        return RobotEvidence(self.result, self.arrays)

    @property
    def plot(self) -> RobotPlots:
        """The figures: `plot.prediction()` and `plot.missing_force()`."""
        return RobotPlots(self.evidence)

    def to_arviz(self) -> NoReturn:
        """Raise `CaseError`: the diagnosis of a robot draws no samples."""
        _refuse("to_arviz", "its posterior is normal and not sampled; .parameters_after has medians and intervals")

    def report(self, path: str | Path = "report.html") -> Path:
        """Write the page as self-contained HTML and return its path."""
        return save_text(Path(path), render(self.evidence))

    def save(self, folder: str | Path) -> Path:
        """Write `diagnosis.json`, `arrays.nc`, `report.html` and the found model into a folder, and return it."""
        place = folder_for(Path(folder))
        save_robot(place, self.result, self.arrays, self.written)
        return place

    def __repr__(self) -> str:
        return "\n".join([f"{self.result.title}: {self.verdict}", *self.says])

    def _repr_html_(self) -> str:
        figure = style.embed_figure(self.plot.prediction(), "prediction")
        return format_answer(f"{self.result.title}: {self.verdict}", self.says, figure)


def load_robot(folder: Path) -> RobotResult:
    """Return the diagnosis of a robot stored in a folder; raise `DataError` where it is absent or damaged."""
    result = load_result(RobotDiagnosis, folder / "diagnosis.json", RERUN_HINT)
    texts = [_read_text(folder / name) for name in (FOUND_MODEL, FOUND_CALLBACK)]
    files = None if texts[0] is None else FoundFiles(texts[0], (), texts[1] or "")
    return RobotResult(result, load_arrays(folder / "arrays.nc", RERUN_HINT), files)


def _read_text(file: Path) -> str | None:
    """Return the text of a file; None where it is absent."""
    try:
        return file.read_text(encoding="utf-8") if file.is_file() else None
    except (OSError, ValueError) as err:
        raise DataError(f"{file} cannot be read ({err}): {RERUN_HINT}") from err
