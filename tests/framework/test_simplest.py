"""Which set of terms is reported where a generic smooth force explains as much, or where a term was refuted."""

from types import SimpleNamespace

import numpy as np
import pytest

from lostmotion.diagnosis import confirming
from lostmotion.diagnosis import search as searching
from lostmotion.diagnosis.compare import PARTS
from lostmotion.inference.term_sets import Selection, TermSet
from lostmotion.settings import DEFAULT

NOTHING = SimpleNamespace(active=frozenset())


@pytest.mark.parametrize(
    ("weights", "scores", "curve", "chosen"),
    [
        ({"a": 40.0}, {"a": 9.0, "smooth": 10.0, "": 0.0}, 30.0, "a"),
        ({"a": 40.0}, {"a": 9.0, "smooth": 10.0, "": 0.0}, 41.0, None),
        ({"a": 40.0}, {"a": 2.0, "smooth": 10.0, "": 0.0}, 30.0, None),
        ({"a": 40.0}, {"a": 9.0, "smooth": 10.0, "": 9.5}, 30.0, None),
        ({"a": 40.0, "ab": 42.0}, {"a": 9.0, "ab": 9.0, "smooth": 10.0, "": 0.0}, 30.0, "a"),
        ({"a": 40.0, "ab": 45.0}, {"a": 9.0, "ab": 9.0, "smooth": 10.0, "": 0.0}, 30.0, "ab"),
        ({"a": 40.0, "b": 41.0}, {"a": 9.0, "b": 1.0, "smooth": 10.0, "": 0.0}, 30.0, "a"),
        ({"a": 40.0, "b": 40.0}, {"a": 9.0, "b": 9.0, "smooth": 10.0, "": 0.0}, 30.0, "a"),
        ({"a": 40.2, "b": 40.0, "c": 40.0}, {"a": 9.0, "b": 9.0, "c": 9.0, "smooth": 10.0, "": 0.0}, 30.0, None),
        ({"a": 11.4}, {"a": 9.0, "smooth": 10.0, "": 0.0}, 0.0, None),
        ({"l": 40.0}, {"l": 9.0, "smooth": 10.0, "": 0.0}, 30.0, None),
        ({"u": 40.0}, {"u": 9.0, "smooth": 10.0, "": 0.0}, 30.0, "u"),
        ({"au": 40.0}, {"au": 9.0, "smooth": 10.0, "": 0.0}, 30.0, None),
    ],
)
def test_a_law_better_than_any_curve_is_the_simplest_explanation(monkeypatch, weights, scores, curve, chosen):
    """It beats the learned curve and the usual channel errors (8.5 fitted), and predicts held-out data as well.

    Three terms that are about equally probable are no explanation; a term that predicts worse does not count. With `l`
    a random force is left. `u` is a delay that is usual in acquisition systems; it may be the only term.
    """
    fits = {k: SimpleNamespace(status="converged", key=k, problem=NOTHING) for k in scores}
    nominal = SimpleNamespace(problem=SimpleNamespace(active=frozenset(), settings=DEFAULT))
    fitted_sets = {frozenset(k): TermSet(frozenset(k), fits[k], weights.get(k, 0.0)) for k in ("", *weights)}
    smooth = SimpleNamespace(fit=fits["smooth"], compute_gain=lambda inflation: 8.5)
    expansion = SimpleNamespace(inflation=1.0, compute_fixed_gain=lambda worse: 9.0)
    selection = Selection(nominal, nominal, fitted_sets)
    monkeypatch.setattr(Selection, "discrepancy_fit", lambda self, term_set: smooth)
    monkeypatch.setattr(Selection, "expansion", lambda self, term_set: expansion)
    monkeypatch.setattr(confirming, "compute_random_force_gain", lambda fit: 50.0 * (fit.key == "l"))
    monkeypatch.setattr(confirming, "delay_in_samples", lambda fit, key: 0.1 if key == "u" else np.inf)
    monkeypatch.setattr(confirming, "score_heldout", lambda fit, pieces: scores[fit.key])
    monkeypatch.setattr(confirming, "compute_run_errors", lambda fit, pieces, horizon: np.ones(PARTS))
    monkeypatch.setattr(confirming, "cut_heldout", lambda observations, held: ())
    learned = SimpleNamespace(gain=curve, fit=fits["smooth"])
    d = SimpleNamespace(
        selection=selection, learned=learned, unexplained=False, held=(), settings=DEFAULT, after=fits["smooth"]
    )
    found = confirming.find_simplest(
        SimpleNamespace(diagnosis=d, horizon=None, after=SimpleNamespace(errors=np.ones(PARTS))), ()
    )
    assert (found and found[0].key) == chosen
    if found and [*weights] == ["a"]:
        assert found[1].probabilities["a"] == pytest.approx(DEFAULT.name.simplest / (1.0 + np.exp(-10.0)))
    if found:
        simplest = found[1]
        alone = sum(p for key, p in simplest.probabilities.items() if [*weights] in (["a"], ["a", "b"], ["u"]))
        assert simplest.nothing < 1e-15
        assert not alone or alone + simplest.unknown + simplest.nothing == pytest.approx(1.0)


def test_a_refuted_term_gives_way_to_a_simpler_set_that_was_visited(monkeypatch):
    """Friction with a wave is refuted: plain friction, which is ahead of nothing, takes its place."""
    free = SimpleNamespace(settings=DEFAULT)
    fits = {k: SimpleNamespace(status="converged", key=k, problem=free) for k in ("", "wave", "plain", "weak")}
    fits["wave"].problem = SimpleNamespace(settings=DEFAULT, active=frozenset({"wave"}))
    weights = {"": 0.0, "wave": 90.0, "plain": 50.0, "weak": 60.0}
    fitted_sets = {
        frozenset([k] if k else []): TermSet(frozenset([k] if k else []), fits[k], w) for k, w in weights.items()
    }
    leads = {"plain": 20.0, "weak": 1.0}
    monkeypatch.setattr(Selection, "settle_comparison", lambda self, term_set, over, needed: None)
    monkeypatch.setattr(Selection, "compute_log_odds", lambda self, term_set, over: leads["".join(term_set.terms)])
    selection = Selection(fits[""], fits["wave"], fitted_sets)
    assert searching._drop_term(selection, "wave").chosen.key == "plain"
    leads["plain"] = 2.0
    assert searching._drop_term(selection, "wave").chosen.key == ""


def test_sets_with_a_term_that_held_out_data_refute_have_no_probability(monkeypatch):
    """Offset and damping predict held-out data better than the friction that is far more probable on fitted data."""

    def fit(*keys):
        return SimpleNamespace(problem=SimpleNamespace(active=frozenset(keys), settings=DEFAULT), status="converged")

    weights = {"": 0.0, "friction": 90.0, "damping": 70.0, "damping offset": 84.0, "friction offset": 92.0}
    fitted_sets = {frozenset(k.split()): TermSet(frozenset(k.split()), fit(*k.split()), w) for k, w in weights.items()}
    d = SimpleNamespace(
        selection=Selection(fitted_sets[frozenset()].fit, fitted_sets[frozenset({"friction"})].fit, fitted_sets),
        named=("friction",),
        learned=None,
    )
    monkeypatch.setattr(searching, "replace", lambda value, **new: SimpleNamespace(**{**vars(value), **new}))
    monkeypatch.setattr(searching, "_refit", lambda diagnosis, dropped, rng: (diagnosis.selection, dropped))
    better = fitted_sets[frozenset({"damping", "offset"})].fit
    selection, dropped = searching.replace_terms(d, better, np.random.default_rng(0))
    assert dropped == ("friction",)
    chances = Selection(**vars(selection)).probabilities()
    assert set(chances) == {frozenset(), frozenset({"damping"}), frozenset({"damping", "offset"})}
    assert chances[frozenset({"damping", "offset"})] > 0.99


def fit_of(*keys):
    return SimpleNamespace(problem=SimpleNamespace(active=frozenset(keys), settings=DEFAULT), status="converged")


@pytest.mark.parametrize(
    ("ahead", "confirmed", "largest"),
    [(-9.0, False, -9.0), (9.0, False, DEFAULT.rival.much + 9.0), (-9.0, True, 300.0)],
)
def test_a_gain_that_no_fit_confirms_does_not_make_a_set_probable(monkeypatch, ahead, confirmed, largest):
    """A set 9 behind or ahead whose discrepancy predicts 309, and one with a further term that is 14 behind."""
    weights = {"": 0.0, "sat": 60.0, "gain": 60.0 + ahead, "cogging sat": 46.0}
    fitted_sets = {
        frozenset(k.split()): TermSet(frozenset(k.split()), fit_of(*k.split()), w) for k, w in weights.items()
    }
    chosen, other, more = (fitted_sets[frozenset(k.split())] for k in ("sat", "gain", "cogging sat"))
    selection = Selection(fitted_sets[frozenset()].fit, chosen.fit, fitted_sets)
    selection.expansions = dict.fromkeys((chosen.terms, other.terms, more.terms))
    leads = {other.terms: 300.0, more.terms: 16.0}
    monkeypatch.setattr(Selection, "expansion", lambda self, term_set: None)
    monkeypatch.setattr(Selection, "discrepancy_fit", lambda self, term_set: confirmed or None)
    monkeypatch.setattr(Selection, "compute_log_odds", lambda self, term_set, over: -leads[over.terms])
    chances = selection.probabilities()
    assert np.log(chances[other.terms] / chances[chosen.terms]) == pytest.approx(largest)
    assert np.log(chances[more.terms] / chances[chosen.terms]) == pytest.approx(-14.0)


def test_a_set_as_good_as_the_chosen_one_is_compared_before_probabilities_are_stated(monkeypatch):
    """A spring and a weight with 0.6 between them: the spring had no probability, for want of an expansion."""
    weights = {"": 0.0, "weight": 54.2, "spring": 53.6, "far": 40.0}
    sets = {frozenset(k.split()): TermSet(frozenset(k.split()), fit_of(*k.split()), w) for k, w in weights.items()}
    selection = Selection(sets[frozenset()].fit, sets[frozenset({"weight"})].fit, sets)
    selection.expansions = {frozenset({"weight"}): None, frozenset(): None}

    def expand(self, term_set):
        self.expansions[term_set.terms] = None

    monkeypatch.setattr(Selection, "expansion", expand)
    monkeypatch.setattr(Selection, "discrepancy_fit", lambda self, term_set: None)
    monkeypatch.setattr(Selection, "compute_log_odds", lambda self, term_set, over: term_set.weight - over.weight)
    chances = selection.probabilities()
    assert chances[frozenset({"spring"})] == pytest.approx(1.0 / (1.0 + np.exp(0.6)))
    assert chances[frozenset({"far"})] < 1e-5


def test_the_gain_of_a_term_is_over_the_best_fit_of_the_nominal_model():
    """The first fit was a local maximum, 40 lower in log evidence than a later one of the same model."""
    evidence = {"first": 60.0, "later": 100.0, "a": 130.0}
    fits = {k: SimpleNamespace(status="converged", log_evidence=e, problem=NOTHING) for k, e in evidence.items()}
    nothing, alone = frozenset[str](), frozenset({"a"})
    sets = {nothing: TermSet(nothing, fits["later"], 100.0), alone: TermSet(alone, fits["a"], 125.0)}
    selection = Selection(fits["first"], fits["a"], sets)
    assert selection.best_nominal is fits["later"]
    assert selection.gain("a") == 30.0
