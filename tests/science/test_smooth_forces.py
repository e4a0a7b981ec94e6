"""Smooth forces of the discrepancy: a constant and a straight line are not among them, because they have names."""

import numpy as np
import pytest
from explained import ODDS, made_of

from lostmotion.contracts import place_of
from lostmotion.evidence.discrepancy import make_frame
from lostmotion.evidence.smooth_forces import LARGE, LENGTHS, LINED, SIZES, USUAL_OPTIONS
from lostmotion.inference.curves import add_all_curves, compute_coefficient_size, smooth_motions
from lostmotion.inference.learned import LEFT, OverPosition, OverTime, OverVelocity
from lostmotion.inference.natural import find_term
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout


@pytest.fixture(scope="module")
def wide(tmp_path_factory):
    """The nominal fit of an oscillator, in a system with every curve."""
    prepared, system = made_of(tmp_path_factory.mktemp("plain"), lambda x, v, t: 0.0)
    train, _ = split_heldout(prepared.observations)
    return add_all_curves(
        search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    )


def follow(fit, kind):
    """Return a curve of a fit, and where the recorded motion was (samples,), in half widths from its middle."""
    posterior = fit.posterior
    curve, _ = find_term(posterior, kind.name)
    place = place_of(posterior.system.model, curve)
    seen = smooth_motions(fit, [place])[place.name][0][int(kind is OverVelocity)]
    index, full = posterior.system.index, posterior.known
    return curve, np.clip((seen - full[index[f"{kind.name}.middle"]]) / full[index[f"{kind.name}.half"]], -1.0, 1.0)


@pytest.mark.parametrize("kind", [OverPosition, OverVelocity])
def test_sines_have_no_constant_and_no_line_along_the_motion(wide, kind):
    curve, z = follow(wide, kind)
    functions = curve.basis(z)
    assert functions[:, :2] == pytest.approx(np.column_stack([np.ones_like(z), z]))
    assert functions[:, 2:].T @ functions[:, :2] / len(z) == pytest.approx(0.0, abs=1e-2)
    raised, fell = (curve.basis(z + step) for step in (1e-6, -1e-6))
    inside = np.abs(z) < 0.99
    assert ((raised - fell) / 2e-6)[inside] == pytest.approx(curve.slopes(z)[inside], abs=1e-6)


@pytest.mark.parametrize("kind", [OverPosition, OverVelocity])
def test_the_size_of_a_force_without_lines_is_its_deviation_along_the_motion(wide, kind):
    """With lines it is that of the whole force; what bends has a third of it where the force is long."""
    curve, z = follow(wide, kind)
    for length in LENGTHS:
        spread = curve.bent_spread(length, curve.count)
        assert spread[:2] == pytest.approx(LEFT)
        assert np.mean(curve.basis(z)[:, 2:] ** 2 @ spread[2:] ** 2) == pytest.approx(1.0, rel=0.05)


def test_a_force_over_the_time_has_no_mean():
    z = np.linspace(-1.0, 1.0, 401)
    assert OverTime().basis(z)[:, 1:].mean(axis=0) == pytest.approx(0.0, abs=1e-3)


def test_the_table_of_the_kernel_is_the_sum_of_the_functions(wide):
    curve, _ = find_term(wide.posterior, OverPosition.name)
    rng = np.random.default_rng(1)
    weights = rng.standard_normal(curve.count) * curve.spread(0.6)
    table = curve.prepared(np.concatenate([weights, [0.01, 0.05]])[None])[0]
    for z in (-0.8, 0.1, 0.6):
        force = curve.force(0.0, 0.01 + 0.05 * z, 0.0, np.zeros(1), tuple(table), ())
        assert force == pytest.approx(float(curve.basis(np.array([z]))[0] @ weights), rel=1e-3, abs=1e-4)


def test_a_force_of_a_large_size_may_have_a_line_at_the_odds_of_a_term(wide):
    posterior = wide.posterior
    frame = make_frame(posterior, posterior.space.start, (), ODDS, LARGE)
    over = next(force for force in frame.forces if force.key == OverPosition.name)
    bent, lined = len(LARGE) * len(LENGTHS), sum(size >= LINED for size in LARGE) * len(LENGTHS)
    having = over.straight > 0.0
    assert having.sum() == lined
    assert len(over.options) == bent + lined
    usual = make_frame(posterior, posterior.space.start, (), ODDS).forces[frame.forces.index(over)]
    assert np.array_equal(over.options[:USUAL_OPTIONS], usual.options)
    at, none = frame.forces.index(over), list(frame.none)
    first = [int(np.flatnonzero(which)[0]) for which in (~having, having)]
    without, line = ((*none[:at], option, *none[at + 1 :]) for option in first)
    bent = [(*none[:at], int(option), *none[at + 1 :]) for option in over.bent[first[1]]]
    assert frame.make_room(line) == list(dict.fromkeys([line, frame.none, *bent]))
    assert frame.make_room(bent[0]) == [bent[0], frame.none]
    twin = over.options[over.bent[first[1], SIZES.index(LINED)]]
    assert twin[:2] == pytest.approx(
        LEFT * LINED * compute_coefficient_size(find_term(posterior, over.key)[0], posterior)
    )
    assert np.all(twin[:2] < 0.3 * over.options[first[1], :2])
    sizes = over.options[over.bent[first[1]], 2]
    assert sizes / sizes[0] == pytest.approx(np.array(SIZES) / SIZES[0])
    assert frame.price(line) - frame.price(without) == pytest.approx(2.0 * ODDS)
    assert frame.price(without) == pytest.approx(np.log(len(over.options)))


def test_a_law_may_take_the_place_of_any_one_smooth_force(wide):
    frame = make_frame(wide.posterior, wide.posterior.space.start, (), ODDS)
    choice = (3, 2, *frame.none[2:])
    room = frame.make_room(choice)
    assert room[:4] == [choice, frame.none, (-1, 2, *frame.none[2:]), (3, -1, *frame.none[2:])]
