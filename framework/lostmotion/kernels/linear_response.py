"""The linear response of the errors of a filter to small forces and to small changes of its readings."""

from __future__ import annotations

from typing import Any

import numpy as np

from lostmotion.kernels.stored import stored


@stored(nogil=True, error_model="numpy")
def respond(steps, ahead, slopes, spread, transition, driving, first, dt, rates, seen):  # type: ignore[no-untyped-def]
    """Return the derivatives (count, samples, sensors) of one-step errors with respect to some small changes.

    `steps` and `ahead` (samples, n, n) are the transition matrices of a filter and its covariances before each sample;
    `slopes` (samples, sensors, n + a) the derivatives of the readings over the states, with one column for each of the
    `a` states of noise of the sensors; `spread` (samples, sensors) the variances of the errors, infinite where nothing
    was read. `transition`, `driving` and `first` (a, a) are the matrices of these states: to the next sample, of the
    noise added there, and of their covariance at the first sample.
    `rates` (count, samples, n) are the changes of the derivatives of the states, `seen` (count, samples, sensors) those
    of the readings less those of their predictions by a direct effect.
    """
    count, samples, sensors = seen.shape
    n, whole = steps.shape[1], slopes.shape[2]
    out = np.zeros((count, samples, sensors))
    moved, next_moved, next_noise = np.zeros((count, whole)), np.zeros(n), np.zeros((whole - n, whole - n))
    cov, cross, pulled = np.zeros((whole, whole)), np.zeros((n, whole - n)), np.zeros(whole)
    cov[n:, n:] = first
    for k in range(samples):
        for a in range(n):
            for b in range(n):
                cov[a, b] = ahead[k, a, b]
        for s in range(sensors):
            if not np.isfinite(spread[k, s]):
                continue
            for a in range(whole):
                pulled[a] = 0.0
                for b in range(whole):
                    pulled[a] += cov[a, b] * slopes[k, s, b]
            for i in range(count):
                miss = seen[i, k, s]
                for a in range(whole):
                    miss -= slopes[k, s, a] * moved[i, a]
                out[i, k, s] = miss
                for a in range(whole):
                    moved[i, a] += pulled[a] * (miss / spread[k, s])
            for a in range(whole):
                for b in range(whole):
                    cov[a, b] -= pulled[a] * pulled[b] / spread[k, s]
        if k == samples - 1:
            break
        for i in range(count):
            for a in range(n):
                total = 0.5 * dt * rates[i, k + 1, a]
                for b in range(n):
                    total += steps[k, a, b] * (moved[i, b] + 0.5 * dt * rates[i, k, b])
                next_moved[a] = total
            for a in range(n):
                moved[i, a] = next_moved[a]
            for j in range(whole - n):
                pulled[j] = 0.0
                for b in range(whole - n):
                    pulled[j] += transition[j, b] * moved[i, n + b]
            for j in range(whole - n):
                moved[i, n + j] = pulled[j]
        for j in range(whole - n):
            for a in range(n):
                cross[a, j] = 0.0
                for b in range(n):
                    for c in range(whole - n):
                        cross[a, j] += steps[k, a, b] * cov[b, n + c] * transition[j, c]
            for i in range(whole - n):
                next_noise[j, i] = driving[j, i]
                for b in range(whole - n):
                    for c in range(whole - n):
                        next_noise[j, i] += transition[j, b] * cov[n + b, n + c] * transition[i, c]
        for j in range(whole - n):
            for a in range(n):
                cov[a, n + j] = cross[a, j]
                cov[n + j, a] = cross[a, j]
            for i in range(whole - n):
                cov[n + j, n + i] = next_noise[j, i]
    return out


def respond_plainly(*told: Any) -> Any:
    """Return the same as `respond`, in plain Python: its slow twin."""
    return respond.py_func(*told)
