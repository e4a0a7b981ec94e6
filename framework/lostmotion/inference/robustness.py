"""Checks of sets of terms against autocorrelated residuals, with which any term that resembles them gains evidence."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from lostmotion.inference.fit import Fit
from lostmotion.inference.random_force import reduces_noise, reduces_random_force
from lostmotion.inference.significance import Significance, measure_significance
from lostmotion.inference.term_sets import TermSet
from lostmotion.settings import SelectSettings


@dataclass
class RobustChecks:
    """Checks of sets of terms against autocorrelated residuals; the significance of each fit is computed once."""

    limits: SelectSettings
    known: dict[frozenset[str], tuple[Fit, Significance]] = field(default_factory=dict)

    def list_vague(self, term_set: TermSet) -> list[str]:
        """Return the terms of a set whose amplitudes are not significant, most vague first."""
        return self._measure(term_set).list_vague(self.limits)

    def is_robust(self, term_set: TermSet, over: TermSet, keys: Iterable[str] | None = None) -> bool:
        """Return whether all terms of a set, or the terms `keys`, are robust against autocorrelated residuals.

        Each amplitude must be significant by its robust standard deviation. If this exceeds the usual one by a factor,
        the random force must also be lower by a share than that of the other set, or the noise of a sensor if no set
        has a random force.
        """
        found = self._measure(term_set)
        calm = found.ratio < self.limits.memory or any(
            reduces(term_set.fit, over.fit, self.limits.share) for reduces in (reduces_random_force, reduces_noise)
        )
        return calm and not set(found.list_vague(self.limits)).intersection(keys or term_set.terms)

    def _measure(self, term_set: TermSet) -> Significance:
        known = self.known.get(term_set.terms)
        if known is None or known[0] is not term_set.fit:
            known = self.known[term_set.terms] = (term_set.fit, measure_significance(term_set.fit))
        return known[1]
