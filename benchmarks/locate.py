"""Where a missing force lives: how often the true covariate and place come first, and how often pure noise has one.

    python benchmarks/locate.py --machines 100 --seed 0 --out FOLDER [--only two,one,noise]

`two`    machines with two places, a link behind a joint: a force hidden at the base or at the ground
`one`    machines with one place: an oscillator, with backlash or without
`noise`  machines of both kinds in which nothing is hidden but noise: white; a white random force of 3 to 16 times the
         usual one; measurement noise with a memory; outliers. Of these there are twice as many.

Hidden are friction, drag and springs, ripples over the position and harmonics of the drive, as large as it takes by the
rough formula of the blind trial to gain 50 to 500 in log-likelihood. Motions are made by the integrator of the blind
trial, which knows no terms. Each recording of 1500 to 2500 samples gets a nominal fit, and two tests:

`shares`  cross-validated shares of the smoothed missing force, against surrogates by the maximum statistic
`plain`   the likelihood ratio of a curve over each covariate inside the filter, as the model states its noise
`odds`    the same, but beyond chance only where the robust ratio is

All at 5 % over all covariates together. One line of JSON for each machine goes to a file in FOLDER as it is done: a
run that was stopped goes on from there.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import tempfile
import time
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.diagnosis.stages import list_half_gaps, locate
from lostmotion.errors import DataError
from lostmotion.evidence.effects import list_bare_promises
from lostmotion.inference.odds import LikelihoodRatio, compute_log_ratios, list_likely
from lostmotion.inference.setup import choose_steps, make_posterior, search_maximum
from lostmotion.likelihood.latent import smooth_latent_force
from lostmotion.likelihood.system import System, key_of
from lostmotion.preparation.prepare import Prepared, prepare
from lostmotion.registry import default
from lostmotion.settings import DEFAULT
from lostmotion_trials.blind.commitment import RUNAWAY, TOUCHES
from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.mechanisms import LARGEST, TABLE, UNKNOWN, Effect, Pilot
from lostmotion_trials.blind.simulator import EXCITATION_NOISE, BlindMachine, Disturbances, draw_rig, simulate_machine
from lostmotion_trials.blind.writing import write_case
from lostmotion_trials.integrators.hidden import Hidden
from lostmotion_trials.rates import estimate_rate

GAIN = (50.0, 500.0)
SAMPLES = (1500, 2500)
MODELS = {"two": ("robot_joint",), "one": ("lin_backlash", "linear_oscillator")}
NOISES = ("white", "random force", "coloured", "outliers")
GOES_WITH: Mapping[str, tuple[str, ...]] = {
    "coulomb_friction": ("sign of velocity", "velocity"),
    "stribeck_friction": ("sign of velocity", "velocity"),
    "viscous_damping": ("velocity",),
    "quadratic_damping": ("velocity",),
    "linear_stiffness": ("position",),
    "cubic_stiffness": ("position",),
    "wave over position that narrows": ("position",),
    "bump at one position": ("position",),
    "friction that depends on position": ("sign of velocity", "velocity"),
    "excitation_harmonic": ("phase",),
}
"""The covariates that a hidden force goes with: any of them is right. Friction is a function of the velocity, too."""
TESTS = ("shares", "plain", "odds")
TRIES = 500
STUCK = 0.2
"""A machine that friction holds shows nothing."""
Row = dict[str, Any]


def draw_effect(name: str, pilot: Pilot, rng: np.random.Generator) -> Effect:
    """Return a mechanism of a size at which it should gain 50 to 500 in log-likelihood."""
    mechanism = (TABLE | UNKNOWN)[name]
    at = str(rng.choice(mechanism.find_places(pilot.rig)))
    draft = mechanism.plan(pilot, at, rng)
    wanted = math.exp(rng.uniform(math.log(GAIN[0]), math.log(GAIN[1])))
    size = math.sqrt(wanted / max(pilot.expect_gain(draft), 1e-300))
    loud = size * float(np.std(draft.force)) / pilot.inertial_force
    size *= min(1.0, LARGEST / max(loud, 1e-300)) * (rng.choice([-1.0, 1.0]) if mechanism.signed else 1.0)
    parameters = draft.parameters(float(size))
    return Effect("unknown", at, parameters, name) if name in UNKNOWN else Effect(name, at, parameters)


def draw_machine(kind: str, rng: np.random.Generator, number: int) -> tuple[BlindMachine, Effect | None, np.ndarray]:
    """Return a machine, what is hidden in it, and its true motion (samples,)."""
    models = MODELS[kind] if kind in MODELS else MODELS[("two", "one")[number % 2]]
    offered = [name for name in GOES_WITH if any(m in (TABLE | UNKNOWN)[name].models for m in models)]
    for _ in range(TRIES):
        rig, name = draw_rig(rng, int(rng.integers(*SAMPLES))), str(rng.choice(offered))
        if rig.model not in models or (kind != "noise" and not (TABLE | UNKNOWN)[name].fits(rig)):
            continue
        with suppress(DataError):
            pilot = Pilot(rig, simulate_machine(rig, Hidden(), Disturbances(), rng))
            if "x0" in rig.values and not TOUCHES[0] < float(np.mean(np.abs(pilot.contact_sign))) < TOUCHES[1]:
                continue
            if kind == "noise":
                kick = (
                    pilot.usual_force * 3.2 * 10.0 ** (0.7 * rng.random()) * (_choose_noise(number) == "random force")
                )
                return rig, None, simulate_machine(rig, Hidden(), Disturbances(rms=kick), rng) if kick else pilot.q
            effect = draw_effect(name, pilot, rng)
            truth = simulate_machine(rig, *convert_effects(rig, (effect,)), rng)
            if STUCK < float(np.std(truth)) / float(np.std(pilot.q)) < RUNAWAY:
                return rig, effect, truth
    raise DataError("no machine was drawn that can have what is to be hidden")


def _choose_noise(number: int) -> str:
    return NOISES[number // 2 % len(NOISES)]


def record(rig: BlindMachine, truth: np.ndarray, noise: str, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return drive and position (samples,) of a machine as they are recorded."""
    clean, n = rig.signal.value(rig.time), len(truth)
    white = rng.standard_normal(n)
    if noise == "coloured":
        memory = float(rng.uniform(0.3, 0.8))
        for i in range(1, n):
            white[i] = memory * white[i - 1] + math.sqrt(1.0 - memory**2) * white[i]
    if noise == "outliers":
        hit = rng.random(n) < 10.0 ** rng.uniform(-3.0, -2.0)
        white = white + hit * rng.choice([-1.0, 1.0], n) * rng.uniform(5.0, 20.0, n)
    shown = truth + rig.noise * float(np.std(truth - clean if rig.based else truth)) * white
    return clean + EXCITATION_NOISE * rig.signal.amplitude * rng.standard_normal(n), shown


def prepare_case(rig: BlindMachine, excitation: np.ndarray, response: np.ndarray) -> Prepared:
    """Return a machine as a diagnosis reads it: from a case file and a table."""
    with tempfile.TemporaryDirectory() as folder:
        return prepare(write_case(rig, (excitation, response), Path(folder), title="study", stated={}), default())


def run_machine(kind: str, seed: int, number: int) -> Row:
    """Return what the tests say of a machine, beside the truth."""
    rng = np.random.default_rng([seed, ("two", "one", "noise").index(kind), number])
    rig, effect, truth = draw_machine(kind, rng, number)
    noise = _choose_noise(number) if kind == "noise" else "white"
    made = prepare_case(rig, *record(rig, truth, noise, rng))
    names = [] if effect is None else [key_of(t) for t in made.terms if t.name == effect.mechanism]
    names = [key for key in names if effect and effect.at in ("", key.partition("@")[2] or "ground")]
    system = System(made.model, tuple(t for t in made.terms if key_of(t) in names))
    begin = time.perf_counter()
    fit = search_maximum(make_posterior(system, made.case, made.observations, jobs=1), np.random.default_rng(0))
    fitted = time.perf_counter()
    honest = choose_steps(fit.posterior, fit.theta)
    missing, plays = smooth_latent_force(honest, fit.theta), list_half_gaps(honest, fit.theta)
    located = locate(made.model, made.observations[0], missing, plays=plays, rng=np.random.default_rng([seed, number]))
    shared = time.perf_counter()
    odds, promises = compute_log_ratios(fit), list_bare_promises(fit, system.keys[:1], {})
    done = time.perf_counter()
    return {
        "kind": kind,
        "number": number,
        "model": rig.model,
        "noise": noise,
        "samples": rig.samples,
        "hidden": (effect.what or effect.mechanism) if effect else None,
        "at": effect.at if effect else None,
        "gain": promises[0].gain if promises else None,
        "status": fit.status,
        "shares": {k: [s.value, s.error, s.p, s.excess] for k, s in located.explained.items()},
        "odds": odds,
        "seconds": [fitted - begin, shared - fitted, done - shared],
    }


def rank_covariates(row: Row, test: str) -> list[str]:
    """Return the covariates that a test calls significant, the first first."""
    if test == "shares":
        told = {k: s for k, s in row["shares"].items() if s[2] <= DEFAULT.locate.level and s[0] > 0.0}
        return sorted(told, key=lambda k: -told[k][0])
    if test == "odds":
        return list_likely({k: LikelihoodRatio(*told) for k, told in row["odds"].items()})
    return list_likely({k: LikelihoodRatio(told[0], told[0]) for k, told in row["odds"].items()})


def score_first(row: Row, test: str) -> dict[str, bool]:
    """Return whether anything is significant, and whether what comes first has the true covariate and place."""
    first = next(iter(rank_covariates(row, test)), "")
    what, _, at = first.partition(" at ")
    quantity = what in GOES_WITH.get(row["hidden"], ())
    place = (at or "ground") == (row["at"] or "ground") or what in ("phase", "time")
    return {"any": bool(first), "covariate": quantity, "place": bool(first) and place, "both": quantity and place}


def summarise(rows: Sequence[Row]) -> str:
    """Return the rates of all tests with their bands."""
    lines = []
    for kind in ("two", "one", "noise"):
        own = [row for row in rows if row["kind"] == kind]
        groups = {kind: own}
        part = "noise" if kind == "noise" else "hidden"
        groups |= {f"  {name}": [r for r in own if r[part] == name] for name in dict.fromkeys(r[part] for r in own)}
        for name, chosen in groups.items():
            for test in TESTS:
                told = [score_first(row, test) for row in chosen]
                asked = ("any",) if kind == "noise" else ("any", "covariate", "place", "both")
                cells = [_format_cell(sum(t[what] for t in told), len(told), what) for what in asked]
                lines.append(f"{name:<36}{test:<8}" + "  ".join(cells))
    gains = [row["gain"] for row in rows if row["gain"] is not None]
    if gains:
        lines.append(
            "true terms gain {:.0f}, {:.0f}, {:.0f} (5, 50, 95 %)".format(*np.quantile(gains, [0.05, 0.5, 0.95]))
        )
    wrong = [row for row in rows if row["kind"] != "noise" and not score_first(row, "odds")["both"]]
    phased = sum(rank_covariates(row, "odds")[:1] == ["phase"] for row in wrong)
    lines.append(f"odds: {len(wrong)} first places are wrong or empty, {phased} of them the phase of the drive")
    seconds = np.median([row["seconds"] for row in rows], axis=0)
    lines.append("median seconds: fit {:.1f}, shares {:.1f}, odds {:.1f}".format(*seconds))
    return "\n".join(lines)


def _format_cell(hits: int, of: int, what: str) -> str:
    rate = estimate_rate(hits, of)
    return f"{what} {hits}/{of} = {rate.share:.0%} [{rate.low:.1%}, {rate.high:.1%}]"


def read_rows(path: Path) -> list[Row]:
    """Return the lines of a run so far; one that was cut off is left out."""
    rows = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else []:
        with suppress(json.JSONDecodeError):
            rows.append(json.loads(line))
    return rows


def run(seed: int, asked: Iterable[tuple[str, int]], path: Path) -> None:
    """Locate in those machines that are not yet in the file."""
    done = {(row["kind"], row["number"]) for row in read_rows(path)}
    for kind, number in asked:
        if (kind, number) not in done:
            with path.open("a", encoding="utf-8") as stream:
                stream.write(json.dumps(run_machine(kind, seed, number)) + "\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machines", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--only", default="two,one,noise")
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    path = asked.out / f"locate-{asked.seed}.jsonl"
    kinds = asked.only.split(",")
    wanted = [(k, n) for n in range(2 * asked.machines) for k in kinds if n < asked.machines or k == "noise"]
    run(asked.seed, wanted, path)
    rows = [row for row in read_rows(path) if (row["kind"], row["number"]) in set(wanted)]
    print(" ".join([Path(sys.argv[0]).name, *sys.argv[1:]]))
    print(summarise(rows))


if __name__ == "__main__":
    main()
