"""The conformance kit: checks whether a component fulfils the contract of its kind, with advice where it does not.

from lostmotion import testing

@testing.parametrize([MyModel, MyTerm])
def test_conforms(component, rule):
    testing.assert_conforms(component, rule)
"""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from lostmotion.contracts import KINDS
from lostmotion.errors import ContractError
from lostmotion.testing import (
    dynamics_rules,
    method_rules,
    model_rules,
    noise_rules,
    shared_rules,
    simulator_rules,
    term_rules,
)
from lostmotion.testing.rules import Finding, Rule, format_error, known_of, rules_for

if TYPE_CHECKING:
    import pytest

__all__ = ["Finding", "Rule", "assert_conforms", "check", "kind_of", "parametrize", "rules_for"]
_KITS = (shared_rules, model_rules, dynamics_rules, term_rules, method_rules, noise_rules, simulator_rules)
"""The modules that define rules; a rule is registered when its module is imported."""
_BUILDING = "is_built_without_arguments"
_STALE, _HIDES = "it is fulfilled, and `known_failures` lists it", "Remove it there: it would hide the next failure."
_HOW = "Give every field a default, and write every method of the contract; or pass an instance."


def check(component: Any) -> list[Finding]:
    """Return a finding for each rule of the kind of a component; a class is first built without arguments.

    Rules of behaviour are checked only when all rules of declaration that they depend on are fulfilled.
    """
    kind = kind_of(component)
    built = _build(component)
    if isinstance(built, Finding):
        return [built]
    rules = rules_for(kind)
    findings = [rule(built) for rule in rules if rule.declaration]
    if not any(f.fatal for f in findings):
        findings += [rule(built) for rule in rules if not rule.declaration]
    return [_check_stale(f) if f.rule in known_of(built) else f for f in findings]


def _check_stale(finding: Finding) -> Finding:
    """Return a finding on a rule in `known_failures`, as a failure if the rule is fulfilled after all."""
    return replace(finding, ok=False, found=_STALE, advice=_HIDES, courtesy=True) if finding.ok else finding


def assert_conforms(component: Any, rule: Rule | None = None) -> None:
    """Raise `AssertionError` with a sentence for each broken rule, of all rules or only the given one.

    Without a rule, failures that the component lists in its `known_failures` are accepted.
    """
    if rule is None:
        findings = [f for f in check(component) if not f.known]
    else:
        built = _build(component)
        findings = [built if isinstance(built, Finding) else rule(built)]
    broken = [str(f) for f in findings if not f.ok]
    if broken:
        raise AssertionError("\n".join(broken))


def parametrize(components: Iterable[Any], *, known_failures: Mapping[str, str] | None = None) -> pytest.MarkDecorator:
    """Return a pytest mark that runs a test over (component, rule), with ids such as `my_drag-force_is_zero_at_null`.

    `known_failures` gives the reason for each id that is expected to fail, besides those that a component lists itself.
    An expected failure that passes is an error.
    """
    import pytest

    reasons, cases = dict(known_failures or {}), []
    for component in components:
        for rule in rules_for(kind_of(component)):
            label = f"{_label_of(component)}-{rule.name}"
            reason = reasons.pop(label, None) or known_of(component).get(rule.name)
            marks = [pytest.mark.xfail(reason=reason, strict=True)] if reason else []
            cases.append(pytest.param(component, rule, id=label, marks=marks))
    if reasons:
        raise ContractError(f"known failure {next(iter(reasons))!r} is no test: write it as component-rule")
    return pytest.mark.parametrize(("component", "rule"), cases)


def kind_of(component: Any) -> str:
    """Return the kind of a class or an instance; raise `ContractError` if it has none."""
    cls = component if isinstance(component, type) else type(component)
    for kind, base in KINDS.items():
        if issubclass(cls, base):
            return kind
    raise ContractError(f"{cls.__name__} is no plugin: subclass one of {', '.join(b.__name__ for b in KINDS.values())}")


def _label_of(component: Any) -> str:
    cls = component if isinstance(component, type) else type(component)
    return str(getattr(component, "name", cls.__name__))


def _build(component: Any) -> Any:
    """Return an instance, or the finding that none can be built."""
    if not isinstance(component, type):
        return component
    if inspect.isabstract(component):
        found = f"{component.__name__} lacks {', '.join(sorted(getattr(component, '__abstractmethods__', ())))}"
        return Finding(_label_of(component), _BUILDING, False, found, _HOW)
    try:
        return component()
    except Exception as err:
        return Finding(_label_of(component), _BUILDING, False, format_error(err), _HOW)
