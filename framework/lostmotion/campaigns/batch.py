"""Many cases in one go: each is diagnosed by a process of its own core, what cannot be used is set aside.

A case whose diagnosis stands there, made of the same files, seed and versions, is not made again; so a batch that was
killed goes on, and one in which a recording was repaired or a case added does what is new.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path

from lostmotion.campaigns.campaign import Campaign, Say
from lostmotion.campaigns.table import SUMMARY, BatchRow, row_aside, row_of, save_rows
from lostmotion.diagnosis.run import run_diagnosis
from lostmotion.errors import CaseError, DataError, LostMotionError, PlaceError, PluginWarning
from lostmotion.preparation.prepare import case_of
from lostmotion.provenance import digest, origin_of, provenance
from lostmotion.registry import Registry
from lostmotion.results.diagnosis import Diagnosis
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import folder_for, load_result, writing

FILES = ("report.html", "diagnosis.json", "arrays.nc")
"""What a diagnosis writes. The report is written last and removed first: where it stands, the others are whole."""
KEPT = ".campaign"
"""The folder of the campaign within that of the batch."""


@dataclass(frozen=True)
class Batch:
    """One who diagnoses: `cases` by the names of their folders in `out`, plugin files, and the seed of each case."""

    cases: tuple[tuple[str, Path], ...]
    out: Path
    plugins: tuple[str, ...] = ()
    seed: int = 0
    settings: Settings = DEFAULT

    def __call__(self, number: int) -> BatchRow:
        """Return the row of a case, once its diagnosis stands in its folder; one that cannot be used has none."""
        name, path = self.cases[number]
        place = self.out / name
        try:
            with _notes_only():
                self._settle(path, place)
            return row_of(name, _read(place))
        except PlaceError:
            raise
        except LostMotionError as err:
            said = str(err)
        except MemoryError:
            said = "there is not enough memory for it: cut the recording, or use fewer --jobs"
        except Exception as err:  # one case of a thousand may not end the others
            said = f"it broke down ({type(err).__name__}: {err}): diagnose it by itself to see where"
        _clear(place)
        return row_aside(name, said)

    def lost(self, number: int) -> BatchRow:
        """Return the row of a case whose process was killed from outside, twice: the second time it ran by itself."""
        name, _ = self.cases[number]
        _clear(self.out / name)
        return row_aside(name, "the system killed its process, for want of memory perhaps: cut the recording")

    def _settle(self, path: Path, place: Path) -> None:
        """See to it that the diagnosis of a case stands in its folder."""
        if not self._stands(path, place):
            _clear(place)
            run_diagnosis(path, place, self._registry(), seed=self.seed, jobs=1, settings=self.settings)

    def _stands(self, path: Path, place: Path) -> bool:
        """Return whether a diagnosis is there and was made of what would be used now."""
        if not all((place / name).is_file() for name in FILES):
            return False
        registry = self._registry()
        case = case_of(path, registry)
        files = {spec.label: digest(case.folder / spec.file) for spec in case.recordings}
        wanted = origin_of("diagnose", {}, self.seed, {**registry.origins(), "case": case.digest, **files})
        try:
            made = _read(place).provenance
        except DataError:
            return False
        thresholds = made.settings.get("thresholds")
        return replace(made, settings={}) == wanted and thresholds == self.settings.as_dict()

    def _registry(self) -> Registry:
        """Return a registry for one case, which may bring plugins that the next one does not know."""
        return Registry.discover(self.plugins)


def _read(place: Path) -> Diagnosis:
    """Return the diagnosis that stands in a folder; `DataError` where no whole one is there."""
    return load_result(Diagnosis, place / "diagnosis.json", "run the same command again")


def run_batch(batch: Batch, *, jobs: int, say: Say = lambda _done, _of: None) -> list[BatchRow]:
    """Return a row for each case after writing its diagnosis into the folder of its name, and all rows as a table."""
    identity = provenance("diagnose many", {"thresholds": batch.settings.as_dict()}, batch.seed, {})
    campaign = Campaign(batch, BatchRow, len(batch.cases), identity, apart=True, lost=batch.lost)
    rows = campaign.run(folder_for(batch.out) / KEPT, jobs, say, fresh=True)
    save_rows(batch.out / SUMMARY, rows)
    return rows


def named(paths: Sequence[Path]) -> tuple[tuple[str, Path], ...]:
    """Return each case file once, under the stem of its name; stems that clash get the names of folders in front."""
    cases = list(dict.fromkeys(path.absolute() for path in paths))
    parts = [[*path.parts[1:-1], path.stem] for path in cases]
    depths = [1] * len(cases)
    while clash := [k for k in _clashing(parts, depths) if depths[k] < len(parts[k])]:
        for k in clash:
            depths[k] += 1
    for k in _clashing(parts, depths):
        raise CaseError(f"{cases[k].name} and another case would share the folder {_name(parts[k], depths[k])}: rename")
    return tuple((_name(p, depth), path) for p, depth, path in zip(parts, depths, cases, strict=True))


def _clashing(parts: Sequence[Sequence[str]], depths: Sequence[int]) -> list[int]:
    """Return the numbers of the cases whose names are not theirs alone; some disks know no capitals."""
    names = [_name(p, depth).casefold() for p, depth in zip(parts, depths, strict=True)]
    times = Counter([*names, KEPT, SUMMARY])
    return [k for k, name in enumerate(names) if times[name] > 1]


def _name(parts: Sequence[str], depth: int) -> str:
    return "-".join(parts[-depth:])


def _clear(place: Path) -> None:
    """Remove what a diagnosis writes, and its folder if nothing else lies there."""
    with writing(place):
        for name in FILES:
            (place / name).unlink(missing_ok=True)
    with suppress(OSError):
        place.rmdir()


@contextmanager
def _notes_only() -> Iterator[None]:
    """Leave what is wrong with a plugin to the notes of each diagnosis: a thousand warnings say no more than one."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PluginWarning)
        yield
