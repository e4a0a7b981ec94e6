"""The conformance kit: whether a component keeps the contract of its kind, and what to do where it does not.

from lostmotion import testing

@testing.parametrize([MyModel, MyTerm])
def test_conforms(component, rule):
    testing.assert_conforms(component, rule)
"""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from lostmotion.contracts import KINDS
from lostmotion.errors import ContractError
from lostmotion.testing import methods, models, shared, terms
from lostmotion.testing.rules import Finding, Rule, raised, rules_for

if TYPE_CHECKING:
    import pytest

__all__ = ["Finding", "Rule", "assert_conforms", "check", "kind_of", "parametrize", "rules_for"]
_KITS = (shared, models, terms, methods)
"""The modules that write rules; a rule joins the kit when its module is imported."""
_BUILDING = "is_built_without_arguments"
_HOW = "Give every field a default, and write every method of the contract; or hand in an instance."


def check(component: Any) -> list[Finding]:
    """Return a finding for each rule of the component's kind; a class is built without arguments first.

    While a rule of declaration is broken, the rules of behaviour are not tried.
    """
    kind = kind_of(component)
    built = _built(component)
    if isinstance(built, Finding):
        return [built]
    rules = rules_for(kind)
    findings = [rule(built) for rule in rules if rule.declaration]
    if all(f.ok for f in findings):
        findings += [rule(built) for rule in rules if not rule.declaration]
    return findings


def assert_conforms(component: Any, rule: Rule | None = None) -> None:
    """Return nothing; raise `AssertionError` with a sentence for each rule, or for the one given, that is broken."""
    if rule is None:
        findings = check(component)
    else:
        built = _built(component)
        findings = [built if isinstance(built, Finding) else rule(built)]
    broken = [str(f) for f in findings if not f.ok]
    if broken:
        raise AssertionError("\n".join(broken))


def parametrize(components: Iterable[Any], *, known_failures: Mapping[str, str] | None = None) -> pytest.MarkDecorator:
    """Return a mark that runs a test over (component, rule), with ids such as `my_drag-force_is_zero_at_null`.

    `known_failures` gives the reason for each id that is expected to fail; one that passes after all is an error.
    """
    import pytest

    reasons, cases = dict(known_failures or {}), []
    for component in components:
        for rule in rules_for(kind_of(component)):
            label = f"{_label(component)}-{rule.name}"
            reason = reasons.pop(label, None)
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
