"""Long recordings: terms are searched on stretches of them, then tested and fitted on all samples."""

from __future__ import annotations

from collections.abc import Iterable

from lostmotion.inference.candidates import Shapes
from lostmotion.inference.fit import Fit, maximise
from lostmotion.inference.memory import select_with_noise_memory
from lostmotion.inference.selection import Progress, Promise, Selector
from lostmotion.inference.term_sets import Selection
from lostmotion.inference.unseen import refit_start
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.problem import Problem

LONG = 32_000
"""From this many samples on, of all recordings together, a search uses stretches of them first."""
STRETCHES, SOUGHT = 4, 16_000
"""The number of stretches of each recording, evenly spread over it, and the samples of all stretches together."""


def search_stretches(
    nominal: Fit, candidates: Iterable[str], say: Progress, shapes: Shapes | None = None, promise: Promise | None = None
) -> Selection:
    """Return the selection among `candidates`, on stretches first where the recordings are long.

    Then every term that was found has to hold on all samples, and every other one is tested there once more: a small
    effect may be visible in the whole alone.
    """
    keys, short = tuple(candidates), cut_stretches(nominal.problem)
    if short is nominal.problem:
        return select_with_noise_memory(nominal, keys, say, shapes, promise)
    say(f"search on {short.samples} samples in {len(short.observations)} stretches")
    course = select_with_noise_memory(refit_start(maximise(short, nominal.theta)), keys, say, shapes, promise)
    say("fit of the terms that were found, on all samples")
    whole = nominal.problem.observations
    fits = (course.nominal, course.chosen, *course.list_close_fits())
    bare, chosen, *rivals = (maximise(f.problem.on(whole), f.theta) for f in fits)
    if "diverged" in (bare.status, chosen.status):
        return select_with_noise_memory(nominal, keys, say, shapes, promise)
    return Selector(bare, keys, say, shapes, promise).verify(chosen, [f for f in rivals if f.status != "diverged"])


def cut_stretches(problem: Problem) -> Problem:
    """Return the problem on stretches of its recordings, or unchanged where they are not long."""
    if problem.samples <= LONG:
        return problem
    parts = [part for o in problem.observations for part in list_stretches(o, SOUGHT / problem.samples)]
    return problem.on(tuple(parts))


def list_stretches(observation: Observation, share: float) -> list[Observation]:
    """Return stretches of a recording, the first and the last at its ends, which make up a share of it."""
    long = max(round(share * observation.samples / STRETCHES), 1)
    gap = (observation.samples - long) / (STRETCHES - 1)
    return [observation.part(round(i * gap), round(i * gap) + long) for i in range(STRETCHES)]
