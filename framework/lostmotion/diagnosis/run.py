"""The whole way of a diagnosis: case in, `diagnosis.json`, `arrays.nc` and `report.html` out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.codec import to_plain
from lostmotion.diagnosis.arrays import arrays_of
from lostmotion.diagnosis.attractors import motions_of
from lostmotion.diagnosis.compare import (
    exponent_of,
    horizon_for,
    pieces_of,
    predict,
    rates_of,
    worsened,
)
from lostmotion.diagnosis.confirming import decided, find_simplest, predicted_better, unconfirmed
from lostmotion.diagnosis.decays import decay_in
from lostmotion.diagnosis.disagreements import disagreement_in
from lostmotion.diagnosis.evidences import evidence_of
from lostmotion.diagnosis.findings import Outcome, draws_of, found_in, why_withheld
from lostmotion.diagnosis.mixed import draws_after
from lostmotion.diagnosis.notes import notes_of
from lostmotion.diagnosis.report.page import write_report
from lostmotion.diagnosis.rivals import Proposals, confused_with, proposed
from lostmotion.diagnosis.search import Diagnosed, diagnose, instead, simpler
from lostmotion.diagnosis.sharings import shared_in
from lostmotion.diagnosis.show import Seen, shown
from lostmotion.diagnosis.states import doubted, in_order, open_of
from lostmotion.diagnosis.unknowns import where
from lostmotion.diagnosis.verdict import (
    angle_of,
    bodies_of,
    confusions_of,
    drive_of,
    exponents_of,
    labels,
    parameters_of,
    ranking_of,
    says,
    scores_of,
    sensors_of,
    unexplained_of,
    units_of,
    valid_times,
    whiteness_of,
)
from lostmotion.errors import ContractError
from lostmotion.kernels.threads import each
from lostmotion.likelihood.system import System, key_of
from lostmotion.preparation.prepare import Prepared, prepare
from lostmotion.preparation.vetting import (
    catch_divergence,
    find_raising_terms,
    name_suspects,
    note_set_aside,
    third_party_keys,
)
from lostmotion.provenance import origin_of
from lostmotion.quantities import quantity_of
from lostmotion.recording import Recording
from lostmotion.registry import Registry
from lostmotion.results.background import FittedMachine, Origin, RecordingFacts, SensorChannel, TermFacts
from lostmotion.results.behaviour import Behaviour
from lostmotion.results.diagnosis import Diagnosis, Response
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import dataset_of, folder_for, save_datasets, save_json

if TYPE_CHECKING:
    import xarray as xr

Say = Callable[[str], None]
SHOW, NEXT, EVIDENCE, WHEN = 1, 2, 3, 4
"""The streams of random numbers for what is shown, proposed, checked and placed in time: no finding depends on them."""


@dataclass(frozen=True, eq=False)
class Told:
    """A diagnosis as it is told: the result, the arrays behind it, and what both are made of."""

    result: Diagnosis
    arrays: xr.Dataset
    outcome: Outcome

    def save(self, folder: Path) -> None:
        """Write `diagnosis.json`, `arrays.nc` and `report.html` into a folder."""
        save_datasets(folder / "arrays.nc", {None: self.arrays})
        save_json(folder / "diagnosis.json", to_plain(self.result))
        write_report(folder)


def run_diagnosis(
    path: Path,
    out: Path,
    registry: Registry,
    *,
    seed: int = 0,
    jobs: int = 2,
    propose: bool = True,
    say: Say = lambda _: None,
    settings: Settings = DEFAULT,
) -> Diagnosis:
    """Return the diagnosis of a case after writing it, `arrays.nc` and `report.html` into the folder `out`.

    Unless it is to `propose` none, it looks for the experiment that would tell rivals apart.
    """
    say("reading the case")
    prepared = prepare(path, registry, settings)
    folder = folder_for(out)
    told = diagnose_prepared(prepared, registry, seed=seed, jobs=jobs, propose=propose, say=say, settings=settings)
    say("report")
    told.save(folder)
    return told.result


@catch_divergence()
def diagnose_prepared(
    prepared: Prepared,
    registry: Registry,
    *,
    seed: int,
    jobs: int,
    propose: bool = True,
    say: Say = lambda _: None,
    settings: Settings = DEFAULT,
) -> Told:
    """Return the diagnosis of a case, with all that is told of it; nothing is written."""
    work = partial(diagnose, jobs=jobs, say=say, settings=settings)
    diagnosis, prepared, rng = _diagnosed(prepared, registry, seed, work)
    say("held-out predictions")
    outcome = upheld(diagnosis, prepared, rng, say)
    outcome = replace(outcome, unconfirmed=unconfirmed(outcome, prepared.observations), angle=angle_of(prepared.case))
    diagnosis = outcome.diagnosis
    motions = motions_of(diagnosis)
    say("attractors")
    show = shown(Seen(outcome, motions, prepared.observations, registry), np.random.default_rng([seed, SHOW]))
    stream = np.random.default_rng([seed, NEXT])
    proposals = proposed(diagnosis, prepared.case.experiment if propose else None, rng=stream, say=say)
    say("evidence by sampling")
    result = _result(prepared, outcome, seed, proposals, show)
    variables, coords = arrays_of(outcome, motions)
    return Told(result, dataset_of(variables, coords, {"title": prepared.case.title}), outcome)


def _diagnosed(
    prepared: Prepared, registry: Registry, seed: int, work: Callable[..., Diagnosed]
) -> tuple[Diagnosed, Prepared, np.random.Generator]:
    """Return the diagnosis, what it was made of, and its random numbers, for who goes on with them.

    Terms of other people that break down on the way are left out, and it begins anew.
    """
    system, rng = System(prepared.model, prepared.terms), np.random.default_rng(seed)
    try:
        return work(prepared.case, prepared.observations, system, rng=rng), prepared, rng
    except ContractError as err:
        third_party = third_party_keys(registry, prepared.terms)
        culprits = {err.plugin} & set(third_party)
        if not err.plugin:
            suspects = [term for term in prepared.terms if key_of(term) in third_party]
            culprits = find_raising_terms(suspects, prepared.observations) or set(third_party)
        if not culprits:
            raise
        kept = tuple(term for term in prepared.terms if key_of(term) not in culprits)
        told = note_set_aside(name_suspects(registry, culprits, err))
        fewer = replace(prepared, terms=kept, aside=(*prepared.aside, told))
        return _diagnosed(fewer, registry, seed, work)


def compare_heldout(diagnosis: Diagnosed, prepared: Prepared, rng: np.random.Generator) -> Outcome:
    """Return the diagnosis with what both models predict of the held-out data."""
    pieces = pieces_of(prepared.observations, diagnosis.held)
    same = diagnosis.after is diagnosis.before
    fits = [diagnosis.before] if same else [diagnosis.before, diagnosis.after]
    jobs = diagnosis.before.problem.jobs
    rates = each(lambda fit: rates_of(fit, prepared.observations), fits, jobs)
    horizon = horizon_for(diagnosis.after, pieces, exponent_of(rates[-1]))
    both = each(lambda pair: predict(pair[0], pieces, horizon, pair[1]), list(zip(fits, rates, strict=True)), jobs)
    before, after = both[0], both[-1]
    draws = draws_of(diagnosis.before, rng)
    return Outcome(diagnosis, before, after, horizon, draws, draws if same else draws_after(diagnosis, rng))


def upheld(diagnosis: Diagnosed, prepared: Prepared, rng: np.random.Generator, say: Say = lambda _: None) -> Outcome:
    """Return the diagnosis with its predictions, less what held-out data speak against.

    They have a veto: where free runs or one-step predictions are worse with what was found than without it, learned
    curves are taken back first, then one term after the other, the least probable one first. So it goes where the force
    that is missing rises with what was found. And held-out data choose among sets that explain the fitted data.
    """
    outcome, limits = compare_heldout(diagnosis, prepared, rng), diagnosis.settings.heldout
    if (better := predicted_better(outcome, prepared.observations)) is not None:
        say(f"held-out predictions with {' and '.join(sorted(better.problem.active))} instead")
        outcome = compare_heldout(instead(diagnosis, better, rng.spawn(1)[0]), prepared, rng)
    elif (close := decided(outcome, prepared.observations)) is not None:
        fit, scored = close
        say(f"held-out data decide for {' and '.join(sorted(fit.problem.active))}")
        weighed = replace(outcome.diagnosis.selection, scored=dict(scored))
        trial = compare_heldout(
            instead(replace(outcome.diagnosis, selection=weighed), fit, rng.spawn(1)[0]), prepared, rng
        )
        good = trial.diagnosis.explains and not worsened(outcome.before, trial.after, limits)
        outcome = trial if good else outcome
    elif (simplest := find_simplest(outcome, prepared.observations)) is not None:
        fit, weighed = simplest[0], replace(outcome.diagnosis.selection, simplest=simplest[1])
        say(f"{' and '.join(sorted(fit.problem.active))} as the simplest explanation")
        trial = compare_heldout(
            instead(replace(outcome.diagnosis, selection=weighed), fit, rng.spawn(1)[0]), prepared, rng
        )
        good = trial.diagnosis.explains and not worsened(outcome.before, trial.after, limits)
        outcome = trial if good else outcome
    while (found := outcome.diagnosis).found:
        if not worsened(outcome.before, outcome.after, limits) and found.explains:
            break
        less = simpler(found, rng.spawn(1)[0])
        if less is None:
            break
        say(f"held-out predictions without {less.withdrawn[-1]}")
        outcome = compare_heldout(less, prepared, rng)
    return outcome


def _result(prepared: Prepared, outcome: Outcome, seed: int, proposals: Proposals, show: Behaviour) -> Diagnosis:
    d, case = outcome.diagnosis, prepared.case
    found, sharing = shared_in(d, found_in(outcome))
    found, rest = in_order([doubted(entry, d.settings.name.sure) for entry in found]), open_of(d)
    over_time, by_recording = disagreement_in(d, np.random.default_rng([seed, WHEN]))
    before = replace(where(d.located, d.learned), bodies=bodies_of(d), over_time=over_time, by_recording=by_recording)
    return Diagnosis(
        title=case.title,
        verdict="mismatch" if found else "adequate",
        says=says(outcome, found, rest),
        found=found,
        open=rest,
        ranking=ranking_of(d, found, failed=bool(why_withheld(outcome))),
        confused_with=confused_with(d, confusions_of(d), proposals),
        unexplained=unexplained_of(d, after=True),
        unexplained_before=unexplained_of(d, after=False),
        where=before,
        where_after=where(d.left or d.located),
        parameters=parameters_of(outcome),
        fit=scores_of(outcome),
        model=labels(d),
        drive=drive_of(d),
        units=replace(units_of(d), angle=outcome.angle),
        response=Response(quantity_of(d.shown.channel)),
        sensors=sensors_of(d),
        lyapunov=exponents_of(outcome),
        valid_prediction_time=valid_times(outcome),
        whiteness=whiteness_of(outcome),
        sharing=sharing,
        show=show,
        decay=decay_in(d),
        evidence=evidence_of(d, np.random.default_rng([seed, EVIDENCE])),
        machine=_machine(outcome, case),
        truth=case.truth,
        recordings=tuple(map(_recording, prepared.recordings)),
        notes=tuple(notes_of(outcome, (*prepared.notes, *unused(case.known)))),
        provenance=_origin(prepared, d, seed),
    )


def _recording(r: Recording) -> RecordingFacts:
    return RecordingFacts(r.name, r.n, r.rate, r.start, tuple(a.attrs["of"] for a in r.inputs))


def _origin(prepared: Prepared, d: Diagnosed, seed: int) -> Origin:
    case = prepared.case
    settings = {"model": case.model, "known": dict(case.known), "terms": [f"{t.name}@{t.at}" for t in prepared.terms]}
    return origin_of("diagnose", {**settings, "thresholds": d.settings.as_dict()}, seed, prepared.inputs)


def _machine(outcome: Outcome, case: CaseFile) -> FittedMachine:
    """Return what it takes to set the model that was fitted in motion again: model, terms, and all values in SI."""
    problem, theta = outcome.diagnosis.after.problem, outcome.diagnosis.after.theta
    system, full = problem.system, problem.full(theta)
    learned = outcome.diagnosis.learned
    own = {q.name for q in system.model.params}
    told = {key: float(full[i]) for key, i in system.index.items()}
    terms = zip(system.keys, system.terms, strict=True)
    return FittedMachine(
        model=case.model,
        equations=case.equations,
        units=case.units,
        motion=system.model.motion,
        terms=tuple(TermFacts(key, term.name, term.at) for key, term in terms if key in problem.active),
        learned=learned.keys if learned else (),
        sensors=tuple(SensorChannel(s.name, s.channel) for s in outcome.diagnosis.shown.sensors),
        values={k: v for k, v in told.items() if k in own or any(k.startswith(f"{a}.") for a in problem.active)},
    )


def unused(known: Iterable[str]) -> list[str]:
    """Return a note on the known values of terms in a case: a diagnosis begins with the model alone."""
    terms = [name for name in known if "." in name]
    if not terms:
        return []
    return [
        f"{', '.join(terms)} in [model.known] is not used: a diagnosis begins with the model alone and estimates each"
        " term that it tries; `identify --term` takes terms with known values."
    ]
