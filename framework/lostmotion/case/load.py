"""A case file, read and checked key by key."""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, cast, get_args

from lostmotion.case.channels import inputs_of, sensors_of
from lostmotion.case.fields import Fields
from lostmotion.case.levels import Level, levels_of
from lostmotion.case.prior import Prior, Scale
from lostmotion.equations import equations_of
from lostmotion.errors import CaseError
from lostmotion.provenance import digest
from lostmotion.recording import Hold, RecordingSpec

TOP = ("title", "plugins", "recordings", "levels", "sensor", "experiment", "model", "truth")
RECORDING = (
    "file", "time", "rate", "start", "excitation", "response", "inputs", "sensors", "hold", "t_start", "t_end", "name",
)  # fmt: skip
TIME = ("column", "unit")
MODEL = ("name", "equations", "units", "motion", "known", "estimate")
SENSOR = ("noise", "offset")
WRITTEN = "equations"
"""The name of a model that is written down."""
EXPERIMENT = ("max_level", "max_frequency")
PRIOR = ("low", "high", "scale", "mean", "sd", "median", "sd_log", "half_sd")
FORMS = ({"low", "high"}, {"mean", "sd"}, {"median", "sd_log"}, {"half_sd"})

LARGEST, DOTS = 2**20, 50
"""Bytes of a case file and dots in one line of it, at most."""

Sharing = Literal["each", "shared"]
Motion = Literal["translation", "rotation"]


@dataclass(frozen=True)
class SensorSpec:
    """What is believed of the measurement: whether several recordings share one `noise` or each has its own.

    `offset` is the prior of the zero of the response, in each recording anew, in the SI unit of the channel.
    """

    noise: Sharing = "each"
    offset: Prior | None = None


@dataclass(frozen=True)
class Experiment:
    """What the next experiment may ask: the largest amplitude (SI unit of the excitation), the highest frequency (Hz).

    Where nothing is said, twice those of the recording.
    """

    max_level: float | None = None
    max_frequency: float | None = None


@dataclass(frozen=True)
class CaseFile:
    """What was recorded, what is believed and what is to be estimated, in SI units.

    `folder` is where the case file lies: the files of `recordings` and `plugins` are relative to it. `truth` holds
    true values for the report alone. `digest` is the SHA-256 of the case file. A case may be without recordings or
    without levels: whoever needs them says so. A model that is written down has `equations` and, where they leave
    these open, `units` of its parameters.
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


def load_case(path: Path) -> CaseFile:
    """Return the case that the TOML file `path` describes; `CaseError` for anything that cannot be meant."""
    path = Path(path)
    top = Fields(path.name, "the case", _parse(path)).only(TOP)
    model = top.table("model").only(MODEL)
    known = model.maybe_table("known").numbers()
    motion = cast(Motion, model.choice("motion", get_args(Motion))) if "motion" in model.values else None
    name, equations = _model(model)
    units = {key: model.table("units").text(key) for key in model.maybe_table("units").values}
    estimate = _estimate(model, known)
    coordinate = ""
    if equations:
        named = {key for key in (*known, *estimate) if "." not in key}
        try:
            coordinate = equations_of(equations, units=units, motion=motion, params=named).coordinates[0]
        except CaseError as err:
            raise model.error(f"cannot be used: {err}") from err
    return CaseFile(
        title=top.maybe_text("title") or path.stem,
        folder=path.parent,
        recordings=tuple(_aliased(spec, coordinate) for spec in _recordings(top)),
        model=name,
        known=known,
        estimate=estimate,
        truth=top.maybe_table("truth").numbers(),
        plugins=_plugins(top, path.parent),
        digest=digest(path),
        sensor=_sensor(top),
        levels=levels_of(top),
        experiment=_experiment(top),
        motion=motion,
        equations=equations,
        units=units,
    )


def _model(model: Fields) -> tuple[str, tuple[str, ...]]:
    """Return the name of a model, or that of one that is written down, with its equations."""
    if "name" in model.values and "equations" in model.values:
        raise model.error("has both name and equations: give one of them")
    if "name" not in model.values and "equations" not in model.values:
        raise model.error("lacks 'name': add name = \"lin_backlash\", or equations = [\"m*x'' + c*x' + k*x = force\"]")
    if "name" in model.values:
        if "units" in model.values:
            raise model.error("has units beside name: they go with equations")
        return model.text("name"), ()
    value = model.values["equations"]
    equations = (model.text("equations"),) if isinstance(value, str) else model.texts("equations")
    if not equations:
        raise model.error("has equations = []: give one for each body")
    return WRITTEN, equations


def _aliased(spec: RecordingSpec, coordinate: str) -> RecordingSpec:
    """Return a recording whose sensors of the first coordinate show `position`, `velocity` or `acceleration`."""
    if not coordinate:
        return spec
    same = {coordinate: "position"} | {f"{coordinate}.{rate}": rate for rate in ("velocity", "acceleration")}
    return replace(spec, sensors=tuple(replace(s, of=same.get(s.of, s.of)) for s in spec.sensors))


def _parse(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(_text(path))
    except (tomllib.TOMLDecodeError, ValueError) as err:  # a plain ValueError for a number of thousands of digits
        raise CaseError(f"{path.name} is not valid TOML ({err}): correct it there") from err
    except RecursionError as err:
        raise CaseError(f"{path.name} nests lists or tables hundreds deep: a case needs three levels") from err


def _text(path: Path) -> str:
    """Return the text of a case, of a size that can be one."""
    try:
        if path.exists() and not (path.is_file() or path.is_dir()):
            raise CaseError(f"{path.name} cannot be read (it is no ordinary file): give the path of a case file")
        if path.is_file() and path.stat().st_size > LARGEST:
            raise CaseError(f"{path.name} holds {path.stat().st_size} bytes, a case {LARGEST} at most: is it one?")
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as err:
        if isinstance(err, UnicodeDecodeError):
            raise CaseError(f"{path.name} is not text in UTF-8: wanted a case in TOML, save it as UTF-8") from err
        said = getattr(err, "strerror", None) or err
        raise CaseError(f"{path.name} cannot be read ({said}): give the path of a case file") from err
    if any(line.count(".") > DOTS for line in text.splitlines()):  # the parser is slow on keys of many parts
        raise CaseError(f"{path.name} has a line with more than {DOTS} dots: keys of a case have three parts at most")
    return text


def _plugins(top: Fields, folder: Path) -> tuple[str, ...]:
    files = top.texts("plugins")
    for file in files:
        if not (folder / file).is_file():
            raise top.error(f"names the plugin file {file!r}, which does not exist beside it: correct the name")
    return files


def _recordings(top: Fields) -> tuple[RecordingSpec, ...]:
    if "recordings" not in top.values:
        return ()
    return tuple(_named_apart([_recording(fields) for fields in top.tables("recordings")]))


def _recording(fields: Fields) -> RecordingSpec:
    fields.only(RECORDING)
    _check_span(fields)
    column, unit = _time(fields)
    return RecordingSpec(
        file=fields.path("file"),
        time=column,
        rate=fields.positive("rate") if "rate" in fields.values else None,
        inputs=inputs_of(fields),
        sensors=sensors_of(fields),
        hold=cast(Hold, fields.choice("hold", ("smooth", "step")) if "hold" in fields.values else "smooth"),
        t_start=fields.maybe_number("t_start"),
        t_end=fields.maybe_number("t_end"),
        name=_name(fields),
        time_unit=unit,
        start=fields.maybe_text("start"),
    )


def _time(fields: Fields) -> tuple[str | None, str | None]:
    """Return the time column and its unit, as far as the case gives them."""
    if not isinstance(fields.values.get("time"), dict):
        return fields.maybe_text("time"), None
    table = fields.table("time").only(TIME)
    return table.text("column"), table.maybe_text("unit")


def _name(fields: Fields) -> str | None:
    """Return the name of a recording; results are stored under it, so it is no path."""
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


def _named_apart(specs: list[RecordingSpec]) -> Iterator[RecordingSpec]:
    """Yield the recordings with names that differ; a clash of file stems is numbered, a clash of names refused."""
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


def _estimate(model: Fields, known: Mapping[str, float]) -> dict[str, Prior]:
    fields = model.maybe_table("estimate")
    both = [name for name in fields.values if name in known]
    if both:
        raise model.error(f"has {both[0]!r} both known and estimated: take it out of one of the two")
    return {name: _prior(fields.table(name), ("each",)) for name in fields.values}


def _sensor(top: Fields) -> SensorSpec:
    fields = top.maybe_table("sensor").only(SENSOR)
    noise = fields.choice("noise", get_args(Sharing)) if "noise" in fields.values else "each"
    offset = _prior(fields.table("offset")) if "offset" in fields.values else None
    return SensorSpec(cast(Sharing, noise), offset)


def _experiment(top: Fields) -> Experiment:
    fields = top.maybe_table("experiment").only(EXPERIMENT)
    return Experiment(**{key: fields.positive(key) for key in fields.values})


def _prior(fields: Fields, more: tuple[str, ...] = ()) -> Prior:
    """Return a prior; `more` are the keys beside its numbers that are known where it stands."""
    fields.only((*PRIOR, *more))
    if not any(form <= fields.values.keys() for form in FORMS):
        wanted = "neither low and high nor mean and sd nor median and sd_log nor half_sd"
        raise fields.error(f"has {wanted}: give one of these")
    scale = fields.choice("scale", ("linear", "log")) if "scale" in fields.values else "linear"
    numbers = {key: fields.number(key) for key in fields.values if key not in ("scale", "each")}
    try:
        return Prior(scale=cast(Scale, scale), each=fields.truth("each"), **numbers)
    except CaseError as err:
        raise fields.error(str(err)) from err
