"""How often the upper bound of an absent term lies above its true small size.

    python benchmarks/absent.py run --machines 200 --out DIR
    python benchmarks/absent.py show --out DIR

Each trial is a random machine (`small_effects.py`) with one hidden effect that is too small to be found as a rule: 0.3
to 3 of its posterior standard deviations, which the bound beside the clean machine tells. The whole diagnosis runs, and
its `absent` has the bound, unless the effect was found. A run that was stopped is continued; each machine has a limit
of processor time (`--timeout`).
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from lostmotion.diagnosis.diagnosis_run import diagnose_prepared
from lostmotion.diagnosis.stages import list_fitted_keys
from lostmotion.evidence.bare import Budget
from lostmotion.evidence.bounds import bound_absent
from lostmotion.evidence.search import ExplanationSearch
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default
from small_effects import SmallMachine, describe_share, draw_small_machine, read_rows, run_command, split_by

SEED = 48
SIZES = (0.3, 3.0)
"""The hidden sizes, in posterior standard deviations; uniformly distributed."""
TWO_SIDED = 1.96
"""The bound of a clean machine over the standard deviation, on average."""


def bound_clean(machine: SmallMachine, folder: Path) -> float:
    """Return the bound of the effect of a machine that hides nothing, beside the model without any term."""
    prepared = prepare(folder / "case.toml", default())
    system = System(prepared.model, prepared.terms)
    train, _ = split_heldout(prepared.observations)
    nominal = search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    search = ExplanationSearch(nominal, list_fitted_keys(system), (), Budget())
    search.weigh(search.bare.fits[frozenset()])
    keys = [k for k, t in zip(system.keys, system.terms, strict=True) if t.name == machine.mechanism]
    found = [b for b in bound_absent(search.found[frozenset()], keys) if not b.why]
    at = [b for b in found if not machine.at or b.key.partition("@")[2] in ("", machine.at)]
    if not at:
        raise ValueError(f"{machine.mechanism} has no bound beside the clean machine")
    return at[0].upper


def run_trial(trial: int) -> dict[str, object]:
    """Return the row of one machine."""
    rng = np.random.default_rng([SEED, trial])
    machine = draw_small_machine(rng)
    head = {"mechanism": machine.mechanism, "at": machine.at, "model": machine.rig.model}
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        machine.write(place / "clean", 0.0, rng)
        deviations = float(rng.uniform(*SIZES))
        size = deviations * bound_clean(machine, place / "clean") / TWO_SIDED
        machine.write(place / "case", size, rng)
        registry = default()
        prepared = prepare(place / "case" / "case.toml", registry)
        result = diagnose_prepared(prepared, registry, seed=0, jobs=1, propose=False)[0].result
    row = {**head, "size": size, "deviations": deviations}
    row["found"] = [(one.mechanism, one.probability, one.state) for one in result.found]
    own = [one for one in result.absent if one.mechanism == machine.mechanism and machine.at in ("", one.at)]
    if any(one.mechanism == machine.mechanism for one in result.found):
        return {**row, "status": "found"}
    if not own:
        said = [one.says for one in result.unlimited if one.mechanism == machine.mechanism]
        return {**row, "status": "no bound", "says": said}
    return {**row, "status": "bound", "upper": own[0].upper}


def show(path: Path) -> None:
    """Print the coverage, in all and by size."""
    rows = read_rows(path)
    bounds = [row for row in rows if row["status"] == "bound"]
    held = [row for row in bounds if row["upper"] >= row["size"]]
    print(f"{len(rows)} machines; the bound lies above the true size in {describe_share(len(held), len(bounds))}")
    for name, own in split_by(bounds, "deviations", [0.3, 1.0, 2.0, 3.0]):
        above = sum(row["upper"] >= row["size"] for row in own)
        print(f"  size of {name} standard deviations: {describe_share(above, len(own))}")
    for status in sorted({row["status"] for row in rows} - {"bound"}):
        print(f"  {sum(row['status'] == status for row in rows)} {status}")
    for row in bounds:
        if row["upper"] < row["size"]:
            print(
                f"  below: trial {row['trial']}, {row['mechanism']} in {row['model']}, {row['upper'] / row['size']:.2f}"
            )


if __name__ == "__main__":
    run_command(str(__doc__), "absent.jsonl", 200, run_trial, show)
