"""The backward pass of the smoother over a filtered recording."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.kernels.stored import stored

Array = NDArray[np.float64]
SURE = 1e-9
"""A state that is known better than this share of its largest value is not corrected: of sliding friction with an
elastic part, the filter knows the deflection to 1e-18 of itself, and rounding errors divided by that are forces of
several hundred times the drive."""
ROUNDING = 1e-14
"""The share of its variance to which a state is computed: where a large random force correlates all states, their
covariance is singular to rounding."""


def smooth(seen_states: Array, seen_cov: Array, ahead_states: Array, ahead_cov: Array, steps: Array) -> Any:
    """Return smoothed states (samples, n) and covariances (samples, n, n); Rauch, Tung, Striebel (1965).

    LAPACK solves the gains of all samples at once; compiling a call of it would take longer.
    """
    states, cov, n = seen_states.copy(), seen_cov.copy(), seen_states.shape[1]
    least = np.diag((SURE * np.max(np.abs(seen_states), axis=0)) ** 2 + 1e-300)
    rounded = ROUNDING * ahead_cov[1:] * np.eye(n)
    gains = np.linalg.solve(ahead_cov[1:] + rounded + least, steps[:-1] @ seen_cov[:-1])
    _sweep_back(states, cov, ahead_states, ahead_cov, gains, np.zeros((n, n)))
    return states, cov


@stored(nogil=True, error_model="numpy")
def _sweep_back(states, cov, ahead_states, ahead_cov, gains, work):  # type: ignore[no-untyped-def]
    """Correct the filtered states by all later samples; `gains` (samples - 1, n, n) are transposed."""
    samples, n = states.shape
    for k in range(samples - 2, -1, -1):
        for a in range(n):
            for c in range(n):
                states[k, a] += gains[k, c, a] * (states[k + 1, c] - ahead_states[k + 1, c])
        for a in range(n):
            for b in range(n):
                work[a, b] = 0.0
                for c in range(n):
                    work[a, b] += gains[k, c, a] * (cov[k + 1, c, b] - ahead_cov[k + 1, c, b])
        for a in range(n):
            for b in range(n):
                for c in range(n):
                    cov[k, a, b] += work[a, c] * gains[k, c, b]
