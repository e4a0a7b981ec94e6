"""The conformance kit: whether a component keeps the contract of its kind, and what to do where it does not.

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
from lostmotion.testing import engines, methods, models, shared, terms
from lostmotion.testing.rules import Finding, Rule, known_of, raised, rules_for

if TYPE_CHECKING:
    import pytest

__all__ = ["Finding", "Rule", "assert_conforms", "check", "kind_of", "parametrize", "rules_for"]
_KITS = (shared, models, terms, methods, engines)
"""The modules that write rules; a rule joins the kit when its module is imported."""
_BUILDING = "is_built_without_arguments"
_STALE, _HIDES = "it is kept, and `known_failures` has it", "Take it out: it would hide the next failure."
_HOW = "Give every field a default, and write every method of the contract; or hand in an instance."


def check(component: Any) -> list[Finding]:
    """Return a finding for each rule of the component's kind; a class is built without arguments first.

    While a rule of declaration is broken on which behaviour depends, the rules of behaviour are not tried.
    """
    kind = kind_of(component)
    built = _built(component)
    if isinstance(built, Finding):
        return [built]
    rules = rules_for(kind)
    findings = [rule(built) for rule in rules if rule.declaration]
    if not any(f.fatal for f in findings):
        findings += [rule(built) for rule in rules if not rule.declaration]
    return [_unless_stale(f) if f.rule in known_of(built) else f for f in findings]


def _unless_stale(finding: Finding) -> Finding:
    """Return a finding on a rule that is known to be broken; where it is kept after all, that is what is wrong."""
    return replace(finding, ok=False, found=_STALE, advice=_HIDES, courtesy=True) if finding.ok else finding


def assert_conforms(component: Any, rule: Rule | None = None) -> None:
    """Return nothing; raise `AssertionError` with a sentence for each rule, or for the one given, that is broken.

    Without a rule, those that the component names in its `known_failures` are let pass.
    """
    if rule is None:
        findings = [f for f in check(component) if not f.known]
    else:
        built = _built(component)
        findings = [built if isinstance(built, Finding) else rule(built)]
    broken = [str(f) for f in findings if not f.ok]
    if broken:
        raise AssertionError("\n".join(broken))


def parametrize(components: Iterable[Any], *, known_failures: Mapping[str, str] | None = None) -> pytest.MarkDecorator:
    """Return a mark that runs a test over (component, rule), with ids such as `my_drag-force_is_zero_at_null`.

    `known_failures` gives the reason for each id that is expected to fail, beside what a component names itself; one
    that passes after all is an error.
    """
    import pytest

    reasons, cases = dict(known_failures or {}), []
    for component in components:
        for rule in rules_for(kind_of(component)):
            label = f"{_label(component)}-{rule.name}"
            reason = reasons.pop(label, None) or known_of(component).get(rule.name)
            marks = [pytest.mark.xfail(reason=reason, strict=True)] if reason else []
            cases.append(pytest.param(component, rule, id=label, marks=marks))
    if reasons:
        raise ContractError(f"known failure {next(iter(reasons))!r} is no test: write component-rule")
    return pytest.mark.parametrize(("component", "rule"), cases)


def kind_of(component: Any) -> str:
    """Return the kind of a class or an instance, or raise `ContractError`."""
    cls = component if isinstance(component, type) else type(component)
    for kind, base in KINDS.items():
        if issubclass(cls, base):
            return kind
    raise ContractError(f"{cls.__name__} is no plugin: subclass one of {', '.join(b.__name__ for b in KINDS.values())}")


def _label(component: Any) -> str:
    cls = component if isinstance(component, type) else type(component)
    return str(getattr(component, "name", cls.__name__))


def _built(component: Any) -> Any:
    """Return an instance, or the finding that none can be had."""
    if not isinstance(component, type):
        return component
    if inspect.isabstract(component):
        found = f"{component.__name__} lacks {', '.join(sorted(getattr(component, '__abstractmethods__', ())))}"
        return Finding(_label(component), _BUILDING, False, found, _HOW)
    try:
        return component()
    except Exception as err:
        return Finding(_label(component), _BUILDING, False, raised(err), _HOW)
