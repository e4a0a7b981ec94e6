"""Orbits, and the curves of an analysis from a few plain lines each: what the fixture of the report is made of."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import cKDTree

from lostmotion.storage import StoredArray

OMEGA, STEPS, EVERY = 40.0, 96, 2
DRIVE_PERIOD = 2 * math.pi / OMEGA


def strobe(rate, y, n, h):
    """Return the first coordinate (n,) of an orbit, by RK4."""
    seen = np.empty(n)
    for k in range(n):
        seen[k] = y[0]
        a = rate(k * h, y)
        b = rate((k + 0.5) * h, y + h / 2 * a)
        c = rate((k + 0.5) * h, y + h / 2 * b)
        y = y + h / 6 * (a + 2 * b + 2 * c + rate((k + 1) * h, y + h * c))
    return seen


def backlash(periods=150, gap=5e-3, transient=30):
    """Return the drive (N) and the displacement (m) of Lin's oscillator with noise-free sampling, and its step (s)."""

    def rate(t, y):
        spring = 4e4 * (max(y[0] - gap, 0.0) + min(y[0] + gap, 0.0))
        return np.array([y[1], 100.0 * math.sin(OMEGA * t) - 8.0 * y[1] - spring])

    h = DRIVE_PERIOD / STEPS * 1.0003
    keep = slice(transient * STEPS, None, EVERY)
    x = strobe(rate, np.array([1e-3, 0.1]), (periods + transient) * STEPS, h)
    return 100.0 * np.sin(OMEGA * np.arange(len(x)) * h)[keep], x[keep], EVERY * h


def lorenz(n=5000, dt=0.02):
    """Return x of the Lorenz system and its step (s)."""

    def rate(_, y):
        return np.array([10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8 / 3 * y[2]])

    return strobe(rate, np.array([1.0, 1.0, 20.0]), n, dt), dt


def under(dims, unit="1", **values):
    """Return columns that share their dimensions and unit."""
    return {name: StoredArray(tuple(dims.split()), v, unit, name) for name, v in values.items()}


def vectors(x, lag, dim):
    rows = len(x) - (dim - 1) * lag
    return np.stack([x[k * lag : k * lag + rows] for k in range(dim)], axis=1)


def embedding_curves(x, dt, lag, prefix):
    """Return mutual information, autocorrelation, Cao's numbers and false neighbours, each from a few lines."""
    lags = np.arange(1, 5 * lag)
    table, edges = [], np.linspace(x.min(), x.max(), 33)
    for k in lags:
        joint = np.histogram2d(x[:-k], x[k:], bins=[edges, edges])[0] / (len(x) - k)
        apart = np.outer(joint.sum(axis=1), joint.sum(axis=0))
        some = joint > 0
        table.append(float(np.sum(joint[some] * np.log(joint[some] / apart[some]))))
    centred = x - x.mean()
    auto = np.array([centred[:-k] @ centred[k:] for k in lags]) / (centred @ centred)
    dims, e, star, false = np.arange(1, 10), [], [], []
    for dim in range(1, 11):
        high = vectors(x, lag, dim + 1)
        distance, index = cKDTree(high[:, :dim]).query(high[:, :dim], k=2, p=np.inf)
        distance, index = np.maximum(distance[:, 1], 1e-9), index[:, 1]
        gap = np.abs(high[:, dim] - high[index, dim])
        e.append(np.mean(np.maximum(distance, gap) / distance))
        star.append(np.mean(gap))
        false.append(np.mean(gap > 10 * distance))
    e, star = np.array(e), np.array(star)
    curves = {"lag": lags * dt, "ami": np.array(table), "ami_floor": np.full(len(lags), 32**2 / (2 * len(x))),
              "autocorrelation": auto, "dim": dims, "e1": e[1:] / e[:-1], "e2": star[1:] / star[:-1],
              "dim_fnn": dims, "fnn": np.array(false[:9])}  # fmt: skip
    axis = {"ami": "lag", "ami_floor": "lag", "autocorrelation": "lag", "e1": "dim", "e2": "dim", "fnn": "dim_fnn"}
    units = {"lag": "s", "ami": "nat", "ami_floor": "nat"}
    return {prefix + k: StoredArray((prefix + axis.get(k, k),), v, units.get(k, "1"), k) for k, v in curves.items()}


def divergence_curves(x, dt, lag, dim):
    def curve(lag, dim, x=x, steps=100):
        points = vectors(x, lag, dim)[:-steps]
        _, index = cKDTree(points[:-1]).query(points, k=40)
        apart = np.abs(index - np.arange(len(points))[:, None]) > 40
        first = index[np.arange(len(points)), np.argmax(apart, axis=1)]
        keep = apart.any(axis=1) & (first + steps < len(x)) & (np.arange(len(points)) + steps < len(x))
        here, there = np.flatnonzero(keep), first[keep]
        return np.array([np.mean(np.log(np.abs(x[here + k] - x[there + k]) + 1e-9)) for k in range(steps)])

    main = curve(lag, dim)
    members = np.array([curve(lag, dim + 1), curve(lag + 2, dim), curve(max(1, lag - 2), dim), curve(lag, dim + 2)])
    time = np.arange(len(main)) * dt
    return {
        **under("lyapunov_time", "s", lyapunov_time=time),
        **under("lyapunov_time", lyapunov_divergence=main, lyapunov_slope=np.gradient(main, dt)),
        **under("lyapunov_variant lyapunov_time", lyapunov_members=members),
    }


def correlation_curves(x, lag, unit, most=7):
    radius = np.geomspace(2e-3, 1.0, 40) * np.ptp(x)
    sums = np.array([_sum(vectors(x, lag, dim)[::3], radius) for dim in range(1, most)])
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.where(sums > 0, np.log(sums), np.nan)
        slopes = np.gradient(logs, np.log(radius), axis=1)
    window = (radius > 0.02 * np.ptp(x)) & (radius < 0.1 * np.ptp(x))
    by_dim = np.nanmean(slopes[:, window], axis=1)
    dims = np.arange(1, most)
    drawn = 0.9 * dims**0.95 + 0.03 * dims * np.random.default_rng(5).normal(size=(15, 1))
    return {
        **under("d2_radius", unit, d2_radius=radius),
        **under("d2_dim d2_radius", d2_log_correlation=logs, d2_slope=slopes),
        **under("d2_dim", d2_dim=dims, d2_dimension_by_dim=by_dim),
        **under("d2_dim", d2_low_by_dim=by_dim - 0.1, d2_high_by_dim=by_dim + 0.1),
        **under("d2_draw d2_dim", surrogate_d2_by_dim=drawn),
    }


def _sum(points, radius):
    tree = cKDTree(points)
    pairs = tree.count_neighbors(tree, radius, p=np.inf) - len(points)
    return pairs / (len(points) * (len(points) - 1))
