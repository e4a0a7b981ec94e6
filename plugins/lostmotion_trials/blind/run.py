"""The steps of a blind trial: one process conceals, another diagnoses, a third opens the truths and scores."""

from __future__ import annotations

import shutil
from dataclasses import asdict, dataclass
from functools import lru_cache, partial
from pathlib import Path

from lostmotion.codec import to_plain
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.errors import LostMotionError, PlaceError
from lostmotion.provenance import digest, provenance
from lostmotion.registry import Registry
from lostmotion.storage import save_json
from lostmotion_trials.blind.commitment import Blind, conceal_case
from lostmotion_trials.blind.judging import score_case
from lostmotion_trials.blind.page import write_proof
from lostmotion_trials.blind.results import DiagnosedCase, JudgedCase, Proof
from lostmotion_trials.blind.score import summarise
from lostmotion_trials.sealing import ConcealedCase, format_case_name, publish
from lostmotion_trials.trial_steps import Say, TrialSteps, be_silent, open_trial


@dataclass(frozen=True)
class Diagnoser:
    """The step that diagnoses: it has the folder of the cases and the plugin files, but not the truths."""

    cases: Path
    plugins: tuple[str, ...] = ()

    def __call__(self, number: int) -> DiagnosedCase:
        """Return whether a case was diagnosed, after writing the diagnosis beside it."""
        place = self.cases / format_case_name(number)
        shutil.rmtree(place / "diagnosis", ignore_errors=True)
        try:
            found = run_diagnosis(
                place / "case.toml", place / "diagnosis", _registry(self.plugins), seed=number, jobs=1, propose=False
            )
        except PlaceError:
            raise
        except (LostMotionError, ArithmeticError, ValueError) as err:
            shutil.rmtree(place / "diagnosis", ignore_errors=True)
            return DiagnosedCase(format_case_name(number), "failed", " ".join(str(err).split()))
        (place / "diagnosis" / "arrays.nc").unlink(missing_ok=True)  # a worker that was taken for lost did it
        return DiagnosedCase(format_case_name(number), "ok", " ".join(found.says))


@dataclass(frozen=True)
class Scorer:
    """One who unseals: knows everything, once all has been said."""

    out: Path
    plugins: tuple[str, ...] = ()

    def __call__(self, number: int) -> JudgedCase:
        """Return the score of a case."""
        return score_case(self.out, _registry(self.plugins), number)


_registry = lru_cache(maxsize=1)(Registry.discover)
"""A registry with these plugin files, the same one for all cases of a process."""


def run_proof(
    blind: Blind,
    out: Path,
    *,
    cases: int,
    jobs: int,
    plugins: tuple[str, ...] = (),
    say: Say = be_silent,
    fresh: bool = False,
    cluster: str = "",
) -> Proof:
    """Return the content of `proof.json` after writing it and `report.html` into `out`, beside cases and truths.

    Each of the three steps is a campaign with its own processes in `out`/steps; an interrupted one is continued. With
    the address of a dask `cluster`, its workers conceal and diagnose, and processes of this machine score.
    """
    blind.check()
    out = open_trial(out, fresh=fresh)
    settings = {key: value for key, value in asdict(blind).items() if key != "seed"}
    library = {**settings, "terms": _registry(plugins).names("term")}
    inputs = {Path(file).name: digest(Path(file)) for file in plugins}
    origin = partial(provenance, seed=blind.seed, inputs=inputs)
    steps = TrialSteps(out, cases, jobs, origin, say, fresh, cluster)
    publish(out, steps.run("conceal", partial(conceal_case, blind, out), ConcealedCase, settings))
    diagnosed = steps.run("diagnose", Diagnoser(out / "cases", plugins), DiagnosedCase, library)
    scored = steps.run("score", Scorer(out, plugins), JudgedCase, library, here=True)
    content = Proof(
        schema="lostmotion.proof/1",
        title=_format_title(blind),
        summary=summarise(scored, [row for row in diagnosed if row.status != "ok"]),
        provenance=origin("prove", {**library, "cases": cases}),
    )
    save_json(out / "proof.json", to_plain(content))
    write_proof(out)
    return content


def _format_title(blind: Blind) -> str:
    if blind.clean:
        return "Blind trial on clean machines"
    return f"Blind trial of {', '.join(blind.only)}" if blind.only else "Blind trial"
