"""A periodic force without the noise of its gauge, where the recorded motion shows that this noise did not act."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lostmotion.inference.fit import Fit, maximise
from lostmotion.likelihood.observation import Observation
from lostmotion.signals import refined_period, without_harmonics


def leave_out_gauge_noise(nominal: Fit, observations: Sequence[Observation]) -> tuple[Fit, tuple[Observation, ...]]:
    """Return fit and recordings with forces that have only the multiples of their frequency, if that is more likely.

    The filter takes the noise of a gauge for a force. A law that depends less on the recorded force then has less of
    this error, and predicts the data better than the true law. Both likelihoods are maxima over the same parameters of
    the nominal model, so no penalty is needed. Fit and recordings are unchanged otherwise.
    """
    calm = {o.name: keep_harmonics(o) for o in observations}
    if not any(o.gauge_noise for o in calm.values()):
        return nominal, tuple(observations)
    fitted = tuple(calm[part.name].cut_again(part) for part in nominal.posterior.observations)
    again = maximise(nominal.posterior.on(fitted), nominal.theta)
    better = again.status != "diverged" and again.log_likelihood > nominal.log_likelihood
    return (again, tuple(calm.values())) if better else (nominal, tuple(observations))


def keep_harmonics(observation: Observation) -> Observation:
    """Return a recording whose force has only its mean and the multiples of its frequency.

    It is unchanged where its force is not periodic or is held between the samples.
    """
    if observation.free or observation.held or observation.slope is not None:
        return observation
    period = refined_period(observation.excitation, observation.dt)
    if period is None:
        return observation
    rest, _ = without_harmonics(observation.excitation, observation.dt, period)
    noise = rest - rest.mean()
    inputs = observation.inputs.copy()
    inputs[:, observation.lead] -= noise
    return replace(observation, inputs=inputs, gauge_noise=float(np.std(noise)))
