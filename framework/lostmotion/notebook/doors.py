"""The commands as Python functions on objects or paths, such as `lostmotion.diagnose(case)`.

Each function uses the registry of this process unless another one is given: plugins added by
`registry.default().add(...)` or `add_file` are available everywhere. No file is written unless `out` names a folder.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from lostmotion.arguments import (
    checked,
    choice,
    describe,
    flag,
    list_texts,
    maybe,
    path,
    paths,
    positive,
    whole,
)
from lostmotion.case import GUESSED, Prior
from lostmotion.contracts import Machine
from lostmotion.errors import CaseError, DataError
from lostmotion.notebook.argument_rules import CASE
from lostmotion.notebook.case import Case
from lostmotion.notebook.check_result import CheckResult, load_check
from lostmotion.notebook.diagnosis_result import DiagnosisResult, load_diagnosis
from lostmotion.notebook.identification_result import IdentificationResult, load_identification
from lostmotion.notebook.recorded import read_recorded_case
from lostmotion.notebook.robot_objects import RERUN_HINT, RobotResult, load_robot
from lostmotion.offers import RESULT
from lostmotion.progress import show_progress
from lostmotion.recording import Recording
from lostmotion.recording.formats import is_recording
from lostmotion.recording.value_checks import fill_lost
from lostmotion.registry import Registry, default
from lostmotion.results.robots import is_robot_result
from lostmotion.robots.arm_model import RobotModel
from lostmotion.settings import DEFAULT, Settings, read
from lostmotion.storage import load_json

Modelled = Machine | type[Machine] | RobotModel | str | Sequence[str]


def load_any_diagnosis(folder: Path) -> DiagnosisResult | RobotResult:
    """Return the diagnosis of a robot or of another machine that is stored in a folder."""
    robot = is_robot_result(load_json(folder / "diagnosis.json", RERUN_HINT))
    return load_robot(folder) if robot else load_diagnosis(folder)


LOADERS: Mapping[str, Callable[[Path], Any]] = {
    "diagnosis.json": load_any_diagnosis,
    "check.json": load_check,
    "identification.json": load_identification,
}


@checked(**CASE)
def diagnose(
    case: Case | Recording | str | Path,
    model: Modelled | None = None,
    *,
    known: Mapping[str, float] | None = None,
    estimate: Mapping[str, Prior] | None = None,
    terms: str | Sequence[str] = "all",
    seed: int = 0,
    jobs: int = 2,
    progress: bool = True,
    out: str | Path | None = None,
    registry: Registry | None = None,
    settings: Settings | Mapping[str, float] | None = None,
) -> DiagnosisResult | RobotResult:
    """Return the diagnosis of a case: the physics that its model does not include.

    `case` is a `Case`, the path of a `case.toml`, or a `Recording` or the path of one, together with a `model`: then
    `known` and `estimate` hold values and priors, and all other parameters have wide priors about the natural scales of
    the recording. `terms` is "all", or the names of the candidate terms. The same `seed` gives the same result.
    `settings` changes thresholds, such as `{"select.decisive": 4.0}` (`lostmotion.settings` lists them). Raises
    `CaseError` or `DataError` where the case cannot be used, with the message of the command line.
    """
    from lostmotion.diagnosis.diagnosis_run import diagnose_prepared
    from lostmotion.robots.arm_run import diagnose_robot

    known_to, limits = registry or default(), read(settings)
    asked = make_case(case, model, known, estimate, known_to, limits=limits)
    found: DiagnosisResult | RobotResult
    with show_progress("diagnose", quiet=not progress, lines=False) as say:
        if asked.robot is not None:
            names = () if terms == "all" else list_texts(terms)
            made = diagnose_robot(
                asked.robot, known_to, terms=names, budget=limits.select.budget or None, jobs=jobs, say=say
            )
            found = RobotResult(made.result, made.arrays, made.written)
        else:
            evidence, outcome = diagnose_prepared(
                asked.prepare(known_to, terms, limits), known_to, seed=seed, jobs=jobs, say=say, settings=limits
            )
            found = DiagnosisResult(evidence.result, evidence.data, known_to, outcome)
    if out is not None:
        found.save(out)
    return found


@checked(**CASE)
def check(
    case: Case | Recording | str | Path,
    model: Modelled | None = None,
    *,
    known: Mapping[str, float] | None = None,
    estimate: Mapping[str, Prior] | None = None,
    terms: str | Sequence[str] = "all",
    seed: int = 0,
    jobs: int = 2,
    progress: bool = True,
    out: str | Path | None = None,
    registry: Registry | None = None,
    settings: Settings | Mapping[str, float] | None = None,
) -> CheckResult:
    """Return what the recordings of a case can tell before terms are fitted, in seconds.

    That is the expected 95 % interval of each estimated parameter, the smallest size of each term that would be named
    with a probability of 90 %, what cannot be told apart, and changes of the experiment that would help. The arguments
    are those of `diagnose`. Raises `CaseError` or `DataError` where the case cannot be used.
    """
    from lostmotion.diagnosis.recording_check import check_prepared

    known_to, limits = registry or default(), read(settings)
    asked = make_case(case, model, known, estimate, known_to, limits=limits)
    with show_progress("check", quiet=not progress, lines=False) as say:
        prepared = asked.prepare(known_to, terms, limits)
        found = CheckResult(check_prepared(prepared, seed=seed, jobs=jobs, say=say, settings=limits))
    if out is not None:
        found.save(out)
    return found


@checked(
    **CASE,
    ess=positive,
    max_steps=whole(1),
    walkers=maybe(whole(2)),
    route=maybe(choice("trajectory", "quantifiers")),
    maps=paths,
    fresh=flag,
)
def identify(
    case: Case | Recording | str | Path,
    model: Modelled | None = None,
    *,
    known: Mapping[str, float] | None = None,
    estimate: Mapping[str, Prior] | None = None,
    terms: str | Iterable[str] = (),
    progress: bool = True,
    out: str | Path | None = None,
    registry: Registry | None = None,
    seed: int = 0,
    jobs: int = 2,
    route: str | None = None,
    maps: Iterable[str | Path] = (),
    fresh: bool = False,
    ess: float = 1000.0,
    max_steps: int = 2000,
    walkers: int | None = None,
    settings: Settings | Mapping[str, float] | None = None,
) -> IdentificationResult:
    """Return the posterior of the parameters of a case, with the `terms` added to its model.

    `case` is as for `diagnose`. The posterior is sampled until the effective sample size is `ess`, with at most
    `max_steps` steps of each of the `walkers`. `out` is a folder for the results, in which an interrupted chain is
    continued unless a `fresh` chain is wanted. `route` is "trajectory" or "quantifiers"; the latter needs the path of a
    case and accepts `maps`. `settings` are as for `diagnose`.
    """
    from lostmotion.identification.identification_run import collect_groups, identify_case
    from lostmotion.identification.routes import IdentificationRequest, choose_route
    from lostmotion.identification.sampling import SamplingPlan
    from lostmotion.preparation.prepare import case_of

    known_to = registry or default()
    limits = read(settings)
    plan = SamplingPlan(ess, max_steps, walkers, limits.chain)
    order = IdentificationRequest(
        list_texts(terms), seed, jobs, plan, route, tuple(Path(m) for m in maps), fresh, limits
    )
    with show_progress("identify", quiet=not progress, lines=False) as say, TemporaryDirectory() as spare:
        place = Path(out) if out is not None else Path(spare)
        file = case_of(Path(case), known_to) if isinstance(case, str | Path) else None
        if file is not None and choose_route(file, order) == "quantifiers":
            done = identify_case(file, None, place, known_to, order, lambda _steps, says: say(says))
        else:
            prepared = make_case(case, model, known, estimate, known_to, limits=limits).prepare(
                known_to, settings=limits
            )
            done = identify_case(prepared.case, prepared, place, known_to, order, lambda _steps, says: say(says))
        groups = collect_groups(done)
    found = IdentificationResult(done.result, groups)
    if out is not None:
        found.save(out)
    return found


@checked(folder=path)
def load(folder: str | Path) -> Any:
    """Return the result that a command or `.save` wrote into a folder: diagnosis, check, identification or analysis."""
    place, known = Path(folder), default()
    offered = tuple(known.offered(RESULT))
    for name in (*LOADERS, *offered):
        if (place / name).is_file():
            return (LOADERS[name] if name in LOADERS else known.function(RESULT, name))(place)
    raise DataError(f"{place} contains no result: a folder with one of {', '.join((*LOADERS, *offered))} is needed")


def make_case(
    case: Case | Recording | str | Path,
    given: Modelled | None,
    known: Mapping[str, float] | None,
    estimate: Mapping[str, Prior] | None,
    registry: Registry,
    *,
    limits: Settings = DEFAULT,
) -> Case:
    """Return the case: the given one, that of a file, or one made of a recording and a model."""
    if isinstance(case, Recording):
        if given is None:
            raise CaseError("a recording alone is no case: give a model beside it, such as lm.model('lin_backlash')")
        return _guess_case(case, given, known or {}, estimate or {})
    if not isinstance(case, (Case, str, Path)):
        raise CaseError(
            f"case is {describe(case)}: expected a Case, a Recording (lm.Recording.from_pandas makes one of a data"
            " frame), or the path of one"
        )
    if not isinstance(case, Case) and is_recording(case):
        return read_recorded_case(Path(case), given, known or {}, estimate or {}, registry, limits)
    if given is not None or known or estimate:
        raise CaseError("the case has a model, known values and priors: change them there, or give a recording")
    return case if isinstance(case, Case) else Case.read(case, registry, limits)


def _guess_case(
    recording: Recording, given: Modelled, known: Mapping[str, float], estimate: Mapping[str, Prior]
) -> Case:
    """Return a case of a recording, with wide priors for parameters that are neither known nor estimated."""
    from lostmotion.preparation.beginning import guesses, sizes_of

    first = Case(recording, given, known, estimate, recording.name)
    if first.robot is not None:
        return first
    machine: Any = first.model
    response = recording.sensors[0]
    pushed = next((a for a in recording.inputs if a.attrs["quantity"] in ("force", "torque")), None)
    seen, quantity = fill_lost(np.asarray(response, dtype=float)), str(response.attrs["quantity"])
    drive = None if pushed is None else np.asarray(pushed) - float(pushed.mean())
    scales = sizes_of(seen - seen.mean(), quantity, drive, recording.dt)
    values, ranges = guesses(machine, scales, forced=pushed is not None or quantity in ("force", "torque"))
    fixed = {name: value for name, (value, _) in values.items() if name not in estimate}
    priors = {name: Prior(low=a, high=b, scale="log") for name, (a, b, _) in ranges.items() if name not in known}
    notes = tuple(
        f"{GUESSED}{name} is {value:g}: {why}"
        for name, (value, why) in values.items()
        if name in fixed and name not in known and value
    )
    return Case(recording, given, {**fixed, **known}, {**priors, **estimate}, recording.name, notes=notes)


__all__ = ["Case", "Modelled", "check", "diagnose", "identify", "load"]
