"""A complete diagnosis of a robot: it reads a case and writes `diagnosis.json`, `arrays.nc` and `report.html`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.codec import to_plain
from lostmotion.contracts import Term
from lostmotion.defaults import SLIDING
from lostmotion.errors import CaseError
from lostmotion.kernels.threads import hold_linear_algebra
from lostmotion.parts import Array
from lostmotion.provenance import origin_of
from lostmotion.quantities import unit_of
from lostmotion.registry import Registry
from lostmotion.results import Interval
from lostmotion.results.background import Origin, RecordingFacts
from lostmotion.results.diagnosis import HeldOutScore, HeldOutScores, Labels, Mechanism, ParameterSets
from lostmotion.results.mismatch import UnexplainedForce
from lostmotion.results.robots import Check, RobotDiagnosis, StepCost, WrittenModel
from lostmotion.robots.arm import TapedArm, can_act
from lostmotion.robots.arm_case import RobotCase, load_robot_case
from lostmotion.robots.arm_hypothesis import ArmHypothesis
from lostmotion.robots.arm_model import RobotModel
from lostmotion.robots.arm_page import write_robot_report
from lostmotion.robots.arm_preparation import SECONDS, SearchOptions, make_arm, prepare_search
from lostmotion.robots.arm_search import NOTHING, ArmSearch, find_probabilities
from lostmotion.robots.arm_words import (
    LIKELY,
    describe_dependence,
    find_told,
    list_confusions,
    list_findings,
    list_joints,
    make_interval,
    rank_sets,
)
from lostmotion.robots.free_runs import HORIZON, HeldOutRuns
from lostmotion.robots.gears import GEARS
from lostmotion.robots.log_checks import average, check_log, predict_torque
from lostmotion.robots.refutation import ToldRuns, leave_out_refuted
from lostmotion.robots.step_costs import TOLD, describe_steps, measure_steps
from lostmotion.robots.tape import Path as RobotPath
from lostmotion.robots.write_back import list_changes, measure_written
from lostmotion.simulators import INVERSE, FoundFiles
from lostmotion.storage import StoredArray, dataset_of, folder_for, save_datasets, save_json, save_text

if TYPE_CHECKING:
    import xarray as xr

Say = Callable[[str], None]
USUAL = 0.03
"""A random force above this share of the torque is more than the usual noise of a drive."""
FOUND_MODEL, FOUND_CALLBACK = "arm_found.xml", "arm_found.py"


@dataclass(frozen=True, eq=False)
class RobotOutput:
    """The output of a diagnosis: the result, the search it comes from, the arrays of the page, and the changed model.

    `written` is the model with what was found; None where the model has no file.
    """

    result: RobotDiagnosis
    search: ArmSearch
    arrays: xr.Dataset
    written: FoundFiles | None


def save_robot(folder: Path, result: RobotDiagnosis, arrays: xr.Dataset, written: FoundFiles | None) -> None:
    """Write `diagnosis.json`, `arrays.nc`, `report.html` and, where there is one, the changed model into a folder.

    A changed model or a callback of an earlier diagnosis is removed.
    """
    texts = {} if written is None else {FOUND_MODEL: written.model, FOUND_CALLBACK: written.callback}
    for name in (FOUND_MODEL, FOUND_CALLBACK):
        if texts.get(name):
            save_text(folder / name, texts[name])
        else:
            (folder / name).unlink(missing_ok=True)
    save_datasets(folder / "arrays.nc", {None: arrays})
    save_json(folder / "diagnosis.json", to_plain(result))
    write_robot_report(folder)


def run_robot(
    path: Path, out: Path, registry: Registry, *, budget: float | None = None, jobs: int = 1, say: Say = lambda _: None
) -> RobotDiagnosis:
    """Return the diagnosis of the case of a robot, after writing its files and the changed model into a folder.

    `budget` is the processor time of the search (s).
    """
    say("reading the case")
    case = load_robot_case(path, registry)
    folder = folder_for(out)
    made = diagnose_robot(case, registry, budget=budget, jobs=jobs, say=say)
    say("report")
    save_robot(folder, made.result, made.arrays, made.written)
    return made.result


def check_robot(path: Path, registry: Registry) -> tuple[str, ...]:
    """Return what is looked at before any fit of the case of a robot, in sentences; raise `CaseError` if it stops.

    Notes on the log come first.
    """
    case = load_robot_case(path, registry)
    arm = make_arm(case.model.simulator, case.log, case.model.side, known=case.known, parts=False)
    checks = check_log(arm, case.model.simulator, case.model.tolerance)
    if stopped := [check.says for check in checks if check.stop]:
        raise CaseError(" ".join(stopped))
    return (*case.log.notes, *(check.says for check in checks))


@hold_linear_algebra()
def diagnose_robot(
    case: RobotCase,
    registry: Registry,
    *,
    terms: Sequence[str] = (),
    budget: float | None = None,
    jobs: int = 1,
    say: Say = lambda _: None,
) -> RobotOutput:
    """Return the output of the diagnosis of a robot; raise `CaseError` where a check of the log fails.

    `terms` are the mechanisms that are tried, by name or as NAME@PLACE; all, if empty. `jobs` is the number of threads,
    on which the result does not depend.
    """
    say("tape")
    simulator = case.model.simulator
    plain = make_arm(simulator, case.log, case.model.side, known=case.known)
    checks = check_log(plain, simulator, case.model.tolerance)
    if stopped := [check.says for check in checks if check.stop]:
        raise CaseError(" ".join(stopped))
    options = SearchOptions(
        case.model.tolerance, budget=SECONDS if budget is None else budget, asked=tuple(terms), jobs=jobs
    )
    search, start = prepare_search(plain, simulator, _make_library(registry), case.coordinates, options, say)
    search.run(start)
    if not search.found:
        raise CaseError(
            "the model diverges from the log at any level of noise: check units, signs and the order of the joints"
        )
    say("free runs over held-out data")
    runs = leave_out_refuted(search)
    say(f"{runs.refuted} sets refuted" if runs.refuted else "no set refuted")
    return _make_output(case, plain, search, checks, registry, runs)


def _make_output(
    case: RobotCase, plain: TapedArm, search: ArmSearch, checks: Sequence[Check], registry: Registry, runs: ToldRuns
) -> RobotOutput:
    simulator = case.model.simulator
    motions = dict(zip(simulator.joints, simulator.moves, strict=True))
    nominal, best = search.found[frozenset()], find_told(search)
    before, after = runs.before, runs.after
    found = list_findings(search, best, motions)
    nothing = find_probabilities(search).get(NOTHING, 0.0)
    missing = average(plain.torque - predict_torque(plain), case.log.dt)
    path = _average_path(plain.tape.path, case.log.dt)
    rows = list_joints(search, (nominal, before), (best, after), found, motions)
    worst = max(rows, key=lambda row: row.random_after / row.torque)
    left = worst.random_after
    changes = list_changes(found, search)
    stepped = measure_written(best, runs, simulator, changes, case.known)
    steps = measure_steps(nominal, simulator)
    written = simulator.write_found(changes, case.known)
    result = RobotDiagnosis(
        title=case.title,
        verdict="mismatch" if found or nothing < LIKELY else "adequate",
        says=(
            *(_summarise(found, before, after, case.log.joints) if found else _tell_nothing(search, nothing)),
            *_list_remarks(steps, stepped, _list_friction(case, plain, found)),
        ),
        checks=tuple(checks),
        found=found,
        ranking=rank_sets(search),
        confused_with=list_confusions(search, best),
        unexplained=UnexplainedForce(left > USUAL * worst.torque, left, worst.unit, left / worst.torque),
        where=describe_dependence(missing, path, plain),
        parameters=ParameterSets(_list_values(nominal, motions), _list_values(best, motions)),
        fit=HeldOutScores(_score(nominal, before), _score(best, after), float(np.mean(after.floor)), "s", 1.0),
        model=Labels(case.model.label, " + ".join([case.model.label, *sorted(best.terms)])),
        joints=rows,
        noise=_list_noise(best, motions),
        steps=steps,
        written=stepped,
        recordings=(
            RecordingFacts(
                case.log.name, case.log.samples, 1.0 / case.log.dt, None, tuple(f"{j}.torque" for j in case.log.joints)
            ),
        ),
        notes=(*_write_notes(case, plain, search, registry, steps), *_list_unwritten(written, found)),
        provenance=make_robot_origin(case, registry, search.budget.seconds),
    )
    arrays, coords = _list_arrays(case, path, missing, (before, after))
    return RobotOutput(result, search, dataset_of(arrays, coords, {"title": case.title}), written)


def _make_library(registry: Registry) -> list[Term]:
    return [registry.make("term", name) for name in registry.names("term")]


def _average_path(path: RobotPath, dt: float) -> RobotPath:
    return RobotPath(*(average(x, dt) for x in (path.q, path.v, path.a)))


def _summarise(
    found: Sequence[Mechanism], before: HeldOutRuns, after: HeldOutRuns, joints: Sequence[str]
) -> tuple[str, ...]:
    """Return the result in sentences."""
    told = [m.says if m.state == "named" else f"Likely (probability {m.probability:.2f}): {m.says}" for m in found]
    best = int(np.argmax(before.nrmse / np.maximum(after.nrmse, 1e-300)))
    fell = after.nrmse[best] < before.nrmse[best]
    told.append(
        f"Free runs of {HORIZON:g} s over held-out data, both models with known values corrected within the tolerance:"
        f" the error of {joints[best]} {'falls' if fell else 'does not fall, but rises'} from"
        f" {100.0 * before.nrmse[best]:.3g} % to {100.0 * after.nrmse[best]:.3g} % of its motion."
    )
    return tuple(told)


def _tell_nothing(search: ArmSearch, nothing: float) -> tuple[str, ...]:
    """Return the result in a sentence where no mechanism is more likely than not; `nothing` is probably missing."""
    if nothing >= LIKELY:
        return (
            "This log shows no missing physics: every mechanism that was tried is less likely than the model as it is.",
        )
    lead = [(key, share) for key, share in find_probabilities(search).items() if key != NOTHING][:3]
    told = ", ".join(f"{key} ({share:.2f})" for key, share in lead)
    return (
        f"Something is missing with a probability of {1.0 - nothing:.2f}, but this log does not tell what: the most"
        f" likely mechanisms are {told}. Record a longer or faster motion.",
    )


def _list_friction(case: RobotCase, plain: TapedArm, found: Sequence[Mechanism]) -> tuple[str, ...]:
    """Return what the simulator says about dry friction of the model, and about that which was found."""
    joints = case.log.joints
    forces = {joint: float(x) for joint, x in zip(joints, plain.get({}, "frictionloss"), strict=True) if x > 0.0}
    for one in found:
        if one.mechanism in SLIDING and one.at in joints:
            forces[one.at] = forces.get(one.at, 0.0) + one.parameters["force"].median
    return case.model.simulator.describe_friction(np.median(plain.tape.path.q, axis=0), forces) if forces else ()


def _list_remarks(steps: tuple[StepCost, ...], stepped: WrittenModel | None, friction: tuple[str, ...]) -> list[str]:
    """Return sentences on the simulation itself: its steps, its friction, and the model with what was found."""
    told = []
    if stepped is not None:
        told.append(
            f"With all known values as in the file, the error of free runs is {100.0 * stepped.before:.3g} % of the"
            f" motion, with what was found in its exact motion {100.0 * stepped.exact:.3g} %, and with {FOUND_MODEL},"
            f" stepped by its simulator, {100.0 * stepped.nrmse:.3g} %."
        )
    if any(one.nats > TOLD for one in steps):
        told.append(describe_steps(steps))
    return [*told, *friction]


def _score(one: ArmHypothesis, runs: HeldOutRuns) -> HeldOutScore:
    """Return the scores of a hypothesis: the mean log density of a held-out sample is that by which it was ranked."""
    log = one.frame.arm.log
    by_joint = {joint: float(x) for joint, x in zip(log.joints, runs.nrmse, strict=True)}
    return HeldOutScore(one.heldout / (log.samples - runs.first), float(np.mean(runs.nrmse)), by_joint, HORIZON)


def _list_values(one: ArmHypothesis, motions: dict[str, str]) -> dict[str, Interval]:
    """Return the estimated values of the model, and the random force of each joint."""
    own = [c for c in one.frame.base if not c.key.endswith("_noise")]
    found = {
        c.key: make_interval(one, c, motions[c.key.partition(".")[0]])
        for c in own
        if c.key.partition(".")[0] in motions
    }
    found |= {c.key: make_interval(one, c, "rotation") for c in own if c.key not in found}
    return {k: replace(v, unit=_name_unit(k, motions, v.unit)) for k, v in found.items()}


def _name_unit(key: str, motions: dict[str, str], unit: str) -> str:
    if not key.endswith(".random_force"):
        return unit
    return unit_of("force", motions[key.partition(".")[0]])


def _list_noise(one: ArmHypothesis, motions: dict[str, str]) -> dict[str, Interval]:
    """Return the noise of each reading."""
    units = {("rotation", "position"): "rad", ("rotation", "velocity"): "rad/s"}
    units |= {("translation", "position"): "m", ("translation", "velocity"): "m/s"}
    found = {}
    for c in one.frame.base:
        joint, _, kind = c.key.partition(".")
        if kind.endswith("_noise"):
            word = kind.removesuffix("_noise")
            found[f"{joint}.{word}"] = replace(make_interval(one, c, motions[joint]), unit=units[motions[joint], word])
    return found


def _write_notes(
    case: RobotCase, plain: TapedArm, search: ArmSearch, registry: Registry, steps: tuple[StepCost, ...]
) -> tuple[str, ...]:
    """Return limitations and remarks."""
    notes = list(case.log.notes)
    if steps and not any(one.nats > TOLD for one in steps):
        notes.append(describe_steps(steps))
    if search.skipped:
        notes.append("The processor time was used up before the search had ended: give --budget SECONDS for more.")
    tried = {effect.key.partition("@")[0] for effect in search.screen.effects}
    others = (term for term in _make_library(registry) if not can_act(term) and term.acts == "motion")
    aside = sorted({term.name for term in others} - tried)
    notes.append(f"Not tried at joints, because they need other places: {', '.join(aside)}.")
    if case.model.side == "motor":
        notes += _list_gearless(case.model, plain)
    if search.temper > 1.5:
        notes.append(
            f"One-step errors scatter by a factor of {search.temper:.1f} more than independent ones: all evidence is"
            " divided by it."
        )
    return tuple(notes)


def _list_gearless(model: RobotModel, plain: TapedArm) -> list[str]:
    """Return a note on joints whose gear was not tried, because the inertia of the motor is not known."""
    without = [joint for joint in model.joints if plain.values.get(f"{joint}.armature", 0.0) <= 0.0]
    if not without:
        return []
    own = " and leave it out of the function" if model.kind == INVERSE else ""
    return [
        f"{' and '.join(law.name for law in GEARS)} were not tried in the gear of {', '.join(without)}: the inertia of"
        f' the motor is not known there. Give it in [model.known], "{without[0]}.armature" = ...{own}.'
    ]


def _list_unwritten(written: FoundFiles | None, found: Sequence[Mechanism]) -> list[str]:
    """Return what the changed model does not express, or expresses by a change beyond what was found."""
    said = {m.says for m in found}
    return [] if written is None else [f"{FOUND_MODEL}: {note}" for note in written.notes if note not in said]


def make_robot_origin(case: RobotCase, registry: Registry, budget: float | None) -> Origin:
    """Return the origin of the diagnosis of a case; `budget` is the processor time of its search (s)."""
    model = case.model
    settings = {
        "simulator": model.kind, "joints": list(model.joints), "torque": model.side, "hold": case.log.hold,
        "tolerance": model.tolerance, "known": dict(case.known), "budget": SECONDS if budget is None else budget,
    }  # fmt: skip
    return origin_of("diagnose", settings, None, {**registry.origins(), **case.inputs})


def _list_arrays(
    case: RobotCase, path: RobotPath, missing: Array, both: tuple[HeldOutRuns, HeldOutRuns]
) -> tuple[dict[str, StoredArray], dict[str, StoredArray]]:
    """Return the arrays of the page: the missing torque over the path, and held-out predictions."""
    log, first = case.log, both[0].first
    window = ("window", "joint")
    held = ("time", "reading")
    turns = [one == "rotation" for one in case.model.simulator.moves]
    torque, angle, speed = (
        ", ".join(dict.fromkeys(pair[not one] for one in turns))
        for pair in (("N m", "N"), ("rad", "m"), ("rad/s", "m/s"))
    )
    arrays = {
        "missing_torque": StoredArray(window, missing, torque, "recorded torque less that of the model"),
        "position": StoredArray(window, path.q, angle, "position"),
        "velocity": StoredArray(window, path.v, speed, "velocity"),
        "recorded": StoredArray(held, log.readings[first:], "", "held-out readings"),
        "before": StoredArray(held, both[0].shown, "", "free runs of the nominal model"),
        "after": StoredArray(held, both[1].shown, "", "free runs with the found mechanisms"),
    }
    words = [f"{log.joints[j]}.{'velocity' if order else 'position'}" for j, order in log.picks]
    coords = {
        "joint": StoredArray(("joint",), list(log.joints)),
        "reading": StoredArray(("reading",), words),
        "time": StoredArray(("time",), log.dt * np.arange(first, log.samples), "s", "time"),
    }
    return arrays, coords
