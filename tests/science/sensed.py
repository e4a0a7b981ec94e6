"""Recordings of several sensors by an integrator that shares nothing with ours, written as a case with its file."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from lostmotion.case import dump_case
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.registry import Registry

CHAIN = {
    "m1": 1.1, "c1": 0.6, "k1": 120.0, "m2": 0.8, "c2": 0.3, "k2": 25.0, "k0": 700.0, "c0": 0.4, "x0": 1.5e-3,
}  # fmt: skip


def multisine(level, low, high, seed, lines=12):
    """Return a multisine of the amplitude `level` as a function of time (s); its band is in Hz."""
    rng = np.random.default_rng(seed)
    tones, phases = rng.uniform(low, high, lines), rng.uniform(0.0, 2.0 * math.pi, lines)
    size = level / math.sqrt(lines)
    return lambda t: size * np.sum(np.cos(2.0 * math.pi * np.multiply.outer(t, tones) + phases), axis=-1)


def moved(rates, t, start, *, finer=6):
    """Return the states (samples, n) at the times `t` (s) from a start."""
    step = (t[1] - t[0]) / finer
    return solve_ivp(rates, (t[0], t[-1]), start, "DOP853", t_eval=t, rtol=1e-8, atol=1e-11, max_step=step).y.T


def chain(t, force, second=lambda t: 0.0, values=CHAIN):
    """Return the states of a clearance chain under a force on the first and one on the second body."""
    q = values

    def rates(now, y):
        lean = y[0] - y[2]
        joint = q["c0"] * (y[1] - y[3]) + q["k0"] * math.copysign(max(abs(lean) - q["x0"], 0.0), lean)
        first = float(force(now)) - q["c1"] * y[1] - q["k1"] * y[0] - joint
        other = float(second(now)) + joint - q["c2"] * y[3] - q["k2"] * y[2]
        return [y[1], first / q["m1"], y[3], other / q["m2"]]

    return moved(rates, t, [0.0] * 4)


def noisy(values, share, seed):
    """Return values with white noise, a share of their standard deviation."""
    return values + share * np.std(values) * np.random.default_rng(seed).standard_normal(len(values))


def case_of(folder: Path, columns, recording, model) -> Path:
    """Return the path of a case with a recording of the given columns."""
    np.savez(folder / "run.npz", **columns)
    recordings = [{"file": "run.npz", "time": "t", **recording}]
    dump_case({"title": "sensors", "recordings": recordings, "model": model}, folder / "case.toml")
    return folder / "case.toml"


def model_of(name, values, unknown):
    """Return the model of a case that knows `values` but for the `unknown`: log-uniform priors of a decade."""
    wide = {k: {"low": values[k] / 3.0, "high": 3.0 * values[k], "scale": "log"} for k in unknown}
    return {"name": name, "known": {k: v for k, v in values.items() if k not in unknown}, "estimate": wide}


def said_of(case: Path, **kind):
    """Return what a diagnosis of a case says."""
    return run_diagnosis(case, case.parent / "out", Registry.discover(), propose=False, **kind)
