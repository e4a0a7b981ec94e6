"""From a case file to what the stages work on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from lostmotion.case import Case, load_case
from lostmotion.contracts import Model, Term
from lostmotion.errors import CaseError
from lostmotion.likelihood.observation import Observation, observation_of
from lostmotion.recording import Recording, load_recording
from lostmotion.registry import Registry
from lostmotion.stages.diagnose import candidates_of
from lostmotion.workflow.vetting import sound, usable_terms


@dataclass(frozen=True)
class Prepared:
    """A case with its recordings, its model, and every term that could act in that model.

    `origins` are the digests or versions of what other people brought, `aside` sentences on what of it cannot be used.
    """

    case: Case
    recordings: tuple[Recording, ...]
    observations: tuple[Observation, ...]
    model: Model
    terms: tuple[Term, ...]
    origins: Mapping[str, str] = field(default_factory=dict)
    aside: tuple[str, ...] = ()

    @property
    def inputs(self) -> dict[str, str]:
        """The digests of what went in, by file name."""
        return {**self.origins, "case": self.case.digest, **{r.name: r.digest for r in self.recordings}}

    @property
    def notes(self) -> tuple[str, ...]:
        """What the recordings have to say of themselves, and what of the plugins cannot be used."""
        several = len(self.recordings) > 1
        of_recordings = (f"{r.name}: {n}" if several else n for r in self.recordings for n in r.notes)
        return (*of_recordings, *self.aside)


def case_of(path: Path, registry: Registry) -> Case:
    """Return the case at `path`; the plugin files it names join the registry."""
    case = load_case(path)
    for plugin in case.plugins:
        registry.add_file(case.folder / plugin)
    return case


def prepare(path: Path, registry: Registry) -> Prepared:
    """Return the case at `path`, ready for the stages; whatever cannot be meant is refused here."""
    return prepared_of(case_of(path, registry), registry)


def prepared_of(case: Case, registry: Registry) -> Prepared:
    """Return a case with its recordings, its model and its terms."""
    if not case.recordings:
        raise CaseError("the case has no [[recordings]]: add one, with file, time or rate, excitation and response")
    model: Model = sound(registry, "model", case.model)
    recordings = tuple(load_recording(spec, case.folder) for spec in case.recordings)
    observations = tuple(observation_of(r, model, held=r.hold == "step") for r in recordings)
    _alike(recordings)
    known, aside = usable_terms(registry)
    return Prepared(
        case, recordings, observations, model, candidates_of(model, known, observations), registry.origins(), aside
    )


def _alike(recordings: Sequence[Recording]) -> None:
    """Refuse recordings of different quantities."""
    kinds = {str(r.data["response"].attrs["quantity"]) for r in recordings}
    if len(kinds) > 1:
        raise CaseError(
            f"the recordings show {' and '.join(sorted(kinds))}: put recordings of one quantity into a case"
        )
