"""Models without a recording as Python functions: `lostmotion.simulate(...)` and `lostmotion.map(...)`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from lostmotion.arguments import checked, choice, flag, list_texts, maybe, positive, share, text, whole, words
from lostmotion.notebook.progress import show_progress
from lostmotion.notebook.rules import KNOWN, RUN
from lostmotion.registry import Registry, default
from lostmotion.simulation import simulate as _simulate

if TYPE_CHECKING:
    import xarray


@checked(
    **RUN,
    model=text,
    drives=words,
    motion=maybe(choice("translation", "rotation")),
    values=KNOWN,
    duration=positive,
    rate=positive,
    initial=maybe(KNOWN),
    noise=share,
)
def simulate(
    model: str,
    *,
    terms: str | Iterable[str] = (),
    drives: str | Iterable[str],
    motion: str | None = None,
    registry: Registry | None = None,
    out: str | Path | None = None,
    values: Mapping[str, float],
    duration: float,
    rate: float,
    initial: Mapping[str, float] | None = None,
    noise: float = 0.0,
    seed: int = 0,
) -> _simulate.SimulatedTable:
    """Return the table of a simulated machine, with columns (samples,) by name; `out` (.csv, .nc) is an optional file.

    `values` and `initial` are values of parameters and states by name, in SI units. `drives` are texts such as
    "harmonic:amplitude=1,frequency=2"; `duration` is in s and `rate` in Hz. `noise` is white, as a share of the
    standard deviation of each channel. `motion` ("translation", "rotation") selects one kind where a model allows both.
    """
    known = registry or default()
    assembly, own = _simulate.assembly_of(known, model, list_texts(terms), motion)
    used = [("model", model), *(("term", term.name) for term in assembly.terms)]
    every = {**own, **values}
    plan = _simulate.Plan(
        assembly, every, list_texts(drives), duration, rate, initial or {}, noise, seed, known.origins(*used)
    )
    table = _simulate.simulate(plan)
    if out is not None:
        table.save(Path(out))
    return table


@checked(
    **RUN,
    model=text,
    axes=words,
    refine=whole(0, 20),
    fresh=flag,
    sets=words,
    drive=text,
    quantities=words,
    periods=whole(1),
    transient=whole(0),
    starts=whole(1),
    unit=choice("nat", "bit"),
    motion=maybe(choice("translation", "rotation")),
)
def map(
    model: str,
    out: str | Path | None = None,
    *,
    axes: str | Iterable[str],
    registry: Registry | None = None,
    jobs: int = 0,
    refine: int = 0,
    fresh: bool = False,
    sets: str | Iterable[str] = (),
    terms: str | Iterable[str] = (),
    drive: str = "",
    quantities: str | Iterable[str] = (),
    periods: int = 600,
    transient: int = 200,
    starts: int = 4,
    unit: str = "nat",
    seed: int = 0,
    motion: str | None = None,
    progress: bool = True,
) -> xarray.Dataset:
    """Return a map of a model over `axes` (NAME=LOW:HIGH:N); with `out` (.zarr, .nc) it is stored and continued there.

    `sets` are texts NAME=VALUE, `terms` NAME[@PLACE][:param=value], `drive` a text such as
    "harmonic:amplitude=1,omega=2", `quantities` names of quantifiers beside the largest exponent; `unit` is "nat" or
    "bit". Each cell has `starts` initial states, followed over `periods` after a `transient`; `refine` is the number of
    times that cells are halved where neighbours differ.
    """
    from lostmotion.maps.run import Request, RunOptions, make_map, make_study
    from lostmotion.maps.sweep import Workers

    request = Request(
        model,
        list_texts(axes),
        periods,
        transient,
        starts,
        list_texts(sets),
        list_texts(terms),
        drive,
        list_texts(quantities),
        unit,
        seed,
        motion,
    )
    study = make_study(request, registry or default())
    options = RunOptions(Workers(jobs), refine, fresh)
    with show_progress("map", progress) as say, TemporaryDirectory() as spare:
        place = Path(out) if out is not None else Path(spare) / "map.nc"
        made = make_map(study, place, options, lambda done, of: say(f"{done} of {of} cells")).dataset
        return made.load() if out is None else made
