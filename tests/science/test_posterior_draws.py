"""Draws of a hypothesis with its smooth forces averaged, beside the sum over every choice of smooth forces."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from explained import explain_machine
from scipy.special import softmax
from scipy.stats import norm, t

from lostmotion.evidence import posterior_draws
from lostmotion.evidence.discrepancy import Quadratic
from lostmotion.evidence.hypothesis import compute_step
from lostmotion.evidence.posterior_draws import ALONG, draw_own, find_along, find_shares, sample_choices
from lostmotion.inference.natural import find_term
from lostmotion.likelihood.tangents import linearise_recordings

DRAWS = 4000


def push(x, v, t):
    """Return a smooth force that no term describes (N)."""
    return 0.1 * np.sin(2.0 * v / 0.1) + 0.06 * np.cos(3.0 * x / 2e-3)


@pytest.fixture(scope="module")
def pushed(tmp_path_factory):
    """The model without any term beside a smooth force, with two smooth forces only: each choice can be listed."""
    found = explain_machine(tmp_path_factory.mktemp("pushed"), push).found[frozenset()]
    frame = replace(found.frame, forces=found.frame.forces[:2])
    return replace(found, frame=frame, choice=found.choice[:2])


def list_shares(found):
    """Return every choice with its probability."""
    quadratic = Quadratic.of(found.frame, found.expansion.curvature)
    choices = list(product(*(range(-1, len(force.options)) for force in found.frame.forces)))
    return choices, softmax([quadratic.evaluate(one) / found.scatter for one in choices])


def find_covariance(found, choice):
    """Return the covariance of own coordinates beside some smooth forces, with what these tell of the unseen part."""
    unseen = ALONG * found.frame.measure_smooth(choice)
    along = find_along(found.frame, find_shares(found))
    return found.scatter * replace(found, choice=choice).covariance + unseen**2 * along


def test_choices_are_drawn_by_their_evidence(pushed):
    """Seeded; 4,000 draws of some tens of likely choices: half the sum of the differences of shares is about 0.05."""
    choices, shares = list_shares(pushed)
    drawn = sample_choices(pushed, DRAWS, np.random.default_rng(0))
    seen = np.array([drawn.count(one) / DRAWS for one in choices])
    assert seen.sum() == pytest.approx(1.0)
    assert 0.5 * np.abs(seen - shares).sum() < 0.12
    assert shares.max() < 0.95  # or nothing is averaged


@pytest.mark.parametrize("beside", [True, False])
def test_draws_beside_a_smooth_force_have_the_tails_of_a_t_distribution(pushed, monkeypatch, beside):
    """Seeded; the quantile of 97.5 % of 4,000 draws scatters by 5 %; the normal one is 38 % smaller."""
    choice = (0, -1) if beside else (-1, -1)
    monkeypatch.setattr(posterior_draws, "sample_choices", lambda found, count, rng: [choice] * count)
    k = pushed.frame.names.index("c")
    drawn = draw_own(pushed, DRAWS, np.random.default_rng(2))[:, k]
    width = np.sqrt(np.diag(find_covariance(pushed, choice))[k])
    wanted = t.ppf(0.975, posterior_draws.FREEDOM) if beside else norm.ppf(0.975)
    assert np.diff(np.quantile(drawn, [0.025, 0.975])) / 2.0 / width == pytest.approx(wanted, rel=0.12)


def test_draws_have_mean_and_deviation_of_the_mixture_over_all_choices(pushed, monkeypatch):
    monkeypatch.setattr(posterior_draws, "FREEDOM", 1e6)
    choices, shares = list_shares(pushed)
    own, shares_of = pushed.frame.own, find_shares(pushed)
    middle, within = np.zeros((2, len(choices), own))
    for i, choice in enumerate(choices):
        at = pushed.at + compute_step(pushed.frame, pushed.expansion, choice)[0]
        middle[i] = at[:own] + shares_of @ at
        within[i] = np.diag(find_covariance(pushed, choice))
    mean = shares @ middle
    deviation = np.sqrt(shares @ (within + (middle - mean) ** 2))
    drawn = draw_own(pushed, DRAWS, np.random.default_rng(1))
    names = pushed.frame.names[:own]
    for k in (names.index("c"), names.index("k")):
        assert drawn[:, k].mean() == pytest.approx(mean[k], abs=0.1 * deviation[k])
        assert drawn[:, k].std() == pytest.approx(deviation[k], rel=0.1)


def test_an_unseen_damping_is_as_large_as_a_share_of_the_smooth_forces(pushed):
    """A line over velocity of 1 N per half range changes the damping by 1 N over that: d log c = 1 / (c half)."""
    frame, along = pushed.frame, find_along(pushed.frame, find_shares(pushed))
    key = next(force.key for force in frame.forces if "velocity" in force.key)
    half = float(frame.posterior.known[frame.posterior.system.index[f"{key}.half"]])
    c = float(np.exp(pushed.theta[frame.names.index("c")]))
    assert along[0, 0] == pytest.approx((c * half) ** -2, rel=0.05)
    sizes = [force.sizes for force in frame.forces]
    assert frame.measure_smooth((0, -1)) == sizes[0][0]
    assert frame.measure_smooth((0, 3)) == pytest.approx(np.hypot(sizes[0][0], sizes[1][3]))
    assert frame.measure_smooth((-1, -1)) == 0.0


def test_laws_take_over_what_is_along_them_of_a_smooth_force(pushed):
    """The slow twin evaluates force of spring, damper and curve along the filtered motion."""
    frame, found = pushed.frame, find_shares(pushed)
    posterior = frame.place(pushed.at)
    one = linearise_recordings(posterior, pushed.at[: len(posterior.space.free)])[0]
    x, v = one.states.T
    c, k = (float(np.exp(pushed.theta[frame.names.index(name)])) for name in ("c", "k"))
    for force in frame.forces:
        term = find_term(posterior, force.key)[0]
        middle, half = (one.full[posterior.system.index[f"{force.key}.{name}"]] for name in ("middle", "half"))
        place = ((v if term.over == "velocity" else x) - middle) / half
        curve = term.basis(place)[:, : force.columns.stop - force.columns.start]
        slow = np.linalg.lstsq(np.column_stack([-c * v, -k * x]), curve, rcond=None)[0]
        quick = found[[frame.names.index(name) for name in ("c", "k")], force.columns]
        assert quick == pytest.approx(slow, rel=1e-3, abs=1e-3 * np.abs(slow).max())
