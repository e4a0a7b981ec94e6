"""From the texts of the command line to a map on the disk."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from pathlib import Path

from lostmotion.errors import CaseError, DataError
from lostmotion.registry import Registry
from lostmotion.simulation.drive_signals import Options, parse_number, parse_pairs
from lostmotion.simulation.simulated_machine import assembly_of
from lostmotion.storage import folder_for
from lostmotion_chaos.defaults import DIMENSION, EMBEDDER, ENTROPY, FLOW_EXPONENT
from lostmotion_chaos.maps.axes import parse_axis
from lostmotion_chaos.maps.cells import Study
from lostmotion_chaos.maps.layout import make_grid_layout
from lostmotion_chaos.maps.map import Map
from lostmotion_chaos.maps.refine import MAX_LEVELS, compute_refined_map, make_refined_layout, remove_stores
from lostmotion_chaos.maps.rig import DRIVE, SweptMachine
from lostmotion_chaos.maps.store import SUFFIXES, has_finished_map, load, make_dataset, save_netcdf, save_zarr
from lostmotion_chaos.maps.sweep import ProgressCallback, Workers, sweep

SHORT_NAMES = {"d2": DIMENSION, "k2": ENTROPY}
"""Short names of quantities."""


@dataclass(frozen=True)
class Request:
    """The request for a map as texts; `axes` are `NAME=LOW:HIGH:N[:log|inverse]`, `sets` are `NAME=VALUE`."""

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


def make_study(request: Request, registry: Registry) -> Study:
    """Return the requested study, or raise a `LostMotionError` that says what in the request is not valid."""
    if not request.axes:
        raise CaseError("a map has one axis or more: give --x NAME=LOW:HIGH:N")
    axes = tuple(parse_axis(text) for text in request.axes)
    names = [axis.name for axis in axes]
    if len({*names}) < len(names):
        raise CaseError(f"the axes are {', '.join(names)}: name each once")
    assembly, fixed = assembly_of(registry, request.model, request.terms, request.motion)
    for key, text in parse_pairs(",".join(request.sets), "--set").items():
        fixed[key] = parse_number(text, f"{key} of --set")
    rig = SweptMachine(assembly, tuple(names), {**fixed, **_parse_drive(request.drive)}).validate()
    settings = {"periods": request.periods, "transient": request.transient}
    further = {}
    for name in request.quantities:
        if name != FLOW_EXPONENT:
            full = SHORT_NAMES.get(name, name)
            known = {entry.name for entry in fields(registry.load("quantifier", full))}
            further[name] = registry.make("quantifier", full, **{k: v for k, v in settings.items() if k in known})
    embedder = registry.make("embedder", EMBEDDER) if any(q.reads == "series" for q in further.values()) else None
    exponent = registry.make("quantifier", FLOW_EXPONENT, **settings)
    used = [("model", request.model), *(("term", t.name) for t in assembly.terms)]
    used += [("quantifier", SHORT_NAMES.get(name, name)) for name in further]
    study = Study(
        rig, axes, exponent, further, embedder, request.periods, request.transient, request.starts, request.seed,
        request.unit == "bit", registry.origins(*used),
    )  # fmt: skip
    _check_ends(study)
    return study


def _parse_drive(text: str) -> dict[str, float]:
    """Return the values that `harmonic:amplitude=..,omega=..,phase=..` sets; `frequency` (Hz) may replace `omega`."""
    kind, _, rest = text.partition(":")
    if not text:
        return {}
    given = parse_pairs(rest, f"drive {text!r}")
    if kind != "harmonic" or (unknown := sorted({*given} - {*DRIVE, "frequency"})):
        wrong = kind if kind != "harmonic" else unknown[0]
        raise CaseError(f"a map has no drive with {wrong!r}: write harmonic:amplitude=..,omega=..,phase=..")
    options = Options("harmonic", given)
    found = {f"drive.{key}": options.number(key) for key in ("amplitude", "phase") if key in given}
    if "omega" in given or "frequency" in given:
        found["drive.omega"] = options.omega()
    return found


def _check_ends(study: Study) -> None:
    """Construct the flow of the first and the last cell, so that invalid values are reported before the work begins."""
    for last in (False, True):
        study.rig.flow(study.point(tuple(n - 1 if last else 0 for n in study.shape)))


@dataclass(frozen=True)
class RunOptions:
    """How a map is made: workers, number of halvings, and whether an existing map is overwritten (`fresh`)."""

    workers: Workers = field(default_factory=Workers)
    levels: int = 0
    fresh: bool = False


def make_map(study: Study, out: Path, options: RunOptions, say: ProgressCallback) -> Map:
    """Return the map of a study, made or continued at `out` (.zarr or .nc)."""
    if out.suffix not in SUFFIXES:
        raise DataError(f"{out.name} ends in {out.suffix or 'nothing'!r}: a map is written as .zarr or .nc")
    if not 0 <= options.levels <= MAX_LEVELS:
        raise CaseError(f"{options.levels} halvings are asked for: expected 0 to {MAX_LEVELS}")
    folder_for(out.parent)
    if options.levels:
        _write_refined(study, out, options, say)
    elif out.suffix == ".zarr":
        sweep(out, make_grid_layout(study), options.workers, say, fresh=options.fresh)
    else:
        _write_netcdf(study, out, options, say)
    return Map.open(out)


def _write_netcdf(study: Study, out: Path, options: RunOptions, say: ProgressCallback) -> None:
    """Write one netCDF file from a temporary store beside it, which is then removed."""
    layout, parts = make_grid_layout(study), out.with_name(f".{out.name}.parts")
    if has_finished_map(out, layout, fresh=options.fresh):
        remove_stores(parts)
        return
    sweep(parts, layout, options.workers, say, fresh=options.fresh)
    save_netcdf(out, load(parts))
    remove_stores(parts)


def _write_refined(study: Study, out: Path, options: RunOptions, say: ProgressCallback) -> None:
    """Write a map refined at the boundary of chaos from temporary stores of its levels, which are then removed."""
    layout, parts = make_refined_layout(study, options.levels), out.with_name(f".{out.name}.levels")
    if has_finished_map(out, layout, fresh=options.fresh):
        remove_stores(parts)
        return
    if options.fresh:
        remove_stores(parts)
    layout, columns = compute_refined_map(study, options.levels, parts, workers=options.workers, say=say)
    if out.suffix == ".nc":
        save_netcdf(out, make_dataset(layout, columns))
    else:
        save_zarr(out, layout, columns)
    remove_stores(parts)
