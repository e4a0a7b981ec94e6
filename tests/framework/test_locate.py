"""Where a force lives: shares by cross-validated fits, held against noise of the same spectrum; likelihood ratios."""

import numpy as np
import pytest
from scipy.signal import lfilter

from lostmotion.diagnosis.stages import locate
from lostmotion.inference.locate import describe_location, list_covariates, list_further_covariates
from lostmotion.inference.odds import (
    LikelihoodRatio,
    compute_gain,
    compute_inflation,
    compute_log_mean,
    compute_p_values,
    list_likely,
)
from lostmotion.inference.shares import Covariate, adjust_p_values, compute_shares, list_significant, randomise_phases
from lostmotion.likelihood.latent import LatentForce
from lostmotion.likelihood.observation import Observation
from lostmotion.registry import default

SAMPLES, PERIOD, DT = 3000, 100, 1e-3


def swing(rng):
    """Return position (m) and velocity (m/s) of a swing whose amplitude and phase wander."""
    t = np.arange(SAMPLES)
    wander = np.cumsum(rng.standard_normal((2, SAMPLES)), axis=1) / np.sqrt(SAMPLES)
    x = 0.01 * (1.0 + 0.3 * np.tanh(wander[0])) * np.sin(2.0 * np.pi * t / PERIOD + wander[1])
    return x, np.gradient(x, DT)


def smoothed_noise(rng, memory=0.9):
    """Return what a smoother makes of nothing: noise with a memory."""
    return lfilter([1.0], [1.0, -memory], rng.standard_normal(SAMPLES))


def asked(x, v):
    """Return what a diagnosis asks of a force along a motion in a gap of 5 mm."""
    model = default().make("model", "lin_backlash")
    observation = Observation.of("seen", x, np.cos(2.0 * np.pi * np.arange(SAMPLES) / PERIOD)[:, None], DT, "position")
    missing = LatentForce(np.zeros(SAMPLES), np.zeros(SAMPLES), np.stack([x, v], axis=1), 0.0, 0.0)
    table = list_covariates(model, observation, missing)
    return table, {k: Covariate((c,)) for k, c in table.items()} | list_further_covariates(
        model, observation, missing, {"ground": 0.005}
    )


def located(force, rng):
    x, v = swing(rng)
    table, questions = asked(x, v)
    made = force(x, v) + 0.3 * smoothed_noise(rng)
    found = compute_shares(questions, made, rng)
    return found, describe_location(table, made, found)


def test_everything_that_is_asked_is_answered():
    found, _ = located(lambda x, v: 0.0 * x, np.random.default_rng(0))
    assert set(found) == {"position", "velocity", "phase", "time", "sign of velocity", "contact", "history"}
    assert all(0.0 <= s.value <= 1.0 and 0.0 < s.p <= 1.0 and np.isfinite(s.error) for s in found.values())


@pytest.mark.parametrize(
    ("force", "where"),
    [
        (lambda x, v: -3.0 * np.sign(v), "sign of velocity"),
        (lambda x, v: 3.0 * np.sin(2.0 * np.pi * x / 0.004), "position"),
        (lambda x, v: 4.0 * (np.abs(x) > 0.005), "contact"),
        (lambda x, v: 3.0 * np.linspace(-1.0, 1.0, SAMPLES) ** 2, "time"),
    ],
)
def test_a_force_is_found_where_it_lives(force, where):
    """Each force is about as large as the noise or larger; half of the variance goes with its covariate at least."""
    found, _ = located(force, np.random.default_rng(3))
    assert where in list_significant(found)
    assert found[where].value > 0.5


def test_the_sentence_names_the_sign_and_leaves_out_what_noise_would_show():
    _, said = located(lambda x, v: -3.0 * np.sign(v), np.random.default_rng(4))
    assert said.startswith("a function of sign of velocity, which explains ")
    _, said = located(lambda x, v: 0.0 * x, np.random.default_rng(5))
    assert said.startswith("no significant structure over position, velocity, phase or time")


def test_history_counts_only_beyond_position_and_velocity():
    """A linear spring goes with where the body is; where it was says nothing more. A late one does."""
    lag = PERIOD // 4
    found, _ = located(lambda x, v: 300.0 * x, np.random.default_rng(6))
    assert found["history"].value < 0.05
    rng = np.random.default_rng(7)
    x = np.convolve(rng.standard_normal(SAMPLES + 40), np.hanning(40), "same")[:SAMPLES]
    late = np.concatenate([np.zeros(lag), x[:-lag]])
    question = {"history": Covariate((x, np.gradient(x), late))}
    assert compute_shares(question, late**2, rng)["history"].value > 0.8


def test_surrogates_keep_the_spectrum_and_lose_the_line():
    rng = np.random.default_rng(8)
    noise = smoothed_noise(rng)
    made = randomise_phases(noise + 5.0 * np.sin(2.0 * np.pi * np.arange(SAMPLES) / PERIOD), 50, rng)
    assert made.shape == (50, SAMPLES)
    assert np.mean(made.var(axis=1)) == pytest.approx(noise.var(), rel=0.15)
    memory = np.mean(made[:, 1:] * made[:, :-1]) / np.mean(made**2)
    assert memory == pytest.approx(0.9, abs=0.03)


def test_the_same_seed_gives_the_same_answer():
    first, second = (located(lambda x, v: 0.0 * x, np.random.default_rng(9))[0] for _ in range(2))
    assert first == second


def test_without_chance_nothing_is_called_significant():
    x, v = swing(np.random.default_rng(10))
    found = compute_shares(asked(x, v)[1], 300.0 * x, None)
    assert found["position"].value > 0.9
    assert list_significant(found) == []


def two_places(force, rng):
    """Return where a force lives of position and velocity relative to the base, in a joint with two places."""
    x, v = swing(rng)
    base = 0.004 * np.sin(2.0 * np.pi * np.arange(SAMPLES) / PERIOD + 0.7)
    inputs = np.stack([base, np.gradient(base, DT)], axis=1)
    model = default().make("model", "robot_joint")
    observation = Observation.of("seen", x, inputs, DT, "position")
    made = force(x - base, v - inputs[:, 1]) + 0.3 * smoothed_noise(rng)
    missing = LatentForce(made, np.zeros(SAMPLES), np.stack([x, v], axis=1), 0.0, 0.0)
    return locate(model, observation, missing, plays={"base": 0.005}, rng=rng)


def test_a_structured_force_is_significant_in_a_model_with_two_places():
    """With eleven covariates and 199 surrogates a Bonferroni level of 0.0045 lay below the least p-value, 0.005.

    `structure` is what `Diagnosed.unknown` asks for.
    """
    found = two_places(lambda x, v: -3.0 * np.sign(v), np.random.default_rng(12))
    assert len(found.explained) == 11
    assert found.structure[0] in ("velocity at base", "sign of velocity at base")
    assert found.summary.startswith("a function of sign of velocity at base, which explains ")


@pytest.mark.slow
def test_pure_noise_is_seldom_called_structure_in_a_model_with_two_places():
    """At most 10 of 100 forces of pure noise, over all eleven covariates; the level is 5 %. Seeded.

    More than 10 of 100 come of a true rate of 5 % in 1.1 % of new ensembles.
    """
    none = [two_places(lambda x, v: 0.0 * x, np.random.default_rng([13, seed])).significant for seed in range(100)]
    assert sum(map(bool, none)) <= 10


def test_adjusted_p_values_are_those_of_the_largest_excess():
    """Against loops, the slow twin."""
    values = np.random.default_rng(14).normal(size=(4, 50)) * np.array([[1.0], [5.0], [0.1], [2.0]])
    values[2, 0] = 0.35
    excess, p = adjust_p_values(values)
    scaled = [[(v - np.mean(row)) / np.std(row) for v in row] for row in values]
    largest = [max(row[k] for row in scaled) for k in range(1, 50)]
    np.testing.assert_allclose(excess, [row[0] for row in scaled])
    np.testing.assert_allclose(p, [(1 + sum(one >= row[0] for one in largest)) / 50 for row in scaled])


def test_adjusted_p_values_hold_their_level_over_all_tests():
    """At 5 % over 30 tests that go together, 400 times: at most the 99.9 % point of the binomial, 34. Seeded."""
    rng, wrong = np.random.default_rng(15), 0
    for _ in range(400):
        values = rng.normal(size=(30, 200)) + 2.0 * rng.normal(size=(1, 200))
        wrong += bool(np.min(adjust_p_values(values**2)[1]) <= 0.05)
    assert wrong <= 34


def linear(rng, size):
    """Return data (60,) of noise and a curve of a given size over six functions, with the functions."""
    design = rng.normal(size=(60, 6))
    return design @ (size * rng.normal(size=6)) + rng.normal(size=60), design


def test_likelihood_ratio_in_closed_form_is_that_of_two_normal_densities():
    data, design = linear(np.random.default_rng(16), 0.3)
    root = np.diag(np.linspace(0.1, 0.5, 6))[:, :4]
    wide = np.eye(60) + design @ root @ root.T @ design.T
    slow = 0.5 * (data @ data - data @ np.linalg.inv(wide) @ data - np.linalg.slogdet(wide)[1])
    assert compute_gain(design.T @ data, design.T @ design, root) == pytest.approx(slow, abs=1e-9)


def test_likelihood_ratio_of_noise_seldom_exceeds_its_inverse_level():
    """1000 data sets of pure noise, two covariates: at most 5 % at the level of 5 % (Markov), and a curve is found."""
    rng, roots = np.random.default_rng(17), [size * np.eye(6) for size in (0.05, 0.2, 1.0)]

    def asked(data, *designs):
        pairs = [(design.T @ data, design.T @ design) for design in designs]
        told = [compute_log_mean([compute_gain(*pair, root) for root in roots]) for pair in pairs]
        return {str(i): LikelihoodRatio(one, one) for i, one in enumerate(told)}

    noise = [linear(rng, 0.0) for _ in range(1000)]
    assert sum(bool(list_likely(asked(data, one, rng.normal(size=(60, 6))))) for data, one in noise) <= 50
    data, one = linear(rng, 1.0)
    odds = asked(data, one, rng.normal(size=(60, 6)))
    assert list_likely(odds)[0] == "0"
    told = compute_p_values(
        {"a": LikelihoodRatio(9.0, 5.0), "b": LikelihoodRatio(60.0, 50.0), "c": LikelihoodRatio(-3.0, -3.0)}
    )
    assert told == {"a": pytest.approx(3.0 * np.exp(-5.0)), "b": 1e-6, "c": 1.0}


def test_scores_with_a_memory_count_for_less():
    """White scores count in full but for their scatter over 40 blocks; with a memory of 0.8 about 9 times less."""
    rng = np.random.default_rng(18)
    white = rng.normal(size=(3, 4000))
    slow = lfilter([0.6], [1.0, -0.8], white, axis=1)

    def blocks(scores):
        sums = scores.reshape(3, 40, 100).sum(axis=2)
        return sums - sums.mean(axis=1, keepdims=True)

    assert compute_inflation(blocks(white), 4000.0 * np.eye(3), np.eye(3)) == pytest.approx(1.0, abs=0.3)
    assert compute_inflation(blocks(slow), 4000.0 * np.eye(3), np.eye(3)) == pytest.approx(9.0, rel=0.3)


@pytest.mark.slow
def test_pure_noise_is_seldom_called_structure():
    """At most 10 of 100 forces of pure noise, over all seven covariates together; the level is 5 %.

    More than 10 of 100 come of a true rate of 5 % in 1.1 % of new ensembles; this one is fixed.
    """
    wrong = 0
    for seed in range(100):
        rng = np.random.default_rng([11, seed])
        x, v = swing(rng)
        wrong += bool(
            list_significant(compute_shares(asked(x, v)[1], smoothed_noise(rng, 0.7 + 0.25 * rng.random()), rng))
        )
    assert wrong <= 10
