"""The content of `diagnosis.json`: the words on the facts of a diagnosis, and what was measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.diagnosis.absent_terms import list_absent
from lostmotion.diagnosis.disagreement_times import describe_disagreement
from lostmotion.diagnosis.evidence_check import check_evidence
from lostmotion.diagnosis.expected_findings import describe_expectation, forecast_recordings
from lostmotion.diagnosis.facts import Facts
from lostmotion.diagnosis.findings import list_findings
from lostmotion.diagnosis.free_decays import describe_decays
from lostmotion.diagnosis.gather_facts import list_units
from lostmotion.diagnosis.notes import write_notes
from lostmotion.diagnosis.rivals import Proposals, describe_confusions
from lostmotion.diagnosis.scales import LEFT, describe_wrong_scales, describe_wrong_sign
from lostmotion.diagnosis.stages import SearchResult
from lostmotion.diagnosis.states import NAMED, is_valid, limit_confidence, list_open_terms, sort_findings
from lostmotion.diagnosis.unknowns import describe_dependence
from lostmotion.diagnosis.values_by_recording import add_sharing
from lostmotion.diagnosis.verdict import (
    describe_whiteness,
    list_confusions,
    list_exponents,
    list_parameters,
    list_scores,
    list_sensors,
    list_valid_times,
    rank_candidates,
    summarise,
)
from lostmotion.inference.fit import Fit
from lostmotion.preparation.prepare import Prepared
from lostmotion.provenance import origin_of
from lostmotion.quantities import quantity_of
from lostmotion.recording import Recording
from lostmotion.results.background import FittedMachine, Origin, RecordingFacts, SensorChannel, TermFacts
from lostmotion.results.behaviour import Behaviour
from lostmotion.results.diagnosis import Diagnosis, Labels, Mechanism, Response
from lostmotion.results.expectation import Expectation
from lostmotion.written import Written

ABSURD = 10.0
"""The share of the drive from which the force of a law means that a unit, a sign or a ratio is wrong."""
EVIDENCE, WHEN, EXPECTED = 3, 4, 6
"""Streams of random numbers for the check of evidence, disagreement over time, and what a recording can tell; no
finding depends on them."""


def make_result(
    prepared: Prepared, d: SearchResult, facts: Facts, *, proposals: Proposals, show: Behaviour, seed: int
) -> Diagnosis:
    """Return the result of a diagnosis: words on its facts, experiments, the behaviour of both models, and numbers."""
    case = prepared.case
    found, sharing = add_sharing(d, list_findings(facts))
    found = sort_findings([limit_confidence(entry, facts.settings.name.sure) for entry in found])
    rest = list_open_terms(facts)
    absent, unlimited = list_absent(d, found, rest, facts.angle) if is_valid(facts) else ((), ())
    over_time, by_recording = describe_disagreement(d, np.random.default_rng([seed, WHEN]))
    before = replace(
        describe_dependence(d.located, d.learned),
        bodies=count_bodies(d),
        over_time=over_time,
        by_recording=by_recording,
    )
    explained = explains_scale(found, facts.force_after.rms / (facts.force_before.rms or 1.0))
    scales = () if explained else d.scales
    scale = () if explained else describe_wrong_scales(scales) or describe_wrong_sign(prepared.recordings)
    return Diagnosis(
        title=case.title,
        verdict="mismatch" if found else "adequate",
        says=(*scale, *summarise(facts, found, rest)),
        scales=scales,
        found=found,
        open=rest,
        ranking=rank_candidates(facts, found),
        confused_with=describe_confusions(facts, list_confusions(facts), proposals),
        expected=_expect(d, facts.angle, np.random.default_rng([seed, EXPECTED])),
        absent=absent,
        unlimited=unlimited,
        unexplained=facts.force_after,
        unexplained_before=facts.force_before,
        where=before,
        where_after=describe_dependence(d.left or d.located),
        parameters=list_parameters(facts),
        fit=list_scores(facts),
        model=Labels(label_model(d.before), label_model(d.after)),
        drive=facts.drive,
        units=replace(list_units(d), angle=facts.angle),
        response=Response(quantity_of(d.shown.channel)),
        sensors=list_sensors(facts),
        lyapunov=list_exponents(facts),
        valid_prediction_time=list_valid_times(facts),
        whiteness=describe_whiteness(facts),
        sharing=sharing,
        show=show,
        decay=describe_decays(d),
        evidence=check_evidence(d, np.random.default_rng([seed, EVIDENCE])),
        machine=_describe_machine(d, case),
        truth=case.truth,
        recordings=tuple(map(_describe_recording, prepared.recordings)),
        notes=write_notes(facts),
        provenance=_make_origin(prepared, facts, seed),
    )


def label_model(fit: Fit) -> str:
    """Return the name of a model, or its equations, followed by its terms."""
    model = fit.posterior.system.model
    name = f"({'; '.join(model.equations)})" if isinstance(model, Written) else model.name
    return " + ".join([name, *sorted(fit.posterior.active)])


def count_bodies(d: SearchResult) -> int:
    """Return the number of bodies of the model on which a force may act."""
    return len({place.bodies[0] for place in d.after.posterior.system.model.places})


def explains_scale(found: Sequence[Mechanism], left: float) -> bool:
    """Return whether laws of usual size, all of them named, explain the recording: then no scale of a column is wrong.

    `left` is the share of the missing force that they leave; a scale that is told leaves less than `LEFT` of it.
    """
    usual = all(e.state == NAMED and (e.share_of_drive or 0.0) < ABSURD for e in found)
    return left < LEFT and usual and bool(found)


def _expect(d: SearchResult, angle: str, rng: np.random.Generator) -> Expectation | None:
    """Return what the recordings can tell, from the nominal fit of the search; None where it cannot follow them."""
    forecast = forecast_recordings(d.explained.nominal, d.recordings, rng)
    return describe_expectation(forecast, d.yardstick, angle) if forecast.valid else None


def _describe_recording(r: Recording) -> RecordingFacts:
    return RecordingFacts(r.name, r.n, r.rate, r.start, tuple(a.attrs["of"] for a in r.inputs))


def _make_origin(prepared: Prepared, facts: Facts, seed: int) -> Origin:
    case = prepared.case
    settings = {"model": case.model, "known": dict(case.known), "terms": [f"{t.name}@{t.at}" for t in prepared.terms]}
    return origin_of("diagnose", {**settings, "thresholds": facts.settings.as_dict()}, seed, prepared.inputs)


def _describe_machine(d: SearchResult, case: CaseFile) -> FittedMachine:
    """Return what is needed to simulate the fitted model again: model, terms, and all values in SI units."""
    posterior = d.after.posterior
    system, full = posterior.system, posterior.recordings[0].full(d.after.theta)
    own = {q.name for q in system.model.params}
    values = {key: float(full[i]) for key, i in system.index.items()}
    terms = zip(system.keys, system.terms, strict=True)
    return FittedMachine(
        model=case.model,
        equations=case.equations,
        units=case.units,
        motion=system.model.motion,
        terms=tuple(TermFacts(key, term.name, term.at) for key, term in terms if key in posterior.active),
        learned=d.learned.keys if d.learned else (),
        sensors=tuple(SensorChannel(s.name, s.channel) for s in d.shown.sensors),
        values={k: v for k, v in values.items() if k in own or any(k.startswith(f"{a}.") for a in posterior.active)},
    )
