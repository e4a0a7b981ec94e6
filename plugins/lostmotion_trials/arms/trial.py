"""A blind trial on robot arms: one process conceals, another diagnoses, a third opens the truths and judges."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import lru_cache, partial
from pathlib import Path

import numpy as np

from lostmotion.codec import described, from_plain, to_plain
from lostmotion.errors import DataError, LostMotionError, nearest
from lostmotion.provenance import provenance
from lostmotion.registry import Registry
from lostmotion.results.robots import RobotDiagnosis
from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_run import diagnose_robot
from lostmotion.storage import folder_for, load_json, save_json
from lostmotion_trials.arms.chains import CHAIN_EFFECTS, draw_hidden_chain, write_chain_case
from lostmotion_trials.arms.draw import EFFECTS, Truth, draw_arm, write_case
from lostmotion_trials.arms.judging import (
    FAILED,
    ArmsTarget,
    JudgedArm,
    count_mechanisms,
    count_targets,
    judge_outcome,
    judge_sizes,
    list_named,
)
from lostmotion_trials.sealing import ConcealedCase, format_case_name, open_seal, publish, seal_case
from lostmotion_trials.trial_steps import Say, TrialSteps, be_silent, open_trial

FILES = ("case.toml", "arm.xml", "log.csv")
CYCLE, HIDING = 5, 3
"""Of so many arms in turn, the first few hide something."""
KNOWN = 0.02
"""The share within which a case states the values of its model, unless they are wrong by more."""
SAMPLES = 5000
"""The usual length of a log, 10 s."""
AGAIN = "run `lostmotion prove` again"


@dataclass(frozen=True)
class ArmsPlan:
    """Settings of a trial on arms: the number of joints and of effects in each, and the length of a log (samples).

    Masses, centres of mass, inertias, armatures and damping of each machine differ from those of its model by the share
    `wrong` (sd), which its case states as tolerance.
    """

    seed: int = 0
    samples: int = SAMPLES
    only: tuple[str, ...] = ()
    clean: bool = False
    joints: int = 2
    effects: int = 1
    wrong: float = 0.0

    @property
    def names(self) -> tuple[str, ...]:
        """The mechanisms that may be hidden."""
        return tuple(EFFECTS if self.joints == 2 else CHAIN_EFFECTS)

    def check(self) -> None:
        """Refuse unknown names, and options that exclude one another."""
        for name in self.only:
            if name not in self.names:
                raise DataError(
                    f"no mechanism {name!r} can be hidden in such an arm{nearest(name, self.names)}: there are"
                    f" {', '.join(self.names)}"
                )
        if self.only and self.clean:
            raise DataError("clean arms hide nothing: give either --clean or --only")
        if self.joints == 2 and self.effects > 1:
            raise DataError("arms with 2 joints hide one effect: give --effects 1, or more --joints")

    def choose(self, number: int) -> tuple[str, ...]:
        """Return the mechanisms to hide in an arm."""
        offered, turn = self.only or self.names, number % CYCLE
        if self.clean or (not self.only and turn >= HIDING):
            return ()
        place = number if self.only else HIDING * (number // CYCLE) + turn
        return tuple(offered[(place + 2 * k) % len(offered)] for k in range(self.effects))


@dataclass(frozen=True)
class SealedArm:
    """The truth of one arm: `sealed/NNN.json`."""

    schema: str = described("`lostmotion.sealed_arm/1`")
    case: str = described("name of the case")
    salt: str = described("random bytes, so that a truth cannot be guessed from its digest")
    effects: tuple[Truth, ...] = described("what is hidden")


@dataclass(frozen=True)
class DiagnosedArm:
    """Whether an arm was diagnosed."""

    case: str = described("name of the case")
    status: str = described("ok or failed")
    says: str = described("the diagnosis in sentences, or why there is none")


@dataclass(frozen=True)
class ArmsProof:
    """What `proof.json` of a trial on arms holds."""

    schema: str = described("`lostmotion.proof_arms/1`")
    title: str = described("title of the trial")
    targets: tuple[ArmsTarget, ...] = described("what should be reached, and what was")
    mechanisms: Mapping[str, Mapping[str, int]] = described("the number of arms with each outcome, by what was hidden")
    arms: tuple[JudgedArm, ...] = described("every arm")
    provenance: Mapping[str, object] = described("versions, settings, seed and digests that made it")


def conceal_arm(plan: ArmsPlan, out: Path, number: int) -> ConcealedCase:
    """Return the digests of an arm after writing its case, and its sealed truth, into the folder `out`."""
    case, names, known = format_case_name(number), plan.choose(number), max(KNOWN, plan.wrong)
    place = folder_for(out / "cases" / case)
    if plan.joints == 2:
        model, truth, log = draw_arm(number, plan.seed, names[0] if names else "none", plan.wrong, plan.samples)
        truths: tuple[Truth, ...] = (truth,) if names else ()
        write_case(place, number, model, log, known)
    else:
        chain, truths, log = draw_hidden_chain(
            number, plan.seed, names, plan.joints, wrong=plan.wrong, samples=plan.samples
        )
        write_chain_case(place, f"Chain {number}", chain, log, known)
    salt = np.random.default_rng([plan.seed, number, plan.joints, 1]).bytes(16).hex()
    sealed = SealedArm("lostmotion.sealed_arm/1", case, salt, truths)
    save_json(folder_for(out / "sealed") / f"{case}.json", to_plain(sealed))
    return seal_case(out, number, FILES)


@dataclass(frozen=True)
class ArmDiagnoser:
    """The step that diagnoses: it has the folder of the cases, but not the truths."""

    cases: Path

    def __call__(self, number: int) -> DiagnosedArm:
        """Return whether an arm was diagnosed, after writing `diagnosis.json` beside its case."""
        case = format_case_name(number)
        try:
            found = _diagnose(self.cases / case)
        except (LostMotionError, ArithmeticError, ValueError) as err:
            return DiagnosedArm(case, "failed", " ".join(str(err).split()))
        save_json(self.cases / case / "diagnosis.json", to_plain(found))
        return DiagnosedArm(case, "ok", " ".join(found.says))


@dataclass(frozen=True)
class ArmScorer:
    """The step that opens the truths, once all has been said."""

    out: Path

    def __call__(self, number: int) -> JudgedArm:
        """Return what became of an arm."""
        case = format_case_name(number)
        truths = from_plain(SealedArm, open_seal(self.out, number), str(self.out / "sealed" / f"{case}.json")).effects
        hidden = tuple(f"{truth.mechanism}@{truth.at}" for truth in truths)
        gain = _measure_gain(self.out / "cases" / case, hidden) if hidden else math.nan
        path = self.out / "cases" / case / "diagnosis.json"
        if not path.exists():
            return JudgedArm(case, hidden, (), FAILED, gain, ())
        found = from_plain(RobotDiagnosis, load_json(path, AGAIN), str(path))
        named = list_named(found)
        return JudgedArm(case, hidden, named, judge_outcome(hidden, named), gain, tuple(judge_sizes(truths, found)))


def _diagnose(place: Path, terms: tuple[str, ...] = ()) -> RobotDiagnosis:
    return diagnose_robot(load_robot_case(place / "case.toml", _registry()), _registry(), terms=terms).result


def _measure_gain(place: Path, hidden: tuple[str, ...]) -> float:
    """Return the log evidence that the true effects gain, where they alone are tried."""
    try:
        ranking = _diagnose(place, hidden).ranking
    except (LostMotionError, ArithmeticError, ValueError):
        return 0.0
    return max((row.log_evidence_gain for row in ranking if row.mechanism.count("+") == len(hidden) - 1), default=0.0)


_registry = lru_cache(maxsize=1)(Registry.discover)


def run_arms(
    plan: ArmsPlan,
    out: Path,
    *,
    cases: int,
    jobs: int,
    say: Say = be_silent,
    fresh: bool = False,
    cluster: str = "",
) -> ArmsProof:
    """Return the content of `proof.json` after writing it into `out`, beside cases and truths.

    Each of the three steps is a campaign with its own processes in `out`/steps; an interrupted one is continued. With
    the address of a dask `cluster`, its workers conceal and diagnose, and processes of this machine score.
    """
    plan.check()
    out = open_trial(out, fresh=fresh)
    settings = {"world": "arms", **{key: value for key, value in asdict(plan).items() if key != "seed"}}
    origin = partial(provenance, seed=plan.seed, inputs={})
    steps = TrialSteps(out, cases, jobs, origin, say, fresh, cluster)
    publish(out, steps.run("conceal", partial(conceal_arm, plan, out), ConcealedCase, settings))
    steps.run("diagnose", ArmDiagnoser(out / "cases"), DiagnosedArm, settings)
    rows = steps.run("score", ArmScorer(out), JudgedArm, settings, here=True)
    content = ArmsProof(
        schema="lostmotion.proof_arms/1",
        title=f"Blind trial on arms with {plan.joints} joints",
        targets=count_targets(rows, wrong=plan.wrong > KNOWN),
        mechanisms=count_mechanisms(rows),
        arms=tuple(rows),
        provenance=origin("prove", {**settings, "cases": cases}),
    )
    save_json(out / "proof.json", to_plain(content))
    return content


def format_arms(proof: ArmsProof) -> list[str]:
    """Return the lines of the tables of a trial."""
    lines = []
    for row in proof.targets:
        found = row.rate
        told = (
            f"{found.hits}/{found.of} = {found.share:.0%} [{found.low:.0%}, {found.high:.0%}]" if found.of else "none"
        )
        lines.append(f"{row.state:<9}  {row.what}: {told}, expected {row.at_least:.1%} to {row.at_most:.1%}")
    wide = max(len(name) for name in proof.mechanisms)
    for name, counts in proof.mechanisms.items():
        lines.append(f"{name:<{wide}}  {', '.join(f'{count} {outcome}' for outcome, count in counts.items())}")
    for arm in proof.arms:
        if arm.outcome not in ("right", "empty"):
            named = ", ".join(arm.named) or "nothing"
            lines.append(f"{arm.case} {arm.outcome}: hidden {', '.join(arm.hidden) or 'nothing'}, named {named}")
    return lines
