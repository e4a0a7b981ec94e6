"""Draws from the posterior of a hypothesis, with size and length of its smooth forces averaged.

The fit has the smooth forces of the largest evidence. The data seldom tell one size or length from its neighbours, or a
small force along a parameter from none: with one choice the intervals of parameters are too narrow.

A smooth force can take over a part of a law, as one over velocity does of dry friction: the data tell their sum only.
What is stated are the parameters of the laws that are closest to all forces together, along the recorded motion. The
rest of the smooth forces is then orthogonal to the laws (Plumlee, J. Am. Stat. Assoc. 112 (2017) 1274-1285). The widths
stay those of the posterior: real errors of a model are orthogonal to it approximately only.

The errors of a real model have a damping and a stiffness of their own, such as the loss in a foundation. The data show
the rest of them only, the smooth forces, and these tell how large the unseen part may be. Nor are they a smooth force
of the prior: the level of what they do to the parameters is known from few pieces of information, and beside a smooth
force the draws have Student's t distribution.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.special import softmax

from lostmotion.contracts import Array
from lostmotion.evidence.discrepancy import Choice, JointFrame, Quadratic
from lostmotion.evidence.hypothesis import Hypothesis, compute_step
from lostmotion.inference.mixture import compute_root
from lostmotion.inference.natural import sort_slots
from lostmotion.likelihood.tangents import linearise_recordings

CHAIN = 100
"""The number of draws of smooth forces; with more draws of parameters each is used again."""
FREEDOM = 3.0
"""Degrees of freedom of draws beside a smooth force. Of 96 parameters in machines with flaws of many kinds (the first
19 of `--fresh 500`, 24 of `--fresh 400`) normal intervals of 95 % held 85 %; those that are wider by the quotient of
the quantiles, 1.62, hold 95 %."""
ALONG = 0.2
"""The standard deviation of what the errors of a model do along a constant, a stiffness and a damping, as a share of
that of all smooth forces together. Without it intervals held the damping in 20 of 26 imperfect machines that hide
nothing (the first of `--set clean`), and the other parameter in all of them; with it they hold it in 24."""
SMALL = 1e-3
"""Derivatives are taken over this share of the standard deviation of a coordinate."""


def draw_own(found: Hypothesis, count: int, rng: np.random.Generator) -> Array:
    """Return draws (count, own) of the own coordinates of a hypothesis, each with smooth forces of its own.

    Given the smooth forces they are normal, because one-step errors are nearly linear near the maximum, but for the
    level of errors of the model.
    """
    choices, shares = sample_choices(found, min(count, CHAIN), rng), find_shares(found)
    along = find_along(found.frame, shares)
    made = np.zeros((count, found.frame.own))
    for choice in dict.fromkeys(choices):
        rows = [i for i in range(count) if choices[i % len(choices)] == choice]
        other, (step, _) = replace(found, choice=choice), compute_step(found.frame, found.expansion, choice)
        unseen = ALONG * found.frame.measure_smooth(choice)
        root = compute_root(found.scatter * other.covariance + unseen**2 * along)
        middle = (found.at + step)[: found.frame.own] + shares @ (found.at + step)
        away = rng.standard_normal((len(rows), found.frame.own)) @ root.T
        if choice != found.frame.none:
            away *= np.sqrt(FREEDOM / rng.chisquare(FREEDOM, len(rows)))[:, None]
        made[rows] = middle + away
    low, high = (bound[: found.frame.own] for bound in found.frame.bounds)
    return np.clip(made, low, high)


def find_along(frame: JointFrame, shares: Array) -> Array:
    """Return the covariance (own, own) that constants and lines of unit standard deviation give to own coordinates.

    They are those over position and over velocity; of several places where these may act, it is the mean.
    """
    lined = [shares[:, f.lines] for f in frame.forces if f.lines.stop - f.lines.start > 1]
    places = max(len(lined) / 2.0, 1.0)
    return sum((rows @ rows.T for rows in lined), np.zeros((frame.own, frame.own))) / places


def find_middle(found: Hypothesis) -> dict[str, float]:
    """Return the own coordinates at the maximum by name, with what the laws take over of the smooth forces."""
    middle = found.theta + find_shares(found) @ found.at
    return dict(zip(found.frame.names[: found.frame.own], map(float, middle), strict=True))


def find_shares(found: Hypothesis) -> Array:
    """Return by how much own coordinates grow (own, count) if laws take over what is along them of smooth forces.

    It is the least-squares solution for the accelerations along the filtered motion. Model parameters and amplitudes of
    laws take part; shapes and levels do not. Zero where the filter has no linearisation.
    """
    frame, own = found.frame, found.frame.own
    made = np.zeros((own, frame.count))
    posterior = frame.place(found.at)
    theta = found.at[: len(posterior.space.free)]
    free = posterior.space.free[:own]
    laws = np.flatnonzero([f.physical and is_amplitude(found, f.key) for f in free])
    waves = np.concatenate([np.arange(force.columns.start, force.columns.stop) for force in frame.forces])
    filtered = linearise_recordings(posterior, theta)
    if not filtered or not len(laws):
        return made
    steps = np.concatenate([SMALL * np.sqrt(np.diag(found.covariance)[laws]), np.ones(len(waves))])
    moved = theta + np.vstack([np.zeros(len(theta)), steps[:, None] * np.eye(len(theta))[[*laws, *waves]]])
    effects = []
    for one in filtered:
        rates, _ = one.compute_effects(one.posterior.recordings[0].full(moved), posterior.active)
        model = rates[:, :, : len(posterior.system.model.states)]
        effects.append((model[1:] - model[0]).reshape(len(steps), -1))
    rows = np.concatenate(effects, axis=1)
    along, taken = rows[: len(laws)].T, rows[len(laws) :].T
    made[np.ix_(laws, waves)] = steps[: len(laws), None] * np.linalg.lstsq(along, taken, rcond=None)[0]
    return made


def is_amplitude(found: Hypothesis, key: str) -> bool:
    """Return whether a parameter is one of the model, or an amplitude of a law."""
    term = key.rpartition(".")[0]
    return not term or key in {slot.key for slot in sort_slots(found.frame.posterior, term)[0]}


def sample_choices(found: Hypothesis, count: int, rng: np.random.Generator) -> list[Choice]:
    """Return draws of the options of all smooth forces from their posterior, begun at the choice of the fit.

    In each draw each smooth force in turn gets one of its options, or none, in proportion to the evidence beside the
    others (Gibbs sampling: Geman, Geman, IEEE Trans. Pattern Anal. Mach. Intell. 6 (1984) 721-741).
    """
    quadratic = Quadratic.of(found.frame, found.expansion.curvature)
    known: dict[Choice, float] = {}
    choice, made = found.choice, []
    for _ in range(count):
        for k, force in enumerate(found.frame.forces):
            options = [(*choice[:k], option, *choice[k + 1 :]) for option in range(-1, len(force.options))]
            known |= {one: quadratic.evaluate(one) for one in options if one not in known}
            ends = np.cumsum(softmax([known[one] / found.scatter for one in options]))
            choice = options[int(np.searchsorted(ends, ends[-1] * rng.random()))]
        made.append(choice)
    return made
