"""A machine of a third party that is stepped: one file, named in a case, in Python and in a command; its faults."""

import json
import re
from dataclasses import dataclass, replace

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import lostmotion as lm
from lostmotion import testing
from lostmotion.cli import main
from lostmotion.contracts import Dynamics, Param, Place
from lostmotion.errors import CaseError, ContractError, PluginError
from lostmotion.inference.setup import make_posterior
from lostmotion.likelihood.stepped import make_system
from lostmotion.preparation.prepare import prepare
from lostmotion.quantities import INERTIA
from lostmotion.registry import Registry, default

FILE = '''
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Dynamics, Param, Place
from lostmotion.quantities import DAMPING, INERTIA, STIFFNESS


@dataclass(frozen=True)
class Cart(Dynamics):
    """m x'' + c x' + k x = force, by RK4."""

    name = "cart"
    paper = "Newton, Principia (1687)"
    motion = "translation"
    states = ("position", "velocity")
    inputs = ("force",)
    channels = ("position", "velocity")
    params = (
        Param("m", "mass", INERTIA, low=0.0, scale="log"),
        Param("c", "damping", DAMPING, low=0.0),
        Param("k", "stiffness", STIFFNESS, low=0.0),
    )
    places = (Place("ground", motion=lambda y, u: (y[0], y[1])),)

    def step(self, x, u, f, p, dt):
        def rates(y):
            return np.column_stack([y[:, 1], (u[:, 0] + f[:, 0] - p[:, 1] * y[:, 1] - p[:, 2] * y[:, 0]) / p[:, 0]])

        k1 = rates(x)
        k2 = rates(x + 0.5 * dt * k1)
        k3 = rates(x + 0.5 * dt * k2)
        return x + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rates(x + dt * k3))

    def observe(self, x, u, f, p):
        return x
'''
CASE = """
title = "Cart"
[[recordings]]
file = "cart.csv"
time = "t"
hold = "step"
excitation = { column = "F", quantity = "force", unit = "N" }
response = { column = "x", quantity = "position", unit = "m" }
[model]
dynamics = "my_cart.py:Cart"
[model.estimate]
m = { low = 0.3, high = 3.0, scale = "log" }
c = { low = 0.05, high = 3.0, scale = "log" }
k = { low = 1.0, high = 20.0, scale = "log" }
"""
TRUE = {"m": 1.0, "c": 0.4, "k": 6.0}
DT, SAMPLES = 0.05, 120


def readings(seed=0):
    """Return the held force and the readings of an exact oscillator: the matrix exponential, no steps."""
    rng, t = np.random.default_rng(seed), np.arange(SAMPLES) * DT
    force = 3.0 * np.sin(2.0 * t) + 2.0 * np.sin(3.3 * t + 1.0)
    whole = np.zeros((3, 3))
    whole[:2] = [[0.0, 1.0, 0.0], [-TRUE["k"] / TRUE["m"], -TRUE["c"] / TRUE["m"], 1.0 / TRUE["m"]]]
    across, y, states = expm(whole * DT), np.zeros(2), []
    for u in force:
        states.append(y)
        y = (across @ [*y, u])[:2]
    return force, np.array(states)[:, 0] + 1e-3 * rng.standard_normal(SAMPLES)


@pytest.fixture(autouse=True)
def _registry():
    """Give each test a registry of its own: the same name from two folders is a clash."""
    default.cache_clear()
    yield
    default.cache_clear()


@pytest.fixture
def folder(tmp_path):
    force, seen = readings()
    table = np.column_stack([np.arange(SAMPLES) * DT, force, seen])
    np.savetxt(tmp_path / "cart.csv", table, delimiter=",", header="t,F,x", comments="")
    (tmp_path / "my_cart.py").write_text(FILE, encoding="utf-8")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    return tmp_path


def run(*args):
    return CliRunner().invoke(main, [str(arg) for arg in args], prog_name="lostmotion")


@pytest.mark.slow
def test_a_file_beside_the_case_is_identified_on_the_command_line(folder):
    done = run("identify", folder / "case.toml", "--out", folder / "out", "--ess", 100, "--max-steps", 700, "--quiet")
    assert done.exit_code == 0, done.output
    result = json.loads((folder / "out" / "identification.json").read_text(encoding="utf-8"))
    rows = result["parameters"]
    for name, true in TRUE.items():  # 95 % of each interval, widened by its half: 3.9 standard deviations
        low, high = rows[name]["low"], rows[name]["high"]
        assert low - 0.5 * (high - low) < true < high + 0.5 * (high - low)
        assert high - low < 0.2 * true
    assert "my_cart.py" in json.dumps(result["provenance"])


def test_the_same_case_in_python(folder):
    force, seen = readings()
    recording = lm.Recording.from_arrays(
        sensors={"position": seen}, inputs={"force": force}, rate=1.0 / DT, units={"position": "m", "force": "N"},
        hold="step",
    )  # fmt: skip
    cart = lm.model(dynamics=str(folder / "my_cart.py:Cart"))
    priors = {"m": lm.LogUniform(0.3, 3.0), "c": lm.LogUniform(0.05, 3.0), "k": lm.LogUniform(1.0, 20.0)}
    one = lm.Case(recording, cart, estimate=priors).prepare(default())
    two = prepare(folder / "case.toml", Registry.discover())
    there, here = (make_posterior(make_system(p.model, p.terms), p.case, p.observations, jobs=1) for p in (one, two))
    assert here.log_likelihood(here.space.start[None]) == pytest.approx(
        there.log_likelihood(there.space.start[None]), rel=1e-6
    )


def test_a_case_made_in_python_is_written_with_the_file_of_its_class(folder, tmp_path):
    case = lm.Case.read(folder / "case.toml")
    path = case.write(tmp_path / "copy")
    assert 'dynamics = "../my_cart.py:Cart"' in path.read_text(encoding="utf-8")
    assert lm.Case.read(path).model == case.model


def test_it_is_listed_shown_and_checked(folder):
    at = ("--plugin", folder / "my_cart.py", "plugins")
    assert re.search(r"dynamics +cart", run(*at).output)
    shown = run(*at, "show", "cart")
    assert "the step applies its force" in shown.output
    checked = run(*at, "check", "cart")
    assert checked.exit_code == 0, checked.output
    assert "0 broken" in checked.output


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("my_cart.py:Cart", "my_cat.py:Cart", "names the file 'my_cat.py', which does not exist"),
        ("my_cart.py:Cart", "my_cart.py:Card", "has no class 'Card' of the kind Dynamics (did you mean 'Cart'?)"),
        ("my_cart.py:Cart", "wagon", "no dynamics is called 'wagon'"),
        (
            'dynamics = "my_cart.py:Cart"',
            'dynamics = "my_cart.py:Cart"\nname = "duffing"',
            "has both name and dynamics",
        ),
        ('m = { low = 0.3, high = 3.0, scale = "log" }', "", "cart needs m"),
    ],
)
def test_a_case_that_cannot_be_used_says_why(folder, old, new, says):
    (folder / "case.toml").write_text(CASE.replace(old, new), encoding="utf-8")
    with pytest.raises((CaseError, PluginError), match=re.escape(says)):
        posterior_of(folder / "case.toml")


def posterior_of(path):
    prepared = prepare(path, Registry.discover())
    return make_posterior(make_system(prepared.model, ()), prepared.case, prepared.observations)


@dataclass(frozen=True)
class Wagon(Dynamics):
    """A mass that a force moves."""

    fault: str = ""
    name = "wagon"
    paper = "Newton, Principia (1687)"
    motion = "translation"
    states = ("position", "velocity")
    inputs = ("force",)
    channels = ("position", "velocity")
    params = (Param("m", "mass", INERTIA, low=0.0, scale="log"),)
    places = (Place("ground", motion=lambda y, u: (y[0], y[1])),)

    def step(self, x, u, f, p, dt):
        push = (u[:, 0] + (0.0 if self.fault == "deaf" else f[:, 0])) / p[:, 0]
        moved = np.column_stack([x[:, 0] + dt * x[:, 1] + 0.5 * dt**2 * push, x[:, 1] + dt * push])
        if self.fault == "one row":
            return moved[0]
        if self.fault == "nan":
            return moved * np.nan
        if self.fault == "mixed":
            return moved + 1e-3 * moved.mean(axis=0)
        if self.fault == "changes":
            x += dt
        if self.fault == "raises":
            raise ValueError("no license")
        if self.fault == "unit":
            moved[:, 0] = x[:, 0] + 1e3 * dt * x[:, 1]
        return moved

    def observe(self, x, u, f, p):
        return x[:, :1] if self.fault == "few" else x[:, ::-1] if self.fault == "swapped" else x


FAULTS = {
    "one row": ("step_returns_states", "step returned an array (2,) for states (6, 2)"),
    "nan": ("step_returns_states", "step returned [nan nan]"),
    "mixed": ("rows_are_independent", "alone give another result"),
    "changes": ("arguments_are_not_changed", "x was changed"),
    "raises": ("step_returns_states", "it raised ValueError: no license"),
    "deaf": ("force_moves_its_place", "a force at ground changes the velocity there by 0"),
    "few": ("observe_returns_channels", "observe returned an array (6, 1) for 6 rows and 2 channels"),
    "swapped": ("observed_states_are_states", "the channel position shows another number"),
    "unit": ("short_step_moves_little", "position moves by another amount than its velocity"),
}


def test_a_good_class_breaks_no_rule():
    assert [str(f) for f in testing.check(Wagon()) if not f.ok] == []


@pytest.mark.parametrize("fault", list(FAULTS))
def test_a_faulty_class_breaks_the_rule_that_says_so(fault):
    name, says = FAULTS[fault]
    broken = {f.rule: f.sentence for f in testing.check(Wagon(fault)) if not f.ok}
    assert says in broken[name]


def wagon_posterior(wagon):
    force, seen = readings()
    recording = lm.Recording.from_arrays(
        sensors={"position": seen}, inputs={"force": force}, rate=1.0 / DT, units={"position": "m", "force": "N"}
    )
    prepared = lm.Case(recording, wagon, estimate={"m": lm.LogUniform(0.3, 3.0)}).prepare(default(), ())
    return make_posterior(make_system(prepared.model, ()), prepared.case, prepared.observations, jobs=1)


@pytest.mark.parametrize(
    ("fault", "says"),
    [
        ("one row", "wagon: step returned an array (2,)"),
        ("few", "wagon: observe returned an array (1, 1) for 1 rows, expected (1, 2): return (rows, channels)"),
        ("raises", "wagon: step raised ValueError: no license; it was called with x ("),
        ("deaf", "wagon: a force of 1 at ground accelerates it by 0, expected a finite number above zero"),
    ],
)
def test_an_instance_that_was_not_checked_stops_with_a_sentence(fault, says):
    with pytest.raises(ContractError, match=re.escape(says)):
        ask(Wagon(fault))


def ask(wagon):
    """Ask a machine for all that a fit asks."""
    posterior = wagon_posterior(wagon)
    posterior.system.senses_force("position")
    posterior.system.own_inertia(posterior.recordings[0].full(posterior.space.start), wagon.places[0])
    posterior.log_likelihood(posterior.space.start[None])


def test_arguments_of_a_step_are_read_only_inputs_and_a_divergence_is_marked():
    posterior = wagon_posterior(Wagon())
    assert np.isfinite(posterior.log_likelihood(posterior.space.start[None])).all()
    wild = replace(posterior, dynamics=replace(posterior.dynamics, system=make_system(Wagon("nan"), ())))
    assert posterior.system.model != wild.system.model
    assert wild.log_likelihood(posterior.space.start[None]) == [-np.inf]


def test_a_term_that_asks_for_what_steps_cannot_tell_has_no_place():
    terms = {name: default().make("term", name) for name in ("hidden_mode", "coulomb_friction")}
    assert [name for name, term in terms.items() if term.fits(Wagon())] == ["coulomb_friction"]


def test_a_model_is_no_dynamics():
    with pytest.raises(ContractError, match="wagon has a step and no equations"):
        _ = make_system(Wagon(), ()).blueprint


def rub(_, y, force, friction):
    """Return the derivatives of the cart with dry friction (N), which a smooth step over 2 mm/s stands for."""
    held = TRUE["c"] * y[1] + TRUE["k"] * y[0] + friction * np.tanh(y[1] / 2e-3)
    return [y[1], (force - held) / TRUE["m"]]


@pytest.mark.slow
def test_a_diagnosis_names_the_friction_that_a_stepped_machine_lacks(folder):
    t, y, states = np.arange(300) * DT, np.zeros(2), []
    force = 3.0 * np.sin(2.0 * t) + 2.0 * np.sin(3.3 * t + 1.0)
    for u in force:
        states.append(y)
        y = solve_ivp(rub, (0.0, DT), y, args=(u, 0.5), method="LSODA", rtol=1e-8, atol=1e-10).y[:, -1]
    seen = np.array(states)[:, 0] + 1e-3 * np.random.default_rng(0).standard_normal(300)
    recording = lm.Recording.from_arrays(
        sensors={"position": seen}, inputs={"force": force}, rate=1.0 / DT, units={"position": "m", "force": "N"},
        hold="step",
    )  # fmt: skip
    priors = {"m": lm.LogUniform(0.3, 3.0), "c": lm.LogUniform(0.05, 3.0), "k": lm.LogUniform(1.0, 20.0)}
    case = lm.Case(recording, lm.model(dynamics=str(folder / "my_cart.py:Cart")), estimate=priors)
    found = lm.diagnose(case, terms=("coulomb_friction", "cubic_stiffness", "viscous_damping"), progress=False)
    (named,) = [one for one in found.found if one.state == "named"]
    assert (named.mechanism, named.at) == ("coulomb_friction", "ground")
    low, high = (getattr(named.parameters["force"], end) for end in ("low", "high"))
    assert low - 0.5 * (high - low) < 0.5 < high + 0.5 * (high - low)
    found.save(folder / "found")
    stored = lm.load(folder / "found").model
    assert stored.values["coulomb_friction.force"] == pytest.approx(0.5, rel=0.05)
    moved = stored.simulate({"force": force}, rate=1.0 / DT).sensors[0].values
    gap = np.std(moved - np.array(states)[:, 0])  # an array is smooth between samples, and was held: half a sample
    assert gap < 0.08 * np.std(moved)
