"""Noise reduction against plain NumPy and SciPy, on Lorenz x with N = 20,000 and 2 or 10 % noise."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from lostmotion.contracts import Series
from lostmotion.results import Embedding
from lostmotion_chaos.denoisers.projective import LocalProjective
from lostmotion_chaos.denoisers.simple import SimpleNonlinear
from yardstick import Array, Case, lorenz

DIM = 7


def noisy(level: float) -> tuple[Array, float]:
    """Return the recording (n,) with noise, and the noise's standard deviation."""
    x = lorenz() - lorenz().mean()
    noise = level * float(x.std())
    return x + noise * np.random.default_rng(12345).normal(size=len(x)), noise


def ours(denoiser: SimpleNonlinear | LocalProjective, level: float) -> Array:
    """Return the cleaned recording (n,)."""
    x, noise = noisy(level)
    return denoiser.clean(Series(x, 0.02, Embedding(8, 4, 100)), noise=noise, rng=np.random.default_rng(0))


def plain_simple(level: float) -> Array:
    """Return the recording after one pass of the simple scheme, by `query_ball_point`."""
    x, noise = noisy(level)
    rows = np.lib.stride_tricks.sliding_window_view(x, DIM)
    middle, out = rows[:, DIM // 2], x.copy()
    near = cKDTree(rows).query_ball_point(rows, 3.0 * noise, p=np.inf)
    out[DIM // 2 : DIM // 2 + len(rows)] = [middle[found].mean() for found in near]
    return out


def plain_projection(level: float, k: int = 30, keep: int = 3) -> Array:
    """Return the recording after one local projection: `eigh` of all neighbourhoods of k at once."""
    x, _ = noisy(level)
    rows = np.lib.stride_tricks.sliding_window_view(x, DIM)
    near = cKDTree(rows).query(rows, k=k, p=np.inf)[1]
    metric = np.ones(DIM)
    metric[[0, -1]] = 1e3
    groups = rows[near]
    mean = groups.mean(axis=1)
    off = (groups - mean[:, None]) * metric
    small = np.linalg.eigh(np.einsum("nki,nkj->nij", off, off))[1][:, :, : DIM - keep]
    raw = np.einsum("nia,nja,nj->ni", small, small, (rows - mean) * metric) / metric
    bare = (raw - raw[near].mean(axis=1)) / (metric * (1.0 / metric).sum())
    out = x.copy()
    for i in range(DIM):
        out[i : i + len(rows)] -= bare[:, i]
    return out


SIMPLE = SimpleNonlinear(iterations=1)
PROJECTED = LocalProjective(dim=DIM, keep=3, iterations=1)

CASES = [
    Case("simple scheme, 2 % noise", lambda: ours(SIMPLE, 0.02), lambda: plain_simple(0.02), 0.03),
    Case("simple scheme, 10 % noise", lambda: ours(SIMPLE, 0.10), lambda: plain_simple(0.10), 0.3),
    Case("simple scheme as it is by default, 10 % noise", lambda: ours(SimpleNonlinear(), 0.10), None),
    Case("local projection, 2 % noise", lambda: ours(PROJECTED, 0.02), lambda: plain_projection(0.02), 0.5),
    Case("local projection, 10 % noise", lambda: ours(PROJECTED, 0.10), lambda: plain_projection(0.10), 0.5),
    Case("local projection as it is by default, 2 % noise", lambda: ours(LocalProjective(), 0.02), None),
    Case("local projection as it is by default, 10 % noise", lambda: ours(LocalProjective(), 0.10), None),
]
