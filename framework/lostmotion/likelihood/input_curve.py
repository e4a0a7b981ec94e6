"""The inputs of a recording as functions of time: between its samples, before the first one and after the last one."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from lostmotion.contracts import Array
from lostmotion.signals.linear_prediction import predict_before

REACH = 300
"""Inputs are predicted for so many samples beyond either end, and for no more than a quarter of the recording."""
JOINT = 4
"""The spline of the predicted samples passes through so many measured ones."""


@dataclass(frozen=True)
class InputCurve:
    """Inputs (samples, inputs) every `dt` s, held between the samples or interpolated by a cubic spline.

    A drive that acts late shows at the first samples what was before the recording. Held at its first value there, it
    would have a jump that the machine never felt; so it is predicted from the recording.
    """

    inputs: Array
    dt: float
    held: bool

    @cached_property
    def spline(self) -> CubicSpline:
        """The inputs over the time (s) from the first sample."""
        return CubicSpline(np.arange(len(self.inputs)) * self.dt, self.inputs)

    def evaluate(self, column: int, t: Array) -> Array:
        """Return an input at times `t` (s) from the first sample, of any shape.

        One that is held between the samples is averaged over a quarter of a sample, and keeps its first and its last
        value outside of the recording. Any other is predicted there, and constant from `REACH` samples on.
        """
        if self.held:
            return self._average(column, t)
        last = (len(self.inputs) - 1) * self.dt
        found = np.asarray(self.spline(np.clip(t, 0.0, last))[..., column])
        early, late, far = t < 0.0, t > last, self._reach * self.dt
        if np.any(early):
            found[early] = self._before(np.minimum(-t[early], far))[..., column]
        if np.any(late):
            found[late] = self._after(np.minimum(t[late] - last, far))[..., column]
        return found

    def _average(self, column: int, t: Array) -> Array:
        half = 0.125 * self.dt
        edges = np.arange(len(self.inputs) + 1) * self.dt
        sums = np.concatenate([[0.0], np.cumsum(self.inputs[:, column])]) * self.dt
        middle = np.clip(t, half, edges[-1] - half)
        return np.asarray(
            (np.interp(middle + half, edges, sums) - np.interp(middle - half, edges, sums)) / (2.0 * half)
        )

    @property
    def _reach(self) -> int:
        return min(REACH, len(self.inputs) // 4)

    @cached_property
    def _before(self) -> CubicSpline:
        """The inputs over the time (s) before the first sample."""
        return self._predict(self.inputs)

    @cached_property
    def _after(self) -> CubicSpline:
        """The inputs over the time (s) after the last sample."""
        return self._predict(self.inputs[::-1])

    def _predict(self, inputs: Array) -> CubicSpline:
        """Return the spline over the time before the first of some inputs (samples, inputs)."""
        joint = inputs[:JOINT]
        outer = np.stack([predict_before(column, self._reach) for column in inputs.T], axis=1)
        times = np.arange(1 - len(joint), self._reach + 1) * self.dt
        return CubicSpline(times, np.concatenate([outer, joint])[::-1])
