"""The backward pass over a filtered recording."""

from __future__ import annotations

import numba
import numpy as np


@numba.njit(cache=True, nogil=True, error_model="numpy")
def smooth(seen_states, seen_cov, ahead_states, ahead_cov, steps):  # type: ignore[no-untyped-def]
    """Return smoothed states (samples, n) and covariances (samples, n, n); Rauch, Tung, Striebel (1965)."""
    samples, n = seen_states.shape
    states = seen_states.copy()
    cov = seen_cov.copy()
    for k in range(samples - 2, -1, -1):
        ahead = ahead_cov[k + 1] + 1e-300 * np.eye(n)
        gain = np.linalg.solve(ahead, np.ascontiguousarray(steps[k] @ seen_cov[k])).T
        states[k] = seen_states[k] + gain @ (states[k + 1] - ahead_states[k + 1])
        change = cov[k + 1] - ahead_cov[k + 1]
        cov[k] = seen_cov[k] + gain @ change @ np.ascontiguousarray(gain.T)
    return states, cov
