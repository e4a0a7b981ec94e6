"""Made-up analyses that look like real ones, and the files they would leave, with curves from a few plain lines each.

Run it to look at the reports: `python tests/framework/analysis_fixture.py FOLDER`.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from lostmotion.signals.sections import stroboscopic
from lostmotion.signals.spectra import spectrum, without_harmonics
from lostmotion.storage import Column, save_arrays, save_json

OMEGA, STEPS = 40.0, 192
DRIVE_PERIOD = 2 * math.pi / OMEGA
EVERY = 4
HOSTILE = "<script>alert('x')</script> & $\\frac{$ \"quoted\" " + "very long " * 30
NULLS = (
    "a Gaussian linear process seen through a static nonlinearity, with the same spectrum and values",
    "a periodic motion with noise that is not correlated from one period to the next",
)


def backlash(periods=150, gap=5e-3, transient=30):
    """Return the drive (N) and the displacement (m) of Lin's oscillator with noise-free sampling, and its step (s)."""
    h = DRIVE_PERIOD / STEPS * 1.0003
    n = (periods + transient) * STEPS

    def rate(t, x, v):
        spring = 4e4 * (max(x - gap, 0.0) + min(x + gap, 0.0))
        return 100.0 * math.sin(OMEGA * t) - 8.0 * v - spring

    x, v, seen = 1e-3, 0.1, np.empty(n)
    for k in range(n):
        seen[k] = x
        t = k * h
        a = rate(t, x, v)
        b = rate(t + h / 2, x + h / 2 * v, v + h / 2 * a)
        x, v = x + h * (v + h / 2 * b), v + h * b
    time = np.arange(n) * h
    keep = slice(transient * STEPS, None, EVERY)
    return 100.0 * np.sin(OMEGA * time[keep]), seen[keep], EVERY * h


def lorenz(n=5000, dt=0.02):
    """Return x of the Lorenz system and its step (s)."""

    def rate(y):
        return np.array([10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8 / 3 * y[2]])

    y, seen = np.array([1.0, 1.0, 20.0]), np.empty(n)
    for k in range(n):
        a = rate(y)
        b = rate(y + dt / 2 * a)
        c = rate(y + dt / 2 * b)
        y = y + dt / 6 * (a + 2 * b + 2 * c + rate(y + dt * c))
        seen[k] = y[0]
    return seen, dt


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
    return {prefix + k: Column((prefix + axis.get(k, k),), v, units.get(k, "1"), k) for k, v in curves.items()}


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
        "lyapunov_time": Column(("lyapunov_time",), time, "s", "time"),
        "lyapunov_divergence": Column(("lyapunov_time",), main),
        "lyapunov_members": Column(("lyapunov_variant", "lyapunov_time"), members),
        "lyapunov_slope": Column(("lyapunov_time",), np.gradient(main, dt), "1/s"),
    }


def correlation_curves(x, lag, unit, most=7):
    radius = np.geomspace(2e-3, 1.0, 40) * np.ptp(x)
    sums = np.array([_sum(vectors(x, lag, dim)[::3], radius) for dim in range(1, most)])
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.where(sums > 0, np.log(sums), np.nan)
        slopes = np.gradient(logs, np.log(radius), axis=1)
    window = (radius > 0.02 * np.ptp(x)) & (radius < 0.1 * np.ptp(x))
    by_dim = np.nanmean(slopes[:, window], axis=1)
    plane, dims = ("d2_dim", "d2_radius"), np.arange(1, most)
    rng = np.random.default_rng(5)
    return {
        "d2_radius": Column(("d2_radius",), radius, unit),
        "d2_dim": Column(("d2_dim",), dims),
        "d2_log_correlation": Column(plane, logs),
        "d2_slope": Column(plane, slopes),
        "d2_dimension_by_dim": Column(("d2_dim",), by_dim),
        "d2_low_by_dim": Column(("d2_dim",), by_dim - 0.1),
        "d2_high_by_dim": Column(("d2_dim",), by_dim + 0.1),
        "surrogate_d2_by_dim": Column(
            ("d2_draw", "d2_dim"), 0.9 * dims**0.95 + 0.08 * dims * rng.normal(size=(15, 1)) / 3
        ),
    }


def _sum(points, radius):
    tree = cKDTree(points)
    pairs = tree.count_neighbors(tree, radius, p=np.inf) - len(points)
    return pairs / (len(points) * (len(points) - 1))


def spectrum_of(x, dt, period, unit):
    table = {"density": x}
    if period:
        table["density_rest"] = without_harmonics(x, dt, period)[0]
    columns = {name: Column(("frequency",), spectrum(v, dt).density, f"({unit})^2/Hz") for name, v in table.items()}
    return columns | {"frequency": Column(("frequency",), spectrum(x, dt).frequency, "Hz")}


def section_of(x, dt, period, lag, unit):
    return Column(("hit", "axis"), stroboscopic(x, dt, period, lag=lag).points, unit)


def chaotic():
    """Return facts and arrays of a driven machine with 3 % noise, of which 0.5 % is left after cleaning."""
    drive, clean, dt = backlash()
    rng = np.random.default_rng(1)
    x = clean + 0.03 * clean.std() * rng.normal(size=len(clean))
    cleaned = clean + 0.005 * clean.std() * rng.normal(size=len(clean))
    lag = 12
    arrays = {
        "time": Column(("time",), np.arange(len(x)) * dt, "s"),
        "x": Column(("time",), x, "m", "displacement, mean taken off"),
        "cleaned": Column(("time",), cleaned, "m", "displacement, noise reduced"),
        "excitation": Column(("time",), drive, "N", "measured excitation"),
        **spectrum_of(x, dt, DRIVE_PERIOD, "m"),
        "section": section_of(x, dt, DRIVE_PERIOD, lag, "m"),
        "section_cleaned": section_of(cleaned, dt, DRIVE_PERIOD, lag, "m"),
        **embedding_curves(cleaned, dt, lag, "embedding_"),
        **embedding_curves(x, dt, lag, "embedding_raw_"),
        **divergence_curves(cleaned, dt, lag, 4),
        **correlation_curves(cleaned, lag, "m"),
        "surrogate_values": Column(
            ("test", "draw"), np.stack([rng.normal(0.61, 0.02, 99), rng.normal(0.34, 0.02, 99)])
        ),
        "surrogate_original": Column(("test",), np.array([0.12, 0.11])),
    }
    return facts("Case 1, gap of 5 mm", dt, lag), arrays


def facts(title, dt, lag):
    return {
        "schema": "lostmotion.analysis/1",
        "title": title,
        "verdict": "chaotic",
        "says": "Neighbouring states part at 7.3 1/s [6.6, 8.1], and the correlation dimension levels off at 2.4. "
        "Noise with the same spectrum and values does not look like it (p = 0.02).",
        "because": ["iaaft: the prediction error is lower than that of 99 surrogates (p = 0.02)"],
        "delay": {"samples": lag, "seconds": lag * dt, "method": "ami"},
        "dimension": {"value": 4, "method": "cao", "theiler": 48},
        "noise": {"before": 0.031, "after": 0.005, "unit": "share of the signal's standard deviation",
                  "method": "local_projective"},
        "lyapunov": {"value": 7.3, "low": 6.6, "high": 8.1, "unit": "1/s", "method": "lyapunov_rosenstein",
                     "status": "ok", "says": "", "details": {"fit_begin": 0.04, "fit_end": 0.2, "intercept": -8.9}},
        "d2": {"value": 2.41, "low": 2.2, "high": 2.6, "unit": "1", "method": "grassberger_procaccia",
               "status": "uncertain", "says": "The sampling is locked to the drive: the dimension of the section plus "
               "one is given.", "details": {"r_low": 3e-4, "r_high": 1.5e-3}},
        "k2": {"value": 6.9, "low": 5.2, "high": 9.0, "unit": "1/s", "method": "grassberger_procaccia",
               "status": "ok", "says": ""},
        "others": [{"name": "lyapunov_kantz", "value": None, "low": None, "high": None, "unit": "1/s",
                    "method": "lyapunov_kantz", "status": "no_scaling_region", "says": ""}],
        "surrogates": [
            {"null": null, "method": method, "statistic": "prediction_error", "draws": 99, "p": p, "sided": "two",
             "original": 0.1, "says": "Rejected: the recording is easier to predict than all of them."}
            for null, method, p in zip(NULLS, ("iaaft", "pseudo_periodic"), (0.02, 0.0004), strict=True)
        ],
        "drive": {"period": DRIVE_PERIOD, "samples_per_period": DRIVE_PERIOD / dt, "source": "excitation"},
        "notes": ["The recording holds 150 periods: some hundreds would narrow the interval of the dimension."],
        "provenance": {"seed": 0, "version": "0"},
    }  # fmt: skip


def undriven():
    """Return facts and arrays of the Lorenz system, without noise, drive or unit, in bit/s."""
    x, dt = lorenz()
    arrays = {
        "time": Column(("time",), np.arange(len(x)) * dt, "s"),
        "x": Column(("time",), x, "", "x"),
        **spectrum_of(x, dt, None, "1"),
        **embedding_curves(x, dt, 8, "embedding_"),
        **divergence_curves(x, dt, 8, 4),
        **correlation_curves(x, 8, ""),
        "surrogate_values": Column(("test", "draw"), np.random.default_rng(2).normal(0.4, 0.03, (1, 39))),
        "surrogate_original": Column(("test",), np.array([0.05])),
    }
    del arrays["surrogate_d2_by_dim"]
    said = facts("Lorenz, x", dt, 8)
    said["lyapunov"] |= {"value": 1.3, "low": 1.1, "high": 1.45, "unit": "bit/s",
                         "details": {"fit_begin": 0.4, "fit_end": 1.6}}  # fmt: skip
    said["d2"] |= {"value": 2.06, "low": 1.95, "high": 2.15, "status": "ok", "says": "",
                   "details": {"r_low": 0.6, "r_high": 4.0}}  # fmt: skip
    said |= {"drive": {"period": None, "samples_per_period": None, "source": "none"}, "others": []}
    said["noise"] |= {"after": None}
    return said | {"surrogates": said["surrogates"][:1], "notes": []}, arrays


def periodic():
    """Return facts and arrays of a motion of period two, without surrogates."""
    dt, period = 1.0 / 97.3, 1.0
    time = np.arange(4000) * dt
    x = np.deg2rad(3 * np.sin(2 * np.pi * time) + 0.8 * np.sin(np.pi * time + 1) + 0.4 * np.sin(6 * np.pi * time))
    x = x + np.deg2rad(0.02) * np.random.default_rng(3).normal(size=time.size)
    arrays = {
        "time": Column(("time",), time, "s"),
        "x": Column(("time",), x, "rad", "joint_angle, mean taken off"),
        **spectrum_of(x, dt, period, "rad"),
        "section": section_of(x, dt, period, 20, "rad"),
        **embedding_curves(x, dt, 20, "embedding_"),
    }
    said = facts("Joint, 1 Hz", dt, 20)
    for key, status in (("lyapunov", "not_saturating"), ("d2", "below_noise"), ("k2", "below_noise")):
        said[key] |= {"value": None, "low": None, "high": None, "status": status, "details": {}}
        said[key]["says"] = "The distances of neighbours do not grow: there is nothing to read an exponent from."
    said |= {"verdict": "periodic", "because": [], "surrogates": [], "others": [], "notes": []}
    said["says"] = "The motion repeats itself every 2 periods of 1 s; 0.9 % of it does not repeat, no more than noise."
    return said | {"drive": {"period": period, "samples_per_period": 97.3, "source": "spectrum"}}, arrays


def refused():
    """Return facts and arrays of noise: no number at all, and curves with NaN in them."""
    x = np.random.default_rng(4).normal(size=1200)
    arrays = {
        "time": Column(("time",), np.arange(1200) * 0.01, "s"),
        "x": Column(("time",), x, "V", "piezo voltage"),
        **spectrum_of(x, 0.01, None, "V"),
        **embedding_curves(x, 0.01, 2, "embedding_"),
        **divergence_curves(x, 0.01, 1, 4),
        **correlation_curves(x, 1, "V"),
        "surrogate_values": Column(("test", "draw"), np.full((1, 39), np.nan)),
        "surrogate_original": Column(("test",), np.array([np.nan])),
    }
    said = facts("Noise", 0.01, 1)
    none = {"value": None, "low": None, "high": None, "details": {}, "says": ""}
    for key, status in (("lyapunov", "not_saturating"), ("d2", "rising"), ("k2", "rising")):
        said[key] |= none | {"status": status}
    said |= {"delay": {"samples": None, "seconds": None, "method": "ami"}, "dimension": {"value": None}}
    said |= {"noise": {"before": None, "after": None, "unit": "share of the signal's standard deviation"}}
    said |= {"verdict": "stochastic", "drive": {"period": None}, "others": []}
    said["says"] = "Noise with the same spectrum and values looks just like it: nothing speaks for chaos."
    said["surrogates"] = [said["surrogates"][0] | {"p": None, "says": ""}]
    return said, arrays


def hostile():
    """Return the analysis of a file in which every text is meant to do harm."""
    said, arrays = chaotic()
    arrays = {name: Column(c.dims, c.values, HOSTILE, HOSTILE) for name, c in arrays.items()}
    return _poisoned(said), arrays


def _poisoned(value):
    if isinstance(value, dict):
        return {key: _poisoned(v) for key, v in value.items()} | {HOSTILE[:30]: HOSTILE}
    if isinstance(value, list):
        return [_poisoned(v) for v in value]
    return HOSTILE if isinstance(value, str) else value


KINDS = {f.__name__: f for f in (chaotic, undriven, periodic, refused, hostile)}


def write(folder: Path, said, arrays) -> Path:
    """Return the folder, with the files of an analysis in it."""
    folder.mkdir(parents=True, exist_ok=True)
    save_json(folder / "analysis.json", said)
    coords = {name: column for name, column in arrays.items() if column.dims == (name,)}
    rest = {name: column for name, column in arrays.items() if name not in coords}
    save_arrays(folder / "analysis.nc", rest, coords, {})
    return folder


if __name__ == "__main__":
    from lostmotion.report.analysis import write_analysis

    for kind, make in KINDS.items():
        write_analysis(write(Path(sys.argv[1]) / kind, *make()))
