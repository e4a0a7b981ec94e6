"""Calls of the Python interface with wrong arguments, for `fuzz.py --only door`.

Each call is a good one, of which one or more, or entries of them, are replaced by something else. It must
return, or raise one sentence (a `LostMotionError`), without a warning of NumPy or Python on the way. The fit of a
diagnosis and the chain of an identification are left out: they begin after every argument was checked.
"""

from __future__ import annotations

import contextlib
import inspect
import os
import warnings
from datetime import datetime
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

import lostmotion as lm
from fuzz_seeds import CASE, COLUMNS, TIME, N
from lostmotion.diagnosis import diagnosis_run as diagnosis_run
from lostmotion.errors import PluginWarning
from lostmotion.identification import identification_run as identification_run
from lostmotion.inference.setup import make_known
from lostmotion.likelihood.system import System
from lostmotion_chaos.defaults import DENOISER, EMBEDDER, METER, SURROGATE

EQUATION = "m*x'' + c*x' + k*x = force"
TEXTS = [
    "", " ", "nan", "force", "x", "m", "lin_backlash", "m*x''", "m*x'' + k*x/0 = force", "m*x'' + c*x' + x^(0-1) = 0",
    "k*x/(1-1)", "m*x'' + sqrt(-1)*x = force", "m*x'' + log(0)*x = force", "m*x'' + 1e308*1e308*x = force",
    "m*x'' + x/(c-c) = force", "m*x'' + 0^(-1)*x = force", "\x00", "\n", "x" * 5000, "../../x", "ünïcode", "%s{0}",
    "harmonic:amplitude=nan,frequency=2", "harmonic:amplitude=1", "coulomb_friction", "coulomb_friction@nowhere", "s",
    "mm", "N", "parsec", "10 N", "run.csv", "case.toml", "none", "all", "step", "1", "ms", "rad/s", "m/0", "m**1e9",
]  # fmt: skip
_FRAMES = [pd.DataFrame(COLUMNS), pd.DataFrame(), pd.DataFrame({"x": ["a"] * N})]
_SERIES = [pd.Series(TIME), pd.Series([None] * N, dtype=object), pd.Series(["x"] * N)]
ODD = [
    None, True, False, 0, -1, 3, 10**400, 0.0, -0.0, -5.0, 0.5, 1e308, -1e308, 5e-324, float("nan"), float("inf"),
    -float("inf"), 1j, complex("nan"), Decimal("NaN"), Fraction(1, 3), np.float64("nan"), np.int8(3), np.array(2.0),
    np.array([1.0]), np.array([]), np.array(["a", "b"]), np.zeros((3, 2)), np.full(N, np.nan), np.full(N, 1j),
    np.zeros(N), TIME, TIME[::-1], TIME[:5], np.ma.masked_array(TIME, mask=True), np.full(N, "x"), np.array([{}] * N),
    np.datetime64("NaT"), np.array(["2025-01-01"] * N, dtype="datetime64[ns]"), [], [1, 2, 3], ["a", "b"], ["force", 3],
    [None], [[1.0]], (), ("x",), {}, {"a": 1}, {"force": "a"}, {1: 2}, {"m": float("nan")}, {"m": 1j}, {None: None},
    {"position": {"a": {}}}, set(), {"x"}, frozenset({1}), b"bytes", b"\xff", range(3), object(), object, int, len,
    lambda: 1, lambda x: x[:2], iter([1, 2]), (n for n in range(2)), datetime(2025, 1, 1), [datetime(2025, 1, 1)] * N,
    Path("run.csv"), Path(), Exception("x"), slice(3), Ellipsis, NotImplemented, np, lm.Normal, xr.Dataset(),
    xr.DataArray(TIME, dims="time"), *_FRAMES, *_SERIES, *TEXTS,
]  # fmt: skip
if (polars := __import__("importlib").util.find_spec("polars")) is not None:
    import polars

    ODD += [polars.DataFrame(COLUMNS), polars.Series("x", TIME), polars.DataFrame(), polars.LazyFrame(COLUMNS)]


def recording():
    """Return a good recording."""
    return lm.Recording.from_arrays(
        TIME, inputs={"force": COLUMNS["u"]}, sensors={"position": COLUMNS["x"]}, units={"force": "N", "position": "m"}
    )


def case(**changes):
    """Return a good case."""
    given = {"recordings": recording(), "model": EQUATION, "known": {"m": 1.0}, "estimate": priors()}
    return lm.Case(**{**given, **changes})


def priors():
    return {"c": lm.LogUniform(0.01, 10.0), "k": lm.LogUniform(1.0, 1e4)}


def columns():
    """Return the columns of a recording by the words that the constructors use."""
    return {"inputs": {"force": "u"}, "sensors": {"position": "x"}, "units": {"u": "N", "x": "m", "time": "s"}}


def arrays():
    return {
        "time": TIME, "inputs": {"force": COLUMNS["u"]}, "sensors": {"position": COLUMNS["x"]},
        "units": {"force": "N", "position": "m"}, "rate": None, "noise": {}, "hold": "smooth", "name": "run",
        "settings": None,
    }  # fmt: skip


def framed():
    return {
        "frame": pd.DataFrame(COLUMNS), **columns(), "time": "time", "rate": None, "noise": None, "hold": "smooth",
        "name": "run", "settings": {"recording.far": 30.0},
    }  # fmt: skip


def gridded():
    data = xr.Dataset({k: ("time", v) for k, v in COLUMNS.items() if k != "time"}, {"time": TIME})
    return {"dataset": data, **columns(), "time": "time", "noise": None, "hold": "smooth", "name": "run"}


def filed():
    return {"path": "run.csv", **columns(), "time": None, "rate": None, "noise": None, "hold": "step", "name": ""}


def described():
    return {
        "recordings": recording(), "model": EQUATION, "known": {"m": 1.0}, "estimate": priors(), "title": "case",
        "truth": {"c": 1.0}, "sensor": None, "experiment": None,
    }  # fmt: skip


def diagnosed():
    return {
        "case": recording(), "model": EQUATION, "known": {"m": 1.0}, "estimate": priors(), "terms": "all", "seed": 0,
        "jobs": 1, "progress": False, "out": None, "settings": {},
    }  # fmt: skip


def identified():
    return {
        **diagnosed(), "terms": (), "route": None, "maps": (), "fresh": False, "ess": 50.0, "max_steps": 10,
        "walkers": None,
    }  # fmt: skip


def analysed():
    return {
        "recording": recording(), "channel": "position", "columns": (), "time": None, "rate": None, "every": 1,
        "period": None, "denoiser": None, "quantifiers": (), "surrogates": (), "draws": 39, "unit": "1/s", "seed": 0,
        "jobs": 1, "progress": False, "out": None, "settings": None,
    }  # fmt: skip


def simulated():
    return {
        "model": "linear_oscillator", "values": {"m": 1.0, "c": 0.2, "k": 50.0}, "terms": (), "duration": 2.0,
        "rate": 50.0, "drives": "harmonic:amplitude=1,frequency=2", "initial": {"position": 0.1}, "noise": 0.01,
        "seed": 1, "motion": None, "out": None,
    }  # fmt: skip


def mapped():
    return {
        "model": "linear_oscillator", "axes": "c=0.1:0.5:2", "sets": ("m=1", "k=50"), "terms": (), "unit": "nat",
        "drive": "harmonic:amplitude=1,omega=5", "quantities": (), "periods": 20, "transient": 5, "starts": 1,
        "refine": 0, "fresh": False, "seed": 0, "jobs": 1, "motion": None, "out": None, "progress": False,
    }  # fmt: skip


def written():
    return {"text": EQUATION, "units": None, "motion": None, "params": ()}


def embedded():
    embedder = lm.registry.default().make("embedder", EMBEDDER)
    return {"values": COLUMNS["x"], "embedder": embedder, "dt": 0.01, "period": 0.7}


def measured():
    known = lm.registry.default()
    series = lm.embed(COLUMNS["x"], known.make("embedder", EMBEDDER), dt=0.01)
    return {"data": series, "quantifier": known.make("quantifier", METER), "rng": np.random.default_rng(0)}


def cleaned():
    given = measured()
    denoiser = lm.registry.default().make("denoiser", DENOISER)
    return {"series": given["data"], "denoiser": denoiser, "meter": given["quantifier"], "rng": given["rng"]}


def ranked():
    given = measured()
    surrogate = lm.registry.default().make("surrogate", SURROGATE)
    return {
        "series": given["data"], "surrogate": surrogate, "statistic": np.ptp, "draws": 39, "rng": given["rng"],
        "sided": "two", "jobs": 1, "level": 0.05,
    }  # fmt: skip


def numbers(*names):
    return lambda: {**{name: 0.5 + k for k, name in enumerate(names)}, "each": False}


def omit(call):
    """Return a constructor that is called without the arguments that are None and may be left out."""
    needed = {name for name, one in inspect.signature(call).parameters.items() if one.default is one.empty}
    return lambda **given: call(**{name: v for name, v in given.items() if v is not None or name in needed})


def opened(**given):
    lm.load(given["folder"])


def written_case(**given):
    case(**given).write("written")


def moved(**given):
    """Simulate a fitted model: the same checks as those of `DiagnosisResult.model`."""
    from lostmotion.likelihood.sensors import Sensor
    from lostmotion.notebook.machine import FittedModel

    values = {"m": 1.0, "c": 0.2, "k": 50.0}
    FittedModel(lm.model("linear_oscillator"), (), values, (Sensor("position", ""),)).simulate(**given)


def driven():
    return {"inputs": {"force": COLUMNS["u"]}, "duration": None, "rate": 100.0, "initial": {"position": 0.0}}


CALLS = [
    (lm.Recording.from_arrays, arrays, 4), (lm.Recording.from_pandas, framed, 4),
    (lm.Recording.from_xarray, gridded, 2), (lm.Recording.read, filed, 2), (omit(lm.Case), described, 4),
    (lm.diagnose, diagnosed, 4), (lm.identify, identified, 3), (lm.analyse, analysed, 2), (lm.simulate, simulated, 3),
    (lm.map, mapped, 2), (lm.model, written, 3), (opened, lambda: {"folder": "."}, 0.3), (moved, driven, 1),
    (written_case, lambda: {"title": "t", "known": {"m": 1.0}}, 0.5), (lm.Uniform, numbers("low", "high"), 0.5),
    (lm.LogUniform, numbers("low", "high"), 0.5), (lm.Normal, numbers("mean", "sd"), 0.5),
    (lm.LogNormal, numbers("median", "sd_log"), 0.5), (lm.HalfNormal, numbers("sd"), 0.5),
    (lm.embed, embedded, 1), (lm.quantify, measured, 0.5), (lm.denoise, cleaned, 0.5), (lm.surrogate_test, ranked, 0.5),
    (lambda **given: lm.Settings().changed(**given), lambda: {"values": {"select.decisive": 4.0}}, 0.5),
]  # fmt: skip
"""What is called, its good arguments, and how often for one of the others."""


def compile_kernels():
    """Make all good arguments once: what they compile is then no part of the time of a call."""
    for _, good, _ in CALLS:
        good()


PIECES = [
    "m*x''", "c*x'", "k*x", "force", "u", "0", "1", "2.5", "1e308", "x", "x'", "(x - x)", "sqrt(x/x0)", "sin(x/x0)",
    "gap(x, k, x0)", "sign(x')", "log(k/k)", "(x/x0)^3", "x''", "y'", "exp(k/c)", "pi", "m", "base_position", "q*z",
]  # fmt: skip


def equation(rng):
    """Return an equation of random parts: some can be read, and most make no sense."""
    text = "m*x''" if rng.random() < 0.8 else ""
    for _ in range(int(rng.integers(1, 5))):
        text += "+-*/^"[int(rng.choice(5, p=[0.4, 0.2, 0.2, 0.15, 0.05]))] + PIECES[int(rng.integers(len(PIECES)))]
    return text + (" = " + PIECES[int(rng.integers(len(PIECES)))] if rng.random() < 0.9 else "")


def alike(value, rng):
    """Return something else of the kind of a value: a number for a number, a text for a text."""
    if isinstance(value, str) and "=" in value and rng.random() < 0.7:
        return equation(rng)
    kind = str if isinstance(value, str) else (int, float) if isinstance(value, (int, float)) else type(value)
    same = [odd for odd in ODD if isinstance(odd, kind)]
    return same[int(rng.integers(len(same)))] if same and rng.random() < 0.6 else ODD[int(rng.integers(len(ODD)))]


def spoiled(given, rng):
    """Return arguments of which one or more, or entries of them, are something else."""
    made = dict(given)
    for _ in range(int(rng.geometric(0.6))):
        name = list(made)[int(rng.integers(len(made)))]
        value = made[name]
        odd = alike(value, rng)
        if isinstance(value, dict) and value and rng.random() < 0.7:
            value, key = dict(value), list(value)[int(rng.integers(len(value)))]
            odd = alike(value[key], rng)
            if rng.random() < 0.2:
                del value[key]
            elif rng.random() < 0.2 and odd.__hash__ is not None:
                value[odd] = value.pop(key)
            else:
                value[key] = odd
            made[name] = value
        elif isinstance(value, np.ndarray) and value.shape == (N,) and rng.random() < 0.5:
            made[name] = _other(value, rng)
        elif isinstance(value, tuple) and rng.random() < 0.5:
            made[name] = (*value, odd)
        else:
            made[name] = odd
    return made


def _other(values, rng):
    """Return an array of another length, kind or shape, with odd values."""
    way = int(rng.integers(7))
    if way == 0:
        return values[: int(rng.integers(len(values)))]
    if way == 1:
        kinds = [np.complex128, object, str, np.float32, bool]
        return values.astype(kinds[int(rng.integers(len(kinds)))])
    if way == 2:
        return np.where(rng.random(len(values)) < 0.1, rng.choice([np.nan, np.inf, -np.inf, 1e308, 0.0]), values)
    if way == 3:
        return [*values.tolist(), ODD[int(rng.integers(len(ODD)))]]
    if way == 4:
        return values.reshape(2, -1)
    return values * rng.choice([1e300, -1.0, 1e-300, np.nan]) if way == 5 and values.dtype == float else values[::-1]


def checked_case(prepared, *_given, **_options):
    """Stand in place of the fit: the values and priors of the prepared case become those of its system."""
    make_known(System(prepared.model, prepared.terms), prepared.case)
    raise PassedError


class PassedError(BaseException):
    """The arguments were accepted: the fit, which takes minutes, would begin here."""


def door(seeds, rng, folder, write_only):
    """Call one function of the Python interface with wrong arguments."""
    weights = np.array([weight for _, _, weight in CALLS], dtype=float)
    call, good, _ = CALLS[int(rng.choice(len(CALLS), p=weights / weights.sum()))]
    given = spoiled(good(), rng)
    if write_only:
        (folder / "call.txt").write_text(f"{getattr(call, '__qualname__', call)} {good.__name__}\n{given!r}\n")
        return
    (folder / "run.csv").write_bytes(seeds.files["csv"]["run.csv"])
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    os.chdir(folder)
    diagnosis_run.diagnose_prepared = checked_case
    identification_run.identify_case = lambda _case, prepared, *_rest: checked_case(prepared)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("default", PluginWarning)
        warnings.filterwarnings("ignore", "unclosed file", ResourceWarning)
        with contextlib.suppress(PassedError):
            call(**given)
