"""A complete diagnosis: it reads a case and writes `diagnosis.json`, `arrays.nc` and `report.html`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.codec import to_plain
from lostmotion.diagnosis.absent_terms import list_absent
from lostmotion.diagnosis.compare import (
    average_exponent,
    choose_heldout_horizon,
    compute_rates,
    cut_heldout,
    is_worse,
    predict,
)
from lostmotion.diagnosis.compared_motions import list_motions
from lostmotion.diagnosis.disagreement_times import describe_disagreement
from lostmotion.diagnosis.evidence_check import check_evidence
from lostmotion.diagnosis.expected_findings import describe_expectation, forecast_recordings
from lostmotion.diagnosis.findings import Outcome, draw_parameters, explain_withheld, list_findings
from lostmotion.diagnosis.free_decays import describe_decays
from lostmotion.diagnosis.mixed import draw_mixture
from lostmotion.diagnosis.moving import note_rest
from lostmotion.diagnosis.notes import write_notes
from lostmotion.diagnosis.report.diagnosis_page import write_report
from lostmotion.diagnosis.rivals import Proposals, describe_confusions, propose_experiments
from lostmotion.diagnosis.scales import LEFT, describe_wrong_sign
from lostmotion.diagnosis.show import measure_behaviour
from lostmotion.diagnosis.stages import SearchResult, diagnose, explain_by
from lostmotion.diagnosis.states import NAMED, limit_confidence, list_open_terms, sort_findings
from lostmotion.diagnosis.stored_arrays import list_arrays
from lostmotion.diagnosis.unknowns import describe_dependence
from lostmotion.diagnosis.values_by_recording import add_sharing
from lostmotion.diagnosis.verdict import (
    count_bodies,
    describe_drive,
    describe_whiteness,
    find_angle_unit,
    label_models,
    list_confusions,
    list_exponents,
    list_parameters,
    list_scores,
    list_sensors,
    list_units,
    list_valid_times,
    measure_unexplained,
    rank_candidates,
    summarise,
)
from lostmotion.errors import ContractError
from lostmotion.evidence.bare import name_terms
from lostmotion.inference.profile import measure_stretches
from lostmotion.kernels.threads import each, hold_linear_algebra
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
from lostmotion.results.diagnosis import Diagnosis, Mechanism, Response
from lostmotion.results.expectation import Expectation
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import dataset_of, folder_for, save_datasets, save_json

if TYPE_CHECKING:
    import xarray as xr

Say = Callable[[str], None]
ABSURD = 10.0
"""The share of the drive from which the force of a law means that a unit, a sign or a ratio is wrong."""
MOST_REFUTED = 4
"""The largest number of sets that free runs over held-out data may refute."""
SHOW, NEXT, EVIDENCE, WHEN, DRAWN, EXPECTED = 1, 2, 3, 4, 5, 6
"""Streams of random numbers for attractors, experiments, the check of evidence, disagreement over time, the draws of
intervals, and what a recording can tell; no finding depends on them."""


@dataclass(frozen=True, eq=False)
class DiagnosisOutput:
    """The output of a diagnosis: the result, its arrays, and the outcome from which both are made."""

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

    With `propose`, it also searches for the experiment that distinguishes the alternatives.
    """
    say("reading the case")
    prepared = prepare(path, registry, settings)
    folder = folder_for(out)
    output = diagnose_prepared(prepared, registry, seed=seed, jobs=jobs, propose=propose, say=say, settings=settings)
    say("report")
    output.save(folder)
    return output.result


@catch_divergence()
@hold_linear_algebra()
def diagnose_prepared(
    prepared: Prepared,
    registry: Registry,
    *,
    seed: int,
    jobs: int,
    propose: bool = True,
    say: Say = lambda _: None,
    settings: Settings = DEFAULT,
) -> DiagnosisOutput:
    """Return the output of the diagnosis of a case; nothing is written."""
    work = partial(diagnose, jobs=jobs, say=say, settings=settings)
    diagnosis, prepared, rng = _run_search(prepared, registry, seed, work)
    say("held-out predictions")
    outcome = check_heldout(diagnosis, rng, say)
    outcome = replace(outcome, angle=find_angle_unit(prepared.case))
    outcome = draw_posteriors(outcome, np.random.default_rng([seed, DRAWN]))
    diagnosis = outcome.diagnosis
    motions = list_motions(diagnosis)
    say("attractors")
    show = measure_behaviour(outcome, motions, registry, np.random.default_rng([seed, SHOW]))
    stream = np.random.default_rng([seed, NEXT])
    proposals = propose_experiments(diagnosis, prepared.case.experiment if propose else None, rng=stream, say=say)
    say("evidence by sampling")
    result = _make_result(prepared, outcome, seed, proposals, show)
    variables, coords = list_arrays(outcome, motions)
    return DiagnosisOutput(result, dataset_of(variables, coords, {"title": prepared.case.title}), outcome)


def _run_search(
    prepared: Prepared, registry: Registry, seed: int, work: Callable[..., SearchResult]
) -> tuple[SearchResult, Prepared, np.random.Generator]:
    """Return the diagnosis, the prepared case that was used, and the random generator.

    If a third-party term fails, the search is repeated without it.
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
        note = note_set_aside(name_suspects(registry, culprits, err))
        fewer = replace(prepared, terms=kept, aside=(*prepared.aside, note))
        return _run_search(fewer, registry, seed, work)


def compare_heldout(diagnosis: SearchResult) -> Outcome:
    """Return the diagnosis with the predictions of both models for the held-out data."""
    recordings = diagnosis.corrected
    pieces = cut_heldout(recordings, diagnosis.held)
    same = diagnosis.after is diagnosis.before
    fits = [diagnosis.before] if same else [diagnosis.before, diagnosis.after]
    jobs = diagnosis.before.problem.jobs
    rates = each(lambda fit: compute_rates(fit, recordings), fits, jobs)
    horizon = choose_heldout_horizon(diagnosis.after, pieces, average_exponent(rates[-1]))
    both = each(lambda pair: predict(pair[0], pieces, horizon, pair[1]), list(zip(fits, rates, strict=True)), jobs)
    before, after = both[0], both[-1]
    return Outcome(diagnosis, before, after, horizon)


def draw_posteriors(outcome: Outcome, rng: np.random.Generator) -> Outcome:
    """Return the outcome with draws of both posteriors; those after are as wide as the profile of each parameter."""
    d = outcome.diagnosis
    after = draw_mixture(d, rng, measure_stretches(d.after))
    before = after if d.after is d.before else draw_parameters(d.before, rng)
    return replace(outcome, draws_before=before, draws_after=after)


def check_heldout(diagnosis: SearchResult, rng: np.random.Generator, say: Say = lambda _: None) -> Outcome:
    """Return the diagnosis with its predictions, by the most probable set that free runs do not refute.

    One-step predictions of held-out data are a part of the score already. Free runs test the model in another way: a
    set is refuted if they are worse with it than with the nominal model.
    """
    outcome = compare_heldout(diagnosis)
    for _ in range(MOST_REFUTED):
        found = outcome.diagnosis
        if not found.found or not is_worse(outcome.before, outcome.after, found.settings.heldout):
            break
        say(f"held-out predictions without {name_terms(found.explained.terms)}")
        less = explain_by(found.explained.refute(), found, rng.spawn(1)[0], say)
        outcome = compare_heldout(less)
    return outcome


def explains_scale(found: Sequence[Mechanism], left: float) -> bool:
    """Return whether laws of usual size, one of them named, explain the recording: then no scale of a column is wrong.

    `left` is the share of the missing force that they leave; a scale that is told leaves less than `LEFT` of it.
    """
    usual = all((e.share_of_drive or 0.0) < ABSURD for e in found)
    return left < LEFT and usual and any(e.state == NAMED for e in found)


def _make_result(prepared: Prepared, outcome: Outcome, seed: int, proposals: Proposals, show: Behaviour) -> Diagnosis:
    d, case = outcome.diagnosis, prepared.case
    found, sharing = add_sharing(d, list_findings(outcome))
    found, rest = sort_findings([limit_confidence(entry, d.settings.name.sure) for entry in found]), list_open_terms(d)
    failed = bool(explain_withheld(outcome))
    absent, unlimited = ((), ()) if failed else list_absent(d, found, rest, outcome.angle)
    over_time, by_recording = describe_disagreement(d, np.random.default_rng([seed, WHEN]))
    before = replace(
        describe_dependence(d.located, d.learned),
        bodies=count_bodies(d),
        over_time=over_time,
        by_recording=by_recording,
    )
    after, nominal = measure_unexplained(d, after=True), measure_unexplained(d, after=False)
    scale = d.scale or describe_wrong_sign(prepared.recordings)
    if explains_scale(found, after.rms / (nominal.rms or 1.0)):
        scale = ()
    return Diagnosis(
        title=case.title,
        verdict="mismatch" if found else "adequate",
        says=(*scale, *summarise(outcome, found, rest)),
        found=found,
        open=rest,
        ranking=rank_candidates(d, found, failed=failed),
        confused_with=describe_confusions(d, list_confusions(d), proposals),
        expected=_expect(d, outcome.angle, np.random.default_rng([seed, EXPECTED])),
        absent=absent,
        unlimited=unlimited,
        unexplained=after,
        unexplained_before=nominal,
        where=before,
        where_after=describe_dependence(d.left or d.located),
        parameters=list_parameters(outcome),
        fit=list_scores(outcome),
        model=label_models(d),
        drive=describe_drive(d),
        units=replace(list_units(d), angle=outcome.angle),
        response=Response(quantity_of(d.shown.channel)),
        sensors=list_sensors(d),
        lyapunov=list_exponents(outcome),
        valid_prediction_time=list_valid_times(outcome),
        whiteness=describe_whiteness(outcome),
        sharing=sharing,
        show=show,
        decay=describe_decays(d),
        evidence=check_evidence(d, np.random.default_rng([seed, EVIDENCE])),
        machine=_describe_machine(outcome, case),
        truth=case.truth,
        recordings=tuple(map(_describe_recording, prepared.recordings)),
        notes=tuple(write_notes(outcome, _list_remarks(prepared, d))),
        provenance=_make_origin(prepared, d, seed),
    )


def _expect(d: SearchResult, angle: str, rng: np.random.Generator) -> Expectation | None:
    """Return what the recordings can tell, from the nominal fit of the search; None where it cannot follow them."""
    forecast = forecast_recordings(d.explained.nominal, d.recordings, rng)
    return describe_expectation(forecast, d.yardstick, angle) if forecast.valid else None


def _list_remarks(prepared: Prepared, d: SearchResult) -> list[str]:
    """Return the notes on the recordings and on the case."""
    rest = note_rest(prepared.observations, d.recordings)
    return [*prepared.notes, *rest, *note_unused(prepared.case.known)]


def _describe_recording(r: Recording) -> RecordingFacts:
    return RecordingFacts(r.name, r.n, r.rate, r.start, tuple(a.attrs["of"] for a in r.inputs))


def _make_origin(prepared: Prepared, d: SearchResult, seed: int) -> Origin:
    case = prepared.case
    settings = {"model": case.model, "known": dict(case.known), "terms": [f"{t.name}@{t.at}" for t in prepared.terms]}
    return origin_of("diagnose", {**settings, "thresholds": d.settings.as_dict()}, seed, prepared.inputs)


def _describe_machine(outcome: Outcome, case: CaseFile) -> FittedMachine:
    """Return what is needed to simulate the fitted model again: model, terms, and all values in SI units."""
    problem, theta = outcome.diagnosis.after.problem, outcome.diagnosis.after.theta
    system, full = problem.system, problem.full(theta)
    learned = outcome.diagnosis.learned
    own = {q.name for q in system.model.params}
    values = {key: float(full[i]) for key, i in system.index.items()}
    terms = zip(system.keys, system.terms, strict=True)
    return FittedMachine(
        model=case.model,
        equations=case.equations,
        units=case.units,
        motion=system.model.motion,
        terms=tuple(TermFacts(key, term.name, term.at) for key, term in terms if key in problem.active),
        learned=learned.keys if learned else (),
        sensors=tuple(SensorChannel(s.name, s.channel) for s in outcome.diagnosis.shown.sensors),
        values={k: v for k, v in values.items() if k in own or any(k.startswith(f"{a}.") for a in problem.active)},
    )


def note_unused(known: Iterable[str]) -> list[str]:
    """Return a note on known values of terms in a case, which a diagnosis does not use."""
    terms = [name for name in known if "." in name]
    if not terms:
        return []
    return [
        f"{', '.join(terms)} in [model.known] is not used: a diagnosis starts with the model alone and estimates the"
        " parameters of each term; `identify --term` accepts terms with known values."
    ]
