"""Facts of a diagnosis that are made by hand: of an oscillator with few candidate terms, in a model that predicts."""

import numpy as np

from lostmotion.diagnosis.compare import Prediction
from lostmotion.diagnosis.facts import AmplitudeChange, CandidateTerm, Facts, FoundTerm, SensorNoise, Support
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.likelihood.predict import Horizon
from lostmotion.results.diagnosis import DriveFacts
from lostmotion.results.mismatch import UnexplainedForce
from lostmotion.settings import DEFAULT
from lostmotion_plugins.terms.bodies import InertiaChange
from lostmotion_plugins.terms.drive import ExcitationDelay
from lostmotion_plugins.terms.friction import CoulombFriction, StribeckFriction

FRICTION, STRIBECK, DELAY, CHANGE = "coulomb_friction", "stribeck_friction", "excitation_delay", "inertia_change"
TERMS = {one.name: one for one in (CoulombFriction(), StribeckFriction(), ExcitationDelay(), InertiaChange())}
NOTHING = frozenset()
WITH_UNKNOWN = frozenset({FRICTION, UNKNOWN})


def make_prediction(nrmse=0.01, scores=(), errors=(), **changes):
    """Return the prediction of a model for held-out data with this error of free runs."""
    zeros = np.zeros(2)
    given = {
        "log_score": 1.0, "expected_score": 1.0, "nrmse": nrmse, "by_sensor": (nrmse,), "scales": (1.0,),
        "exponent": -0.1, "rates": zeros, "lead": zeros, "growth": zeros, "valid_time": 1.0,
        "forecasts": np.zeros((2, 1)), "restarts": zeros, "acf": zeros, "white": 0.5,
        "scores": np.asarray(scores, dtype=float), "errors": np.asarray(errors, dtype=float),
    }  # fmt: skip
    return Prediction(**(given | changes))


def make_sensor(**changes):
    """Return a sensor whose noise is a hundredth of its readings."""
    given = {"name": "position", "channel": "position", "unit": "m", "sd": 0.01, "slow": 0.0, "scale": 1.0}
    return SensorNoise(**(given | changes))


def make_found(name, *, gain=20.0, share=0.1, parameters=None, **support):
    """Return a found term with this support."""
    return FoundTerm(
        key=name, term=TERMS[name], parameters=parameters or {}, share=share, support=Support(gain=gain, **support)
    )


def make_change(alone, beside, sd=0.01):
    """Return an amplitude of friction that a further term moves from `alone` to `beside` (N)."""
    return AmplitudeChange("Coulomb friction", "force", "N", alone, beside, sd)


def make_facts(*found, sets=None, alone=None, **changes):
    """Return the facts of a diagnosis with these found terms, which are certain if `sets` are not given.

    `alone` maps names of terms to the log evidence that they alone add.
    """
    alone = alone or {}
    given = {
        "settings": DEFAULT,
        "motion": "translation",
        "drive": DriveFacts(10.0, "N", "the drive", 1.0, False),
        "input_unit": "N",
        "level": 10.0,
        "sensors": (make_sensor(),),
        "before": make_prediction(0.2),
        "after": make_prediction(),
        "horizon": Horizon(10, 1.0, "drive periods", 1.0),
        "force_before": UnexplainedForce(True, 2.0, "N", 0.2),
        "force_after": UnexplainedForce(False, 1.0, "N", 0.1),
        "sets": sets or {frozenset(one.key for one in found): 1.0},
        "candidates": tuple(
            CandidateTerm(key=name, term=term, gain=0.0, price=1.0, fitted=False, alone=alone.get(name))
            for name, term in TERMS.items()
        ),
        "found": found,
        "augmented": bool(found),
    }
    return Facts(**(given | changes))
