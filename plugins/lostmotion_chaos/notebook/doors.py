"""The commands as Python functions: `lostmotion.analyse(...)` and `lostmotion.map(...)`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from lostmotion.arguments import checked, choice, describe, flag, list_texts, maybe, positive, text, whole, words
from lostmotion.errors import DataError, nearest
from lostmotion.notebook.argument_rules import RUN
from lostmotion.progress import show_progress
from lostmotion.recording import Recording
from lostmotion.registry import Registry, default
from lostmotion.settings import Settings, read
from lostmotion_chaos.defaults import EMBEDDER
from lostmotion_chaos.notebook.analysis import AnalysisResult
from lostmotion_chaos.rates import UNITS

if TYPE_CHECKING:
    import xarray


@checked(
    **RUN,
    channel=maybe(text),
    columns=words,
    time=maybe(text),
    rate=maybe(positive),
    every=whole(1),
    period=maybe(positive),
    embedder=text,
    denoiser=maybe(text),
    quantifiers=words,
    surrogates=words,
    draws=whole(1, 100_000),
    unit=choice(*UNITS),
)
def analyse(
    recording: Recording | str | Path,
    *,
    channel: str | None = None,
    progress: bool = True,
    out: str | Path | None = None,
    registry: Registry | None = None,
    columns: str | Iterable[str] = (),
    time: str | None = None,
    rate: float | None = None,
    every: int = 1,
    period: float | None = None,
    embedder: str = EMBEDDER,
    denoiser: str | None = None,
    quantifiers: str | Iterable[str] = (),
    surrogates: str | Iterable[str] = (),
    draws: int = 99,
    unit: str = "1/s",
    seed: int = 0,
    jobs: int = 2,
    settings: Settings | Mapping[str, float] | None = None,
) -> AnalysisResult:
    """Return the kind of motion in a recording, with exponents, dimensions and surrogate tests.

    `channel` names a sensor of a `Recording`; for a file, `columns` names its columns, `time` that of time where the
    automatic choice is wrong, and `rate` (Hz) is needed where it has no time. One sample of `every` is kept. `period`
    (s) is the period of the drive, if it is known. Plugins are given by name: `embedder`, `denoiser` ("none" for no
    reduction; with None the noise level decides), further `quantifiers`, and `surrogates` with the number of their
    `draws`. `unit` is the unit of exponents: "1/s", "bit/s", "1/period" or "bit/period". `settings` are as for
    `diagnose`.
    """
    from lostmotion_chaos.analysis.run import AnalysisRequest, analyse_source
    from lostmotion_chaos.analysis.source import WantedChannel, extract_source, load_source

    request = AnalysisRequest(
        columns=list_texts(columns),
        rate=rate,
        every=every,
        period=period,
        embedder=embedder,
        denoiser=denoiser,
        quantifiers=list_texts(quantifiers),
        surrogates=list_texts(surrogates),
        draws=draws,
        unit=unit,
        seed=seed,
        jobs=jobs,
        settings=read(settings),
        time=time,
    )
    known_to = registry or default()
    if not isinstance(recording, (Recording, str, Path)):
        raise DataError(f"recording is {describe(recording)}: expected a Recording, or the path of one")
    if isinstance(recording, Recording):
        source = extract_source(recording, _find_sensor(recording, channel))
    else:
        wanted = WantedChannel(request.columns or list_texts(channel or ()), request.rate, request.every, time)
        source = load_source(Path(recording), wanted, known_to, request.settings.recording)
    with show_progress("analyse", quiet=not progress, lines=False) as say:
        result, arrays = analyse_source(source, known_to, request, say)
    found = AnalysisResult(result, arrays)
    if out is not None:
        found.save(out)
    return found


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
    from lostmotion_chaos.maps.run import Request, RunOptions, make_map, make_study
    from lostmotion_chaos.maps.sweep import Workers

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
    with show_progress("map", quiet=not progress, lines=False) as say, TemporaryDirectory() as spare:
        place = Path(out) if out is not None else Path(spare) / "map.nc"
        made = make_map(study, place, options, lambda done, of: say(f"{done} of {of} cells")).dataset
        return made.load() if out is None else made


def _find_sensor(recording: Recording, channel: str | None) -> int:
    """Return the index of the sensor with this name or channel; 0 where none is named."""
    if channel is None:
        return 0
    for kind in ("sensor", "of"):
        for number, array in enumerate(recording.sensors):
            if array.attrs[kind] == channel:
                return number
    known = [str(array.attrs["sensor"] or array.attrs["of"]) for array in recording.sensors]
    raise DataError(f"{recording.name} has no sensor {channel!r}{nearest(channel, known)}: it has {', '.join(known)}")
