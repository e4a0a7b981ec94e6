"""The sets of `benchmarks/judge.py` that other studies draw: rows of the library table, and blind trials.

`library`: random rows of terms x sensors x drives as in `library.py`. `imperfect`: machines of
`prove --world imperfect` that each hide one effect. `clean`: machines that hide nothing, of both worlds in turn.
"""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import library
from judge_truth import Hiding, Truth, is_complete, save_truth
from library_rows import DRIVES, LATE, SENSORS
from lostmotion.errors import LostMotionError
from lostmotion_trials.blind.bound import EQUIVALENT, complete_parameters
from lostmotion_trials.blind.commitment import IMPERFECT, PERFECT, Blind, conceal_case
from lostmotion_trials.blind.judging import FRICTION_TERMS
from lostmotion_trials.blind.mechanisms import NAMES, TABLE, Effect
from lostmotion_trials.blind.simulator import BlindMachine

LIBRARY_SEED, LIBRARY_SAMPLES, LIBRARY_ROWS = 20, 1500, 100
SEED, SAMPLES, ROWS = 44, 2000, 60


def find_names(name: str, *, rough: bool = False) -> tuple[str, ...]:
    """Return the names that are right for a term: those that no recording tells from it, any friction if `rough`."""
    same = {name}.union(*(group for group in EQUIVALENT if name in group))
    if rough and name in FRICTION_TERMS:
        same |= set(FRICTION_TERMS)
    return tuple(sorted(same))


def is_friction(effect: Effect) -> bool:
    """Return whether an effect is dry friction, whose level is a random curve in the imperfect world."""
    if effect.what:
        return effect.what.startswith("friction")
    return TABLE[effect.mechanism].kin == "rub"


def convert_effect(effect: Effect, rig: BlindMachine, *, rough: bool = False) -> Hiding:
    """Return a hidden effect with its parameters under the names of the library.

    A law outside the library has no name there; if `rough`, friction is right for dry friction of such a law as well.
    """
    numbers = dict(effect.parameters)
    full = numbers if effect.what else complete_parameters(numbers, rig.values, rig.signal)
    if effect.what:
        accept = tuple(sorted(FRICTION_TERMS)) if rough and is_friction(effect) else ()
    else:
        accept = find_names(effect.mechanism, rough=rough)
    short = effect.mechanism in LATE and max(abs(v) for v in numbers.values()) < 0.5 / rig.rate
    return Hiding(effect.what or effect.mechanism, effect.at, full, tuple(sorted(LATE)) if short else accept)


def list_library_tasks(seed: int = LIBRARY_SEED) -> list[tuple[str, str, str, int, float, int]]:
    """Return random rows of the library table in the order of a seed, more than are used."""
    rng = np.random.default_rng(seed)
    cells = [
        (name, sensor, drive, seed)
        for name in sorted(TABLE)
        for sensor in SENSORS
        for drive in DRIVES
        if not TABLE[name].tone or drive == "harmonic"
    ]
    order = rng.permutation(len(cells))
    gains = 50.0 * 10.0 ** rng.random(len(cells))
    return [(*cells[i], float(g), LIBRARY_SAMPLES) for i, g in zip(order, gains, strict=True)]


def make_library(out: Path, limit: int = 0, fresh: int = 0) -> list[Path]:
    """Return the folders of rows of the library table; those that are missing are written first.

    A row that cannot be made (no machine in 200 attempts) is left out.
    """
    folders = []
    for number, task in enumerate(list_library_tasks(LIBRARY_SEED + fresh)[: limit or LIBRARY_ROWS]):
        folder = out / f"{number:03d}"
        if not is_complete(folder):
            try:
                write_library(task, folder)
            except (ValueError, ArithmeticError, LostMotionError) as err:
                print(f"{folder}: not made: {err}", flush=True)
                continue
        folders.append(folder)
    return folders


def write_library(task: tuple[str, str, str, int, float, int], folder: Path) -> None:
    """Write the machine of one row of the library table, and its truth."""
    draft = library.draft_machine(task)
    folder.mkdir(parents=True, exist_ok=True)
    effects, _, reached = library.write_sized_case(task, draft, folder)
    if np.ptp(np.loadtxt(folder / "recording.csv", delimiter=",", skiprows=1)[:, -1]) == 0.0:
        raise ValueError("the effect leaves a constant reading")
    rig, gain = draft.rig, reached if isinstance(reached, float) else None
    hidden = tuple(convert_effect(effect, rig) for effect in effects)
    says = f"{task[0]}, {task[1]}, {task[2]}, {rig.model}"
    further = {"sensor": task[1], "wanted": task[4]}
    save_truth(
        folder, Truth(folder.name, hidden, rig.values, task[2], says, 1.0 / rig.rate, gain=gain, further=further)
    )


def conceal(blind: Blind, number: int, folder: Path) -> None:
    """Write a machine of a blind trial, its truth, and its sealed truth for the oracle."""
    from lostmotion.codec import from_plain
    from lostmotion_trials.blind.sealed import SealedTruth

    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        conceal_case(blind, place, number)
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(place / "cases" / f"{number:03d}", folder)
        text = (place / "sealed" / f"{number:03d}.json").read_text()
    folder.with_name(f"{folder.name}.sealed.json").write_text(text)
    sealed = from_plain(SealedTruth, json.loads(text), folder.name)
    rough = blind.world == IMPERFECT
    hidden: Sequence[Hiding] = tuple(convert_effect(e, sealed.machine, rough=rough) for e in sealed.effects)
    drive = sealed.world.kind if sealed.world else ("sweep" if sealed.machine.signal.sweep else "tones")
    several, rate = sealed.machine.model == "robot_joint", sealed.machine.rate
    says = f"{', '.join(e.mechanism for e in hidden) or 'nothing'} in {sealed.machine.model}, {blind.world} world"
    further = {"world": blind.world, "variant": sealed.variant}
    truth = Truth(folder.name, hidden, sealed.machine.values, drive, says, 1.0 / rate, several, further=further)
    save_truth(folder, truth)


def make_imperfect(out: Path, limit: int = 0, fresh: int = 0) -> list[Path]:
    """Return the folders of machines of the imperfect world with one hidden effect each."""
    blind = Blind(seed=SEED + fresh, most=SAMPLES, only=NAMES, world=IMPERFECT)
    folders = [out / f"{number:03d}" for number in range(limit or ROWS)]
    for number, folder in enumerate(folders):
        if not is_complete(folder):
            conceal(blind, number, folder)
    return folders


def make_clean(out: Path, limit: int = 0, fresh: int = 0) -> list[Path]:
    """Return the folders of machines that hide nothing, of the perfect and the imperfect world in turn."""
    folders = []
    for number in range(limit or 2 * ROWS):
        world = (PERFECT, IMPERFECT)[number % 2]
        folder = out / f"{number // 2:03d}-{world}"
        folders.append(folder)
        if not is_complete(folder):
            conceal(Blind(seed=SEED + 1 + fresh, most=SAMPLES, clean=True, world=world), number // 2, folder)
    return folders
