"""From texts, as the command line has them, to a map on the disk."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from pathlib import Path

from lostmotion.defaults import DIMENSION, EMBEDDER, ENTROPY, FLOW_EXPONENT
from lostmotion.errors import CaseError, DataError
from lostmotion.maps.axes import axis_of
from lostmotion.maps.cells import Study
from lostmotion.maps.layout import layout_of
from lostmotion.maps.map import Map
from lostmotion.maps.refine import MOST, cleared, finished_layout, refined
from lostmotion.maps.rig import DRIVE, SweptMachine
from lostmotion.maps.store import ENDINGS, as_dataset, holds, load, save_netcdf, save_zarr
from lostmotion.maps.sweep import Crew, Say, sweep
from lostmotion.registry import Registry
from lostmotion.simulation.drives import Options, number, pairs
from lostmotion.simulation.simulate import assembly_of
from lostmotion.storage import folder_for

SHORT = {"d2": DIMENSION, "k2": ENTROPY}
"""Short names of quantities."""


@dataclass(frozen=True)
class Request:
    """What is asked for, as texts; `axes` are `NAME=LOW:HIGH:N[:log|inverse]`, `sets` `NAME=VALUE`."""

    model: str
    axes: tuple[str, ...]
    periods: int = 600
    transient: int = 200
    starts: int = 4
    sets: tuple[str, ...] = ()
    terms: tuple[str, ...] = ()
    drive: str = ""
    quantities: tuple[str, ...] = ()
    unit: str = "nat"
    seed: int = 0
    motion: str | None = None


def study_of(request: Request, registry: Registry) -> Study:
    """Return the study that is asked for, or raise a `LostMotionError` that says what cannot be meant."""
    if not request.axes:
        raise CaseError("a map has one axis or more: give --x NAME=LOW:HIGH:N")
    axes = tuple(axis_of(text) for text in request.axes)
    names = [axis.name for axis in axes]
    if len({*names}) < len(names):
        raise CaseError(f"the axes are {', '.join(names)}: name each once")
    assembly, fixed = assembly_of(registry, request.model, request.terms, request.motion)
    for key, text in pairs(",".join(request.sets), "--set").items():
        fixed[key] = number(text, f"{key} of --set")
    rig = SweptMachine(assembly, tuple(names), {**fixed, **_drive(request.drive)}).checked()
    settings = {"periods": request.periods, "transient": request.transient}
    further = {}
    for name in request.quantities:
        if name != FLOW_EXPONENT:
            full = SHORT.get(name, name)
            known = {entry.name for entry in fields(registry.load("quantifier", full))}
            further[name] = registry.make("quantifier", full, **{k: v for k, v in settings.items() if k in known})
    embedder = registry.make("embedder", EMBEDDER) if any(q.reads == "series" for q in further.values()) else None
    exponent = registry.make("quantifier", FLOW_EXPONENT, **settings)
    used = [("model", request.model), *(("term", t.name) for t in assembly.terms)]
    used += [("quantifier", SHORT.get(name, name)) for name in further]
    study = Study(
        rig, axes, exponent, further, embedder, request.periods, request.transient, request.starts, request.seed,
        request.unit == "bit", registry.origins(*used),
    )  # fmt: skip
    _try_ends(study)
    return study


def _drive(text: str) -> dict[str, float]:
    """Return the knobs that `harmonic:amplitude=..,omega=..,phase=..` sets; the frequency may be in Hz."""
    kind, _, rest = text.partition(":")
    if not text:
        return {}
    told = pairs(rest, f"drive {text!r}")
    if kind != "harmonic" or (unknown := sorted({*told} - {*DRIVE, "frequency"})):
        wrong = kind if kind != "harmonic" else unknown[0]
        raise CaseError(f"a map has no drive with {wrong!r}: write harmonic:amplitude=..,omega=..,phase=..")
    options = Options("harmonic", told)
    found = {f"drive.{key}": options.number(key) for key in ("amplitude", "phase") if key in told}
    if "omega" in told or "frequency" in told:
        found["drive.omega"] = options.omega()
    return found


def _try_ends(study: Study) -> None:
    """Make the flow at the first and at the last cell, so that bad numbers are told before the work begins."""
    for last in (False, True):
        study.rig.flow(study.point(tuple(n - 1 if last else 0 for n in study.shape)))


@dataclass(frozen=True)
class How:
    """How a map is made: who computes, how often squares are halved, and whether what is there is thrown away."""

    crew: Crew = field(default_factory=Crew)
    levels: int = 0
    fresh: bool = False


def make_map(study: Study, out: Path, how: How, say: Say) -> Map:
    """Return the map of a study, made or continued at `out` (.zarr or .nc)."""
    if out.suffix not in ENDINGS:
        raise DataError(f"{out.name} ends in {out.suffix or 'nothing'!r}: a map is written as .zarr or .nc")
    if not 0 <= how.levels <= MOST:
        raise CaseError(f"{how.levels} halvings are asked for: wanted 0 to {MOST}")
    folder_for(out.parent)
    if how.levels:
        _refine(study, out, how, say)
    elif out.suffix == ".zarr":
        sweep(out, layout_of(study), how.crew, say, fresh=how.fresh)
    else:
        _one_file(study, out, how, say)
    return Map.open(out)


def _one_file(study: Study, out: Path, how: How, say: Say) -> None:
    """Write one netCDF at the end, from a store beside it that is removed."""
    layout, parts = layout_of(study), out.with_name(f".{out.name}.parts")
    if holds(out, layout, fresh=how.fresh):
        cleared(parts)
        return
    sweep(parts, layout, how.crew, say, fresh=how.fresh)
    save_netcdf(out, load(parts))
    cleared(parts)


def _refine(study: Study, out: Path, how: How, say: Say) -> None:
    """Write a map that is fine at the boundary of chaos, from stores of its levels that are removed."""
    layout, parts = finished_layout(study, how.levels), out.with_name(f".{out.name}.levels")
    if holds(out, layout, fresh=how.fresh):
        cleared(parts)
        return
    if how.fresh:
        cleared(parts)
    layout, columns = refined(study, how.levels, parts, crew=how.crew, say=say)
    if out.suffix == ".nc":
        save_netcdf(out, as_dataset(layout, columns))
    else:
        save_zarr(out, layout, columns)
    cleared(parts)
