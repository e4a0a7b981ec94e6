"""A first case for a recording that nobody has prepared: which columns, which model, and wide priors from the data."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.case import WRITTEN
from lostmotion.contracts import Array, Model
from lostmotion.defaults import CARRIAGE, JOINT, OSCILLATOR, SLIDER
from lostmotion.errors import CaseError
from lostmotion.parts import Param
from lostmotion.preparation.prepare import prepare
from lostmotion.preparation.vetting import sound
from lostmotion.quantities import LENGTH, si_factor
from lostmotion.recording.checks import fill_lost
from lostmotion.recording.outline import GivenRoles, Outline, OutlinedColumn, outline_table
from lostmotion.registry import Registry
from lostmotion.signals import refined_period
from lostmotion.signals.repetition import period_found
from lostmotion.written import Written, is_equation, model_of

WIDE = 10.0
"""A prior reaches this factor below and above what a straight line through the spectra says."""
WIDER = 300.0
"""And this factor about a natural scale, where nothing else is known."""
HEARD = 1e-3
"""Lines of the drive count from this share of the strongest on."""
SPRUNG = 0.02
"""A spring is told from this share of the drive on."""
Waves = NDArray[np.complex128]
POWERS = {"position": 0, "velocity": 1, "acceleration": 2}


@dataclass(frozen=True)
class Draft:
    """A first case: the text of `case.toml`, what was found in sentences, and what looks wrong."""

    text: str
    found: tuple[str, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class RecordedScales:
    """What a recording says of the size of things in SI units: a force (N, N m), a length (m, rad), a time (s).

    `straight` holds mass, damping and stiffness of the straight line through the spectra, as far as they are positive.
    """

    force: float
    length: float
    time: float
    straight: Mapping[str, float]


def begun(
    path: Path,
    out: Path,
    roles: GivenRoles,
    registry: Registry,
    model: str = "",
    factors: Mapping[str, float] | None = None,
) -> Draft:
    """Return the draft of a case for the recording `path`, written to the file `out`, with what looks wrong in it.

    `factors` multiply a column before its unit, for instance newtons per volt. Raises `DataError` where roles cannot be
    told, `CaseError` where the model cannot take them.
    """
    outline, gains = outline_table(path, roles), factors or {}
    scales = scales_of(outline, gains)
    machine = (
        _machine(registry, model)
        if is_equation(model)
        else sound(registry, "model", model or _model_for(outline, scales))
    )
    _check(outline, machine)
    text = _text(outline, machine, scales, gains, Path(os.path.relpath(path, out.parent)).as_posix())
    out.write_text(text, encoding="utf-8")
    return Draft(text, tuple(_found(outline, machine, gains)), tuple(prepare(out, registry).notes))


def _machine(registry: Registry, equations: str) -> Model:
    """Return a model that is written down, several equations with semicolons between them; the registry learns it."""
    cls: Any = model_of([text.strip() for text in equations.split(";") if text.strip()])
    registry.add(cls, WRITTEN)
    machine: Model = cls()
    return machine


def _model_for(outline: Outline, scales: RecordedScales) -> str:
    """Return the textbook model of what was recorded: a joint where the base moves, else an oscillator or a drive."""
    drive = outline.drive
    if drive is not None and drive.kind == "position":
        return JOINT if drive.turns else SLIDER
    return OSCILLATOR if "k" in scales.straight or drive is None or drive.kind != "force" else CARRIAGE


def _check(outline: Outline, machine: Model) -> None:
    """Refuse a model that has not the input or the channel that were recorded."""
    wanted = input_of(outline)
    if wanted and wanted not in machine.inputs:
        raise CaseError(
            f"{machine.name} has no input {wanted!r}: it has {', '.join(machine.inputs)}; give another --model"
        )
    if outline.response.kind not in machine.channels:
        listed = ", ".join(machine.channels)
        raise CaseError(
            f"{machine.name} has no channel {outline.response.kind!r}: it has {listed}; give another --model"
        )


def input_of(outline: Outline) -> str:
    """Return the input of a model that the drive is; an empty string where nothing drives the machine."""
    if outline.drive is None:
        return ""
    return f"base_{outline.drive.kind}" if outline.base_driven else "force"


def scales_of(outline: Outline, factors: Mapping[str, float]) -> RecordedScales:
    """Return the natural sizes of a recording, and mass, damping and stiffness of the straight line through spectra."""
    drive = outline.drive
    pushed = _filled(drive, factors) if drive is not None and drive.kind == "force" else None
    return sizes_of(_filled(outline.response, factors), outline.response.kind, pushed, outline.dt)


def sizes_of(seen: Array, kind: str, pushed: Array | None, dt: float) -> RecordedScales:
    """Return the natural sizes of a response (n,) of a kind, and of the force (n,) that drives it, both without mean.

    They are in SI units, and sampled every `dt` s.
    """
    spectrum, omega = _spectrum(seen, dt)
    power = POWERS.get(kind, 0)
    motion = spectrum / (1j * omega) ** power
    weight = np.abs(motion) ** 2
    mean = float(np.sum(weight * omega**2) / np.sum(weight))
    pace = math.sqrt(mean) if mean > 0.0 else 1.0
    length = float(np.std(seen)) / pace**power
    if pushed is None:
        return RecordedScales(length * pace**2, length, 1.0 / pace, {})
    return RecordedScales(float(np.std(pushed)), length, 1.0 / pace, _straight(_spectrum(pushed, dt)[0], motion, omega))


def _filled(column: OutlinedColumn, factors: Mapping[str, float]) -> Array:
    """Return a column (n,) in SI units without its mean; lost readings are bridged by straight lines."""
    values = column.values * si_factor(column.stated_unit, column.kind)[0] * factors.get(column.name, 1.0)
    even = fill_lost(values)
    return np.asarray(even - even.mean())


def _spectrum(values: Array, dt: float) -> tuple[Waves, Array]:
    """Return the spectrum of a tapered series below 0.8 of the Nyquist frequency, without its mean; and omega."""
    omega = 2.0 * math.pi * np.fft.rfftfreq(values.size, dt)
    kept = slice(2, int(0.8 * omega.size))
    return np.fft.rfft(values * np.hanning(values.size))[kept], np.asarray(omega[kept], dtype=float)


def _straight(force: Waves, motion: Waves, omega: Array) -> dict[str, float]:
    """Return mass, damping and stiffness by least squares of F = (k + i c w - m w^2) X, those that are positive.

    Only lines that the drive has are counted. A stiffness is left out whose force is small beside the drive.
    """
    heard = np.abs(force) > HEARD * np.abs(force).max()
    f, x, w = force[heard], motion[heard], omega[heard]
    rows = np.stack([-(w**2) * x, 1j * w * x, x], axis=1)
    sizes = np.linalg.norm(rows, axis=0)
    rows, aim = np.vstack([rows.real, rows.imag]) / sizes, np.concatenate([f.real, f.imag])
    found = np.linalg.lstsq(rows, aim, rcond=1e-9)[0] / sizes
    shares = found * sizes / np.linalg.norm(f)
    names = dict(zip(("m", "c", "k"), zip(found.tolist(), shares.tolist(), strict=True), strict=True))
    return {name: value for name, (value, share) in names.items() if value > 0.0 and (name != "k" or share > SPRUNG)}


def _text(outline: Outline, machine: Model, scales: RecordedScales, factors: Mapping[str, float], file: str) -> str:
    head = (
        "# A first case, made by `lostmotion init`. Check columns, units and signs; remarks say what was guessed.",
        f"title = {_quoted(Path(outline.file).stem)}",
        "",
        "[[recordings]]",
        f"file = {_quoted(file)}",
        *_channels(outline, factors),
        "",
        "[model]",
        _named(machine),
        "",
    )
    return "\n".join([*head, *_parameters(outline, machine, scales)]) + "\n"


def _named(machine: Model) -> str:
    """Return the line that says which model it is."""
    if isinstance(machine, Written):
        return f"equations = [{', '.join(_quoted(text) for text in machine.equations)}]"
    return f'name = "{machine.name}"  # `lostmotion plugins show {machine.name}` tells what it is'


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _channels(outline: Outline, factors: Mapping[str, float]) -> Iterator[str]:
    """Yield the lines on time, inputs and sensors."""
    drive, response = outline.drive, outline.response
    if outline.time is None:
        yield f"rate = {1.0 / outline.dt:.9g}  # Hz"
    elif outline.time_unit == "s":
        yield f"time = {_quoted(outline.time)}"
    else:
        yield f"time = {{ column = {_quoted(outline.time)}, unit = {_quoted(outline.time_unit)} }}"
    if drive is None:
        yield "inputs = []  # nothing drives the machine: the state in which it begins is estimated"
    else:
        yield f"inputs = [{_channel('input', input_of(outline), drive, factors)}]{_doubt(drive)}"
    yield f"sensors = [{_channel('channel', response.kind, response, factors)}]{_doubt(response)}"
    taken = (drive.name if drive else "", response.name)
    unused = [f"{c.name} ({c.unit or 'no unit'})" for c in outline.columns if c.name not in taken]
    if unused:
        yield f"# not used: {', '.join(unused)}; further sensors go into the list above"


def _channel(key: str, name: str, column: OutlinedColumn, factors: Mapping[str, float]) -> str:
    named = f", name = {_quoted(column.name)}" if key == "channel" and _plain(column.name) else ""
    factor = f", factor = {factors[column.name]!r}" if column.name in factors else ""
    told = _quoted(column.name), _quoted(column.stated_unit)
    return f'{{ {key} = "{name}", column = {told[0]}, unit = {told[1]}{factor}{named} }}'


def _plain(name: str) -> bool:
    """Return whether a column may give its name to a sensor."""
    return not set("[]:/@.") & set(name)


def _doubt(column: OutlinedColumn) -> str:
    if column.sure:
        return ""
    why = f"the file says {column.unit}, which may need a factor" if column.unit else "the file gives no unit"
    return f"  # {why}: {column.stated_unit} and {column.kind} are guesses"


def _parameters(outline: Outline, machine: Model, scales: RecordedScales) -> Iterator[str]:
    """Yield what is known and what is to be estimated; without a force the inertia has to be known."""
    motion = "rotation" if outline.response.turns else "translation"
    forced = "force" in (outline.response.kind, outline.drive.kind if outline.drive else "")
    known, ranges = guesses(machine, scales, forced=forced)
    params = {param.name: param for param in machine.params}
    if known:
        yield "[model.known]"
        for name, (value, why) in known.items():
            yield f"{name} = {value}  # {params[name].dimension.unit(motion)}: {why}"
        yield ""
    yield "[model.estimate]  # wide priors; what a data sheet says belongs into [model.known]"
    for name, (low, high, why) in ranges.items():
        yield (
            f'{name} = {{ low = {_figures(low)}, high = {_figures(high)}, scale = "log" }}'
            f"  # {params[name].dimension.unit(motion)}: {params[name].meaning}, {why}"
        )


def guesses(
    machine: Model, scales: RecordedScales, *, forced: bool
) -> tuple[dict[str, tuple[float, str]], dict[str, tuple[float, float, str]]]:
    """Return values of parameters that have to be known, and ranges of all others, each with the reason.

    Without a force only ratios to the inertia can be told. All parameters of equations are estimated, as positive.
    """
    inertia = machine.interfaces[0].inertia
    told = isinstance(machine, Written)
    known = {
        p.name: (1.0, "only ratios to it can be told: put the true one") if p.scale == "log" else (0.0, p.meaning)
        for p in machine.params
        if (p.name == inertia and not forced) or (p.scale != "log" and not told)
    }
    return known, {p.name: _range(p, scales, forced) for p in machine.params if p.name not in known}


def _range(param: Param, scales: RecordedScales, forced: bool) -> tuple[float, float, str]:
    if param.name in scales.straight:
        value = scales.straight[param.name]
        return value / WIDE, value * WIDE, f"about {_figures(value)} by the spectra"
    if param.dimension == LENGTH:
        return scales.length / 1e3, 3.0 * scales.length, "beside the size of the motion"
    force = scales.force if forced else scales.length / scales.time**2
    value = param.dimension.scale(force, scales.length, scales.time)
    return value / WIDER, value * WIDER, "from the sizes of drive and motion"


def _figures(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _found(outline: Outline, machine: Model, factors: Mapping[str, float]) -> Iterator[str]:
    """Yield what was found in the table, one sentence for each thing."""
    clock = f"time in the column {outline.time!r} ({outline.time_unit})" if outline.time else "no column of time"
    yield f"{outline.file}: {outline.samples} rows at {1.0 / outline.dt:.6g} Hz, {clock}"
    for column in outline.columns:
        yield _described(column, outline)
    if outline.drive is not None:
        period = _period(_filled(outline.drive, factors), outline.dt) if outline.drive.moves else None
        yield f"the drive repeats every {period:.4g} s" if period else "the drive does not repeat"
    else:
        yield "nothing looks like a drive, so this is taken for a free decay: if there is one, give --drive COLUMN"
    yield f"model: {'; '.join(machine.equations) if isinstance(machine, Written) else machine.name}"


def _period(pushed: Array, dt: float) -> float | None:
    """Return the period (s) of a drive (n,), or None; one that is too short for its spectrum is laid over itself."""
    period = refined_period(pushed, dt)
    if period is None:
        lag = period_found(pushed, _noise(pushed))
        period = None if lag is None else lag * dt
    return period


def _described(column: OutlinedColumn, outline: Outline) -> str:
    column = outline.response if column.name == outline.response.name else column
    roles = {outline.drive.name if outline.drive else "": "drive", outline.response.name: "response"}
    role = roles.get(column.name, "not used")
    taken = f", taken for {column.stated_unit}" if column.kind and not column.sure else ""
    seen = column.values[np.isfinite(column.values)]
    if not seen.size:
        return f"  {column.name}: no reading at all"
    size = f"{seen.min():.4g} to {seen.max():.4g}"
    lost = f", {column.lost} readings lost" if column.lost else ""
    noise = f", noise about {_noise(seen):.2g}" if role == "response" else ""
    named = f"  {column.name} ({column.unit or 'no unit'}{taken})"
    return f"{named}: {column.kind or 'unknown'}, {size}{noise}{lost} -> {role}"


def _noise(values: Array) -> float:
    """Return the deviation of white noise (n,) by sixth differences, of which smooth motion has next to none."""
    return float(np.std(np.diff(values, 6)) / math.sqrt(math.comb(12, 6))) if values.size > 20 else 0.0
