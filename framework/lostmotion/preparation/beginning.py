"""A first case for a new recording: roles of the columns, a model, and wide priors from the data."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.case import GUESSED, WRITTEN
from lostmotion.contracts import Array, Model
from lostmotion.defaults import CARRIAGE, JOINT, OSCILLATOR, SLIDER
from lostmotion.equations import name_inputs
from lostmotion.errors import CaseError
from lostmotion.parts import Param
from lostmotion.preparation.guessed import check_guesses, list_guesses
from lostmotion.preparation.prepare import prepare
from lostmotion.preparation.vetting import make_plugin
from lostmotion.quantities import LENGTH, si_factor
from lostmotion.recording.outline import GivenRoles, Outline, OutlinedColumn, outline_table
from lostmotion.recording.value_checks import fill_lost
from lostmotion.registry import Registry
from lostmotion.signals import refined_period
from lostmotion.signals.repetition import period_found
from lostmotion.written import Written, is_equation, model_of

WIDE = 10.0
"""A prior extends by this factor below and above the value of a linear fit to the spectra."""
WIDER = 300.0
"""And by this factor about a natural scale, where no such value is known."""
HEARD = 1e-3
"""Frequencies of the drive count from this share of the strongest one on."""
SPRUNG = 0.02
"""A stiffness is used when its force is at least this share of the drive."""
LONG = 50_000
"""The number of samples of a drive in which its period is sought first."""
Waves = NDArray[np.complex128]
POWERS = {"position": 0, "velocity": 1, "acceleration": 2}


@dataclass(frozen=True)
class Draft:
    """A first case: the text of `case.toml`, the findings in sentences, and warnings."""

    text: str
    found: tuple[str, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class RecordedScales:
    """The natural scales of a recording in SI units: a force (N, N m), a length (m, rad), a time (s).

    `straight` contains mass, damping and stiffness of a linear fit to the spectra, where they are positive.
    """

    force: float
    length: float
    time: float
    straight: Mapping[str, float]


def write_first_case(
    path: Path,
    out: Path,
    roles: GivenRoles,
    registry: Registry,
    model: str = "",
    factors: Mapping[str, float] | None = None,
) -> Draft:
    """Return the draft of a case for the recording `path`, with warnings, after writing it to the file `out`.

    `factors` multiply a column before its unit, for instance newtons per volt. `DataError` is raised where roles cannot
    be found, `CaseError` where the model does not support them.
    """
    outline, gains = outline_table(path, roles), factors or {}
    scales = scales_of(outline, gains)
    said: tuple[str, ...] = ()
    if is_equation(model):
        machine, said = _make_written(registry, model, input_of(outline))
    else:
        machine = make_plugin(registry, "model", model or _choose_model(outline, scales))
    check_guesses(outline, gains, free=roles.drive == "none")
    _check_model(outline, machine)
    known = guesses(machine, scales, forced=_has_force(outline))[0]
    supposed = [*list_guesses(outline, machine, known), *said]
    if not model:
        supposed.append(f"the model is {machine.name}, since none was given")
    file = Path(os.path.relpath(path, out.parent)).as_posix()
    text = _format_case(outline, machine, scales, gains, (file, supposed))
    out.write_text(text, encoding="utf-8")
    return Draft(
        text,
        tuple(_list_findings(outline, machine, gains)),
        tuple(note.removeprefix(GUESSED) for note in prepare(out, registry).notes),
    )


def _make_written(registry: Registry, equations: str, driven: str) -> tuple[Model, tuple[str, ...]]:
    """Return a model made from equations, separated by semicolons, after adding it to the registry.

    A name in them that stands for the input `driven` is exchanged, and a sentence says so.
    """
    texts = [text.strip() for text in equations.split(";") if text.strip()]
    named, said = name_inputs(texts, [driven] if driven else [])
    cls: Any = model_of(named)
    registry.add(cls, WRITTEN)
    machine: Model = cls()
    return machine, said


def _choose_model(outline: Outline, scales: RecordedScales) -> str:
    """Return the name of a textbook model for the recording: a joint for a moved base, an oscillator or a drive."""
    drive = outline.drive
    if drive is not None and drive.kind == "position":
        return JOINT if drive.turns else SLIDER
    return OSCILLATOR if "k" in scales.straight or drive is None or drive.kind != "force" else CARRIAGE


def _check_model(outline: Outline, machine: Model) -> None:
    """Raise `CaseError` for a model without the recorded input or channel."""
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
    """Return the input of a model for the drive; an empty string where nothing drives the machine."""
    if outline.drive is None:
        return ""
    return f"base_{outline.drive.kind}" if outline.base_driven else "force"


def scales_of(outline: Outline, factors: Mapping[str, float]) -> RecordedScales:
    """Return the natural scales of a recording, with mass, damping and stiffness of a linear fit to the spectra."""
    drive = outline.drive
    pushed = _to_centred(drive, factors) if drive is not None and drive.kind == "force" else None
    return sizes_of(_to_centred(outline.response, factors), outline.response.kind, pushed, outline.dt)


def sizes_of(seen: Array, kind: str, pushed: Array | None, dt: float) -> RecordedScales:
    """Return the natural scales of a response (n,) of a kind, and of its driving force (n,), both without mean.

    Both are in SI units and sampled every `dt` s.
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
    return RecordedScales(float(np.std(pushed)), length, 1.0 / pace, _fit_line(_spectrum(pushed, dt)[0], motion, omega))


def _to_centred(column: OutlinedColumn, factors: Mapping[str, float]) -> Array:
    """Return a column (n,) in SI units without its mean; lost readings are interpolated linearly."""
    values = column.values * si_factor(column.stated_unit, column.kind)[0] * factors.get(column.name, 1.0)
    even = fill_lost(values)
    return np.asarray(even - even.mean())


def _spectrum(values: Array, dt: float) -> tuple[Waves, Array]:
    """Return the spectrum of a tapered series up to 0.8 of the Nyquist frequency, and omega (rad/s)."""
    omega = 2.0 * math.pi * np.fft.rfftfreq(values.size, dt)
    kept = slice(2, int(0.8 * omega.size))
    return np.fft.rfft(values * np.hanning(values.size))[kept], np.asarray(omega[kept], dtype=float)


def _fit_line(force: Waves, motion: Waves, omega: Array) -> dict[str, float]:
    """Return mass, damping and stiffness from a least-squares fit of F = (k + i c w - m w^2) X, if positive.

    Only frequencies of the drive count. A stiffness is left out if its force is small compared with the drive.
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


def _format_case(
    outline: Outline,
    machine: Model,
    scales: RecordedScales,
    factors: Mapping[str, float],
    of: tuple[str, Sequence[str]],
) -> str:
    """Return the text of a case; `of` are the path of the recording and the sentences on what is supposed."""
    file, supposed = of
    head = (
        "# A first case, made by `lostmotion init`. Check columns, units and signs; remarks mark guesses.",
        f"title = {_quote(Path(outline.file).stem)}",
        *_format_guesses(supposed),
        "",
        *_format_recordings(outline, factors, file),
        "[model]",
        _format_model(machine),
        "",
    )
    return "\n".join([*head, *_format_parameters(outline, machine, scales)]) + "\n"


def _format_recordings(outline: Outline, factors: Mapping[str, float], file: str) -> Iterator[str]:
    """Yield the lines of the recording, or of each of its stretches between gaps in the time."""
    if outline.cut:
        used = "each is a recording, the last ones are held out" if len(outline.stretches) > 1 else "one is used"
        yield f"# The time has gaps. Of the stretches between them {used}."
    for stretch in outline.stretches or (None,):
        yield from ("[[recordings]]", f"file = {_quote(file)}", *_format_channels(outline, factors))
        yield from (f"{key} = {value!r}" for key, value in (stretch.keys.items() if stretch else ()))
        yield ""


def _format_guesses(supposed: Sequence[str]) -> Iterator[str]:
    """Yield the lines of the guesses, which stand in the answer."""
    if supposed:
        yield "guessed = [  # these sentences stand in the answer: remove each one that you have checked"
        yield from (f"  {_quote(says)}," for says in supposed)
        yield "]"


def _has_force(outline: Outline) -> bool:
    """Return whether a force is recorded; without one only ratios to the inertia can be determined."""
    return "force" in (outline.response.kind, outline.drive.kind if outline.drive else "")


def _format_model(machine: Model) -> str:
    """Return the line that names the model."""
    if isinstance(machine, Written):
        return f"equations = [{', '.join(_quote(text) for text in machine.equations)}]"
    return f'name = "{machine.name}"  # see `lostmotion plugins show {machine.name}`'


def _quote(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _format_channels(outline: Outline, factors: Mapping[str, float]) -> Iterator[str]:
    """Yield the lines for time, inputs and sensors."""
    drive, response = outline.drive, outline.response
    if outline.time is None:
        yield f"rate = {1.0 / outline.dt:.9g}  # Hz"
    elif outline.time_unit == "s" and not np.array_equal(outline.clock.time, np.rint(outline.clock.time)):
        yield f"time = {_quote(outline.time)}"
    else:
        yield f"time = {{ column = {_quote(outline.time)}, unit = {_quote(outline.time_unit)} }}"
    if drive is None:
        yield "inputs = []  # nothing drives the machine: its initial state is estimated"
    else:
        yield f"inputs = [{_format_channel('input', input_of(outline), drive, factors)}]{_format_doubt(drive)}"
    yield f"sensors = [{_format_channel('channel', response.kind, response, factors)}]{_format_doubt(response)}"
    taken = (drive.name if drive else "", response.name)
    unused = [f"{c.name} ({c.unit or 'no unit'})" for c in outline.columns if c.name not in taken]
    if unused:
        yield f"# not used: {', '.join(unused)}; further sensors belong into the list above"


def _format_channel(key: str, name: str, column: OutlinedColumn, factors: Mapping[str, float]) -> str:
    named = f", name = {_quote(column.name)}" if key == "channel" and _can_be_name(column.name) else ""
    factor = f", factor = {factors[column.name]!r}" if column.name in factors else ""
    quoted = _quote(column.name), _quote(column.stated_unit)
    more = f'{factor}, differences = true, noise = "quantised"' if column.summed else factor
    return f'{{ {key} = "{name}", column = {quoted[0]}, unit = {quoted[1]}{more}{named} }}'


def _can_be_name(name: str) -> bool:
    """Return whether the name of a column can be that of a sensor."""
    return not set("[]:/@.") & set(name)


def _format_doubt(column: OutlinedColumn) -> str:
    if column.sure:
        return ""
    why = f"the unit in the file is {column.unit}, which may need a factor" if column.unit else "the file gives no unit"
    return f"  # {why}: {column.stated_unit} and {column.kind} are guesses"


def _format_parameters(outline: Outline, machine: Model, scales: RecordedScales) -> Iterator[str]:
    """Yield the lines of known and estimated parameters; without a force the inertia has to be known."""
    motion = "rotation" if outline.response.turns else "translation"
    known, ranges = guesses(machine, scales, forced=_has_force(outline))
    params = {param.name: param for param in machine.params}
    if known:
        yield "[model.known]"
        for name, (value, why) in known.items():
            yield f"{name} = {value}  # {params[name].unit(motion)}: {why}"
        yield ""
    yield "[model.estimate]  # wide priors; values of data sheets belong into [model.known]"
    for name, (low, high, why) in ranges.items():
        yield (
            f'{name} = {{ low = {_round(low)}, high = {_round(high)}, scale = "log" }}'
            f"  # {params[name].unit(motion)}: {params[name].meaning}, {why}"
        )


def guesses(
    machine: Model, scales: RecordedScales, *, forced: bool
) -> tuple[dict[str, tuple[float, str]], dict[str, tuple[float, float, str]]]:
    """Return values of parameters that have to be known, and ranges of all others, each with a reason.

    Without a force only ratios to the inertia can be determined. All parameters of equations are estimated as positive.
    """
    inertia = machine.first_place.inertia
    is_written = isinstance(machine, Written)
    known = {
        p.name: (1.0, "only ratios to it can be determined: enter the true value")
        if p.scale == "log"
        else (0.0, p.meaning)
        for p in machine.params
        if (p.name == inertia and not forced) or (p.scale != "log" and not is_written)
    }
    return known, {p.name: _choose_range(p, scales, forced) for p in machine.params if p.name not in known}


def _choose_range(param: Param, scales: RecordedScales, forced: bool) -> tuple[float, float, str]:
    if param.name in scales.straight:
        value = scales.straight[param.name]
        return value / WIDE, value * WIDE, f"about {_round(value)} from the spectra"
    if param.dimension == LENGTH:
        return scales.length / 1e3, 3.0 * scales.length, "from the size of the motion"
    force = scales.force if forced else scales.length / scales.time**2
    value = param.dimension.scale(force, scales.length, scales.time)
    return value / WIDER, value * WIDER, "from the sizes of drive and motion"


def _round(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _list_findings(outline: Outline, machine: Model, factors: Mapping[str, float]) -> Iterator[str]:
    """Yield the findings in the table, one sentence each."""
    yield f"{outline.file}: {outline.samples} rows at {1.0 / outline.dt:.6g} Hz, {outline.clock.says}"
    yield from (f"  {note}" for note in (*outline.clock.notes, *([outline.cut] if outline.cut else ())))
    for column in outline.columns:
        yield _describe_column(column, outline, factors.get(column.name, 1.0))
    yield from (f"  not read: {why}" for why in outline.unread)
    if outline.drive is not None:
        period = _period(_to_centred(outline.drive, factors), outline.dt) if outline.drive.moves else None
        yield f"the drive repeats every {period:.4g} s" if period else "the drive does not repeat"
    else:
        yield "no column looks like a drive, and the response decays: a free decay is assumed; else give --drive COLUMN"
    yield f"model: {'; '.join(machine.equations) if isinstance(machine, Written) else machine.name}"


def _period(pushed: Array, dt: float) -> float | None:
    """Return the period (s) of a drive (n,), or None; one that is too short for its spectrum is laid over itself.

    Of a long drive a part is examined first.
    """
    if pushed.size > LONG and (found := _period(pushed[:LONG], dt)):
        return found
    period = refined_period(pushed, dt)
    if period is None:
        lag = period_found(pushed, _noise_level(pushed))
        period = None if lag is None else lag * dt
    return period


def _describe_column(column: OutlinedColumn, outline: Outline, factor: float) -> str:
    column = outline.response if column.name == outline.response.name else column
    roles = {outline.drive.name if outline.drive else "": "drive", outline.response.name: "response"}
    role = roles.get(column.name, "not used")
    taken = f", taken for {column.stated_unit}" if column.kind and not column.sure else ""
    seen = factor * column.values[np.isfinite(column.values)]
    if not seen.size:
        return f"  {column.name}: no reading at all"
    size = f"{seen.min():.4g} to {seen.max():.4g}"
    lost = f", {column.lost} readings lost" if column.lost else ""
    noise = f", noise about {_noise_level(seen):.2g}" if role == "response" else ""
    named = f"  {column.name} ({column.unit or 'no unit'}{taken})"
    return f"{named}: {column.kind or 'unknown'}, {size}{noise}{lost} -> {role}"


def _noise_level(values: Array) -> float:
    """Return the standard deviation of white noise from sixth differences, which are small for a smooth motion."""
    return float(np.std(np.diff(values, 6)) / math.sqrt(math.comb(12, 6))) if values.size > 20 else 0.0
