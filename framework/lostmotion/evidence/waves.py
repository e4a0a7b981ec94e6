"""Proposals of waves of any frequency: a stiffness that pulsates, a component of the drive that was not recorded.

The slope of the log-likelihood over a force that is a law of the motion times a wave is the Fourier transform of the
law times the gradient of the log-likelihood over the force. So one spectrum tests all frequencies up to half the rate.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lostmotion.contracts import Array
from lostmotion.inference.fit import Fit
from lostmotion.inference.late import find_span
from lostmotion.inference.natural import compute_size, find_wave, sort_slots
from lostmotion.inference.setup import choose_steps
from lostmotion.inference.shape_scan import SmoothedMotion
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.system import Slot

FINER = 8
"""Frequencies are tried at this many points within the width of a spectral line."""
MOST_WAVES = 3
"""The largest number of frequencies that are proposed for one term."""
NEIGHBOURS = 100
"""The median over this many spectral lines on both sides is the level of a spectrum without a wave."""
LEAST = 12.0
"""A line is proposed if it is this many times as high as its neighbours. For noise, the ratio to the median is over 12
with probability 2^-12 at each line."""


def scan_waves(fit: Fit, observations: Sequence[Observation]) -> dict[str, list[dict[str, float]]]:
    """Return for each idle term with a wave the frequencies that stand out, in units of the drive frequency.

    `fit` is a model without curves; the recordings are those on which frequencies are told apart, usually all.
    """
    keys = {
        key: slot
        for key in fit.posterior.system.keys
        if key not in fit.posterior.active
        if (slot := find_wave(fit.posterior, key))
    }
    if not keys or not observations[0].harmonic.omega:
        return {}
    posterior = choose_steps(fit.posterior, fit.theta)
    motions = [SmoothedMotion.of(posterior.on((one,)), fit.theta) for one in observations]
    span = find_span(posterior.on(tuple(observations)))
    found = {key: _list_waves(motions, span, key, slot) for key, slot in keys.items()}
    return {key: shapes for key, shapes in found.items() if shapes}


def _list_waves(
    motions: Sequence[SmoothedMotion], span: tuple[float, float], key: str, wave: Slot
) -> list[dict[str, float]]:
    """Return the shapes of a term with the frequencies that stand out over a span of time (s), the clearest first."""
    posterior = motions[0].posterior
    dt, omega = posterior.observations[0].dt, posterior.observations[0].harmonic.omega
    shape = {s.key: compute_size(s.param, posterior.scales) for s in sort_slots(posterior, key)[1]}
    signal = np.zeros(round((span[1] - span[0]) / dt))
    for motion in motions:
        columns = motion.compute_columns(key, [{**shape, wave.key: 0.0}])[0]
        product = columns[:, np.argmax(np.abs(columns).sum(axis=0))] * motion.gradient
        first = round((float(motion.posterior.observations[0].time[0]) - span[0]) / dt)
        signal[first : first + len(product)] += product - product.mean()
    power = np.abs(np.fft.rfft(signal, FINER * len(signal))) ** 2
    ratio = power / _measure_level(power)
    paces = 2.0 * np.pi * np.fft.rfftfreq(FINER * len(signal), dt) / omega
    ratio[np.abs(paces - 1.0) < 2.0 * FINER * paces[1]] = 0.0  # at the drive frequency it is a scale and a delay
    return [{**shape, wave.key: float(paces[i])} for i in _list_peaks(ratio)]


def _measure_level(power: Array) -> Array:
    """Return the median of a spectrum over the lines about each one."""
    width = NEIGHBOURS * FINER
    edges = np.arange(0, len(power), width)
    medians = [float(np.median(power[max(i - width, 0) : i + 2 * width])) for i in edges]
    return np.maximum(np.interp(np.arange(len(power)), edges + 0.5 * width, medians), np.finfo(float).tiny)


def _list_peaks(ratio: Array) -> list[int]:
    """Return the indices of the highest lines, highest first, each at least two lines from a higher one."""
    found: list[int] = []
    for i in np.argsort(-ratio)[: 200 * FINER].tolist():
        if ratio[i] < LEAST or len(found) == MOST_WAVES:
            break
        if i > 2 * FINER and all(abs(i - other) > 2 * FINER for other in found):
            found.append(i)
    return found
