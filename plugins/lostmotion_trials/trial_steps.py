"""The steps of a blind trial: each is a campaign in processes or on a cluster, and an interrupted one is continued."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from lostmotion.campaigns.campaign import Campaign, Trial
from lostmotion.storage import folder_for

T = TypeVar("T")
Say = Callable[[str, int, int], None]
"""Called with the current step, how many of its trials are done, and how many there are."""
Origin = Callable[[str, Mapping[str, object]], Mapping[str, object]]
"""Returns the provenance of a command with its settings."""


def be_silent(_step: str, _done: int, _of: int) -> None:
    """Tell nobody how far a step is."""


@dataclass(frozen=True)
class TrialSteps:
    """The steps of a trial of so many `cases` in the folder `out`; with `fresh` ones nothing is continued.

    They run in `jobs` processes, or on the dask cluster at the address `cluster` if it is given.
    """

    out: Path
    cases: int
    jobs: int
    origin: Origin
    say: Say = be_silent
    fresh: bool = False
    cluster: str = ""

    def run(
        self, step: str, trial: Trial[T], kind: type[T], settings: Mapping[str, object], *, here: bool = False
    ) -> list[T]:
        """Return the result of a step for each case, of the class `kind`; `here` keeps it on this machine."""
        campaign = Campaign(trial, kind, self.cases, self.origin(f"prove {step}", settings), apart=True)
        folder, say = self.out / "steps" / step, partial(self.say, step)
        return campaign.run(folder, self.jobs, say, fresh=self.fresh, cluster="" if here else self.cluster)


def open_trial(out: Path, *, fresh: bool) -> Path:
    """Return the folder of a trial, which is made; with `fresh` the seal of an earlier one is removed."""
    out = folder_for(out).absolute()
    if fresh:
        (out / "seal.json").unlink(missing_ok=True)
    return out
