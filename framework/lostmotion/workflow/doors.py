"""The commands as functions, for a notebook: `lostmotion.diagnose("case.toml", "result")`.

Each takes the registry of this process unless it is handed another one: what `registry.default().add(...)` or
`add_file` has put into it is used everywhere. Options are those of the command line, by the names of the fields of
`Order`, `Request` and `Plan`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lostmotion.registry import Registry, default
from lostmotion.workflow import simulate as _simulate

if TYPE_CHECKING:
    import xarray

    from lostmotion.workflow.identify import Identified


def simulate(
    model: str,
    *,
    terms: str | Iterable[str] = (),
    drives: str | Iterable[str],
    motion: str | None = None,
    registry: Registry | None = None,
    out: str | Path | None = None,
    values: Mapping[str, float],
    **plan: Any,
) -> _simulate.Table:
    """Return the table of a simulated machine, each column (samples,) by name; `out` (.csv, .nc) is written too.

    `plan` holds `duration` (s) and `rate` (Hz), and `initial`, `noise` and `seed` if need be; `motion` ("translation",
    "rotation") turns a model that can be either.
    """
    known = registry or default()
    assembly, told = _simulate.assembly_of(known, model, _texts(terms), motion)
    used = [("model", model), *(("term", term.name) for term in assembly.terms)]
    every = {**told, **values}
    table = _simulate.simulate(_simulate.Plan(assembly, every, _texts(drives), origins=known.origins(*used), **plan))
    if out is not None:
        table.save(Path(out))
    return table


def diagnose(
    case: str | Path, out: str | Path, *, registry: Registry | None = None, seed: int = 0, jobs: int = 2
) -> Mapping[str, Any]:
    """Return the content of `diagnosis.json`; that file, `arrays.nc` and `report.html` are written into `out`."""
    from lostmotion.workflow.diagnose import run_diagnosis

    return run_diagnosis(Path(case), Path(out), registry or default(), seed=seed, jobs=jobs)


def identify(
    case: str | Path,
    out: str | Path,
    *,
    terms: str | Iterable[str] = (),
    registry: Registry | None = None,
    **options: Any,
) -> Identified:
    """Return the posterior of a case with the `terms` added; its files are written into `out`.

    `options` are those of the sampling (`ess`, `max_steps`, `walkers`) and of `Order`, such as `route` and `seed`.
    """
    from dataclasses import fields

    from lostmotion.stages.identify import Plan
    from lostmotion.workflow.identify import Order, run_identification

    of_plan = {f.name for f in fields(Plan)}
    plan = Plan(**{key: options.pop(key) for key in list(options) if key in of_plan})
    order = Order(terms=_texts(terms), plan=plan, **options)
    return run_identification(Path(case), Path(out), registry or default(), order)


def analyse(
    recording: str | Path, out: str | Path, *, registry: Registry | None = None, **asked: Any
) -> Mapping[str, Any]:
    """Return the content of `analysis.json`; that file, `analysis.nc` and `report.html` are written into `out`.

    `asked` are the fields of `Request`: `columns`, `rate`, `embedder`, `quantifiers`, `surrogates`, `seed` ...
    """
    from lostmotion.workflow.analyse import Request, run_analysis

    several: dict[str, Any] = {
        key: _texts(asked.pop(key)) for key in ("columns", "quantifiers", "surrogates") if key in asked
    }
    return run_analysis(Path(recording), Path(out), registry or default(), Request(**several, **asked))


def map(
    model: str,
    out: str | Path,
    *,
    axes: str | Iterable[str],
    registry: Registry | None = None,
    jobs: int = 0,
    refine: int = 0,
    fresh: bool = False,
    **asked: Any,
) -> xarray.Dataset:
    """Return a map of a model over `axes` (NAME=LOW:HIGH:N), kept in `out` (.zarr, .nc), which it goes on from.

    `asked` are the further fields of `Request`: `sets`, `terms`, `drive`, `quantities`, `periods`, `starts` ...
    """
    from lostmotion.study.sweep import Crew
    from lostmotion.workflow.mapping import How, Request, make_map, study_of

    several: dict[str, Any] = {key: _texts(asked.pop(key)) for key in ("sets", "terms", "quantities") if key in asked}
    study = study_of(Request(model, _texts(axes), **several, **asked), registry or default())
    return make_map(study, Path(out), How(Crew(jobs), refine, fresh), lambda _done, _of: None).dataset


def _texts(given: str | Iterable[str]) -> tuple[str, ...]:
    """Return texts as a tuple; one by itself may be given bare."""
    return (given,) if isinstance(given, str) else tuple(given)
