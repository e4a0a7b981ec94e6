"""A complete diagnosis: it reads a case and writes `diagnosis.json`, `arrays.nc` and `report.html`."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from lostmotion.diagnosis.compare import (
    average_exponent,
    choose_heldout_horizon,
    compute_rates,
    cut_heldout,
    is_worse,
    predict,
)
from lostmotion.diagnosis.compared_motions import list_motions
from lostmotion.diagnosis.gather_facts import gather_facts
from lostmotion.diagnosis.guest_sections import find_sections
from lostmotion.diagnosis.mixed import draw_mixture
from lostmotion.diagnosis.moving import note_rest
from lostmotion.diagnosis.nested_laws import find_simpler_set
from lostmotion.diagnosis.outcome import Outcome, draw_parameters
from lostmotion.diagnosis.report.diagnosis_page import save_diagnosis
from lostmotion.diagnosis.report.page_data import Evidence, make_evidence
from lostmotion.diagnosis.rivals import propose_experiments
from lostmotion.diagnosis.show import measure_behaviour
from lostmotion.diagnosis.stages import SearchResult, diagnose, explain_by
from lostmotion.diagnosis.stored_arrays import list_arrays
from lostmotion.diagnosis.write_result import make_result
from lostmotion.errors import ContractError
from lostmotion.evidence.bare import name_terms
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.inference.profile import measure_stretches
from lostmotion.kernels.threads import each, hold_linear_algebra
from lostmotion.likelihood.stepped import make_system
from lostmotion.likelihood.system import key_of
from lostmotion.preparation.prepare import Prepared, prepare
from lostmotion.preparation.vetting import (
    catch_divergence,
    find_raising_terms,
    name_suspects,
    note_set_aside,
    third_party_keys,
)
from lostmotion.registry import Registry
from lostmotion.results.diagnosis import Diagnosis
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import dataset_of, folder_for

Say = Callable[[str], None]
MOST_REFUTED = 4
"""The largest number of sets that free runs over held-out data may refute."""
SHOW, NEXT, DRAWN = 1, 2, 5
"""Streams of random numbers for attractors, experiments and the draws of intervals; no finding depends on them."""


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
    evidence, _ = diagnose_prepared(
        prepared, registry, seed=seed, jobs=jobs, propose=propose, say=say, settings=settings
    )
    say("report")
    save_diagnosis(evidence, folder, find_sections(registry))
    return evidence.result


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
) -> tuple[Evidence, Outcome]:
    """Return the diagnosis of a case with its arrays, and the fits and predictions behind both; nothing is written."""
    work = partial(diagnose, jobs=jobs, say=say, settings=settings)
    diagnosis, prepared, rng = _run_search(prepared, registry, seed, work)
    say("held-out predictions")
    outcome = check_heldout(diagnosis, rng, say)
    outcome = draw_posteriors(outcome, np.random.default_rng([seed, DRAWN]))
    outcome = name_simplest(outcome, np.random.default_rng([seed, DRAWN]), say)
    diagnosis = outcome.diagnosis
    motions = list_motions(diagnosis)
    say("attractors")
    show = measure_behaviour(outcome, motions, registry, np.random.default_rng([seed, SHOW]))
    facts = gather_facts(outcome, prepared.case, _list_remarks(prepared, diagnosis))
    allowed, stream = prepared.case.experiment if propose else None, np.random.default_rng([seed, NEXT])
    proposals = propose_experiments(facts, diagnosis.explained.fits, allowed, rng=stream, say=say)
    say("evidence by sampling")
    result = make_result(prepared, diagnosis, facts, proposals=proposals, show=show, seed=seed)
    variables, coords = list_arrays(outcome, motions)
    return make_evidence(result, dataset_of(variables, coords, {"title": prepared.case.title})), outcome


def _run_search(
    prepared: Prepared, registry: Registry, seed: int, work: Callable[..., SearchResult]
) -> tuple[SearchResult, Prepared, np.random.Generator]:
    """Return the diagnosis, the prepared case that was used, and the random generator.

    If a third-party term fails, the search is repeated without it.
    """
    system, rng = make_system(prepared.model, prepared.terms), np.random.default_rng(seed)
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
    jobs = diagnosis.before.posterior.jobs
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


def name_simplest(outcome: Outcome, rng: np.random.Generator, say: Say = lambda _: None) -> Outcome:
    """Return the outcome with the simplest of nested laws that the data do not tell apart."""
    found = outcome.diagnosis
    if UNKNOWN in found.explained.best.terms or (simpler := find_simpler_set(outcome)) is None:
        return outcome
    say(f"with the simpler law: {name_terms(simpler)}")
    less = explain_by(found.explained.simplify(simpler), found, rng.spawn(1)[0], say)
    return draw_posteriors(compare_heldout(replace(less, withdrawn=found.withdrawn)), rng)


def _list_remarks(prepared: Prepared, d: SearchResult) -> list[str]:
    """Return the notes on the recordings and on the case."""
    rest = note_rest(prepared.observations, d.recordings)
    return [*prepared.notes, *rest, *note_unused(prepared.case.known)]


def note_unused(known: Iterable[str]) -> list[str]:
    """Return a note on known values of terms in a case, which a diagnosis does not use."""
    terms = [name for name in known if "." in name]
    if not terms:
        return []
    return [
        f"{', '.join(terms)} in [model.known] is not used: a diagnosis starts with the model alone and estimates the"
        " parameters of each term; `identify --term` accepts terms with known values."
    ]
