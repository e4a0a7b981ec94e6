"""Made-up analyses that look like real ones, and the files they would leave.

Run it to look at the reports: `python tests/framework/analysis_fixture.py FOLDER`.
"""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from lostmotion.signals.spectra import spectrum, without_harmonics
from lostmotion.storage import StoredArray, save_arrays, save_json
from lostmotion_chaos.signals.sections import stroboscopic

HOSTILE = "<script>alert('x')</script> & $\\frac{$ \"quoted\" " + "very long " * 30
plain = SimpleNamespace(**runpy.run_path(str(Path(__file__).with_name("analysis_curves.py"))))
under, DRIVE_PERIOD = plain.under, plain.DRIVE_PERIOD
FEW = ("verdict", "strength", "state", "sided", "source")
SHARE = "share of the signal's standard deviation"
NULLS = (
    "a Gaussian linear process seen through a static nonlinearity, with the same spectrum and values",
    "a periodic motion with noise that is not correlated from one period to the next",
)


def spectrum_of(x, dt, period, unit):
    table = {"density": x}
    if period:
        table["density_rest"] = without_harmonics(x, dt, period)[0]
    columns = {
        name: StoredArray(("frequency",), spectrum(v, dt).density, f"({unit})^2/Hz") for name, v in table.items()
    }
    return columns | {"frequency": StoredArray(("frequency",), spectrum(x, dt).frequency, "Hz")}


def section_of(x, dt, period, lag, unit):
    return StoredArray(("hit", "axis"), stroboscopic(x, dt, period, lag=lag).points, unit)


def chaotic():
    """Return facts and arrays of a driven machine with 3 % noise, of which 0.5 % is left after cleaning."""
    drive, clean, dt = plain.backlash()
    rng = np.random.default_rng(1)
    x = clean + 0.03 * clean.std() * rng.normal(size=len(clean))
    cleaned = clean + 0.005 * clean.std() * rng.normal(size=len(clean))
    lag = 12
    arrays = {
        "time": StoredArray(("time",), np.arange(len(x)) * dt, "s"),
        "x": StoredArray(("time",), x, "m", "displacement, mean taken off"),
        "cleaned": StoredArray(("time",), cleaned, "m", "displacement, noise reduced"),
        "excitation": StoredArray(("time",), drive, "N", "measured excitation"),
        **spectrum_of(x, dt, DRIVE_PERIOD, "m"),
        "section": section_of(x, dt, DRIVE_PERIOD, lag, "m"),
        "section_cleaned": section_of(cleaned, dt, DRIVE_PERIOD, lag, "m"),
        **plain.embedding_curves(cleaned, dt, lag, "embedding_"),
        **plain.embedding_curves(x, dt, lag, "embedding_raw_"),
        **plain.divergence_curves(cleaned, dt, lag, 4),
        **plain.correlation_curves(cleaned, lag, "m"),
        **under("test draw", surrogate_values=np.stack([rng.normal(0.61, 0.02, 99), rng.normal(0.34, 0.02, 99)])),
        **under("test", surrogate_original=np.array([0.12, 0.11])),
    }
    return facts("Case 1, gap of 5 mm", dt, lag), arrays


def number(ends, unit, method, says="", **details):
    """Return the facts on a number; one with something to say is uncertain."""
    facts = dict(zip(("value", "low", "high"), ends, strict=True), unit=unit, method=method, says=says)
    return facts | {"status": "uncertain" if says else "ok", "details": details}


def origin():
    versions = dict.fromkeys(("python", "lostmotion", "numpy", "numba"), "1.0")
    return {"component": "analyse", "versions": versions, "settings": {"unit": "1/s"}, "seed": 0, "inputs": {}}


def facts(title, dt, lag):
    says = "The sampling is locked to the drive: the dimension of the section plus one is given."
    fit, plateau = {"fit_begin": 0.04, "fit_end": 0.2}, {"r_low": 3e-4, "r_high": 1.5e-3}
    follows = {
        "sided": "two",
        "original": 0.12,
        "says": "Rejected: the recording is easier to predict than all of them.",
    }
    tests = zip(NULLS, ("iaaft", "pseudo_periodic"), (0.02, 0.0004), strict=True)
    return {
        "schema": "lostmotion.analysis/1",
        "title": title,
        "verdict": "chaotic",
        "strength": "firm",
        "signs": [],
        "says": "Neighbouring states part at 7.3 1/s [6.6, 8.1], and the correlation dimension levels off at 2.4. "
        "Noise with the same spectrum and values does not look like it (p = 0.02).",
        "because": ["iaaft: the prediction error is lower than that of 99 surrogates (p = 0.02)"],
        "delay": {"samples": lag, "seconds": lag * dt, "method": "ami"},
        "dimension": {"value": 4, "method": "cao", "theiler": 48},
        "noise": {
            "before": 0.031,
            "after": 0.005,
            "unit": SHARE,
            "before_interval": [0.02, 0.04],
            "method": "local_projective",
        },
        "lyapunov": number((7.3, 6.6, 8.1), "1/s", "lyapunov_rosenstein", **fit),
        "d2": number((2.41, 2.2, 2.6), "1", "grassberger_procaccia", says, **plateau),
        "k2": number((6.9, 5.2, 9.0), "1/s", "grassberger_procaccia"),
        "others": [
            number([None] * 3, "1/s", "lyapunov_kantz") | {"name": "lyapunov_kantz", "status": "no_scaling_region"}
        ],
        "surrogates": [
            {"null": n, "method": m, "statistic": "prediction_error", "draws": 99, "p": p, **follows}
            for n, m, p in tests
        ],
        "drive": {"period": DRIVE_PERIOD, "samples_per_period": DRIVE_PERIOD / dt, "source": "excitation"},
        "notes": ["The recording holds 150 periods: some hundreds would narrow the interval of the dimension."],
        "provenance": origin(),
    }


def undriven():
    """Return facts and arrays of the Lorenz system, without noise, drive or unit, in bit/s."""
    x, dt = plain.lorenz()
    arrays = {
        "time": StoredArray(("time",), np.arange(len(x)) * dt, "s"),
        "x": StoredArray(("time",), x, "", "x"),
        **spectrum_of(x, dt, None, "1"),
        **plain.embedding_curves(x, dt, 8, "embedding_"),
        **plain.divergence_curves(x, dt, 8, 4),
        **plain.correlation_curves(x, 8, ""),
        **under("test draw", surrogate_values=np.random.default_rng(2).normal(0.4, 0.03, (1, 39))),
        **under("test", surrogate_original=np.array([0.05])),
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
        "time": StoredArray(("time",), time, "s"),
        "x": StoredArray(("time",), x, "rad", "joint_angle, mean taken off"),
        **spectrum_of(x, dt, period, "rad"),
        "section": section_of(x, dt, period, 20, "rad"),
        **plain.embedding_curves(x, dt, 20, "embedding_"),
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
        "time": StoredArray(("time",), np.arange(1200) * 0.01, "s"),
        "x": StoredArray(("time",), x, "V", "piezo voltage"),
        **spectrum_of(x, 0.01, None, "V"),
        **plain.embedding_curves(x, 0.01, 2, "embedding_"),
        **plain.divergence_curves(x, 0.01, 1, 4),
        **plain.correlation_curves(x, 1, "V"),
        **under("test draw", surrogate_values=np.full((1, 39), np.nan)),
        **under("test", surrogate_original=np.array([np.nan])),
    }
    said = facts("Noise", 0.01, 1)
    none = {"value": None, "low": None, "high": None, "details": {}, "says": ""}
    for key, status in (("lyapunov", "not_saturating"), ("d2", "rising"), ("k2", "rising")):
        said[key] |= none | {"status": status}
    said["noise"] |= {"before": None, "after": None}
    said |= {"verdict": "stochastic", "others": []}
    said |= {"drive": {"period": None, "samples_per_period": None, "source": "none"}}
    said["says"] = "Noise with the same spectrum and values looks just like it: nothing speaks for chaos."
    said["surrogates"] = [said["surrogates"][0] | {"p": None, "says": ""}]
    return said, arrays


def hostile():
    """Return the analysis of a file in which every text is meant to do harm."""
    said, arrays = chaotic()
    arrays = {name: StoredArray(c.dims, c.values, HOSTILE, HOSTILE) for name, c in arrays.items()}
    return _poisoned(said), arrays


def _poisoned(value, key=""):
    """Return facts whose texts and names are meant to do harm, but for those that are one of a few words."""
    if isinstance(value, dict):
        bad = {key: _poisoned(v, key) for key, v in value.items()}
        return bad | {HOSTILE[:30]: 1.0 if key == "details" else HOSTILE}
    if isinstance(value, list):
        return [_poisoned(v, key) for v in value]
    return HOSTILE if isinstance(value, str) and key not in FEW else value


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
    from lostmotion_chaos.analysis.report.page import write_analysis

    for kind, make in KINDS.items():
        write_analysis(write(Path(sys.argv[1]) / kind, *make()))
