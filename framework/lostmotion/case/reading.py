"""Reading of a case file, with a check of each key."""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, cast, get_args

from lostmotion.case.channels import inputs_of, sensors_of
from lostmotion.case.drive_levels import Level, levels_of
from lostmotion.case.fields import Fields
from lostmotion.case.prior import Prior, Scale
from lostmotion.equations import equations_of, name_inputs
from lostmotion.errors import CaseError
from lostmotion.provenance import digest
from lostmotion.recording import Hold, RecordingSpec

TOP = ("title", "guessed", "plugins", "recordings", "levels", "sensor", "experiment", "model", "truth")
RECORDING = (
    "file", "time", "rate", "start", "excitation", "response", "inputs", "sensors", "hold", "t_start", "t_end", "name",
)  # fmt: skip
TIME = ("column", "unit")
MODEL = ("name", "dynamics", "equations", "units", "motion", "known", "estimate")
MACHINES = ("name", "dynamics", "equations")
"""The keys of which one names the machine."""
SENSOR = ("noise", "offset")
WRITTEN = "equations"
"""The name of a model that is given by equations."""
GUESSED = "guessed: "
"""The beginning of a note on what a case supposes."""
EXPERIMENT = ("max_level", "max_frequency")
PRIOR = ("low", "high", "scale", "mean", "sd", "median", "sd_log", "half_sd")
FORMS = ({"low", "high"}, {"mean", "sd"}, {"median", "sd_log"}, {"half_sd"})

LARGEST, DOTS = 2**20, 50
"""The greatest size (bytes) of a case file, and number of dots in one line."""

Sharing = Literal["each", "shared"]
Motion = Literal["translation", "rotation"]


@dataclass(frozen=True)
class SensorSpec:
    """Assumptions about the measurement: whether several recordings share one `noise` or each has its own.

    `offset` is the prior of the zero of a sensor, separate for each recording, in the SI unit of the channel.
    """

    noise: Sharing = "each"
    offset: Prior | None = None


@dataclass(frozen=True)
class Experiment:
    """Limits of the next experiment: the largest amplitude (SI unit of the excitation), the highest frequency (Hz).

    The defaults are twice those of the recording.
    """

    max_level: float | None = None
    max_frequency: float | None = None


@dataclass(frozen=True)
class CaseFile:
    """A case: measurements, known parameters and priors of the parameters to be estimated, in SI units.

    `folder` is the folder of the case file, to which the files of `recordings` and `plugins` are relative. `truth`
    contains true values for the report only. `digest` is the SHA-256 of the case file. A case may have no recordings
    or no levels; commands that need them raise an error. `kind` is "dynamics" for a machine that is stepped. A model
    given by `equations` may have `units` of parameters that the equations do not determine. `notes` are sentences on
    what was supposed.
    """

    title: str
    folder: Path
    recordings: tuple[RecordingSpec, ...]
    model: str
    known: Mapping[str, float]
    estimate: Mapping[str, Prior]
    truth: Mapping[str, float]
    plugins: tuple[str, ...]
    digest: str
    sensor: SensorSpec = SensorSpec()
    levels: tuple[Level, ...] = ()
    experiment: Experiment = Experiment()
    motion: Motion | None = None
    equations: tuple[str, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    kind: Literal["model", "dynamics"] = "model"


def load_case(path: Path) -> CaseFile:
    """Return the case in the TOML file `path`; raise `CaseError` for anything that cannot be valid."""
    path = Path(path)
    top = Fields(path.name, "the case", parse_case(path)).only(TOP)
    model = top.table("model").only(MODEL)
    known = model.maybe_table("known").numbers()
    motion = cast(Motion, model.choice("motion", get_args(Motion))) if "motion" in model.values else None
    name, equations = _read_model(model, path.parent)
    units = {key: model.table("units").text(key) for key in model.maybe_table("units").values}
    estimate = _read_estimate(model, known)
    coordinate, recordings, notes = "", _read_recordings(top), top.texts("guessed") if "guessed" in top.values else ()
    if equations:
        named = {key for key in (*known, *estimate) if "." not in key}
        recorded = [channel.target for spec in recordings for channel in spec.inputs]
        try:
            equations, said = name_inputs(equations, recorded, named)
            notes = (*notes, *said)
            coordinate = equations_of(equations, units=units, motion=motion, params=named).coordinates[0]
        except CaseError as err:
            raise model.error(f"cannot be used: {err}") from err
    return CaseFile(
        title=top.maybe_text("title") or path.stem,
        folder=path.parent,
        recordings=tuple(_rename_channels(spec, coordinate) for spec in recordings),
        model=name,
        kind="dynamics" if "dynamics" in model.values else "model",
        known=known,
        estimate=estimate,
        truth=top.maybe_table("truth").numbers(),
        plugins=_read_plugins(top, path.parent),
        digest=digest(path),
        sensor=_read_sensor(top),
        levels=levels_of(top),
        experiment=_read_experiment(top),
        motion=motion,
        equations=equations,
        units=units,
        notes=tuple(f"{GUESSED}{says}" for says in notes),
    )


def _read_model(model: Fields, folder: Path) -> tuple[str, tuple[str, ...]]:
    """Return the name of the model, and its equations if it is given by equations."""
    given = [key for key in MACHINES if key in model.values]
    if len(given) > 1:
        raise model.error(f"has both {given[0]} and {given[1]}: give one of them")
    if not given:
        raise model.error("lacks 'name': add name = \"lin_backlash\", or equations = [\"m*x'' + c*x' + k*x = force\"]")
    if given[0] != "equations":
        if "units" in model.values:
            raise model.error(f"has units besides {given[0]}: units belong to equations")
        name = model.text(given[0])
        file = name.partition(":")[0]
        if given[0] == "dynamics" and file.endswith(".py") and not (folder / file).is_file():
            raise model.error(f"names the file {file!r}, which does not exist beside it: write 'my_arm.py:MyArm'")
        return name, ()
    value = model.values["equations"]
    equations = (model.text("equations"),) if isinstance(value, str) else model.texts("equations")
    if not equations:
        raise model.error("has equations = []: give one for each body")
    return WRITTEN, equations


def _rename_channels(spec: RecordingSpec, coordinate: str) -> RecordingSpec:
    """Return a recording in which sensors of the first coordinate have the channels `position`, `velocity`, ..."""
    if not coordinate:
        return spec
    same = {coordinate: "position"} | {f"{coordinate}.{rate}": rate for rate in ("velocity", "acceleration")}
    return replace(spec, sensors=tuple(replace(s, of=same.get(s.of, s.of)) for s in spec.sensors))


def parse_case(path: Path) -> dict[str, Any]:
    """Return the content of a case file; raise `CaseError` if it is too large, or is no valid TOML."""
    try:
        return tomllib.loads(_read_text(path))
    except (tomllib.TOMLDecodeError, ValueError) as err:  # ValueError is raised for a number with thousands of digits
        raise CaseError(f"{path.name} is not valid TOML ({err}): correct this place") from err
    except RecursionError as err:
        raise CaseError(f"{path.name} nests lists or tables hundreds deep: a case needs three levels") from err


def _read_text(path: Path) -> str:
    """Return the text of a case file; raise `CaseError` if it is too large or is no text."""
    shown = path.name if path.name.isprintable() else repr(path.name[:80])
    try:
        if path.exists() and not (path.is_file() or path.is_dir()):
            raise CaseError(f"{shown} cannot be read (it is not a regular file): give the path of a case file")
        if path.is_file() and path.stat().st_size > LARGEST:
            raise CaseError(
                f"{path.name} holds {path.stat().st_size} bytes, and a case {LARGEST} at most: is it a case file?"
            )
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as err:
        if isinstance(err, UnicodeDecodeError):
            raise CaseError(f"{path.name} is not text in UTF-8: expected a case in TOML, save it as UTF-8") from err
        said = getattr(err, "strerror", None) or err
        raise CaseError(f"{shown} cannot be read ({said}): give the path of a case file") from err
    if any(line.count(".") > DOTS for line in text.splitlines()):  # the TOML parser is slow for keys of many parts
        raise CaseError(f"{path.name} has a line with more than {DOTS} dots: keys of a case have three parts at most")
    return text


def _read_plugins(top: Fields, folder: Path) -> tuple[str, ...]:
    files = top.texts("plugins")
    for file in files:
        if not (folder / file).is_file():
            raise top.error(f"names the plugin file {file!r}, which does not exist beside it: correct the name")
    return files


def _read_recordings(top: Fields) -> tuple[RecordingSpec, ...]:
    if "recordings" not in top.values:
        return ()
    return tuple(_number_names([_read_recording(fields) for fields in top.tables("recordings")]))


def _read_recording(fields: Fields) -> RecordingSpec:
    fields.only(RECORDING)
    _check_span(fields)
    column, unit = _read_time(fields)
    return RecordingSpec(
        file=fields.path("file"),
        time=column,
        rate=fields.positive("rate") if "rate" in fields.values else None,
        inputs=inputs_of(fields),
        sensors=sensors_of(fields),
        hold=cast(Hold, fields.choice("hold", ("smooth", "step")) if "hold" in fields.values else "smooth"),
        t_start=fields.maybe_number("t_start"),
        t_end=fields.maybe_number("t_end"),
        name=_read_name(fields),
        time_unit=unit,
        start=fields.maybe_text("start"),
    )


def _read_time(fields: Fields) -> tuple[str | None, str | None]:
    """Return the time column and its unit, each None where the case gives none."""
    if not isinstance(fields.values.get("time"), dict):
        return fields.maybe_text("time"), None
    table = fields.table("time").only(TIME)
    return table.text("column"), table.maybe_text("unit")


def _read_name(fields: Fields) -> str | None:
    """Return the name of a recording, which must be no path, since results are stored under it."""
    name = fields.maybe_text("name")
    if name and "/" in name:
        raise fields.wrong("name", "a name without '/'")
    return name


def _check_span(fields: Fields) -> None:
    if ("time" in fields.values) == ("rate" in fields.values):
        found = "both time and rate" if "time" in fields.values else "neither time nor rate"
        raise fields.error(f"has {found}: give one, time = 'a column' or rate = 1000.0 (Hz)")
    start, end = fields.maybe_number("t_start"), fields.maybe_number("t_end")
    if start is not None and end is not None and start >= end:
        raise fields.error(f"has t_start = {start:g} and t_end = {end:g}: t_start must lie before t_end")


def _number_names(specs: list[RecordingSpec]) -> Iterator[RecordingSpec]:
    """Yield the recordings with unique names: equal file stems get numbers, equal given names raise `CaseError`."""
    given = Counter(spec.name for spec in specs if spec.name)
    for name, count in given.items():
        if count > 1:
            raise CaseError(f"two recordings are named {name!r}: give each its own name")
    taken: set[str] = set(given)
    for spec in specs:
        name, k = spec.label, 1
        while name in taken and not spec.name:
            k += 1
            name = f"{spec.label} {k}"
        taken.add(name)
        yield replace(spec, name=name)


def _read_estimate(model: Fields, known: Mapping[str, float]) -> dict[str, Prior]:
    fields = model.maybe_table("estimate")
    both = [name for name in fields.values if name in known]
    if both:
        raise model.error(f"has {both[0]!r} both known and estimated: remove it from one of the two")
    return {name: read_prior(fields.table(name), ("each",)) for name in fields.values}


def _read_sensor(top: Fields) -> SensorSpec:
    fields = top.maybe_table("sensor").only(SENSOR)
    noise = fields.choice("noise", get_args(Sharing)) if "noise" in fields.values else "each"
    offset = read_prior(fields.table("offset")) if "offset" in fields.values else None
    return SensorSpec(cast(Sharing, noise), offset)


def _read_experiment(top: Fields) -> Experiment:
    fields = top.maybe_table("experiment").only(EXPERIMENT)
    return Experiment(**{key: fields.positive(key) for key in fields.values})


def read_prior(fields: Fields, more: tuple[str, ...] = ()) -> Prior:
    """Return a prior; `more` are further keys that are allowed at its place."""
    fields.only((*PRIOR, *more))
    if not any(form <= fields.values.keys() for form in FORMS):
        wanted = "neither low and high nor mean and sd nor median and sd_log nor half_sd"
        raise fields.error(f"has {wanted}: give one of these")
    scale = fields.choice("scale", ("linear", "log")) if "scale" in fields.values else "linear"
    numbers = {key: fields.number(key) for key in fields.values if key not in ("scale", "each")}
    try:
        return Prior(scale=cast(Scale, scale), each=fields.flag("each"), **numbers)
    except CaseError as err:
        raise fields.error(str(err)) from err
