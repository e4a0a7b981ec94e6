"""Cases that cannot be meant, and plugins that cannot be used: each is refused with a sentence."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from lostmotion.case import CaseFile, Prior
from lostmotion.contracts import Param, Term
from lostmotion.diagnosis.stages import locate
from lostmotion.errors import CaseError, ContractError, DataError
from lostmotion.evidence.effects import list_bare_promises
from lostmotion.inference.fit import maximise
from lostmotion.inference.setup import make_known, make_posterior
from lostmotion.likelihood.latent import LatentForce
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import System
from lostmotion.preparation.candidate_terms import candidates_of
from lostmotion.preparation.prepare import prepare
from lostmotion.quantities import FORCE
from lostmotion.registry import default

KNOWN = {"m": 1.0, "c": 8.0, "k": 1e4}
CASE = """
[[recordings]]
file = "seen.csv"
rate = 100.0
hold = "{hold}"
excitation = {{ column = "force", quantity = "force", unit = "N" }}
response = {{ column = "x", quantity = "position", unit = "m" }}
[model]
name = "linear_oscillator"
"""


@dataclass(frozen=True)
class Misspelt(Term):
    """A term that asks for a name which is nowhere."""

    at: str = "ground"
    name = "misspelt"
    physics = "A force of {force} acts"
    formula = "force"
    paper = "none"
    params = (Param("force", "a force", FORCE, null=0.0),)

    @staticmethod
    def force(t, x, v, u, p, s):
        return nowhere * p[0]  # noqa: F821 - the point of the test


def oscillator(*terms):
    """Return the system of the linear oscillator with the given terms."""
    model = default().make("model", "linear_oscillator")
    return System(model, candidates_of(model, terms))


def case_of(known, estimate=None):
    """Return a case without recordings."""
    return CaseFile("study", Path(), (), "linear_oscillator", known, estimate or {}, {}, (), "")


@pytest.mark.parametrize(("name", "value"), [("m", -1.0), ("m", 0.0), ("c", -8.0), ("k", -1e4)])
def test_a_known_value_that_no_machine_has_is_refused(name, value):
    """A negative mass made a diagnosis run for minutes."""
    with pytest.raises(CaseError, match=rf"^{name} \(.*is {value:g}, expected "):
        make_known(oscillator(), case_of({**KNOWN, name: value}))


@pytest.mark.parametrize("prior", [Prior(low=-5.0, high=80.0), Prior(mean=-5.0, sd=1.0)])
def test_a_prior_that_no_machine_has_is_refused(prior):
    with pytest.raises(CaseError, match=r"^c \("):
        make_known(oscillator(), case_of({"m": 1.0, "k": 1e4}, {"c": prior}))


def test_zero_damping_may_be_known():
    assert make_known(oscillator(), case_of({**KNOWN, "c": 0.0})).min() == 0.0


def test_a_term_that_cannot_be_compiled_is_told_in_a_sentence():
    system = oscillator(Misspelt)
    full = system.vector({**KNOWN, "misspelt.force": 1.0})
    with pytest.raises(ContractError, match=r"cannot be compiled .*nowhere.* and the math module only$") as told:
        system.find_fastest_rate(full, ["misspelt"], np.zeros((2, 2)), np.zeros((2, 1)))
    assert "\n" not in str(told.value)


class Rootless(Misspelt):
    """A term whose force is a number while the body moves forth, and none while it moves back."""

    name = "rootless"

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * math.sqrt(v) if v >= 0.0 else math.nan


class Plain(Misspelt):
    name = "plain"

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * v


def test_a_term_without_a_finite_force_is_refused():
    time = 0.1 * np.arange(200.0)
    observation = Observation.of("seen", np.sin(time), np.cos(time)[:, None], 0.1, "position")
    case = case_of({"m": 1.0, "c": 0.5}, {"k": Prior(low=0.1, high=100.0)})
    fit = maximise(make_posterior(oscillator(Rootless, Plain), case, (observation,)))
    with pytest.raises(ContractError, match="force of rootless is not a finite number"):
        list_bare_promises(fit, ["rootless"], {})
    assert [promise.key for promise in list_bare_promises(fit, ["plain"], {})] == ["plain"]


@pytest.mark.parametrize("size", [1e200, np.nan])
def test_a_filter_that_ran_away_is_no_diagnosis(size):
    system = oscillator()
    observation = Observation.of("seen", np.zeros(4), np.zeros((4, 1)), 0.1, "position")
    missing = LatentForce(np.full(4, size), np.zeros(4), np.zeros((4, 2)), 0.0, 0.0)
    with pytest.raises(DataError, match=r"^seen: the model cannot follow this recording"):
        locate(system.model, observation, missing)


@pytest.mark.parametrize("hold", ["step", "smooth"])
def test_an_excitation_that_is_held_is_taken_as_held(tmp_path, hold):
    """`hold = "step"` was read, checked and then forgotten."""
    rows = np.random.default_rng(0).normal(size=(200, 2))
    np.savetxt(tmp_path / "seen.csv", rows, delimiter=",", header="force,x", comments="")
    (tmp_path / "case.toml").write_text(CASE.format(hold=hold))
    assert prepare(tmp_path / "case.toml", default()).observations[0].held is (hold == "step")
