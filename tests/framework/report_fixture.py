"""A made-up diagnosis that looks like a real one: Case 1 with 3 N of dry friction hidden, and the files it would leave.

`draw_report.py` beside it draws the page.
"""

from __future__ import annotations

import copy
import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from lostmotion.codec import from_plain
from lostmotion.diagnosis.report.page_data import Evidence, make_evidence
from lostmotion.results.diagnosis import Diagnosis

OMEGA, DRIVE, MASS, STIFF, GAP = 40.0, 100.0, 1.0, 4e4, 5e-3
PERIOD, PER_PERIOD, SUBSTEPS = 2 * math.pi / OMEGA, 120, 3
TRUTH, BASELINE, FOUND = (8.0, 3.0), (13.0, 0.0), (8.01, 3.01)
HELD, SEGMENT = 0.7, 4 * PER_PERIOD


def acceleration(t, x, v, law):
    spring = STIFF * (np.maximum(x - GAP, 0) + np.minimum(x + GAP, 0))
    return (DRIVE * np.sin(OMEGA * t) - law[0] * v - law[1] * np.tanh(v / 0.01) - spring) / MASS


def step(t, x, v, law):
    h = PERIOD / PER_PERIOD / SUBSTEPS
    for _ in range(SUBSTEPS):
        a = acceleration(t, x, v, law)
        b = acceleration(t + h / 2, x + h / 2 * v, v + h / 2 * a, law)
        x, v = x + h * (v + h / 2 * b), v + h * b
        t = t + h
    return x, v


def run(t0, x, v, steps, law):
    seen = [(x, v)]
    for k in range(steps - 1):
        x, v = step(t0 + k * PERIOD / PER_PERIOD, x, v, law)
        seen.append((x, v))
    return np.array(seen).reshape(steps, 2, -1)


def forecasts(time, x, v, law, rng, blur):
    """Return free-running predictions, four periods from each restart, all started together."""
    length = SEGMENT
    starts = np.arange(int(HELD * time.size), time.size - length, length)
    spread = blur * np.array([x.std(), v.std()])
    x0, v0 = x[starts] + spread[0] * rng.normal(size=starts.size), v[starts] + spread[1] * rng.normal(size=starts.size)
    return starts, run(time[starts], x0, v0, length, law)[:, 0, :]


def laid_out(time, starts, runs):
    out = np.full(time.size, np.nan)
    for start, one in zip(starts, runs.T, strict=True):
        out[start : start + one.size] = one
    return out


def binned(x, y, bins=24):
    edges = np.linspace(*np.quantile(x, [0.002, 0.998]), bins + 1)
    groups = [y[(x >= a) & (x <= b)] for a, b in pairwise(edges)]
    stats = [(g.mean(), *np.quantile(g, [0.025, 0.975])) if g.size > 4 else (np.nan,) * 3 for g in groups]
    return (edges[:-1] + edges[1:]) / 2, np.array(stats).T


def curves(time, x, v, missing, left):
    covariates = {"position": x, "velocity": v, "phase": OMEGA * time % (2 * np.pi), "time": time}
    out: dict[str, Any] = {k: [] for k in ("bin_center", "law_mean")}
    for name, covariate in covariates.items():
        for when, force in (("before", missing), ("after", left)):
            center, (mean, low, high) = binned(covariate, force)
            for kind, values in (("mean", mean), ("low", low), ("high", high)):
                out.setdefault(f"{when}_{kind}", []).append(values)
        out["bin_center"].append(center)
        out["law_mean"].append(-3.01 * np.tanh(center / 0.01) if name == "velocity" else np.full(center.size, np.nan))
    data = {key: (("covariate", "bin"), np.array(rows)) for key, rows in out.items()}
    return data | {"covariate_unit": ("covariate", ["m", "m/s", "rad", "s"])}, list(covariates)


def mechanics(rng, periods):
    steps = periods * PER_PERIOD
    time = np.arange(steps) * PERIOD / PER_PERIOD
    settled = run(0.0, 0.004, 0.0, 20 * PER_PERIOD + 1, TRUTH)[-1, :, 0]
    x, v = run(0.0, *settled, steps, TRUTH)[:, :, 0].T
    response = x + 0.01 * x.std() * rng.normal(size=steps)
    missing = -3 * np.tanh(v / 0.01) + np.convolve(rng.normal(size=steps), np.ones(9) / 9, "same")
    left = 0.6 * np.convolve(rng.normal(size=steps), np.ones(9) / 9, "same")
    return time, x, v, response, missing, left


def growth(time, x, v):
    out = {}
    for name, law, blur in (("before", BASELINE, 3e-3), ("after", FOUND, 3e-3), ("floor", TRUTH, 3e-3)):
        starts, runs = forecasts(time, x, v, law, np.random.default_rng(7), blur)
        true = np.stack([x[s : s + runs.shape[0]] for s in starts], axis=1)
        out[f"growth_{name}"] = ("lead", np.sqrt(np.mean((runs - true) ** 2, axis=1)) / x.std())
    return out, np.arange(SEGMENT) * PERIOD / PER_PERIOD


def portraits(x, v):
    out = {}
    runs = {"recorded": (x, v)}
    for name, law in (("before", BASELINE), ("after", FOUND)):
        runs[name] = tuple(run(0.0, x[0], v[0], x.size, law)[:, :, 0].T)
    for name, (a, b) in runs.items():
        out |= {
            f"portrait_{name}_x": ("portrait", a[: 25 * PER_PERIOD]),
            f"portrait_{name}_v": ("portrait", b[: 25 * PER_PERIOD]),
        }
        out |= {f"section_{name}_x": ("section", a[::PER_PERIOD]), f"section_{name}_v": ("section", b[::PER_PERIOD])}
    return out


def posteriors(rng, draws=600):
    before = np.stack([rng.normal(13.0, 0.09, draws), rng.normal(5.01e-3, 4e-6, draws)], axis=1)
    after = np.stack(
        [rng.normal(8.01, 0.05, draws), rng.normal(5e-3, 2e-6, draws), rng.normal(3.01, 0.02, draws)], axis=1
    )
    return {
        "posterior_before": (("draw", "parameter"), before),
        "posterior_after": (("draw", "parameter_after"), after),
    }


def arrays(seed=1, periods=60):
    rng = np.random.default_rng(seed)
    time, x, v, response, missing, left = mechanics(rng, periods)
    starts, before = forecasts(time, x, v, BASELINE, rng, 3e-3)
    _, after = forecasts(time, x, v, FOUND, rng, 3e-3)
    bins, covariates = curves(time, x, v, missing, left)
    grown, lead = growth(time, x, v)
    restart = np.zeros(time.size, dtype=int)
    restart[starts] = 1
    lags = np.arange(41)
    acf = {
        "before": 0.5 * 0.9**lags * np.cos(lags / 3) + 0.012 * rng.normal(size=41),
        "after": 0.012 * rng.normal(size=41),
    }
    samples = {
        "excitation": (DRIVE * np.sin(OMEGA * time), "N"),
        "response": (response, "m"),
        "position": (x, "m"),
        "velocity": (v, "m/s"),
        "missing_force": (missing, "N"),
        "missing_force_sd": (0.3 + 0 * x, "N"),
        "left_force": (left, "N"),
        "left_force_sd": (0.2 + 0 * x, "N"),
        "forecast_before": (laid_out(time, starts, before), "m"),
        "forecast_after": (laid_out(time, starts, after), "m"),
        "heldout": ((np.arange(time.size) >= HELD * time.size).astype(int), "1"),
        "record": (np.zeros(time.size, int), "1"),
        "restart": (restart, "1"),
    }
    return xr.Dataset(
        {name: ("time", values, {"units": unit, "long_name": name}) for name, (values, unit) in samples.items()}
        | bins
        | grown
        | portraits(x, v)
        | posteriors(rng)
        | {f"acf_{name}": ("lag", np.r_[1.0, values[1:]]) for name, values in acf.items()}
        | {"acf_limit": 0.025},
        coords={
            "time": ("time", time, {"units": "s"}),
            "covariate": covariates,
            "lead": ("lead", lead, {"units": "s"}),
            "lag": lags,
            "parameter": ["c", "x0"],
            "parameter_after": ["c", "x0", "coulomb_friction.force"],
        },
    )


def band(median, half, unit):
    return {"median": median, "low": median - half, "high": median + half, "unit": unit}


RANKING = [
    ("coulomb_friction", 2003.1, 0.9991),
    ("stribeck_friction", 1996.4, 0.0009),
    ("lugre_friction", 1984.0, 1e-9),
    ("quadratic_damping", 797.2, 0.0),
    ("contact_damping", 15.2, 0.0),
    ("cubic_stiffness", 6.8, 0.0),
    ("viscous_damping", 0.0, 0.0),
    ("asymmetric_gap", -1.9, 0.0),
    ("linear_stiffness", -2.2, 0.0),
    ("offset_force", -3.4, 0.0),
    ("gravity_pendulum", None, 0.0),
    ("random_force", 402.0, 0.0),
    ("unknown", 1650.0, 0.0),
    ("nothing_missing", 0.0, 0.0),
]


NOTHING = [
    ("nothing_missing", 0.0, 0.962),
    ("viscous_damping", -1.2, 0.02),
    ("coulomb_friction", -2.7, 0.011),
    ("linear_stiffness", -3.1, 0.007),
    ("cubic_stiffness", -14.8, 0.0),
    ("gravity_pendulum", -870.0, 0.0),
]


def score(log_score, error):
    return {"heldout_log_score": log_score, "heldout_nrmse": error, "heldout_nrmse_by_sensor": {}, "horizon": 2.0}


def row(mechanism, gain, p):
    return {"mechanism": mechanism, "at": "", "log_evidence_gain": gain, "probability": p, "fitted": gain is not None}


def place(summary, **explained_by):
    """Return what a missing force depends on; no p-values, and nothing beyond chance."""
    parts = ("standard_error", "log_likelihood_ratio", "robust_log_likelihood_ratio", "p_value", "p_value_of_share")
    told = {"summary": summary, "explained_by": explained_by, "significant": [], "against": "", "bodies": 1}
    return told | {part: {} for part in parts}


def measures(score, error, p):
    """Return how a model behaves."""
    return {
        "heldout_log_score": score,
        "free_run_error": error,
        "valid_prediction_time": {"value": 3.0, "or_longer": error < 0.1},
        "attractor_distance": {"value": error, "p": p, "status": "ok"},
        "largest_exponent": {"value": 1.0, "low": 0.8, "high": 1.2, "status": "ok"},
        "d2": {"value": 2.1, "low": 2.0, "high": 2.2, "status": "ok", "says": ""},
        "whiteness": {"p": p},
    }


MEASURES = tuple(measures(0.0, 0.0, 0.0))
UNITS = {"valid_prediction_time": "Lyapunov times", "largest_exponent": "1/s"}


def show(augmented=True):
    """Return the measures of the motion, before, after and of noise alone."""
    floor = measures(4.4, 0.01, 0.5)
    del floor["whiteness"], floor["valid_prediction_time"], floor["largest_exponent"]
    after = {"after": measures(4.37, 0.02, 0.4)} if augmented else {}
    return {
        "before": measures(4.02, 0.3, 0.005),
        "noise_floor": floor,
        "units": {name: UNITS.get(name, "1") for name in MEASURES},
        "horizon": {"value": 2.0, "unit": "Lyapunov times"},
        "says": dict.fromkeys(MEASURES, "It is measured."),
        **after,
    }


MACHINE = {
    "model": "lin_backlash",
    "equations": [],
    "units": {},
    "motion": "translation",
    "terms": [{"key": "coulomb_friction", "name": "coulomb_friction", "at": "ground"}],
    "learned": [],
    "sensors": [{"name": "position", "channel": "position"}],
    "values": {"c": 8.01, "x0": 5e-3, "coulomb_friction.force": 3.01},
}


def mismatch():
    """Return a whole `diagnosis.json`."""
    return {
        "schema": "lostmotion.diagnosis/1",
        "verdict": "mismatch",
        "title": "Case 1, 6.37 Hz, 1 % noise",
        "says": [
            "Dry friction of 3.01 N [2.97, 3.05] was left out.",
            "With it the unexplained force falls from 3.1 N to 0.05 N, and the free-running prediction error over "
            "2 Lyapunov times from 31 % to 1.2 % of the response.",
        ],
        "found": [
            {
                "mechanism": "coulomb_friction",
                "state": "named",
                "probability": 0.9991,
                "parameters": {"force": band(3.01, 0.04, "N")},
                "says": "Dry friction of 3.01 N [2.97, 3.05] opposes the motion, 3.0 % of the drive.",
            }
        ],
        "open": [],
        "ranking": [row(*one) for one in RANKING],
        "confused_with": [
            {
                "mechanism": "stribeck_friction",
                "says": "A slower drive, which dwells near zero velocity, would tell them apart.",
            }
        ],
        "unexplained": {"significant": False, "rms": 0.05, "unit": "N", "share_of_drive": 5e-4},
        "unexplained_before": {"significant": True, "rms": 3.1, "unit": "N", "share_of_drive": None},
        "where": place("odd in velocity, absent from position", velocity=0.93, position=0.01, phase=0.02, time=0.0),
        "where_after": place("nowhere above the noise"),
        "parameters": {
            "before": {"c": band(13.0, 0.18, "N s/m"), "x0": band(5.01e-3, 8e-6, "m")},
            "after": {
                "c": band(8.01, 0.1, "N s/m"),
                "x0": band(5e-3, 4e-6, "m"),
                "coulomb_friction.force": band(3.01, 0.04, "N"),
            },
        },
        "fit": {
            "before": score(4.02, 0.31),
            "after": score(4.37, 0.012),
            "noise_floor_nrmse": 0.010,
            "horizon_unit": "Lyapunov times",
            "horizon_unit_time": 1.0 / 7.2,
        },
        "model": {"before": "lin_backlash", "after": "lin_backlash + coulomb_friction"},
        "drive": {"amplitude": 100.0, "unit": "N", "of": "the drive", "frequency": OMEGA / 2 / math.pi, "free": False},
        "units": {"position": "m", "velocity": "m/s", "force": "N", "time": "s"},
        "response": {"quantity": "position"},
        "sensors": [{"name": "position", "channel": "position", "unit": "m", "noise_sd": 4e-5, "kind": "white"}],
        "show": show(),
        "evidence": {},
        "machine": MACHINE,
        "recordings": [{"name": "run 1", "samples": 7200, "rate": 764.0, "start": None, "inputs": ["force"]}],
        "truth": {"c": 8.0, "x0": 5e-3, "coulomb_friction.force": 3.0},
        "lyapunov": {"before": 7.9, "after": 7.2, "unit": "1/s"},
        "valid_prediction_time": {
            "before": 0.19,
            "after": 0.55,
            "unit": "s",
            "or_longer": {"before": False, "after": False},
            "in_lyapunov_times": {"before": 1.4, "after": 4.0},
        },
        "whiteness": {
            "before": {"p": 1e-9, "says": "The innovations remember their past."},
            "after": {"p": 0.41, "says": "The innovations are white."},
        },
        "notes": ["Viscous damping soaks up dry friction: the interval of c without the term is narrow and wrong."],
        "provenance": {
            "component": "lostmotion.diagnose",
            "versions": {"lostmotion": "0.1.0"},
            "seed": 1,
            "inputs": {"recording.csv": "sha256:0f3c"},
            "settings": {"substeps": 3},
        },
    }


def adequate():
    facts = mismatch()
    says = ["Nothing is missing that this recording can show."]
    facts |= {"verdict": "adequate", "found": [], "says": says, "confused_with": [], "title": "Nothing hidden"}
    del facts["parameters"]["after"]["coulomb_friction.force"]
    both = ("fit", "parameters", "valid_prediction_time", "whiteness")
    for told in (*(facts[key] for key in both), facts["valid_prediction_time"]["in_lyapunov_times"]):
        told["before"] = copy.deepcopy(told["after"])
    facts["model"] = {"before": "lin_backlash", "after": "lin_backlash"}
    facts |= {"ranking": [row(*one) for one in NOTHING], "show": show(augmented=False)}
    return facts | {"where": place("nowhere above the noise"), "unexplained_before": facts["unexplained"]}


def alone(data):
    """Return arrays of a model to which nothing had to be added: the good one, now standing first."""
    stale = [
        n for n in data.variables if "before" in n or n in ("parameter", "law_mean") or n.startswith("missing_force")
    ]
    data = data.drop_vars(stale).isel(parameter_after=slice(2)).reset_index("parameter_after")
    names = {n: "parameter" if n == "parameter_after" else n.replace("after", "before") for n in data.variables}
    return data.rename({n: new.replace("left_", "missing_") for n, new in names.items() if n != new})


def unknown():
    facts = mismatch()
    entry = {
        "mechanism": "unknown",
        "state": "open",
        "probability": 0.97,
        "depends_on": ["position", "velocity"],
        "parameters": {},
        "says": "Something is missing that no mechanism of the library explains.",
    }
    return facts | {"found": [entry], "says": [entry["says"]]}


def evidence(facts: dict[str, Any], data: xr.Dataset | None = None) -> Evidence:
    """Return what a page is drawn from, without a folder."""
    return make_evidence(from_plain(Diagnosis, facts), xr.Dataset() if data is None else data)


def write(folder: Path, facts: dict[str, Any], data: xr.Dataset | None = None) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "diagnosis.json").write_text(json.dumps(facts), encoding="utf-8")
    if data is not None:
        data.to_netcdf(folder / "arrays.nc", engine="h5netcdf")
    return folder
