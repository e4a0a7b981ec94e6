"""Recordings of known truth, and what a diagnosis says of each; the tables of `first_light.py` are made of these."""

from __future__ import annotations

import json
import math
import multiprocessing
import os
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests" / "science"), str(ROOT / "tests" / "framework")]

from truths import FORCE, FRICTION, TRUE, case_of, observation_of, system_of  # noqa: E402 - they lie beside the tests

__all__ = ["FORCE", "FRICTION", "ROOT", "TRUE", "Study", "command", "rms", "several", "track_for", "z_scores"]


@dataclass(frozen=True)
class Study:
    """One recording to be diagnosed: what is hidden in it (N), its length and noise, and what is unknown."""

    hidden: float
    seed: int = 0
    periods: int = 29
    noise: float = 0.01
    gap: bool = True
    predict: bool = False

    @property
    def unknown(self):
        return ("c", "x0", "k0") if self.gap else ("c", "x0")


def track_for(study):
    """Return the recording of a study."""
    return observation_of(study.hidden, seed=study.seed, periods=study.periods, noise=study.noise)[0]


def run(study):
    """Return what a diagnosis says of a study, as numbers and names."""
    from lostmotion.diagnosis.stages import diagnose

    observation, start = track_for(study), time.perf_counter()
    d = diagnose(case_of(study.unknown), [observation], system_of(), rng=np.random.default_rng(0), jobs=1)
    taken = time.perf_counter() - start
    more = predictions(d, observation, study.hidden) if study.predict else {}
    return {**asdict(study), "seconds": taken, **findings(d), **more}


def findings(d):
    """Return names, intervals, gains and statuses of a diagnosis."""
    from lostmotion.codec import to_plain
    from lostmotion.diagnosis.outcome import compute_intervals, draw_parameters

    rng = np.random.default_rng(1)
    explained = d.explained
    bottom = explained.nominal.log_likelihood
    friction = d.after if FRICTION in d.found else explained.fits.get(frozenset({FRICTION}))
    wide = {"before": d.before, "after": d.after, **({"friction": friction} if friction else {})}
    return {
        "found": list(d.found),
        "probability": {k: explained.inclusion(k) for k in d.after.posterior.system.keys},
        "nothing": explained.probabilities.get(frozenset(), 0.0),
        "gains": {"+".join(sorted(k)): fit.log_likelihood - bottom for k, fit in explained.fits.items()},
        "promised": dict(sorted(explained.promised.items(), key=lambda row: row[1])),
        "scores": {"+".join(sorted(k)): found.score() for k, found in explained.found.items()},
        "status": {"+".join(sorted(k)): f"{fit.status} {fit.rounds}" for k, fit in explained.fits.items()},
        "random_gain": d.random_gain,
        "verdict": [*d.named, *["unknown"] * d.unknown] or ["random_force"] * d.unexplained,
        "levels": {n: dict(zip(f.posterior.space.keys, map(float, f.theta), strict=True)) for n, f in wide.items()},
        "usual": {n: {k: float(s) for k, s in f.sd.items()} for n, f in wide.items()},
        "intervals": {n: to_plain(compute_intervals(f, draw_parameters(f, rng))) for n, f in wide.items()},
        "nsub": [d.before.posterior.dynamics.nsub, d.after.posterior.dynamics.nsub],
    }


def predictions(d, observation, hidden):
    """Return valid-prediction times on held-out starts, in Lyapunov times: before, after, and with the truth."""
    from lostmotion.diagnosis.compare import (
        average_exponent,
        choose_heldout_horizon,
        compute_rates,
        cut_heldout,
        predict,
    )

    pieces = cut_heldout([observation], d.held)
    fits = {"before": d.before, "after": d.after, "truth": truth_of(d, hidden)}
    rates = {name: compute_rates(fit, [observation]) for name, fit in fits.items()}
    exponents = {name: average_exponent(found) for name, found in rates.items()}
    horizon = choose_heldout_horizon(d.after, pieces, exponents["after"])
    seen = {name: predict(fit, pieces, horizon, rates[name]) for name, fit in fits.items()}
    return {
        "exponents": exponents,
        "valid": {name: p.valid_time / horizon.unit_time for name, p in seen.items()},
        "nrmse": {name: p.nrmse for name, p in seen.items()},
        "score": {name: p.log_score for name, p in seen.items()},
        "unit": horizon.unit,
    }


def truth_of(d, hidden):
    """Return the fit with every parameter at its true value and the noise levels as they were found."""
    fit, system = d.after, d.after.posterior.system
    kept = [i for i, free in enumerate(fit.posterior.space.free) if not free.physical]
    full = system.vector({**TRUE, FORCE: hidden})
    free = tuple(fit.posterior.space.free[i] for i in kept)
    posterior = replace(fit.posterior, known=full).over(free).acting({FRICTION})
    return replace(fit, posterior=posterior, local=replace(fit.local, theta=fit.theta[kept]))


def several(studies, args):
    """Return the results of studies, in order, from `--jobs` processes; each is kept as a line of JSON if wanted."""
    os.environ["OMP_NUM_THREADS"] = "1"
    with ProcessPoolExecutor(args.jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        results = []
        for result in pool.map(run, studies):
            results.append(result)
            if args.keep:
                with args.keep.open("a") as stream:
                    stream.write(json.dumps(result) + "\n")
        return results


def z_scores(found, key, hidden):
    """Return how many of its stated standard deviations an estimate lies from the truth."""
    truth, scores = {**TRUE, FORCE: hidden}[key], []
    for r in found:
        i = r["intervals"]["after"].get(key)
        if i:
            scores.append((i["median"] - truth) / ((i["high"] - i["low"]) / (2 * 1.96)))
    return np.array(scores)


def rms(values):
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else math.nan


def command(text, folder):
    """Return `diagnosis.json` and the time of `lostmotion diagnose` as a whole process."""
    (folder / "case.toml").write_text(text)
    line = [sys.executable, "-m", "lostmotion", "diagnose", str(folder / "case.toml"), "--out", str(folder / "out")]
    start = time.perf_counter()
    subprocess.run([*line, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "out" / "diagnosis.json").read_text()), time.perf_counter() - start
