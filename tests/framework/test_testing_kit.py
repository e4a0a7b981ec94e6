"""How the kit tells what it found, and what it makes of classes that are not finished."""

import inspect
from dataclasses import dataclass, replace

import pytest
from test_testing import DRAG, Drag, broken_rules, pushes_always, spoiled

from lostmotion import testing
from lostmotion.contracts import Denoiser, Term
from lostmotion.errors import ContractError
from lostmotion.quantities import NUMBER


def test_declaration_comes_before_behaviour():
    findings = testing.check(spoiled(Drag, {"needs": ("a b",)}))
    behaviour = {rule.name for rule in testing.rules_for("term") if not rule.declaration}
    assert behaviour.isdisjoint(f.rule for f in findings)


def test_a_broken_rule_is_told_with_advice():
    with pytest.raises(
        AssertionError, match=r"drag, force_is_zero_at_null: the force is .* Return a force of exactly 0"
    ):
        testing.assert_conforms(spoiled(Drag, {"force": staticmethod(pushes_always)}))


def test_an_unfinished_class_is_a_finding():
    unfinished = type("Unfinished", (Term,), {"name": "unfinished"})
    (finding,) = testing.check(unfinished)
    assert not finding.ok
    assert "lacks force" in finding.sentence
    with pytest.raises(AssertionError, match="lacks force"):
        testing.assert_conforms(unfinished, testing.rules_for("term")[0])


def test_a_class_that_needs_arguments_is_a_finding():
    @dataclass(frozen=True)
    class Sized(Drag):
        size: float = 0.0

        def __post_init__(self):
            raise ValueError("size must be given")

    (finding,) = testing.check(Sized)
    assert "size must be given" in finding.sentence


def test_something_else_is_refused():
    with pytest.raises(ContractError, match="no plugin: subclass one of Model, Dynamics, Term"):
        testing.check(3)


def test_kinds_without_rules_of_their_own_keep_the_general_ones():
    class Silent(Denoiser):
        def clean(self, x, *, embedding, rng):
            return x

    broken = broken_rules(Silent)
    assert {"is_frozen_dataclass", "paper_is_cited", "attributes_are_complete"} <= broken


def test_parametrize_gives_readable_ids_and_marks_known_failures():
    mark = testing.parametrize([Drag], known_failures={"drag-has_a_null": "a reason"}).mark
    cases = {case.id: case for case in mark.args[1]}
    assert "drag-force_is_zero_at_null" in cases
    assert cases["drag-has_a_null"].marks[0].kwargs == {"reason": "a reason", "strict": True}
    with pytest.raises(ContractError, match="known failure 'drag-nothing'"):
        testing.parametrize([Drag], known_failures={"drag-nothing": "a reason"})


def test_a_parameter_of_no_dimension_is_a_number():
    assert broken_rules(spoiled(Drag, {"params": (replace(DRAG, dimension=NUMBER),)})) == {"can_be_pickled"}


def test_rules_are_small():
    long = [r.name for k in ("model", "term") for r in testing.rules_for(k) if len(inspect.getsource(r.judge)) > 1200]
    assert long == []
