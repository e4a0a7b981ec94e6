"""What a diagnosis has established, in plain values: everything that its words are made of, gathered once.

A rule of the words is a `Remark` on these facts, or a `Doubt` about a term that was found. Each names the facts that it
requires: where one of them is absent, empty or false, the rule is silent.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from lostmotion.contracts import Term
from lostmotion.diagnosis.compare import Prediction
from lostmotion.inference.unseen import BodyPosition
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.predict import Horizon
from lostmotion.results import Interval
from lostmotion.results.diagnosis import DriveFacts, Mechanism
from lostmotion.results.mismatch import UnexplainedForce
from lostmotion.settings import Settings


@dataclass(frozen=True, kw_only=True)
class CandidateTerm:
    """A term of the library with its gains in log evidence over the nominal model.

    `gain` is that beside a discrepancy, `alone` that of a fit without one, None without such a fit. `price` is its
    prior penalty; `fitted` states whether it was fitted alone.
    """

    key: str
    term: Term
    gain: float
    price: float
    fitted: bool
    alone: float | None = None


@dataclass(frozen=True)
class AmplitudeChange:
    """An amplitude of another term, `alone` and `beside` a found term, with its standard deviation alone."""

    term: str
    name: str
    unit: str
    alone: float
    beside: float
    sd: float


@dataclass(frozen=True, kw_only=True)
class Support:
    """The evidence for a found term: the score `gain` that it adds to the other terms, and what may cast doubt on it.

    `vague` names amplitudes whose interval reaches zero, `moved` has the amplitudes of other terms with it and without
    it. `delay` is its delay in samples, `complete` the share of the recording after which a change is complete.
    """

    gain: float
    vague: tuple[str, ...] = ()
    moved: tuple[AmplitudeChange, ...] = ()
    delay: float | None = None
    complete: tuple[float, ...] = ()


@dataclass(frozen=True, kw_only=True)
class FoundTerm:
    """A term of the library that was found, with its parameters and numbers derived from them, by name.

    `share` is its largest force as a share of the drive. `place` and `sensor` are told only where there are several.
    `unlocated` names the parameters that depend on a zero of the position that nothing shows, None where it is known.
    """

    key: str
    term: Term
    parameters: Mapping[str, Interval]
    share: float
    support: Support
    since: Interval | None = None
    place: str = ""
    sensor: str = ""
    unlocated: tuple[str, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class SensorNoise:
    """A sensor, the standard deviation of its noise, and that of the `slow` part of it after half of a recording.

    `scale` is the standard deviation of its held-out readings; `kind` names the noise, `words` are sentences on it.
    """

    name: str
    channel: str
    unit: str
    sd: float
    slow: float
    scale: float
    kind: str = "white"
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class PriorBound:
    """A parameter at a bound of its prior."""

    name: str
    bound: float
    unit: str


@dataclass(frozen=True, kw_only=True)
class Facts:
    """All that the words of a diagnosis are made of; sentences state angles in the unit `angle`, rad or deg.

    `level` is the amplitude of the first input, in `input_unit`. `sets` has the posterior probability of each set of
    terms by their keys. `unnamed` is the entry of a force without a name, `quantised` those of quantisation.
    `augmented` states whether anything was added to the nominal model, `structured` whether the force that is left has
    a structure, `remains` the share of the missing force that is left. `unknown` is the probability of a force that the
    library lacks, with its log evidence `unknown_gain`; `smooth_fitted` states whether one was fitted. `explanations`
    is the number of fitted sets, `skipped` names those that were not extended. `withdrawn` are the keys of terms that
    held-out data refuted, `corrected` clauses on corrected errors, `contacts` notes on short contacts. `position` is
    the smoothed position where no sensor shows it. `recordings` are whole, `fitted` and `held` their parts. `said` are
    the notes on the case and its recordings.
    """

    settings: Settings
    motion: str
    drive: DriveFacts
    input_unit: str
    level: float
    sensors: tuple[SensorNoise, ...]
    before: Prediction
    after: Prediction
    horizon: Horizon
    force_before: UnexplainedForce
    force_after: UnexplainedForce
    sets: Mapping[frozenset[str], float]
    candidates: tuple[CandidateTerm, ...] = ()
    found: tuple[FoundTerm, ...] = ()
    quantised: tuple[Mechanism, ...] = ()
    unnamed: Mechanism | None = None
    parameters_before: Mapping[str, Interval] = field(default_factory=dict)
    parameters_after: Mapping[str, Interval] = field(default_factory=dict)
    augmented: bool = False
    learned: bool = False
    unexplained: bool = False
    structured: bool = False
    on_other_body: bool = False
    remains: float = 0.0
    smooth_fitted: bool = False
    unknown: float = 0.0
    unknown_gain: float = 0.0
    explanations: int = 1
    skipped: tuple[str, ...] = ()
    withdrawn: tuple[str, ...] = ()
    corrected: tuple[str, ...] = ()
    contacts: tuple[str, ...] = ()
    bounds: tuple[PriorBound, ...] = ()
    position: BodyPosition | None = None
    recordings: tuple[Observation, ...] = ()
    fitted: tuple[Observation, ...] = ()
    held: tuple[Observation, ...] = ()
    said: tuple[str, ...] = ()
    angle: str = "rad"

    @cached_property
    def noise_floor(self) -> float:
        """The share of the held-out readings that is noise, as the mean over the sensors."""
        return float(np.mean([one.sd / one.scale for one in self.sensors]))

    def inclusion(self, key: str) -> float:
        """Return the posterior probability of a term by its key, or of an `UNKNOWN` smooth force."""
        return min(sum(p for terms, p in self.sets.items() if key in terms), 1.0)

    def find(self, key: str) -> CandidateTerm:
        """Return a term of the library by its key."""
        return next(one for one in self.candidates if one.key == key)


@dataclass(frozen=True)
class Remark:
    """A rule of the words: sentences on facts, where all facts that it `requires` are present."""

    requires: tuple[str, ...]
    says: Callable[[Facts], Iterable[str]]

    def write(self, facts: Facts) -> tuple[str, ...]:
        """Return the sentences on these facts."""
        return tuple(self.says(facts)) if _has_all(facts, self.requires) else ()


@dataclass(frozen=True)
class Doubt:
    """A rule of the words: reasons for doubt about a found term, where the support that it `requires` is present."""

    requires: tuple[str, ...]
    says: Callable[[Facts, FoundTerm], Iterable[str]]

    def write(self, facts: Facts, found: FoundTerm) -> tuple[str, ...]:
        """Return the reasons for doubt about this term."""
        return tuple(self.says(facts, found)) if _has_all(found.support, self.requires) else ()


def _has_all(facts: object, names: Iterable[str]) -> bool:
    """Return whether all facts of these names are present: neither None, nor false, nor empty."""
    values = [getattr(facts, name) for name in names]
    return not any(value is None or value is False or value == () for value in values)


def remark(*requires: str) -> Callable[[Callable[[Facts], Iterable[str]]], Remark]:
    """Return a decorator that makes a `Remark` of a function of facts, with the names of facts that it requires."""
    return lambda says: Remark(requires, says)


def doubt(*requires: str) -> Callable[[Callable[[Facts, FoundTerm], Iterable[str]]], Doubt]:
    """Return a decorator that makes a `Doubt` of a function, with the names of the support that it requires."""
    return lambda says: Doubt(requires, says)


def write_remarks(remarks: Sequence[Remark], facts: Facts) -> tuple[str, ...]:
    """Return the sentences of remarks on facts, in their order."""
    return tuple(said for one in remarks for said in one.write(facts))


def write_doubts(doubts: Sequence[Doubt], facts: Facts, found: FoundTerm) -> tuple[str, ...]:
    """Return the reasons for doubt about a found term, in their order."""
    return tuple(said for one in doubts for said in one.write(facts, found))
