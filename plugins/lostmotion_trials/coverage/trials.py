"""One trial of a calibration: a machine drawn from the priors, its recordings, its posterior, the rank of the truth.

A trial depends only on the design and its number.
"""

from __future__ import annotations

import tempfile
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from lostmotion.case import dump_case
from lostmotion.case.drive_levels import Level
from lostmotion.contracts import Array
from lostmotion.errors import CaseError, LostMotionError, PlaceError
from lostmotion.identification.sampling import SampledPosterior, identify
from lostmotion.identification.trajectory import choose_terms, sample_case
from lostmotion.preparation.prepare import case_of, prepare
from lostmotion.quantities import ANGULAR, SI, unit_of
from lostmotion.simulation.drive_signals import Options, parse_pairs
from lostmotion.storage import save_table
from lostmotion_chaos.levels.levels import MapGrid, make_inversion, make_quantifier_task
from lostmotion_trials.coverage.design import Design, DrawnMachine, Workshop, make_workshop
from lostmotion_trials.coverage.machines import SeenMachine
from lostmotion_trials.coverage.ranks import compute_rank
from lostmotion_trials.coverage.results import FAILED, OK, UNCONVERGED, MachineTrial, Sought, Standing

REPLACED = ("recordings", "levels", "truth", "plugins")
"""Tables of the case that are replaced by those of the machine, or that the registry has loaded already."""


def run_trial(design: Design, number: int) -> MachineTrial:
    """Return the result of machine `number`: its true parameters and their ranks in the posterior."""
    shop = make_workshop(design)
    of_truth, of_motion, of_fit = np.random.default_rng([design.seed, number]).spawn(3)
    machine = shop.draw(of_truth)
    unknown = {name: Sought(value, name in machine.drawn) for name, value in machine.truth.items()}
    try:
        result, also = ROUTE_FUNCTIONS[design.route](shop, machine, of_motion, int(of_fit.integers(2**32)))
    except PlaceError:
        raise
    except (LostMotionError, ArithmeticError, ValueError) as err:
        return MachineTrial(number, FAILED, " ".join(str(err).split()), unknown)
    if not result.converged:
        return MachineTrial(number, UNCONVERGED, "; ".join(result.lacks), unknown)
    found = _locate_truths(result, {**machine.truth, **also}, machine.drawn)
    return MachineTrial(number, OK, "", found, float(result.quality.ess.min()), float(result.quality.rhat.max()))


def _locate_truths(result: SampledPosterior, truth: Mapping[str, float], drawn: frozenset[str]) -> dict[str, Sought]:
    """Return for each parameter whose truth is known where that lies among the draws."""
    if lost := drawn - set(result.keys):
        raise ValueError(f"the posterior has no parameter {sorted(lost)[0]}, which was drawn")
    return {
        key: Sought(truth[key], key in drawn, _locate_truth(truth[key], result.chain[:, :, i], unit))
        for i, (key, unit) in enumerate(zip(result.keys, result.units, strict=True))
        if key in truth
    }


def _locate_truth(truth: float, chain: Array, unit: str) -> Standing:
    """Return where a truth lies among the draws of a chain (walkers, steps)."""
    low, median, high = np.quantile(chain, [0.025, 0.5, 0.975]).tolist()
    mean, sd = float(chain.mean()), float(chain.std())
    below = float(np.mean(chain < truth))
    return Standing(unit, low, median, high, sd, (truth - mean) / sd, below, compute_rank(truth, chain))


RouteFunction = Callable[[Workshop, DrawnMachine, np.random.Generator, int], tuple[SampledPosterior, dict[str, float]]]
"""Makes the posterior of a machine from a generator for its motion and a seed for the fit; and further truths."""


def infer_by_trajectory(
    shop: Workshop, machine: DrawnMachine, rng: np.random.Generator, seed: int
) -> tuple[SampledPosterior, dict[str, float]]:
    """Return the posterior from the recordings themselves, and the true measurement noise of each."""
    seen = shop.record(machine, rng)
    with tempfile.TemporaryDirectory() as folder:
        prepared = prepare(_write_case(shop, machine, seen, Path(folder)), shop.registry)
    terms = choose_terms(prepared, shop.design.terms, shop.registry)
    result = sample_case(prepared, terms, shop.design.plan, rng=np.random.default_rng(seed)).result
    several = len(seen) > 1
    names = [f"measurement_noise[{label}]" if several else "measurement_noise" for label in shop.design.labels]
    return result, {name: one.noise for name, one in zip(names, seen, strict=True)}


def infer_by_quantifiers(
    shop: Workshop, machine: DrawnMachine, rng: np.random.Generator, seed: int
) -> tuple[SampledPosterior, dict[str, float]]:
    """Return the posterior from what the recordings are read as, one level of the drive each."""
    seen, design = shop.record(machine, rng), shop.design
    fit = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as folder:
        case = case_of(_write_case(shop, machine, seen, Path(folder)), shop.registry)
        task = make_quantifier_task(case, shop.registry, Path(folder), fit, MapGrid(maps=design.maps, jobs=1))
    return identify(task, rng=fit, plan=design.plan), {}


def make_maps(shop: Workshop, out: Path, jobs: int) -> tuple[Path, ...]:
    """Return the maps in which every machine is looked up, made in the folder `out` unless they are there."""
    unit = unit_of(shop.system.model.inputs[0], shop.system.model.motion)
    both = zip(shop.design.labels, shop.design.bench.drives, strict=True)
    levels = tuple(Level(label, *_read_harmonic(drive), unit=unit) for label, drive in both)
    make_inversion(shop.case, levels, shop.registry, out, MapGrid(jobs=jobs))
    return tuple(sorted(out.glob("map-*.nc")))


def _read_harmonic(drive: str) -> tuple[float, float]:
    """Return amplitude and angular frequency (rad/s) of a drive, which must be a plain sine."""
    kind, _, rest = drive.partition(":")
    options = Options(kind, {"harmonics": "", **parse_pairs(rest, f"drive {drive!r}")})
    if kind != "harmonic" or options.shares():
        raise CaseError(
            f"the drive {drive!r} is no sine: the route by quantifiers wants harmonic:amplitude=...,omega=..."
        )
    return options.number("amplitude"), options.omega()


def _write_case(shop: Workshop, machine: DrawnMachine, seen: list[SeenMachine], folder: Path) -> Path:
    """Return the case of a machine, written with its recordings into a folder."""
    design, model = shop.design, shop.system.model
    quantity = model.inputs[0]
    units = SI if model.motion == "translation" else ANGULAR
    entries = []
    for label, one, offset in zip(design.labels, seen, machine.offsets, strict=True):
        columns = {"excitation": one.excitation, "response": one.response + offset}
        save_table(folder / f"{label}.csv", columns, {}, {})
        entries.append(
            {
                "file": f"{label}.csv",
                "name": label,
                "rate": design.bench.rate,
                "excitation": {"column": "excitation", "quantity": quantity, "unit": units[quantity]},
                "response": {"column": "response", "quantity": "position", "unit": units["position"]},
            }
        )
    content = tomllib.loads(design.case.read_text(encoding="utf-8-sig"))
    kept = {key: value for key, value in content.items() if key not in REPLACED}
    dump_case({**kept, "recordings": entries}, folder / design.case.name)
    return folder / design.case.name


ROUTE_FUNCTIONS: Mapping[str, RouteFunction] = {"trajectory": infer_by_trajectory, "quantifiers": infer_by_quantifiers}
"""The ways to a posterior."""
