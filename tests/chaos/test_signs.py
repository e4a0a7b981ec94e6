"""The signs of chaos: each has a state of its own, and a verdict says no more than they bear."""

from __future__ import annotations

import itertools
from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.contracts import Series
from lostmotion.results import Embedding, Estimate
from lostmotion.settings import DEFAULT
from lostmotion_chaos.analysis.denoise import Denoised
from lostmotion_chaos.analysis.motion import _find_common_period, judge_motion
from lostmotion_chaos.analysis.motion_options import OPTIONS
from lostmotion_chaos.analysis.period import BasePeriod, MotionEvidence
from lostmotion_chaos.analysis.signs import collect_signs
from lostmotion_chaos.analysis.surrogates import SurrogateTest
from lostmotion_chaos.quantifiers.correlation_curves import measure_flatness
from lostmotion_chaos.quantifiers.dimension import MOST_SCATTER, MOST_TILT

PERIOD = 0.1
NOTHING = Estimate.refused("no_scaling_region", "There is no scaling region.")
GROWN = {"e_folds": 1.6, "fit_begin": 0.5, "fit_end": 1.7}
EXPONENTS = {
    "for": Estimate(2.0, 1.5, 2.5, "ok", "1/s", details=GROWN),
    "against": Estimate.refused("regular", "Neighbouring states do not diverge."),
    "silent": NOTHING,
}
DIMENSIONS = {
    "for": Estimate(2.3, 2.1, 2.5, "ok", details={"tilt": 0.05, "scatter": 0.04}),
    "against": Estimate.refused("rising", "The slope rises."),
    "silent": NOTHING,
}
ENTROPIES = {
    "for": Estimate(1.8, 1.2, 2.4, "ok", "1/s"),
    "against": Estimate.refused("rising", "The entropy rises."),
    "silent": Estimate(1.8, -0.2, 3.8, "ok", "1/s"),
}
RANKS = {"for": 0.01, "against": 0.6, "silent": float("nan")}


def ranked(p, method="iaaft"):
    return SurrogateTest(method, "noise", "error", 0.1, np.zeros(19), p, 1.0, "low", 0, slice(0, 1), "No test.")


def evidence(*, exponent=NOTHING, dimension=NOTHING, entropy=NOTHING, ranks=(0.01,), x=None, period=PERIOD, dt=0.02):
    """Return what was measured of noise, which never comes back, with estimates of any kind beside it."""
    x = np.random.default_rng(3).normal(size=1500) if x is None else x
    raw = Series(x, dt, Embedding(4, 4, 20), period)
    level = Estimate(0.0, 0.0, 0.001, "ok")
    tests = tuple(ranked(p, m) for p, m in zip(ranks, ("iaaft", "pseudo_periodic"), strict=False))
    base = BasePeriod(period, "given" if period else "none")
    return MotionEvidence(base, raw, Denoised(raw, level, level), exponent, dimension, entropy, tests)


def state(it, key):
    return next(s for s in collect_signs(it) if s.key == key).state


@pytest.mark.parametrize("wanted", ["for", "against", "silent"])
def test_each_sign_has_its_state_and_a_sentence_why(wanted):
    it = evidence(exponent=EXPONENTS[wanted], dimension=DIMENSIONS[wanted], entropy=ENTROPIES[wanted],
                  ranks=(RANKS[wanted],))  # fmt: skip
    for sign in collect_signs(it)[1:]:
        assert sign.state == wanted, sign
    assert all(sign.says.endswith((".", ":")) and sign.excludes for sign in collect_signs(it))


@pytest.mark.parametrize("states", list(itertools.product(("for", "against", "silent"), repeat=4)))
def test_the_headline_says_no_more_than_the_weakest_sign_allows(states):
    """All 81 combinations of test, exponent, dimension and entropy, on a motion that never comes back."""
    test, exponent, dimension, entropy = states
    found = judge_motion(evidence(exponent=EXPONENTS[exponent], dimension=DIMENSIONS[dimension],
                            entropy=ENTROPIES[entropy], ranks=(RANKS[test],)))  # fmt: skip
    assert [s.state for s in found.signs] == ["for", *states]
    measured = states[1:].count("for")
    assert (found.motion == "chaotic") == (test == "for" and measured >= 2 and "against" not in states)
    assert ("All" in found.says) == (set(states) == {"for"})
    assert (found.motion == "chaotic" and found.strength == "firm") == (set(states) == {"for"})
    if found.motion == "chaotic" and "silent" in states:
        assert found.strength == "likely"
        assert f"{1 + states.count('for')} of 5 signs speak for chaos and none against it; silent: " in found.says
    if found.motion == "stochastic":
        assert "against" in (test, dimension, entropy)
        assert "for" not in (exponent, dimension)


def test_what_is_silent_is_not_called_noise():
    """It was "stochastic": no exponent and no dimension could be read, of chaos recorded for 26 periods."""
    found = judge_motion(evidence())
    assert found.motion == "undecided"
    assert "1 silent" not in found.says
    assert "3 silent" in found.says


def test_the_page_that_was_seen_is_undecided():
    """Growth by 0.6 e-foldings within less than a period, no entropy, and no plateau: "all signs agree" stood there."""
    brief = Estimate(7.0, 5.9, 8.1, "uncertain", "1/s", details={"e_folds": 0.6, "fit_begin": 0.2, "fit_end": 0.6})
    found = judge_motion(evidence(exponent=brief))
    assert found.motion == "undecided"
    assert state(evidence(exponent=brief), "exponent") == "silent"
    assert "All" not in found.says


@pytest.mark.parametrize(
    ("folds", "turns", "wanted"),
    [(0.81, 1.01, "for"), (0.79, 3.0, "silent"), (3.0, 0.99, "silent")],
)
def test_growth_counts_over_enough_e_foldings_and_time(folds, turns, wanted):
    details = {"e_folds": folds, "fit_begin": 0.1, "fit_end": 0.1 + turns * PERIOD}
    it = evidence(exponent=Estimate(2.0, 1.5, 2.5, "ok", "1/s", details=details))
    assert state(it, "exponent") == wanted


def test_the_dimension_of_a_closed_curve_speaks_against_chaos():
    assert state(evidence(dimension=Estimate(1.05, 0.95, 1.15, "ok")), "dimension") == "against"


def test_a_number_with_a_doubt_is_no_sign():
    doubted = Estimate(2.3, 2.1, 2.5, "uncertain", says="Too few pairs.")
    sign = next(s for s in collect_signs(evidence(dimension=doubted)) if s.key == "dimension")
    assert (sign.state, sign.says) == ("silent", "Too few pairs.")


def test_no_entropy_in_a_turn_speaks_against_chaos():
    assert state(evidence(entropy=Estimate(0.01, -0.02, 0.04, "ok", "1/s")), "entropy") == "against"


def test_a_short_recording_silences_its_tests():
    it = evidence(x=np.random.default_rng(0).normal(size=int(DEFAULT.motion.fewest_samples) - 1))
    assert state(it, "surrogates_iaaft") == "silent"


def test_a_few_cycles_of_a_sine_are_not_called_noise():
    """Surrogates of seven cycles are sines as well: the displacement of a damper was called stochastic for that."""
    t = 0.02 * np.arange(3000)
    it = evidence(x=np.sin(2.0 * np.pi * 7.0 * t / t[-1]), ranks=(0.6,), period=None)
    assert state(it, "surrogates_iaaft") == "silent"
    assert judge_motion(it).motion == "undecided"


def test_cycles_that_can_be_shuffled_forbid_chaos():
    both = {"exponent": EXPONENTS["for"], "dimension": DIMENSIONS["for"], "entropy": ENTROPIES["for"]}
    assert judge_motion(evidence(**both, ranks=(0.01, 0.01))).strength == "firm"
    found = judge_motion(evidence(**both, ranks=(0.01, 0.4)))
    assert found.motion == "undecided"
    assert "1 against it (order of the cycles)" in found.says


def test_growth_in_a_motion_that_comes_back_is_said():
    x = np.sin(2.0 * np.pi * 0.02 * np.arange(1500) / PERIOD)
    calm, odd = (judge_motion(evidence(x=x, exponent=EXPONENTS[k])) for k in ("against", "for"))
    assert (calm.motion, calm.strength) == ("periodic", "firm")
    assert (odd.motion, odd.strength) == ("periodic", "likely")
    assert "contradicts" in odd.says


@pytest.mark.parametrize("what", ["size", "pace"])
def test_a_motion_that_changes_is_told_nothing_of(what):
    t = np.linspace(0.0, 1.0, 8000)
    x = {"size": np.exp(-4.0 * t) * np.sin(900.0 * t), "pace": np.sin(1000.0 * t**4)}[what]
    found = judge_motion(evidence(x=x, period=None))
    assert found.motion == "undecided"
    assert f"The {what} of the motion changes" in found.says


@pytest.mark.parametrize(
    ("ratio", "periods", "after"), [(1.3333, 21, 3), (1.25, 21, 4), (0.6180, 400, 0), (1.4142, 400, 0), (1.25, 400, 4)]
)
def test_frequencies_are_told_apart_as_far_as_a_recording_resolves_them(ratio, periods, after):
    """A beam in one well at 4/3 of its drive: four seconds of it were called quasiperiodic."""
    assert _find_common_period(ratio, OPTIONS.resolution / periods) == after


def find_plateau(rows, first=3):
    """Return a curve of local slopes (dims, radii) over four octaves, and the plateau that was claimed in it."""
    radius = np.geomspace(0.01, 0.16, rows.shape[1])
    return {"radius": radius, "slope": rows}, SimpleNamespace(ends=(0.01, 0.16), first=first, mean=2.0)


def test_flatness_is_that_of_a_loop_over_dimensions_and_radii():
    rows = 2.0 + 0.1 * np.random.default_rng(0).normal(size=(7, 33))
    curve, claimed = find_plateau(rows)
    square, mean = 0.0, np.zeros(33)
    for m in range(2, 7):
        for k in range(33):
            square += (rows[m, k] - 2.0) ** 2 / (5 * 33)
            mean[k] += rows[m, k] / 5
    u = np.log2(curve["radius"]) - np.log2(curve["radius"]).mean()
    slope = sum(u[k] * mean[k] for k in range(33)) / sum(u[k] ** 2 for k in range(33))
    assert measure_flatness(curve, claimed) == pytest.approx((abs(slope) * 4.0 / 2.0, np.sqrt(square) / 2.0))


@pytest.mark.parametrize(
    ("rows", "flat"),
    [
        (np.full((7, 33), 2.0), True),
        (np.tile(np.linspace(1.5, 2.5, 33), (7, 1)), False),
        (np.where(np.arange(7)[:, None] > 4, np.linspace(2.0, 8.0, 33), 2.0), False),
        (np.full((7, 33), np.nan), False),
    ],
    ids=["flat", "leaning", "higher dimensions go their own way", "nothing"],
)
def test_a_plateau_has_to_be_one(rows, flat):
    tilt, scatter = measure_flatness(*find_plateau(rows))
    assert (tilt <= MOST_TILT and scatter <= MOST_SCATTER) == flat
