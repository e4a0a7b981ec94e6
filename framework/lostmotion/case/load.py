"""A case file, read and checked key by key."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, cast

from lostmotion.case.fields import Fields
from lostmotion.case.prior import Prior, Scale
from lostmotion.errors import CaseError, DataError
from lostmotion.provenance import digest
from lostmotion.quantities import si_factor
from lostmotion.recording import Channel, Hold, RecordingSpec
from lostmotion.recording.spec import EXCITATIONS, RESPONSES

TOP = ("title", "plugins", "recordings", "model", "truth")
RECORDING = ("file", "time", "rate", "excitation", "response", "hold", "t_start", "t_end", "name")
CHANNEL = ("column", "quantity", "unit", "factor")
MODEL = ("name", "known", "estimate")
PRIOR = ("low", "high", "scale", "mean", "sd")


@dataclass(frozen=True)
class Case:
    """What was recorded, what is believed and what is to be estimated, in SI units.

    `folder` is where the case file lies: the files of `recordings` and `plugins` are relative to it. `truth` holds
    true values for the report alone. `digest` is the SHA-256 of the case file.
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


def load_case(path: Path) -> Case:
    """Return the case that the TOML file `path` describes; `CaseError` for anything that cannot be meant."""
    path = Path(path)
    top = Fields(path.name, "the case", _parse(path)).only(TOP)
    model = top.table("model").only(MODEL)
    known = model.maybe_table("known").numbers()
    return Case(
        title=top.maybe_text("title") or path.stem,
        folder=path.parent,
        recordings=tuple(_named_apart([_recording(fields) for fields in top.tables("recordings")])),
        model=model.text("name"),
        known=known,
        estimate=_estimate(model, known),
        truth=top.maybe_table("truth").numbers(),
        plugins=_plugins(top, path.parent),
        digest=digest(path),
    )


def _parse(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as err:
        raise CaseError(f"{path.name} cannot be read ({err.strerror}): give the path of a case file") from err
    except UnicodeDecodeError as err:
        raise CaseError(f"{path.name} is not text in UTF-8: wanted a case in TOML, save it as UTF-8") from err
    except tomllib.TOMLDecodeError as err:
        raise CaseError(f"{path.name} is not valid TOML ({err}): correct it there") from err


def _plugins(top: Fields, folder: Path) -> tuple[str, ...]:
    files = top.texts("plugins")
    for file in files:
        if not (folder / file).is_file():
            raise top.error(f"names the plugin file {file!r}, which does not exist beside it: correct the name")
    return files


def _recording(fields: Fields) -> RecordingSpec:
    fields.only(RECORDING)
    _check_span(fields)
    return RecordingSpec(
        file=fields.text("file"),
        time=fields.maybe_text("time"),
        rate=_positive(fields, "rate"),
        excitation=_channel(fields.table("excitation"), EXCITATIONS),
        response=_channel(fields.table("response"), RESPONSES),
        hold=cast(Hold, fields.choice("hold", ("smooth", "step")) if "hold" in fields.values else "smooth"),
        t_start=fields.maybe_number("t_start"),
        t_end=fields.maybe_number("t_end"),
        name=fields.maybe_text("name"),
    )


def _check_span(fields: Fields) -> None:
    if ("time" in fields.values) == ("rate" in fields.values):
        found = "both time and rate" if "time" in fields.values else "neither time nor rate"
        raise fields.error(f"has {found}: give one, time = 'a column in seconds' or rate = 1000.0 (Hz)")
    start, end = fields.maybe_number("t_start"), fields.maybe_number("t_end")
    if start is not None and end is not None and start >= end:
        raise fields.error(f"has t_start = {start:g} and t_end = {end:g}: t_start must lie before t_end")


def _positive(fields: Fields, key: str) -> float | None:
    value = fields.maybe_number(key)
    if value is not None and value <= 0:
        raise fields.wrong(key, "a positive number")
    return value


def _channel(fields: Fields, quantities: tuple[str, ...]) -> Channel:
    fields.only(CHANNEL)
    factor = fields.maybe_number("factor")
    if factor == 0:
        raise fields.wrong("factor", "a number other than zero")
    channel = Channel(
        column=fields.text("column"),
        quantity=fields.choice("quantity", quantities),
        unit=fields.text("unit"),
        factor=1.0 if factor is None else factor,
    )
    try:
        si_factor(channel.unit, channel.quantity)
    except DataError as err:
        raise fields.error(f"has a wrong unit: {err}") from err
    return channel


def _named_apart(specs: list[RecordingSpec]) -> Iterator[RecordingSpec]:
    """Yield the recordings with names that differ; a clash of file stems is numbered, a clash of names refused."""
    given = [spec.name for spec in specs if spec.name]
    for name in given:
        if given.count(name) > 1:
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
    return {name: _prior(fields.table(name)) for name in fields.values}


def _prior(fields: Fields) -> Prior:
    fields.only(PRIOR)
    if not ({"low", "high"} <= fields.values.keys() or {"mean", "sd"} <= fields.values.keys()):
        raise fields.error("has neither low and high nor mean and sd: give one of these pairs")
    scale = fields.choice("scale", ("linear", "log")) if "scale" in fields.values else "linear"
    numbers = {key: fields.number(key) for key in fields.values if key != "scale"}
    try:
        return Prior(scale=cast(Scale, scale), **numbers)
    except CaseError as err:
        raise fields.error(str(err)) from err
