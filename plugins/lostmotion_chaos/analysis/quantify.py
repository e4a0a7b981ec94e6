"""One quantity of a recording or of a model; the estimate is checked against the contract of quantifiers."""

from __future__ import annotations

import math

import numpy as np

from lostmotion.arguments import checked, error, instance, random
from lostmotion.contracts import Data, Quantifier, Series
from lostmotion.errors import ContractError
from lostmotion.results import STATUSES, Estimate


@checked(
    quantifier=instance(Quantifier, "a quantifier, such as lm.registry.default().make('quantifier', NAME)"), rng=random
)
def quantify(data: Data, quantifier: Quantifier[Data], *, rng: np.random.Generator) -> Estimate:
    """Return the estimate of `quantifier` on a `Series`, or on the `Flow` of a model.

    A refusal is a status with a sentence. Raises `ContractError` when the quantifier breaks its contract.
    """
    if quantifier.reads == "series" and not isinstance(data, Series):
        raise error(data, "data", f"a Series, as lm.embed returns it, for {quantifier.name}")
    estimate = quantifier.estimate(data, rng=rng)
    if wrong := _explain_violation(estimate):
        raise ContractError(f"{quantifier.name} {wrong}: write to its author")
    return estimate


def _explain_violation(estimate: object) -> str:
    if not isinstance(estimate, Estimate):
        return f"returned {type(estimate).__name__}, and an Estimate was expected"
    if estimate.status not in STATUSES:
        return f"returned the status {estimate.status!r}, which is none of {', '.join(STATUSES)}"
    if estimate.status == "ok" and not math.isfinite(estimate.value):
        return f"returned the status 'ok' with the value {estimate.value}"
    if estimate.low > estimate.value or estimate.value > estimate.high:
        return f"returned {estimate.value:g} outside of its interval [{estimate.low:g}, {estimate.high:g}]"
    if estimate.status != "ok" and not estimate.says:
        return f"returned the status {estimate.status!r} without a sentence"
    return ""
