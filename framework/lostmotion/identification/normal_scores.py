"""Normal scores of bounded coordinates: in them a posterior has light tails, even if its mass lies at a bound."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr, ndtri

from lostmotion.contracts import Array

MAX_SCORE = 6.0
"""Largest absolute score, so that a coordinate stays distinguishable from its bound."""
FLAT_BREADTH = 30.0
"""A Cauchy density is practically flat between the bounds when it is this many times as broad as their distance."""


@dataclass(frozen=True)
class Scores:
    """The score of a coordinate: the standard normal quantile of its rank in a Cauchy density truncated at its bounds.

    `low`, `high`, `middle` and `breadth` are (parameters,). The density is flat; where the posterior is expected to
    have its mass at a bound, it is centred there with the breadth of the posterior. In scores such a posterior falls
    off like a normal density towards its bound, faster than the proposal kernels, so that no walker gets stuck.
    """

    low: Array
    high: Array
    middle: Array
    breadth: Array

    @classmethod
    def flat(cls, low: Array, high: Array) -> Scores:
        """Return the scores of coordinates of which only the bounds are known."""
        return cls(low, high, 0.5 * (low + high), FLAT_BREADTH * (high - low))

    @classmethod
    def piled(cls, low: Array, high: Array, theta: Array, spread: Array) -> Scores:
        """Return the scores for a posterior about `theta` that may lie within three times its `spread` of a bound."""
        flat = cls.flat(low, high)
        nearer = np.where(theta - low < high - theta, low, high)
        close = (np.abs(theta - nearer) < 3.0 * spread) & (spread < high - low)
        return cls(low, high, np.where(close, nearer, flat.middle), np.where(close, spread, flat.breadth))

    @property
    def _angles(self) -> tuple[Array, Array]:
        begin = np.arctan((self.low - self.middle) / self.breadth)
        return begin, np.arctan((self.high - self.middle) / self.breadth) - begin

    def to_scores(self, points: Array) -> Array:
        """Return the scores of points (..., parameters)."""
        begin, span = self._angles
        shares = (np.arctan((points - self.middle) / self.breadth) - begin) / span
        return np.asarray(np.clip(ndtri(np.clip(shares, 0.0, 1.0)), -MAX_SCORE, MAX_SCORE))

    def to_points(self, scores: Array) -> Array:
        """Return the points of scores (..., parameters), within the bounds."""
        begin, span = self._angles
        raw = self.middle + self.breadth * np.tan(begin + span * ndtr(np.clip(scores, -MAX_SCORE, MAX_SCORE)))
        return np.asarray(np.clip(raw, self.low, self.high))

    def compute_log_slopes(self, points: Array) -> Array:
        """Return the logarithm of the derivative of the scores by the coordinates at points (..., parameters)."""
        scores = self.to_scores(points)
        off = (points - self.middle) / self.breadth
        cauchy = -np.log1p(off**2) - np.log(self.breadth * self._angles[1])
        return np.asarray(cauchy + 0.5 * scores**2 + 0.5 * math.log(2.0 * math.pi))
