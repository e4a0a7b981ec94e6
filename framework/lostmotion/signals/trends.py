"""Stiffness and damping from a free decay: the change of frequency and decrement with the amplitude."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.signals.decay import Decay

Array = NDArray[np.float64]
SURE = 4.0
"""A slope is significant from this many standard errors on."""
STIFFER, DAMPED = 2e-4, 0.1
"""Smaller relative changes of frequency and of decrement over the decay count as constant."""
LAGS = 5
"""The number of neighbouring cycles with correlated errors: the windows of fitted sines overlap."""
AT_ENDS = 5
FEWEST = 5
"""The least number of cycles for a slope."""

_STIFFNESS = {
    "hardening": "the stiffness rises with the amplitude (hardening)",
    "softening": "the stiffness falls with the amplitude (softening)",
}
_DAMPING = {
    "drag": "the damping is strongest in large motion, as with drag",
    "dry friction": "the damping is strongest in small motion, as with dry friction",
}


@dataclass(frozen=True)
class Slope:
    """A slope with its standard error, which allows for the overlap of neighbouring windows."""

    value: float
    error: float

    @property
    def sure(self) -> bool:
        """Whether the slope differs from zero by more than four standard errors."""
        return abs(self.value) > SURE * self.error


@dataclass(frozen=True)
class Trend:
    """How frequency and decrement of a decay change with its amplitude.

    `frequency` is the slope over the amplitude squared (Hz/unit^2), `decrement` that over the amplitude (1/unit),
    `dry` that over one over the amplitude (unit): under Coulomb friction it is the decrease of the amplitude per cycle.
    `stiffness` is "constant", "hardening" or "softening"; `damping` is "viscous" where the decay is exponential,
    "dry friction" where the decrement rises as the amplitude falls, "drag" where it falls with it.
    """

    frequency: Slope
    decrement: Slope
    dry: Slope
    stiffness: str
    damping: str


def trend_of(decay: Decay) -> Trend:
    """Return how frequency and decrement change with the amplitude, from tests of weighted straight lines.

    The frequency of a weakly nonlinear spring changes with the square of the amplitude (Nayfeh and Mook, Nonlinear
    Oscillations, 1979, section 2.3); under dry friction the decrement is proportional to one over the amplitude (Den
    Hartog, Trans. ASME 53, 1931, APM-107), under a drag with the square of the speed with the amplitude. Errors are
    those of Newey and West (Econometrica 55, 1987, 703), or those of the noise where these are larger. A change counts
    when its slope exceeds four errors, and is 0.02 % of the frequency or 10 % of the decrement over the decay.
    """
    # A sine whose amplitude falls much within a cycle has no sharp frequency (measured on closed-form solutions).
    blurred = np.hypot(decay.frequency_error, 2.0 * decay.frequency * (decay.decrement / (2.0 * math.pi)) ** 2)
    frequency, _ = _fit_line(decay.amplitude**2, decay.frequency, blurred)
    # The decrease over two cycles is valid even where a sine with an exponential envelope does not fit well.
    size, inside = decay.amplitude, decay.amplitude[1:-1]
    fall = (size[:-2] - size[2:]) / ((decay.time[2:] - decay.time[:-2]) * decay.frequency[1:-1] * inside)
    errors = np.hypot(decay.amplitude_error[:-2], decay.amplitude_error[2:]) / (2.0 * inside)
    decrement, left = _fit_line(inside, fall, errors)
    dry, left_dry = _fit_line(1.0 / inside, fall, errors)
    change = frequency.value * float(np.ptp(decay.amplitude**2)) / float(np.mean(decay.frequency))
    stiffness = "constant"
    if frequency.sure and abs(change) > STIFFER:
        stiffness = "hardening" if change > 0.0 else "softening"
    least = DAMPED if stiffness == "constant" else DAMPED + 2.0 * abs(change)
    kind = _classify_damping(decay, (decrement, dry), is_dry=left_dry < left, least=least)
    return Trend(frequency, decrement, dry, stiffness, kind)


def _classify_damping(decay: Decay, slopes: tuple[Slope, Slope], *, is_dry: bool, least: float) -> str:
    """Return the kind of damping from the line with the smaller residual, if the change is large enough.

    A nonlinear spring changes the decrement of a viscous damper, by up to twice as much as the frequency.
    """
    decrement, dry = slopes
    better, over = (dry, 1.0 / decay.amplitude) if is_dry else (decrement, decay.amplitude)
    change = better.value * float(np.ptp(over))
    if not better.sure or abs(change) < least * abs(float(np.median(decay.decrement))):
        return "viscous"
    return "dry friction" if (change > 0.0) == is_dry else "drag"


def _fit_line(over: Array, values: Array, errors: Array) -> tuple[Slope, float]:
    """Return the slope of a straight line through values with standard errors, and the weighted residual."""
    if over.size < FEWEST:
        return Slope(0.0, math.inf), 0.0
    scale = float(np.max(np.abs(over)))
    table = np.column_stack([np.ones_like(over), over / scale])
    rough = values - table @ np.linalg.lstsq(table, values, rcond=None)[0]
    scatter = 1.4826 * float(np.median(np.abs(rough)))
    weights = 1.0 / np.maximum(errors**2 + scatter**2, 1e-300)
    weights /= weights.max()
    inverse = np.linalg.pinv((table * weights[:, None]).T @ table)
    found = inverse @ (table * weights[:, None]).T @ values
    left = values - table @ found
    scores = table * (weights * left)[:, None]
    noise = np.sum(
        (table * (weights * errors)[:, None])[:, :, None] * (table * (weights * errors)[:, None])[:, None], 0
    )
    spread = [float((inverse @ middle @ inverse)[1, 1]) for middle in (_long_run_covariance(scores), noise)]
    error = math.sqrt(max(*spread, 0.0)) / scale
    return Slope(float(found[1]) / scale, error), float(np.sum(weights * left**2) / np.sum(weights))


def _long_run_covariance(scores: Array) -> Array:
    """Return the covariance (k, k) of a sum of scores (n, k) whose neighbours are correlated."""
    total = scores.T @ scores
    for lag in range(1, min(LAGS, len(scores) - 1) + 1):
        both = scores[lag:].T @ scores[:-lag]
        total = total + (1.0 - lag / (LAGS + 1.0)) * (both + both.T)
    return np.asarray(total * len(scores) / max(len(scores) - 2, 1))


def says(decay: Decay, unit: str = "", *, factor: float = 1.0) -> str:
    """Return sentences on the change of frequency and decrement from the first to the last cycles of a decay.

    `unit` is that of the amplitude after multiplication with `factor`.
    """
    trend = trend_of(decay)
    some = min(AT_ENDS, max(1, decay.time.size // 10))
    first, last = slice(0, some), slice(-some, None)
    sizes = [factor * float(np.mean(decay.amplitude[end])) for end in (first, last)]
    at = [f"{_round(size, size)} {unit}".rstrip() for size in sizes]
    pitch = [float(np.mean(decay.frequency[end])) for end in (first, last)]
    loss = [float(np.mean(decay.decrement[end])) for end in (first, last)]
    parts = [_describe_frequency(decay, trend, pitch, at), _describe_decrement(decay, trend, loss)]
    why = [_STIFFNESS.get(trend.stiffness), _DAMPING.get(trend.damping)]
    meaning = " and ".join(reason for reason in why if reason)
    if (trend.stiffness, trend.damping) == ("softening", "drag"):
        meaning += "; a joint that slips does both"
    closing = f" So {meaning}." if meaning else " So one linear mode with viscous damping describes the decay."
    return f"The frequency {parts[0]}; the logarithmic decrement {parts[1]}.{closing}"


def _describe_frequency(decay: Decay, trend: Trend, pitch: list[float], at: list[str]) -> str:
    if trend.stiffness == "constant":
        middle = float(np.median(decay.frequency))
        return f"stays at {_round(middle, 1e-2 * middle)} Hz from an amplitude of {at[0]} to {at[1]}"
    way = "falls" if trend.stiffness == "hardening" else "rises"
    first, last = (_round(value, pitch[1] - pitch[0]) for value in pitch)
    return f"{way} from {first} Hz at {at[0]} to {last} Hz at {at[1]}"


def _describe_decrement(decay: Decay, trend: Trend, loss: list[float]) -> str:
    if trend.damping == "viscous":
        middle = float(np.median(decay.decrement))
        if abs(loss[0] - loss[1]) > DAMPED * abs(middle) and trend.stiffness != "constant":
            first, last = (_round(value, 0.1 * value) for value in loss)
            return f"goes from {first} to {last}, no more than such a spring brings about with viscous damping"
        return f"stays at {_round(middle, 0.1 * middle)}"
    way = "rises" if trend.damping == "dry friction" else "falls"
    first, last = (_round(value, loss[1] - loss[0]) for value in loss)
    return f"{way} from {first} to {last} as the motion dies"


def _round(value: float, change: float) -> str:
    """Return a number with enough decimals for two digits of a change."""
    decimals = 1 - math.floor(math.log10(abs(change))) if change else 3
    return f"{value:.{min(max(decimals, 0), 9)}f}"
