"""A law that equals the sum of two more common laws is replaced by these, where its values make that more probable."""

from __future__ import annotations

from collections.abc import Collection

from lostmotion.inference.candidates import join_term
from lostmotion.inference.fit import Fit, restart
from lostmotion.inference.late import find_onset
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import key_of, onset_key


def rewrite_term(fit: Fit, key: str, candidates: Collection[str]) -> Posterior | None:
    """Return the posterior with more common terms in place of one, at the same force; None where it is no sum.

    A common term that another law of the fit contains is not added once more.
    """
    term, slots = find_term(fit.posterior, key)
    values = fit.values
    if not all(slot.key in values for slot in slots):
        return None
    commoner = term.commoner({slot.param.name: values[slot.key] for slot in slots})
    rest = [find_term(fit.posterior, other)[0] for other in fit.posterior.active - {key}]
    names = commoner.keys() - {name for law in rest if law.at == term.at for name in law.extends}
    keys = {t.name: key_of(t) for t in fit.posterior.system.terms if t.at == term.at and t.name in names}
    if not names or len(keys) < len(names) or not set(keys.values()) <= set(candidates) - fit.posterior.active:
        return None
    since, posterior = find_onset(fit.posterior, key), restart(fit).remove_term(key, values)
    for name, law in keys.items():
        start = {f"{law}.{param}": value for param, value in commoner[name].items()}
        posterior = join_term(posterior, law, {**start, onset_key(law): since})
    return posterior
