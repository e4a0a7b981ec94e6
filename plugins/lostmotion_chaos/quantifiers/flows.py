"""Lyapunov exponents and dimension of a model, from the growth of its tangent vectors in each period."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from scipy.special import stdtr, stdtrit

from lostmotion.contracts import Array, Flow, Quantifier
from lostmotion.results import Estimate

_LEAST_PERIODS = 40
"""With fewer periods neither an error nor a transient can be judged. Chosen by experience; no measurement recorded."""
_LEAST_BLOCKS = 20
"""The least number of blocks for the error; the test whether the motion has settled uses at least twice as many. Chosen
by experience; no measurement recorded."""
_PARTS = ((0.5, 0.5), (0.25, 0.5), (0.125, 0.5), (0.5, 0.75), (0.5, 0.875))
"""Parts of an orbit that are compared: up to the first share of it, and from the second share on. Short parts show a
motion that settles early or late."""
_FALSE_ALARMS = 0.01
"""Share of settled orbits that are reported as not settled, over all these comparisons."""
_END_ERROR = 1.0
"""Standard error (natural logarithm) of tangent growth over a whole orbit: the positions of its start and end on the
attractor change the length of a tangent vector by such a factor, independent of the length of the orbit."""
_DRAWS = 400
"""Bootstrap samples for the interval of the dimension."""


@dataclass(frozen=True, eq=False)
class _Growth:
    """Growth (periods, k) of the tangent vectors after the transient, in 1/s, or a refusal."""

    rates: Array
    period: float
    driven: bool
    refusal: Estimate | None = None


@dataclass(frozen=True, eq=False)
class _Mean:
    """Means (k,) and standard errors (k,) from means over blocks (blocks, k); `gap` between parts.

    `ends` is the part of the errors that is due to the ends of the orbit.
    """

    value: Array
    stderr: Array
    blocks: Array
    length: int
    gap: float
    settled: bool
    ends: float

    @property
    def reach(self) -> float:
        """Half the width of a 95 % interval, in standard errors."""
        return float(stdtrit(len(self.blocks) - 1, 0.975))


@dataclass(frozen=True)
class LyapunovMax(Quantifier[Flow]):
    """Largest Lyapunov exponent (1/s, natural logarithm) of a model, by Benettin's method.

    The error is that of means over blocks, whose length follows from the autocorrelation time of the growth, and of
    the ends. Curve: `running`, the mean (1/s) up to each of some `periods`.
    """

    periods: int = 2000
    transient: int = 200
    name: ClassVar[str] = "lyapunov_max"
    paper: ClassVar[str] = "Benettin, Galgani, Giorgilli, Strelcyn, Meccanica 15 (1980) 9-20"
    unit: ClassVar[str] = "1/s"
    reads = "flow"

    def estimate(self, data: Flow, *, rng: np.random.Generator) -> Estimate:
        growth = _follow_flow(data, self.periods, self.transient, 1)
        if growth.refusal:
            return growth.refusal
        mean = _average_growth(growth.rates, growth.period)
        return _make_estimate(mean, growth, curve=_average_running(growth.rates))


@dataclass(frozen=True)
class LyapunovSpectrum(Quantifier[Flow]):
    """All Lyapunov exponents (1/s, natural logarithm) of a model; the value is the largest.

    Curves: `spectrum` and `stderr` (n,), in 1/s. The zero exponent of the drive phase is not among them. The detail
    `sum` is the mean growth rate of volumes.
    """

    periods: int = 2000
    transient: int = 200
    name: ClassVar[str] = "lyapunov_spectrum"
    paper: ClassVar[str] = "Shimada, Nagashima, Progress of Theoretical Physics 61 (1979) 1605-1616"
    unit: ClassVar[str] = "1/s"
    reads = "flow"

    def estimate(self, data: Flow, *, rng: np.random.Generator) -> Estimate:
        growth = _follow_flow(data, self.periods, self.transient, len(data.states))
        if growth.refusal:
            return growth.refusal
        mean = _average_growth(growth.rates, growth.period)
        order = np.argsort(-mean.value, kind="stable")
        curve = {"spectrum": mean.value[order], "stderr": mean.stderr[order], **_average_running(growth.rates)}
        return _make_estimate(mean, growth, curve=curve)


@dataclass(frozen=True)
class KaplanYorke(Quantifier[Flow]):
    """Kaplan-Yorke dimension of the attractor of a model, from all its exponents.

    It is the dimension of the flow: under a drive the phase adds an exponent of zero, and the detail `section` is the
    dimension of the stroboscopic section, which is less by one. The interval is that of resampled blocks of periods.
    """

    periods: int = 2000
    transient: int = 200
    name: ClassVar[str] = "kaplan_yorke"
    paper: ClassVar[str] = "Kaplan, Yorke, Lecture Notes in Mathematics 730 (1979) 204-227"
    unit: ClassVar[str] = "1"
    reads = "flow"

    def estimate(self, data: Flow, *, rng: np.random.Generator) -> Estimate:
        growth = _follow_flow(data, self.periods, self.transient, len(data.states))
        if growth.refusal:
            return replace(growth.refusal, unit="1")
        mean = _average_growth(growth.rates, growth.period)
        value = _compute_dimension(mean.value, mean.stderr, growth.driven)
        drawn = [_compute_dimension(exponents, mean.stderr, growth.driven) for exponents in _resample_means(mean, rng)]
        low, high = np.quantile(drawn, [0.025, 0.975])
        curve = {"spectrum": mean.value, "stderr": mean.stderr}
        details = {"section": max(value - 1.0, 0.0), "lyapunov_max": float(mean.value.max())}
        status, says = _judge_settling(mean)
        return Estimate(value, min(float(low), value), max(float(high), value), status, "1", curve, says, details)


def _resample_means(mean: _Mean, rng: np.random.Generator) -> Array:
    """Return means (draws, k) of resampled blocks, spread as wide as their standard errors and Student's t ask for."""
    many = len(mean.blocks)
    resampled = mean.blocks[rng.integers(many, size=(_DRAWS, many))].mean(axis=1) - mean.blocks.mean(axis=0)
    own = mean.blocks.std(axis=0) / math.sqrt(many)
    wider = np.sqrt(np.maximum(mean.stderr**2 - mean.ends**2, 0.0)) * mean.reach / 1.96 / np.where(own > 0.0, own, 1.0)
    redrawn: Array = mean.value + resampled * wider + mean.ends * rng.standard_normal((_DRAWS, mean.value.size))
    return redrawn


def _follow_flow(flow: Flow, periods: int, transient: int, tangents: int) -> _Growth:
    """Return the growth over `periods` after the transient, or a refusal."""
    nothing, driven = np.zeros((0, tangents)), flow.driven
    if periods < _LEAST_PERIODS:
        says = f"{periods} periods are too few to judge an error from: follow {_LEAST_PERIODS} or more"
        return _Growth(nothing, flow.period, driven, _refuse("too_short", says, nothing))
    orbit = flow.strobe(flow.start, periods=max(transient, 0) + periods, tangents=tangents)
    rates = orbit.growth[max(transient, 0) :] / flow.period
    if orbit.status != "ok":
        return _Growth(
            nothing, flow.period, driven, _refuse(orbit.status, _explain_status(orbit.status, orbit.growth), rates)
        )
    return _Growth(rates, flow.period, driven)


def _refuse(status: str, says: str, rates: Array) -> Estimate:
    """Return a refused estimate with the running mean of the growth so far."""
    return Estimate.refused(status, says, unit="1/s", curve=_average_running(rates[np.isfinite(rates).all(axis=1)]))


def _explain_status(status: str, growth: Array) -> str:
    """Return the sentence for an orbit that did not end with the status "ok"."""
    if status == "diverged":
        survived = int(np.isfinite(growth).all(axis=1).sum())
        return f"The motion diverges after {survived} periods: check the parameters and the start."
    if status == "jumps":
        return (
            "The force jumps, or rises too steeply for the step, along the motion, and tangent vectors are not "
            "followed across a jump: smooth the jump over a few steps, or take the exponent from a recording."
        )
    return f"The flow of the model ended with the status {status}."


def _average_running(rates: Array, points: int = 200) -> dict[str, Array]:
    """Return the mean rate (1/s) of the first vector up to some numbers of periods."""
    if not len(rates):
        return {}
    until = np.unique(np.linspace(1, len(rates), min(points, len(rates))).astype(int))
    return {"periods": until.astype(float), "running": np.cumsum(rates[:, 0])[until - 1] / until}


def _average_growth(rates: Array, period: float) -> _Mean:
    """Return the means of the columns of `rates` (periods, k), with errors from means over blocks.

    Length of the blocks: Flyvbjerg, Petersen, J. Chemical Physics 91 (1989) 461-466, by the rule (2 tau^2 n)^(1/3)
    with the integrated autocorrelation time tau, and at least twenty blocks. The variance from blocks of half the
    length serves to remove the bias of long correlations: Vats, Flegal, Biometrika 109 (2022) 735-750.
    """
    n, tau = len(rates), max(_estimate_memory(column) for column in rates.T)
    wanted = math.ceil((2.0 * tau * tau * n) ** (1.0 / 3.0))
    length = max(1, min(wanted, n // _LEAST_BLOCKS))
    blocks = _average_blocks(rates, length)
    half = _compute_variance(_average_blocks(rates, max(1, length // 2)))
    stderr = np.sqrt(np.maximum(_compute_variance(blocks), 2.0 * _compute_variance(blocks) - half))
    ends = _END_ERROR / (period * n)
    short = max(1, min(wanted, n // (2 * _LEAST_BLOCKS)))
    gap, settled = _compare_parts(_average_blocks(rates, short), _END_ERROR / (period * short))
    stderr = np.hypot(stderr, ends)
    return _Mean(rates.mean(axis=0), stderr, blocks, length, gap, settled, ends)


def _compute_variance(blocks: Array) -> Array:
    """Return the variance (k,) of the mean over blocks (blocks, k)."""
    variance: Array = blocks.var(axis=0, ddof=1) / len(blocks)
    return variance


def _compare_parts(blocks: Array, ends: float) -> tuple[float, bool]:
    """Return the most significant difference (1/s) between beginning and end, and whether chance explains it.

    Welch's test on the means over blocks (blocks, k), with the fewer degrees of freedom; `ends` is the error of a block
    that is due to its ends.
    """
    many, least, gap = len(blocks), 1.0, 0.0
    for until, begin in _PARTS:
        parts = blocks[: math.ceil(until * many)], blocks[math.floor(begin * many) :]
        squares = [x.var(axis=0, ddof=1) / len(x) + (ends / len(x)) ** 2 for x in parts]
        apart = np.abs(parts[0].mean(axis=0) - parts[1].mean(axis=0))
        chance = 2.0 * stdtr(min(map(len, parts)) - 1, -apart / np.sqrt(squares[0] + squares[1]))
        worst = int(np.argmin(chance))
        if chance[worst] < least:
            least, gap = float(chance[worst]), float(apart[worst])
    return gap, least * len(_PARTS) * blocks.shape[1] > _FALSE_ALARMS


def _average_blocks(rates: Array, length: int) -> Array:
    """Return means (blocks, k) over whole blocks of `length` periods; periods that do not fit are left out first."""
    many = len(rates) // length
    means: Array = rates[len(rates) - many * length :].reshape(many, length, -1).mean(axis=1)
    return means


def _estimate_memory(x: Array) -> float:
    """Return the integrated autocorrelation time of `x` (n,) in samples, of absolute correlations up to 5 tau.

    The absolute value is conservative: the growth alternates, so that signed correlations would cancel.
    """
    y = x - x.mean()
    power = float(y @ y)
    if power <= 1e-24 * float(x @ x) or len(x) < 4:
        return 1.0
    size = 1 << (2 * len(y) - 1).bit_length()
    spectrum = np.fft.rfft(y, size)
    correlation = np.abs(np.fft.irfft(spectrum * spectrum.conj(), size)[: len(y)]) / power
    tau = 1.0 + 2.0 * np.cumsum(correlation[1:])
    ends = np.flatnonzero(np.arange(1, len(tau) + 1) >= 5.0 * tau)
    return float(tau[ends[0]]) if len(ends) else float(tau[len(tau) // 10])


def _judge_settling(mean: _Mean) -> tuple[str, str]:
    """Return the status and the sentence that follow from the comparison of beginning and end of the orbit."""
    if mean.settled:
        return "ok", ""
    return "uncertain", (
        f"Beginning and end of the orbit differ significantly, by {mean.gap:.3g} 1/s: "
        "the motion has not settled yet. Raise transient or periods."
    )


def _make_estimate(mean: _Mean, growth: _Growth, *, curve: dict[str, Array]) -> Estimate:
    """Return the estimate of the largest exponent."""
    best = int(np.argmax(mean.value))
    value, stderr = float(mean.value[best]), float(mean.stderr[best])
    status, says = _judge_settling(mean)
    details = {"stderr": stderr, "block": float(mean.length), "period": growth.period}
    if mean.value.size > 1:
        details["sum"] = float(mean.value.sum())
    half = mean.reach * stderr
    return Estimate(value, value - half, value + half, status, "1/s", curve, says, details)


def _compute_dimension(exponents: Array, stderr: Array, driven: bool) -> float:
    """Return the Kaplan-Yorke dimension; what is zero within three standard errors counts as zero."""
    slack = np.concatenate([3.0 * stderr, [0.0]]) if driven else 3.0 * stderr
    every = np.concatenate([exponents, [0.0]]) if driven else exponents
    order = np.argsort(-every, kind="stable")
    sums, allowed = np.cumsum(every[order]), np.sqrt(np.cumsum(slack[order] ** 2))
    below = np.flatnonzero(sums < -allowed)
    if not len(below):
        return float(len(every))
    k = int(below[0])
    return float(k + max(sums[k - 1], 0.0) / abs(every[order][k])) if k else 0.0
