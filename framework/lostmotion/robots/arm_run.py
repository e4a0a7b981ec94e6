"""A complete diagnosis of a robot: it reads a case and writes `diagnosis.json`, `arrays.nc` and `report.html`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from lostmotion.codec import to_plain
from lostmotion.contracts import Term
from lostmotion.errors import CaseError
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.kernels.threads import hold_linear_algebra
from lostmotion.parts import Array
from lostmotion.provenance import origin_of
from lostmotion.registry import Registry
from lostmotion.results import Interval
from lostmotion.results.background import Origin, RecordingFacts
from lostmotion.results.diagnosis import HeldOutScore, HeldOutScores, Labels, Mechanism, ParameterSets
from lostmotion.results.mismatch import UnexplainedForce
from lostmotion.results.robots import Check, RobotDiagnosis
from lostmotion.robots.arm import TapedArm, can_act
from lostmotion.robots.arm_case import RobotCase, load_robot_case
from lostmotion.robots.arm_hypothesis import ArmHypothesis
from lostmotion.robots.arm_page import write_robot_report
from lostmotion.robots.arm_preparation import SECONDS, SearchOptions, make_arm, prepare_search
from lostmotion.robots.arm_search import ArmSearch
from lostmotion.robots.arm_words import (
    describe_dependence,
    list_confusions,
    list_findings,
    list_joints,
    make_interval,
    rank_sets,
)
from lostmotion.robots.free_runs import HORIZON, HeldOutRuns, predict_heldout
from lostmotion.robots.log_checks import average, check_log, predict_torque
from lostmotion.robots.tape import Path as RobotPath
from lostmotion.simulators import FoundMechanism
from lostmotion.storage import StoredArray, dataset_of, folder_for, save_datasets, save_json, save_text

Say = Callable[[str], None]
USUAL = 0.03
"""A random force above this share of the torque is more than the usual noise of a drive."""
FOUND_MODEL = "arm_found.xml"


@dataclass(frozen=True, eq=False)
class RobotOutput:
    """The output of a diagnosis: the result, the search it comes from, and the arrays of the page."""

    result: RobotDiagnosis
    search: ArmSearch
    arrays: dict[str, StoredArray]
    coords: dict[str, StoredArray]

    def save(self, folder: Path) -> None:
        """Write `diagnosis.json`, `arrays.nc` and `report.html` into a folder."""
        save_datasets(folder / "arrays.nc", {None: dataset_of(self.arrays, self.coords, {"title": self.result.title})})
        save_json(folder / "diagnosis.json", to_plain(self.result))
        write_robot_report(folder)


def run_robot(
    path: Path, out: Path, registry: Registry, *, budget: float | None = None, say: Say = lambda _: None
) -> RobotDiagnosis:
    """Return the diagnosis of the case of a robot, after writing its files and the changed model into a folder.

    `budget` is the processor time of the search (s).
    """
    say("reading the case")
    case = load_robot_case(path, registry)
    folder = folder_for(out)
    output = diagnose_robot(case, registry, budget=budget, say=say)
    say("report")
    output.save(folder)
    written = case.simulator.write_found(list_changes(output), case.known)
    if written is not None:
        save_text(folder / FOUND_MODEL, written[0])
    return output.result


@hold_linear_algebra()
def diagnose_robot(
    case: RobotCase, registry: Registry, *, budget: float | None = None, say: Say = lambda _: None
) -> RobotOutput:
    """Return the output of the diagnosis of a robot; raise `CaseError` where a check of the log fails."""
    say("tape")
    plain = make_arm(case.simulator, case.log, case.side, known=case.known)
    checks = check_log(plain, case.simulator)
    if stopped := [check.says for check in checks if check.stop]:
        raise CaseError(" ".join(stopped))
    terms = [registry.make("term", name) for name in registry.names("term")]
    options = SearchOptions(case.tolerance, budget=SECONDS if budget is None else budget)
    search, start = prepare_search(plain, case.simulator, terms, case.estimate, options, say)
    search.run(start)
    if not search.found:
        raise CaseError(
            "the model diverges from the log at any level of noise: check units, signs and the order of the joints"
        )
    return _make_output(case, plain, search, checks, terms)


def _make_output(
    case: RobotCase, plain: TapedArm, search: ArmSearch, checks: Sequence[Check], terms: Sequence[Term]
) -> RobotOutput:
    motions = dict(zip(case.simulator.joints, case.simulator.moves, strict=True))
    nominal, best = search.found[frozenset()], search.best
    before, after = predict_heldout(nominal), predict_heldout(best)
    found = list_findings(search, motions)
    missing = average(case.log.torque - predict_torque(plain), case.log.dt)
    path = plain.tape.path
    seen = replace(plain, tape=replace(plain.tape, path=_average_path(path, case.log.dt)))
    rows = list_joints(search, (nominal, before), (best, after), found, motions)
    worst = max(rows, key=lambda row: row.random_after / row.torque)
    left = worst.random_after
    result = RobotDiagnosis(
        title=case.title,
        verdict="mismatch" if found else "adequate",
        says=_summarise(found, before, after, case.log.joints),
        checks=tuple(checks),
        found=found,
        ranking=rank_sets(search),
        confused_with=list_confusions(search),
        unexplained=UnexplainedForce(left > USUAL * worst.torque, left, worst.unit, left / worst.torque),
        where=describe_dependence(missing, seen),
        parameters=ParameterSets(_list_values(nominal, motions), _list_values(best, motions)),
        fit=HeldOutScores(
            _score(before, case.log.joints), _score(after, case.log.joints), float(np.mean(after.floor)), "s", 1.0
        ),
        model=Labels(Path(case.file).name, " + ".join([Path(case.file).name, *sorted(best.terms)])),
        joints=rows,
        noise=_list_noise(best, motions),
        recordings=(
            RecordingFacts(
                case.log.name, case.log.samples, 1.0 / case.log.dt, None, tuple(f"{j}.torque" for j in case.log.joints)
            ),
        ),
        notes=_write_notes(case, search, terms),
        provenance=_make_origin(case, search),
    )
    return RobotOutput(result, search, *_list_arrays(case, seen, missing, (before, after)))


def _average_path(path: RobotPath, dt: float) -> RobotPath:
    return RobotPath(*(average(x, dt) for x in (path.q, path.v, path.a)))


def _summarise(
    found: Sequence[Mechanism], before: HeldOutRuns, after: HeldOutRuns, joints: Sequence[str]
) -> tuple[str, ...]:
    """Return the result in sentences."""
    if not found:
        return (
            "This log shows no missing physics: every mechanism that was tried is less likely than the model as it is.",
        )
    told = [m.says if m.state == "named" else f"Likely (probability {m.probability:.2f}): {m.says}" for m in found]
    best = int(np.argmax(before.nrmse / np.maximum(after.nrmse, 1e-300)))
    told.append(
        f"Free runs of {HORIZON:g} s over held-out data: the error of {joints[best]} falls from"
        f" {100.0 * before.nrmse[best]:.3g} % to {100.0 * after.nrmse[best]:.3g} % of its motion."
    )
    return tuple(told)


def _score(told: HeldOutRuns, joints: Sequence[str]) -> HeldOutScore:
    by_joint = {joint: float(x) for joint, x in zip(joints, told.nrmse, strict=True)}
    return HeldOutScore(told.log_score, float(np.mean(told.nrmse)), by_joint, HORIZON)


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
    return "N m" if motions[key.partition(".")[0]] == "rotation" else "N"


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


def _write_notes(case: RobotCase, search: ArmSearch, terms: Sequence[Term]) -> tuple[str, ...]:
    """Return limitations and remarks."""
    notes = list(case.log.notes)
    if case.simulator.step is not None and case.simulator.step > 5e-4:
        notes.append(
            f"The model integrates with steps of {1e3 * case.simulator.step:g} ms. The diagnosis does not depend on"
            " them, because it uses the exact equations of motion; a simulation with these steps has errors of its own."
        )
    if search.skipped:
        notes.append("The processor time was used up before the search had ended: give --budget SECONDS for more.")
    aside = sorted(term.name for term in terms if not can_act(term) and term.acts == "motion")
    notes.append(f"Not tried at joints, because they have states or need other places: {', '.join(aside)}.")
    if search.temper > 1.5:
        notes.append(
            f"One-step errors scatter by a factor of {search.temper:.1f} more than independent ones: all evidence is"
            " divided by it."
        )
    return tuple(notes)


def _make_origin(case: RobotCase, search: ArmSearch) -> Origin:
    settings = {
        "simulator": case.kind, "joints": list(case.simulator.joints), "torque": case.side, "hold": case.log.hold,
        "tolerance": case.tolerance, "known": dict(case.known), "most": search.most, "budget": search.budget.seconds,
    }  # fmt: skip
    return origin_of("diagnose", settings, None, case.inputs)


def _list_arrays(
    case: RobotCase, seen: TapedArm, missing: Array, both: tuple[HeldOutRuns, HeldOutRuns]
) -> tuple[dict[str, StoredArray], dict[str, StoredArray]]:
    """Return the arrays of the page: the missing torque over the path, and held-out predictions."""
    log, first = case.log, both[0].first
    path = seen.tape.path
    window = ("window", "joint")
    held = ("time", "reading")
    arrays = {
        "missing_torque": StoredArray(window, missing, "N m", "recorded torque less that of the model"),
        "position": StoredArray(window, path.q, "rad", "position"),
        "velocity": StoredArray(window, path.v, "rad/s", "velocity"),
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


def list_changes(output: RobotOutput) -> tuple[FoundMechanism, ...]:
    """Return the named mechanisms for a simulator, which writes them into its own file."""
    return tuple(
        FoundMechanism(m.mechanism, m.at, {name: x.median for name, x in m.parameters.items()}, m.says)
        for m in output.result.found
        if m.mechanism != UNKNOWN
    )
