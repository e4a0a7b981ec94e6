"""Normal scores of bounded coordinates, in which posteriors have light tails, one that piles up at a bound too."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr, ndtri

from lostmotion.contracts import Array

FAR = 6.0
"""No score is larger, so that a coordinate stays a number apart from its bound."""
FLAT = 30.0
"""A Cauchy density this many times as broad as the bounds are apart is flat between them."""


@dataclass(frozen=True)
class Scores:
    """The score of a coordinate: the standard normal quantile of its place in a Cauchy density cut at its bounds.

    `low`, `high`, `middle` and `breadth` are (parameters,). The density is flat, or at a bound at which a posterior is
    expected to pile up it has its middle, and the breadth of that. In scores such a posterior falls off like a normal
    density towards its bound, faster than any kernel that proposes there, so that no walker gets stuck.
    """

    low: Array
    high: Array
    middle: Array
    breadth: Array

    @classmethod
    def flat(cls, low: Array, high: Array) -> Scores:
        """Return the scores of coordinates of which nothing more is known than the bounds."""
        return cls(low, high, 0.5 * (low + high), FLAT * (high - low))

    @classmethod
    def piled(cls, low: Array, high: Array, theta: Array, spread: Array) -> Scores:
        """Return the scores for a posterior about `theta`, which may lie within three times its `spread` of a bound."""
        flat = cls.flat(low, high)
        nearer = np.where(theta - low < high - theta, low, high)
        close = (np.abs(theta - nearer) < 3.0 * spread) & (spread < high - low)
        return cls(low, high, np.where(close, nearer, flat.middle), np.where(close, spread, flat.breadth))

    @property
    def _ends(self) -> tuple[Array, Array]:
        begin = np.arctan((self.low - self.middle) / self.breadth)
        return begin, np.arctan((self.high - self.middle) / self.breadth) - begin

    def of(self, points: Array) -> Array:
        """Return the scores of points (..., parameters)."""
        begin, span = self._ends
        shares = (np.arctan((points - self.middle) / self.breadth) - begin) / span
        return np.asarray(np.clip(ndtri(np.clip(shares, 0.0, 1.0)), -FAR, FAR))

    def points(self, scores: Array) -> Array:
        """Return the points of scores (..., parameters), within the bounds."""
        begin, span = self._ends
        raw = self.middle + self.breadth * np.tan(begin + span * ndtr(np.clip(scores, -FAR, FAR)))
        return np.asarray(np.clip(raw, self.low, self.high))

    def log_slopes(self, points: Array) -> Array:
        """Return the logarithm of the derivative of the scores by the coordinates at points (..., parameters)."""
        scores = self.of(points)
        off = (points - self.middle) / self.breadth
        cauchy = -np.log1p(off**2) - np.log(self.breadth * self._ends[1])
        return np.asarray(cauchy + 0.5 * scores**2 + 0.5 * math.log(2.0 * math.pi))
