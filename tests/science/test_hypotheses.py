"""One score for each explanation: closed forms against their slow twins, and machines with known answers."""

import copy
import math
from dataclasses import replace

import numpy as np
import pytest
from explained import ODDS, made_of
from scipy.integrate import quad
from scipy.interpolate import CubicSpline
from scipy.special import logsumexp

from lostmotion.diagnosis.compare import cut_heldout
from lostmotion.diagnosis.stages import list_fitted_keys
from lostmotion.evidence import discrepancy, weighing
from lostmotion.evidence.bare import BareFits, Budget
from lostmotion.evidence.channel_errors import DriveError, ScaleError, SensorError, list_channel_errors
from lostmotion.evidence.discrepancy import list_known_values, make_frame
from lostmotion.evidence.effects import Promise
from lostmotion.evidence.expansion import Expansion, compute_log_evidence
from lostmotion.evidence.hypothesis import fit_hypothesis
from lostmotion.evidence.probabilities import compute_probabilities
from lostmotion.evidence.search import ExplanationSearch
from lostmotion.evidence.smooth_forces import LENGTHS, SIZES
from lostmotion.inference.candidates import add_term, join_term
from lostmotion.inference.curves import add_all_curves
from lostmotion.inference.fit import ROUGHLY, begin_at, choose_first_steps, hold_free, maximise
from lostmotion.inference.late import find_onset
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.kernels.linear_response import respond, respond_plainly
from lostmotion.likelihood.innovations import Innovations
from lostmotion.likelihood.system import ALWAYS, onset_key
from lostmotion.likelihood.tangents import linearise_filter


def rub(x, v, t):
    """Return dry friction of 0.8 N (N), without sticking."""
    return -0.8 * np.tanh(v / 1e-3)


def nothing(x, v, t):
    """Return no force (N)."""
    return 0.0


def bend(x, v, t):
    """Return a smooth force (N) over the position that no term of the library has."""
    return 0.8 * math.sin(40.0 * x) * math.exp(-((x / 0.03) ** 2))


def start_search(folder, extra, *, budget=600.0):
    """Return the search for explanations of a recording of an oscillator with a further force."""
    prepared, system = made_of(folder, extra)
    train, held = split_heldout(prepared.observations)
    nominal = search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    pieces = [(piece.observation, piece.begin) for piece in cut_heldout(prepared.observations, held)]
    return ExplanationSearch(nominal, list_fitted_keys(system), pieces, Budget(seconds=budget))


def make_expansion(errors, variances=None, precision=None):
    """Return an expansion with given derivatives of errors of unit variance, about zero."""
    rng = np.random.default_rng(3)
    n, readings = errors.shape
    here = Innovations(rng.standard_normal(readings), np.ones(readings), np.array(True))
    none = np.zeros_like(errors) if variances is None else variances
    precision = np.zeros(n) if precision is None else precision
    blocks = {"own": slice(0, 1), "a": slice(1, 2), "b": slice(2, n)}
    return Expansion(here, np.zeros(n), errors, none, np.zeros(n), precision, blocks)


def test_the_evidence_of_a_coefficient_is_the_integral_over_its_prior():
    gradient, information, width = 7.0, 11.0, 0.4

    def density(x):
        return math.exp(gradient * x - 0.5 * information * x * x - 0.5 * (x / width) ** 2) / (
            width * math.sqrt(2.0 * math.pi)
        )

    integral = quad(density, -5.0, 5.0, epsabs=1e-12)[0]
    found = compute_log_evidence(np.array([gradient]), np.array([[information]]), np.array([width]))
    assert found == pytest.approx(math.log(integral), abs=1e-9)


def test_a_coefficient_without_width_adds_nothing():
    h = np.array([[5.0, 1.0], [1.0, 4.0]])
    alone = compute_log_evidence(np.array([2.0]), h[:1, :1], np.array([0.3]))
    assert compute_log_evidence(np.array([2.0, 9.0]), h, np.array([0.3, 0.0])) == pytest.approx(alone, abs=1e-12)
    assert compute_log_evidence(np.array([2.0, 9.0]), h, np.zeros(2)) == 0.0


def test_profiling_is_the_regression_on_the_own_coordinates():
    rng = np.random.default_rng(1)
    errors = rng.standard_normal((4, 500))
    expansion = make_expansion(errors)
    gradient, information = expansion.curvature.profile(np.array([0]), np.array([1, 2, 3]))
    own, more = errors[0], errors[1:]
    residuals = more - np.outer(more @ own / (own @ own), own)
    assert information == pytest.approx(residuals @ residuals.T, rel=1e-9)
    assert gradient == pytest.approx(-residuals @ expansion.here.errors, rel=1e-6, abs=1e-9)


def test_the_scatter_of_independent_scores_is_one_and_that_of_correlated_ones_is_larger():
    rng = np.random.default_rng(4)
    slopes = rng.standard_normal((24, 8000))
    slopes[1:] = np.cumsum(slopes[1:], axis=1) / 90.0  # slow effects feel slow errors
    expansion = make_expansion(slopes)
    assert expansion.measure_scatter(("b",)) < 1.6
    slow = np.convolve(rng.standard_normal(8100), np.ones(100) / 10.0, mode="valid")[:8000]
    here = Innovations(slow, np.ones(8000), np.array(True))
    correlated = Expansion(
        here, np.zeros(24), slopes, np.zeros_like(slopes), np.zeros(24), np.zeros(24), expansion.blocks
    )
    assert correlated.measure_scatter(("b",)) > 10.0


def test_the_linear_response_equals_its_plain_twin():
    rng = np.random.default_rng(5)
    n, samples, sensors = 2, 40, 2
    steps = 0.3 * rng.standard_normal((samples, n, n))
    roots = rng.standard_normal((samples, n, n))
    ahead = roots @ roots.transpose(0, 2, 1)
    slopes = 0.5 * rng.standard_normal((samples, sensors, n + 2))
    spread = rng.uniform(6.0, 9.0, (samples, sensors))
    spread[7, 1] = math.inf
    turn, noise = np.array([[0.7, -0.2], [0.1, 0.5]]), np.array([[0.2, 0.05], [0.05, 0.1]])
    told = (steps, ahead, slopes, spread, turn, 0.5 * noise, noise, 0.01)
    forces, seen = rng.standard_normal((3, samples, n)), rng.standard_normal((3, samples, sensors))
    found = respond(*told, forces, seen)
    assert found == pytest.approx(respond_plainly(*told, forces, seen), rel=1e-10, abs=1e-12)
    assert np.all(found[:, 7, 1] == 0.0)


@pytest.fixture(scope="module")
def rubbing(tmp_path_factory):
    """Return the search for a machine with dry friction, after its run."""
    return start_search(tmp_path_factory.mktemp("rub"), rub).run()


def test_a_fit_begins_at_the_hypothesis_of_another_noise_where_that_is_more_likely(rubbing, monkeypatch):
    begun, seed = [], rubbing.best
    monkeypatch.setattr(weighing, "fit_hypothesis", lambda *told: begun.append(told) or fit_hypothesis(*told))
    again = ExplanationSearch(
        rubbing.nominal, rubbing.keys, rubbing.pieces, Budget(seconds=600.0), errors=rubbing.errors, seeds=rubbing.found
    )
    again.weigh(rubbing.bare.fits[seed.terms])
    (_, at, _, choice), *_ = begun
    assert choice == seed.choice
    assert at == pytest.approx(seed.at)
    assert again.best.score() == pytest.approx(seed.score(), abs=0.5)


@pytest.mark.parametrize("bent", [{}, {"cosine": 1e-3, "sine": -7e-4, "pitch": 0.03}])
def test_derivatives_of_the_linearised_filter_equal_differences(rubbing, monkeypatch, bent):
    """With the values of `bent`, the sensor has a wave of error whose slope is up to 0.26."""
    posterior, key = rubbing.bare.nominal.posterior, "position_ripple"
    begun = begin_at(posterior, rubbing.bare.nominal.theta)
    if bent:
        begun = add_term(begun, key, {f"{key}.{name}": v for name, v in bent.items()})
    frame = make_frame(begun, begun.space.start, rubbing.errors, ODDS)
    steps = choose_first_steps(begun)
    fast = frame.expand(frame.start, steps, frame.none)
    monkeypatch.setattr(discrepancy, "linearise_filter", lambda *_: None)
    slow = frame.expand(frame.start, steps, frame.none)
    assert fast.here.log_likelihood == pytest.approx(slow.here.log_likelihood, abs=1e-6)
    typical = tuple(len(SIZES) * len(LENGTHS) + LENGTHS.index(0.6) for _ in frame.forces)  # with their lines
    sizes = np.concatenate([np.ones(frame.own), frame.widths(typical)])[:, None]
    for block in fast.blocks.values():  # the shortest waves turn within a sample, and have little weight in the prior
        apart = np.linalg.norm((sizes * (fast.errors - slow.errors))[block])
        assert apart < 0.05 * np.linalg.norm((sizes * slow.errors)[block])


def test_a_recording_does_not_tell_the_scales_of_its_channels(rubbing):
    """A machine and its forces may be one per cent larger; its sensor, or the machine one per cent smaller."""
    frame = make_frame(rubbing.nominal.posterior, rubbing.nominal.theta, rubbing.errors, ODDS)
    found = frame.expand(frame.start, choose_first_steps(rubbing.nominal.posterior), frame.none)
    rows = dict(zip(frame.names, found.errors, strict=True))
    sensor, drive = (f"channel error {i}" for i in (0, 3))
    sizes = {name: np.linalg.norm(row) for name, row in rows.items()}
    machine = rows["m"] + rows["c"] + rows["k"]
    assert np.linalg.norm(machine + rows[drive] + 2.0 * rows["log_random_force"]) < 1e-4 * sizes[drive]
    assert np.linalg.norm(rows[sensor] - machine) < 0.2 * sizes[sensor]  # its shape follows the random force


def test_points_near_another_take_its_steps(rubbing):
    """Errors are smooth along a parameter: their second differences fall with the square of the step."""
    posterior, theta = rubbing.nominal.posterior, rubbing.nominal.theta

    def bend(step):
        points = theta + step * np.array([0.0, 1.0, -1.0])[:, None] * (np.arange(len(theta)) == 0)
        _, seen = linearise_filter(posterior, points)
        return np.linalg.norm(seen.errors[1] + seen.errors[2] - 2.0 * seen.errors[0]) / step**2

    assert bend(1e-3) == pytest.approx(bend(1e-2), rel=0.05)


def test_a_correction_of_a_sensor_has_the_shape_of_its_predicted_readings(rubbing):
    observation = rubbing.nominal.posterior.observations[0]
    bent, *_ = (error for error in rubbing.errors if isinstance(error, SensorError))
    changed = bent.correct(observation, 0.01).readings - observation.readings
    middle = np.mean(observation.readings)
    half = np.abs(observation.readings - middle).max()
    assert changed == pytest.approx(0.01 * half * ((observation.readings - middle) / half) ** 2, abs=3e-4 * half)
    part = observation.part(100, 300)
    assert bent.correct(part, 0.01).readings - part.readings == pytest.approx(changed[100:300], abs=1e-15)


@pytest.mark.parametrize("size", [-0.03, 0.03])
def test_the_scale_of_the_only_sensor_of_a_free_machine_changes_no_likelihood(rubbing, size):
    """Drive and sensor have units of their own: parameters take up the change, whatever the errors of the model are.

    With readings that were scaled by their predictions the likelihood of a carriage changed by 81.
    """
    nominal = rubbing.nominal
    scaled = nominal.posterior.on(
        tuple(ScaleError(0, 0.01).correct(one, size) for one in nominal.posterior.observations)
    )
    known = [f for f in list_known_values(nominal.posterior) if f.parameter == "m"]
    free = replace(known[0], low=known[0].mean - 1.0, high=known[0].mean + 1.0, sd=10.0)
    before, after = (maximise(one.over((*one.space.free, free)), np.append(nominal.theta, free.mean))
                     for one in (nominal.posterior, scaled))  # fmt: skip
    assert after.log_likelihood == pytest.approx(before.log_likelihood, abs=0.3)
    assert after.values["m"] / before.values["m"] == pytest.approx(1.0 / (1.0 + size), rel=2e-3)


def test_a_delay_of_the_drive_is_half_a_sample_at_a_size_of_minus_one_half(rubbing):
    observation = rubbing.nominal.posterior.observations[0]
    late = next(e for e in rubbing.errors if isinstance(e, DriveError) and e.late)
    moved = late.correct(observation, -0.5).inputs[:, 0]
    places = np.arange(observation.samples)
    shift = CubicSpline(places, observation.inputs[:, 0])(places - 0.5) - observation.inputs[:, 0]
    made = moved - observation.inputs[:, 0]
    assert np.corrcoef(made[5:-5], shift[5:-5])[0, 1] > 0.97
    assert np.std(made) == pytest.approx(np.std(shift), rel=0.1)


def test_every_sensor_has_three_errors_and_every_drive_two(rubbing):
    errors = list_channel_errors(rubbing.nominal, list(rubbing.nominal.posterior.observations))
    assert [type(error) for error in errors] == [ScaleError] + [SensorError] * 2 + [DriveError] * 2


def test_dry_friction_is_the_explanation_with_the_true_damping(rubbing):
    shares = compute_probabilities(rubbing.found.values(), rubbing.best.scatter)
    friction = sum(p for terms, p in shares.items() if any("friction" in key for key in terms))
    assert friction > 0.95
    best = rubbing.best
    assert best.terms == {"coulomb_friction"}
    sd = math.sqrt(
        best.covariance[list(best.frame.posterior.space.keys).index("c")][
            list(best.frame.posterior.space.keys).index("c")
        ]
    )
    free = next(f for f in best.frame.posterior.space.free if f.key == "c")
    c, spread = free.value(best.values["c"]), sd * (free.value(best.values["c"]) if free.log else 1.0)
    assert abs(c - 0.8) < 3.0 * spread


def test_the_score_without_the_term_contains_the_best_smooth_force(rubbing):
    """The smooth force explains most of the friction: both hypotheses have paid for the same discrepancy."""
    found = rubbing.found
    assert frozenset() in found
    bare = found[frozenset()]
    assert bare.smooth > 5.0
    assert bare.log_evidence < found[frozenset({"coulomb_friction"})].log_evidence


@pytest.mark.slow
def test_nothing_is_named_in_a_clean_machine(tmp_path):
    found = start_search(tmp_path, nothing).run()
    assert found.best.terms == frozenset()
    assert compute_probabilities(found.found.values(), found.best.scatter)[frozenset()] > 0.9


@pytest.mark.slow
def test_a_smooth_force_outside_the_library_gets_no_name(tmp_path):
    found = start_search(tmp_path, bend).run()
    shares = compute_probabilities(found.found.values(), found.best.scatter)
    keys = {key for terms in shares for key in terms}
    assert all(sum(p for terms, p in shares.items() if key in terms) < 0.95 for key in keys)


def test_a_search_without_time_has_the_hypothesis_of_nothing_missing(tmp_path):
    found = start_search(tmp_path, rub, budget=0.0).run()
    assert set(found.found) == {frozenset()}
    assert found.skipped == ["no term"]


def test_probabilities_are_the_softmax_of_the_scores(rubbing):
    shares = compute_probabilities(rubbing.found.values(), 2.0)
    scores = {h.terms: (h.log_evidence + h.heldout) / 2.0 - h.price for h in rubbing.found.values()}
    total = logsumexp(list(scores.values()))
    assert shares == pytest.approx({terms: math.exp(score - total) for terms, score in scores.items()}, abs=1e-9)


def test_a_hypothesis_from_its_own_maximum_stays_there(rubbing):
    best = rubbing.best
    again = fit_hypothesis(best.frame, best.at, best.price, best.choice)
    assert again.log_evidence == pytest.approx(best.log_evidence, abs=0.5)
    assert add_all_curves(rubbing.bare.nominal) is rubbing.bare.nominal


def test_a_promise_in_other_parameters_is_fitted_anew(rubbing):
    """The known fit of the law may hold what the promise has as a free parameter."""
    search, key, nothing = copy.copy(rubbing), "coulomb_friction", rubbing.found[frozenset()]
    posterior = rubbing.bare.fits[frozenset({key})].posterior
    held = maximise(hold_free(posterior, posterior.space.keys.index(f"{key}.force"), 0.5), tolerance=ROUGHLY)
    search.found, search.bare = {frozenset(): nothing}, replace(rubbing.bare, fits={frozenset(): rubbing.bare.nominal})
    search.bare.keep(held)
    promise = Promise(key, 10.0, {f"{key}.force": 0.8}, np.zeros(nothing.frame.count), nothing.frame.none)
    search._weigh_beside(nothing, promise)
    assert search.found[frozenset({key})].values[f"{key}.force"] == pytest.approx(0.8, abs=0.02)


@pytest.mark.parametrize("option", [0, 5, 10])
def test_the_evidence_is_that_of_the_forces_of_a_hypothesis(rubbing, option):
    """Forces that are left out leave the point, too: a likelihood that contains them has not paid for them."""
    best = rubbing.found[frozenset({"coulomb_friction"})]
    frame, every = best.frame, (option,) * len(best.frame.forces)
    begin = best.at.copy()
    begin[frame.own :] += 0.1 * frame.widths(every) * (frame.widths(frame.none) == 0.0)
    found = fit_hypothesis(frame, begin, best.price, every)
    seen = frame.log_likelihood(found.at, found.choice)
    assert seen == pytest.approx(float(found.expansion.here.log_likelihood), abs=1e-6)
    assert not np.any(found.at[frame.own :][frame.widths(found.choice) == 0.0])


@pytest.mark.parametrize(("behind", "smooth", "proposed"), [(20.0, 3.0, True), (20.0, 0.0, False)])
def test_laws_are_proposed_in_place_of_the_best_one(rubbing, monkeypatch, behind, smooth, proposed):
    """The model without any term is worse by `behind`, and has a smooth force with this log evidence."""
    best, asked = rubbing.best, []
    search = copy.copy(rubbing)
    nothing = replace(rubbing.found[frozenset()], log_evidence=best.log_evidence - behind, smooth=smooth)
    search.found, search.proposed = {best.terms: best, frozenset(): nothing}, set()
    monkeypatch.setattr(BareFits, "list_promises", lambda self, beside, known: asked.append(beside) or [])
    search._replace_each()
    search._replace_each()
    assert [one.terms for one in asked] == ([frozenset()] if proposed else [])


def test_promises_are_of_fitted_and_heldout_data(rubbing):
    """The score is of all data; what promises more in the fitted part alone may have a lower score."""
    nothing = rubbing.found[frozenset()]
    whole = rubbing._expand_whole(nothing)
    (observation, _), *others = rubbing.pieces
    assert not others
    assert len(whole.expansion.here.errors) == observation.samples * len(observation.sensors)
    assert len(nothing.expansion.here.errors) < len(whole.expansion.here.errors)
    assert whole.frame.bare(whole.at, whole.choice).log_likelihood(
        whole.at[: len(whole.frame.posterior.space.free)]
    ) == (pytest.approx(float(whole.expansion.here.log_likelihood)))


def test_a_set_is_not_worse_than_its_subset(rubbing):
    """A law whose fit predicts held-out data badly is fitted again beside the smooth forces of nothing missing."""
    nothing, terms = rubbing.found[frozenset()], frozenset({"coulomb_friction"})
    low = replace(rubbing.found[terms], heldout=nothing.heldout - 1e3)
    search = copy.copy(rubbing)
    search.found = {frozenset(): nothing, terms: low}
    search._lift(low)
    lifted = search.found[terms]
    assert lifted.choice == nothing.choice
    assert lifted.log_profile > nothing.log_profile - 1.0
    search._lift(lifted)
    assert search.found[terms] is lifted


def test_no_recording_tells_the_unit_of_force(rubbing):
    """All that has the unit of force, changed together with the scale of the drive, leaves the errors as they are."""
    best = rubbing.best
    frame, seen = best.frame, best.expansion
    change = np.zeros(frame.count)
    (scale,) = [i for i, one in enumerate(frame.errors) if isinstance(one, DriveError) and not one.late]
    for i, name in enumerate(frame.names):
        change[i] = {"c": 1.0, "k": 1.0, "m": 1.0, "log_random_force": 1.0}.get(name, 0.0)
        change[i] = best.at[i] if name == "coulomb_friction.force" else change[i]
    drive = seen.errors[frame.channels.start + scale]
    left = change @ seen.errors
    left -= (left @ drive) / (drive @ drive) * drive
    known = 1.0 / rubbing.nominal.posterior.settings.rival.known**2
    assert np.sum(left**2 / seen.here.variances) < 0.01 * known


@pytest.mark.parametrize(("more", "kept"), [(8.0, True), (12.0, False)])
def test_a_law_that_adds_less_than_the_discrepancy_is_no_name(rubbing, monkeypatch, more, kept):
    """A cubic spring adds 10 beside friction, which adds 500; the discrepancy adds `more` to both.

    If it is no name, nothing is proposed beside it.
    """
    rub, cubic = frozenset({"coulomb_friction"}), frozenset({"cubic_stiffness"})
    base = rubbing.found[frozenset()]
    search = copy.copy(rubbing)
    search.found = {}
    for terms, score in ((frozenset(), 0.0), (rub, 500.0), (cubic, 40.0), (rub | cubic, 510.0)):
        frame = replace(base.frame, posterior=base.frame.posterior.acting(terms))
        search.found[terms] = replace(base, frame=frame, log_evidence=score, price=0.0)
    monkeypatch.setattr(ExplanationSearch, "_drop_each", lambda self: None)
    monkeypatch.setattr(ExplanationSearch, "_measure_leftover", lambda self, found: more)
    monkeypatch.setattr(ExplanationSearch, "_drop", lambda self, target, key, less: None)
    proposed = []
    monkeypatch.setattr(ExplanationSearch, "_weigh_promised", lambda self, target: proposed.append(target.terms))
    search._extend(replace(search.found[rub | cubic], smooth=1.0))
    assert bool(proposed) == kept
    search.leave_out_sharers()
    assert set(search.found) == {frozenset(), rub, cubic} | ({rub | cubic} if kept else set())


def test_the_leftover_of_the_right_law_is_small(rubbing):
    assert rubbing._measure_leftover(rubbing.best) < 0.0 < rubbing._measure_leftover(rubbing.found[frozenset()])


@pytest.mark.parametrize("onset", [3.0, ALWAYS])
def test_a_law_with_an_onset_is_weighed_without_it_as_well(tmp_path, onset):
    """Friction that acts from the beginning has no onset, even where its bare fit has one; late friction keeps it."""
    search = start_search(tmp_path, lambda x, v, t: rub(x, v, t) if t > onset else 0.0)
    search.weigh(search.nominal)
    start = {"coulomb_friction.force": 0.8, onset_key("coulomb_friction"): 3.0}
    search.weigh(maximise(join_term(search.bare.fits[frozenset()].posterior, "coulomb_friction", start)))
    found = search.found[frozenset({"coulomb_friction"})]
    bare = search.bare.fits[found.terms]
    assert find_onset(found.frame.posterior, "coulomb_friction") == onset
    assert find_onset(bare.posterior, "coulomb_friction") == onset


def test_the_leading_set_of_several_laws_is_weighed_and_taken_apart_first(tmp_path, monkeypatch):
    """Where smooth forces leave much that its laws explain, proposals from nothing would use up the budget."""
    search, weighed = start_search(tmp_path, lambda x, v, t: rub(x, v, t) + 0.5), []

    def end(self, terms):
        weighed.append((terms, set(self.found)))
        self.budget.end()

    monkeypatch.setattr(ExplanationSearch, "_reduce", end)
    search.run()
    ((lead, known),) = weighed
    assert len(lead) == 2
    assert known == {frozenset(), lead}


def test_a_gain_is_the_score_that_a_law_adds_to_the_best_set(rubbing):
    best, nothing = rubbing.best, rubbing.found[frozenset()]
    assert best.terms == frozenset({"coulomb_friction"})
    assert rubbing.measure_gain(best, "coulomb_friction") == pytest.approx(best.score() - nothing.score())
    assert rubbing.measure_gain(best, "cubic_stiffness") == 0.0
