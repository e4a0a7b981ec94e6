"""The words of an answer: one hypothesis for all its numbers, and units of what moves."""

from types import SimpleNamespace

import pytest

from lostmotion.quantities import INERTIA
from lostmotion.results import Interval
from lostmotion.robots.arm_effects import MassEffect
from lostmotion.robots.arm_words import _describe_mass, find_told

COULOMB, DRIFT, SPRING = "coulomb_friction@elbow", "friction_drift@elbow", "linear_stiffness@elbow"


def search_with(scores):
    """Return a search in which sets of effects have these log evidences."""

    def make(terms, score):
        effects = tuple(SimpleNamespace(key=k, extends=(COULOMB,) if k == DRIFT else ()) for k in terms)
        return SimpleNamespace(
            terms=frozenset(terms), frame=SimpleNamespace(effects=effects), log_evidence=score, heldout=0.0, price=0.0,
            score=lambda temper: score / temper,
        )  # fmt: skip

    found = {frozenset(terms): make(terms, score) for terms, score in scores.items()}
    best = max(found.values(), key=lambda one: one.log_evidence)
    return SimpleNamespace(found=found, temper=1.0, best=best)


@pytest.mark.parametrize(
    ("scores", "told"),
    [
        ({(): 0.0, (COULOMB,): 100.0, (DRIFT,): 101.5}, {COULOMB}),
        ({(): 0.0, (COULOMB,): 100.0, (DRIFT,): 120.0}, {DRIFT}),
        ({(): 0.0, (SPRING,): 0.3, (COULOMB,): 0.2}, set()),
        ({(): 0.0, (COULOMB, SPRING): 50.0, (DRIFT, SPRING): 51.0}, {COULOMB, SPRING}),
    ],
)
def test_an_answer_is_about_the_effects_that_it_names(scores, told):
    assert find_told(search_with(scores)).terms == told


@pytest.mark.parametrize(
    ("value", "motion", "known", "says"),
    [
        ("rod.mass", "rotation", 1.5, "The mass of rod is 1.6 kg, not 1.5 kg"),
        ("rod.armature", "rotation", 0.3, "The moment of inertia of the motor of rod is 0.4 kg m^2, not 0.3 kg m^2."),
        ("rod.armature", "translation", 0.3, "The mass of the motor of rod is 0.4 kg, not 0.3 kg."),
        ("rod.armature", "rotation", 0.0, "The moment of inertia that moves with rod is 0.1 kg m^2 larger than in the"),
    ],
)
def test_a_mass_has_the_unit_of_what_moves(value, motion, known, says):
    effect = MassEffect("inertia_change", "rod", value, None, 0.1)
    change = Interval(0.1, 0.05, 0.15, INERTIA.unit(motion))
    sentence, told = _describe_mass(effect, {"change": change}, motion, known)
    assert sentence.startswith(says)
    assert told["change"].unit == ("kg m^2" if "kg m^2" in says else "kg")
