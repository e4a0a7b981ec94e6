"""Oscillators with a hidden force, recorded by another integrator, and the explanations that are found for them."""

import numpy as np
from sensed import case_of, model_of, moved, multisine, noisy

from lostmotion.diagnosis.compare import cut_heldout
from lostmotion.diagnosis.stages import list_fitted_keys
from lostmotion.evidence.bare import Budget
from lostmotion.evidence.course import Course
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry

VALUES = {"m": 1.2, "c": 0.8, "k": 300.0}
T = np.arange(0.0, 12.0, 0.02)
ODDS = 4.5
"""The log odds against a constant or a line in a smooth force, about those against one law of 30."""
SECONDS = 600.0
"""The processor time of a search, in s."""


def oscillator(force, extra):
    """Return the position (samples,) of an oscillator by DOP853, with a further force of position, velocity, time."""

    def rates(t, y):
        more = extra(y[0], y[1], t)
        return [y[1], (float(force(t)) - VALUES["c"] * y[1] - VALUES["k"] * y[0] + more) / VALUES["m"]]

    return moved(rates, T, [0.0, 0.0])[:, 0]


def made_of(folder, extra, *, seed=0, stated=1.0, shown=lambda x: x, late=0.0):
    """Return the prepared case of a recording under a multisine of 10 N, and the system of all terms.

    The sensor has `shown` of the position, the case states `stated` times the mass, and the force acts `late` s later.
    """
    force = multisine(10.0, 0.5, 5.0, seed)
    x = oscillator(lambda t: force(t - late), extra)
    columns = {"t": T, "F": force(T), "x": noisy(shown(x), 0.003, seed)}
    recording = {
        "excitation": {"column": "F", "quantity": "force", "unit": "N"},
        "response": {"column": "x", "quantity": "position", "unit": "m"},
    }
    model = model_of("linear_oscillator", {**VALUES, "m": stated * VALUES["m"]}, ("c", "k"))
    prepared = prepare(case_of(folder, columns, recording, model), Registry.discover())
    return prepared, System(prepared.model, prepared.terms)


def bend(size):
    """Return a smooth force (N) over the position that no term has: a wave of a few turns that narrows and fades.

    It has neither a constant nor a straight line over the range of the motion, for which there are terms.
    """

    def wave(x):
        return size * np.sin(x / 0.012 * (1.0 + 4.0 * x) + 0.7) * (1.0 - 4.0 * x)

    seen = np.linspace(-0.075, 0.075, 301)
    line = np.polyfit(seen, wave(seen), 1)
    return lambda x, v, t: wave(x) - np.polyval(line, x)


def explain(nominal, keys, pieces=()):
    """Return the explanations for what a nominal fit leaves out, among terms; `pieces` are held-out data."""
    return Course(keys, pieces, Budget(seconds=SECONDS), lambda _: None).find_explanations(nominal)


def explain_machine(folder, extra, **made):
    """Return the explanations of such a recording, by all terms of the library and with its held-out part."""
    prepared, system = made_of(folder, extra, **made)
    train, held = split_heldout(prepared.observations)
    nominal = search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    pieces = [(piece.observation, piece.begin) for piece in cut_heldout(prepared.observations, held)]
    return explain(nominal, list_fitted_keys(system), pieces)
