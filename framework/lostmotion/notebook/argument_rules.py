"""The rules of arguments that several functions of the Python interface have."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from lostmotion.arguments import Rule, describe, flag, instance, mapping, maybe, number, path, positive, whole, words
from lostmotion.case import Prior
from lostmotion.contracts import Machine
from lostmotion.errors import CaseError
from lostmotion.registry import Registry
from lostmotion.robots.arm_model import RobotModel


def modelled(value: Any, name: str) -> Any:
    """Return a model, its class, its name or equations, or that of a robot; raise `CaseError` for anything else."""
    if isinstance(value, (Machine, RobotModel)) or (isinstance(value, type) and issubclass(value, Machine)):
        return value
    if isinstance(value, type) or not isinstance(value, (str, Sequence)) or not value:
        raise CaseError(f"{name} is {describe(value)}: expected a model, its name, or equations as text")
    return words(value, name)


KNOWN = mapping(number, "{'m': 1.0}")
"""Values by parameter."""
PRIORS = mapping(instance(Prior, "lm.LogUniform(1, 100) or the like"), "{'c': lm.LogUniform(1, 100)}")
"""Priors by parameter."""
RUN: Mapping[str, Rule] = {
    "seed": whole(0),
    "jobs": whole(0),
    "progress": flag,
    "out": maybe(path),
    "terms": words,
    "registry": maybe(instance(Registry, "a Registry, such as lm.registry.default()")),
}
"""The arguments that most functions have."""
CASE: Mapping[str, Rule] = {**RUN, "model": maybe(modelled), "known": maybe(KNOWN), "estimate": maybe(PRIORS)}
"""Those of functions of a case."""
TRIED: Mapping[str, Rule] = {
    "values": maybe(KNOWN),
    "terms": words,
    "begin": maybe(number),
    "every": maybe(positive),
    "registry": RUN["registry"],
}
"""Those of predictions with values that are tried."""
