"""Diagnosis of many cases: each one in a process on one core; cases that cannot be used are set aside.

An existing diagnosis from the same files, seed and versions is not repeated. So an interrupted batch is continued, and
only new or changed cases are diagnosed when it is run again.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path

from lostmotion.campaigns.campaign import Campaign, Say
from lostmotion.campaigns.summary import SUMMARY, BatchRow, make_aside_row, make_row, save_rows
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.errors import CaseError, DataError, LostMotionError, PlaceError, PluginWarning
from lostmotion.preparation.prepare import case_of
from lostmotion.provenance import digest, origin_of, provenance
from lostmotion.registry import Registry
from lostmotion.results.diagnosis import Diagnosis
from lostmotion.results.robots import RobotDiagnosis, is_robot_result
from lostmotion.robots import is_robot_case
from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_run import FOUND_CALLBACK, FOUND_MODEL, make_robot_origin, run_robot
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import folder_for, load_json, load_result, writing

FILES = ("report.html", "diagnosis.json", "arrays.nc")
"""The files of a diagnosis. The report is written last and removed first: where it exists, the others are complete."""
KEPT = ".campaign"
"""The folder of the campaign in the folder of the batch."""


@dataclass(frozen=True)
class Batch:
    """A batch of diagnoses: `cases` by the names of their folders in `out`, plugin files, and the seed of each case."""

    cases: tuple[tuple[str, Path], ...]
    out: Path
    plugins: tuple[str, ...] = ()
    seed: int = 0
    settings: Settings = DEFAULT

    def __call__(self, number: int) -> BatchRow:
        """Return the row of a case after its diagnosis is in its folder; a case that is set aside has no diagnosis."""
        name, path = self.cases[number]
        place = self.out / name
        try:
            with _silence_plugin_warnings():
                self._ensure_diagnosis(path, place)
            return make_row(name, _load_diagnosis(place))
        except PlaceError:
            raise
        except LostMotionError as err:
            reason = str(err)
        except MemoryError:
            reason = "there is not enough memory for it: cut the recording, or use fewer --jobs"
        except Exception as err:  # an error of one case must not end the others
            reason = f"it failed ({type(err).__name__}: {err}): diagnose it separately to see where"
        _remove_results(place)
        return make_aside_row(name, reason)

    def lost(self, number: int) -> BatchRow:
        """Return the row of a case whose process was killed from outside twice, the second time when it ran alone."""
        name, _ = self.cases[number]
        _remove_results(self.out / name)
        return make_aside_row(name, "the system killed its process, perhaps for lack of memory: cut the recording")

    def _ensure_diagnosis(self, path: Path, place: Path) -> None:
        """Make the diagnosis of a case in its folder, unless it exists there."""
        if not self._is_current(path, place):
            _remove_results(place)
            known = self._registry()
            if is_robot_case(path, known):
                run_robot(path, place, known, budget=self._budget)
            else:
                run_diagnosis(path, place, known, seed=self.seed, jobs=1, settings=self.settings)

    def _is_current(self, path: Path, place: Path) -> bool:
        """Return whether a diagnosis exists that was made from the present inputs, versions and settings."""
        if not all((place / name).is_file() for name in FILES):
            return False
        registry = self._registry()
        try:
            made = _load_diagnosis(place).provenance
        except DataError:
            return False
        if is_robot_case(path, registry):
            return made == make_robot_origin(load_robot_case(path, registry), registry, self._budget)
        case = case_of(path, registry)
        files = {spec.label: digest(case.folder / spec.file) for spec in case.recordings}
        wanted = origin_of("diagnose", {}, self.seed, {**registry.origins(), "case": case.digest, **files})
        thresholds = made.settings.get("thresholds")
        return replace(made, settings={}) == wanted and thresholds == self.settings.as_dict()

    @property
    def _budget(self) -> float | None:
        """The processor time (s) of a search, where one is given."""
        return self.settings.select.budget or None

    def _registry(self) -> Registry:
        """Return a registry for one case, so that its plugins are not available to other cases."""
        return Registry.discover(self.plugins)


def _load_diagnosis(place: Path) -> Diagnosis | RobotDiagnosis:
    """Return the diagnosis in a folder; raise `DataError` where there is no complete one."""
    file, hint = place / "diagnosis.json", "run the same command again"
    if is_robot_result(load_json(file, hint)):
        return load_result(RobotDiagnosis, file, hint)
    return load_result(Diagnosis, file, hint)


def run_batch(batch: Batch, *, jobs: int, say: Say = lambda _done, _of: None) -> list[BatchRow]:
    """Return a row for each case after writing its diagnosis into its folder, and all rows as a table."""
    identity = provenance("diagnose many", {"thresholds": batch.settings.as_dict()}, batch.seed, {})
    campaign = Campaign(batch, BatchRow, len(batch.cases), identity, apart=True, lost=batch.lost)
    rows = campaign.run(folder_for(batch.out) / KEPT, jobs, say, fresh=True)
    save_rows(batch.out / SUMMARY, rows)
    return rows


def name_cases(paths: Sequence[Path]) -> tuple[tuple[str, Path], ...]:
    """Return each case file once, named by its stem; equal stems are prefixed with the names of folders."""
    cases = list(dict.fromkeys(path.absolute() for path in paths))
    parts = [[*path.parts[1:-1], path.stem] for path in cases]
    depths = [1] * len(cases)
    while clash := [k for k in _find_clashes(parts, depths) if depths[k] < len(parts[k])]:
        for k in clash:
            depths[k] += 1
    for k in _find_clashes(parts, depths):
        raise CaseError(
            f"{cases[k].name} and another case would share the folder {_join_name(parts[k], depths[k])}: rename"
        )
    return tuple((_join_name(p, depth), path) for p, depth, path in zip(parts, depths, cases, strict=True))


def _find_clashes(parts: Sequence[Sequence[str]], depths: Sequence[int]) -> list[int]:
    """Return the numbers of the cases with equal names; upper case is ignored, as on some disks."""
    names = [_join_name(p, depth).casefold() for p, depth in zip(parts, depths, strict=True)]
    times = Counter([*names, KEPT, SUMMARY])
    return [k for k, name in enumerate(names) if times[name] > 1]


def _join_name(parts: Sequence[str], depth: int) -> str:
    return "-".join(parts[-depth:])


def _remove_results(place: Path) -> None:
    """Remove the files of a diagnosis, and its folder if it is empty then."""
    with writing(place):
        for name in (*FILES, FOUND_MODEL, FOUND_CALLBACK):
            (place / name).unlink(missing_ok=True)
    with suppress(OSError):
        place.rmdir()


@contextmanager
def _silence_plugin_warnings() -> Iterator[None]:
    """Suppress warnings about plugins, which the notes of each diagnosis contain, to avoid many repetitions."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PluginWarning)
        yield
