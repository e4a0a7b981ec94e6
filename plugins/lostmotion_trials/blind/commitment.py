"""The commitment of a blind trial: truths are sealed before the first diagnosis, and opened and checked afterwards."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from lostmotion.codec import from_plain, to_plain
from lostmotion.contracts import Array
from lostmotion.errors import DataError
from lostmotion.storage import folder_for, save_json
from lostmotion_trials.blind.hiding import convert_effects
from lostmotion_trials.blind.imperfect import (
    CYCLE,
    IMPACTS,
    KINDS,
    World,
    draw_effect,
    draw_machine,
    draw_world,
    follow_motion,
    record_imperfect,
    simulate_imperfect,
)
from lostmotion_trials.blind.mechanisms import NAMES, SPRUNG, TABLE, Effect, Pilot, draw_sized_effect
from lostmotion_trials.blind.sealed import SealedMachine, SealedTruth
from lostmotion_trials.blind.simulator import EXCITATION_NOISE, BlindMachine, Disturbances, draw_rig, simulate_machine
from lostmotion_trials.blind.writing import write_case
from lostmotion_trials.integrators.hidden import Hidden
from lostmotion_trials.sealing import ConcealedCase, format_case_name, open_seal, seal_case

CLEAN, SEVERAL = 0.25, 0.15
"""Shares of the cases that hide nothing, and that hide two or three effects."""
RARE = 0.5
"""Relative weight of an effect that no library has, of which there are several kinds, in the draw of mechanisms."""
PLAIN, COLOURED, OUTLIERS = "plain", "coloured", "outliers"
VARIANTS: Mapping[str, float] = {PLAIN: 0.6, COLOURED: 0.2, OUTLIERS: 0.2}
"""The measurement noise of clean cases: white; AR(1); white with outliers. All other cases have white noise."""
TOUCHES = (0.05, 0.98)
"""A machine with a gap must be in contact for a share of time between these. Chosen by experience; no measurement
recorded."""
RUNAWAY = 4.0
"""Another machine is drawn where the hidden effects increase the motion by more than this factor, as a softening spring
may do. Chosen by experience; no measurement recorded."""
TRIES = 2000
"""Machines that are drawn until one fits."""
PERFECT, IMPERFECT = "perfect", "imperfect"
WORLDS = (PERFECT, IMPERFECT)


@dataclass(frozen=True)
class Blind:
    """Settings of a blind trial: seed, longest recording (samples), and optionally only some mechanisms, or none.

    In an imperfect world machines have imperfections beside the hidden effect (`imperfect.py`), and kinds of drives
    alternate.
    """

    seed: int = 0
    most: int = 20_000
    only: tuple[str, ...] = ()
    clean: bool = False
    world: str = PERFECT

    def check(self) -> None:
        """Refuse unknown names, and options that exclude one another."""
        for name in self.only:
            if name not in NAMES:
                raise DataError(f"no mechanism is called {name!r}: there are {', '.join(NAMES)}")
        if self.world not in WORLDS:
            raise DataError(f"no world is called {self.world!r}: there are {', '.join(WORLDS)}")
        if self.only and self.clean:
            raise DataError("clean cases hide nothing: give either --clean or --only")


def conceal_case(blind: Blind, out: Path, number: int) -> ConcealedCase:
    """Return the digests of case `number` after writing it, and its sealed truth, into the folder `out`."""
    rng = np.random.default_rng([blind.seed, number])
    salt = rng.bytes(16).hex()
    kind = KINDS[number % len(KINDS)]
    names, variant = _choose_effects(blind, rng, kind if blind.world == IMPERFECT else "")
    place = folder_for(out / "cases" / format_case_name(number))
    if blind.world == IMPERFECT:
        names = names[:1]
        draw, fill = partial(draw_machine, kind, rng, blind.most), partial(_fill_imperfect, names, kind, rng)
    else:
        draw, fill = partial(draw_rig, rng, blind.most), partial(_fill_perfect, names, rng)
    rig, (effects, motion, world) = _draw_machine(names, rng, draw, fill)
    step = convert_effects(rig, effects)[1].step
    if world:
        response, noise = record_imperfect(rig, motion, world, rng, hidden_step=step)
        noise_size = EXCITATION_NOISE * rig.signal.amplitude
        excitation = rig.signal.value(rig.time) + noise_size * rng.standard_normal(len(motion))
    else:
        excitation, response, noise = _record(rig, motion, step, variant, rng)
    stated = world.stated if world else {}
    write_case(rig, (excitation, response), place, title=f"Blind case {format_case_name(number)}", stated=stated)
    truth = SealedTruth(
        schema="lostmotion.sealed/1",
        case=format_case_name(number),
        salt=salt,
        variant=variant,
        effects=effects,
        machine=SealedMachine(**vars(rig), measurement_noise=noise),
        world=world,
    )
    save_json(folder_for(out / "sealed") / f"{format_case_name(number)}.json", to_plain(truth))
    return seal_case(out, number, ("case.toml", "recording.csv"))


def open_sealed(out: Path, number: int) -> SealedTruth:
    """Return the truth of a case, after checking that neither it nor the case has changed since it was sealed."""
    return from_plain(SealedTruth, open_seal(out, number), str(out / "sealed" / f"{format_case_name(number)}.json"))


def _choose_effects(blind: Blind, rng: np.random.Generator, kind: str = "") -> tuple[tuple[str, ...], str]:
    """Return the effects to hide, and the kind of measurement noise; `kind` is that of the drive, if it is given."""
    lot, noisy = rng.random(), str(rng.choice(list(VARIANTS), p=list(VARIANTS.values())))
    if blind.clean or (not blind.only and lot < CLEAN):
        return (), noisy
    offered = [name for name in blind.only or NAMES if not kind or _is_possible(name, kind)]
    if not offered:
        raise DataError(f"{' and '.join(blind.only)} cannot be hidden in a machine under {kind}: name more mechanisms")
    weights = np.array([RARE if name == "unknown" else 1.0 for name in offered])
    count = 1 if blind.only or lot < 1.0 - SEVERAL else int(rng.integers(2, 4))
    picked = rng.choice(offered, size=count, replace=False, p=weights / weights.sum()).tolist()
    return tuple(_drop_same_kin(picked)), PLAIN


def _drop_same_kin(names: Sequence[str]) -> list[str]:
    """Return the names with at most one of each kin; an effect that no library has is hidden alone."""
    if "unknown" in names:
        return ["unknown"]
    kin = {TABLE[name].kin: name for name in reversed(names)}
    return [name for name in names if kin[TABLE[name].kin] == name]


Filled = tuple[tuple[Effect, ...], Array, "World | None"]
"""The hidden effects of a machine with their sizes; its motion (samples,); and its imperfections, if it has any."""


def _draw_machine(
    names: Sequence[str],
    rng: np.random.Generator,
    draw: Callable[[], BlindMachine],
    fill: Callable[[Pilot], Filled],
) -> tuple[BlindMachine, Filled]:
    """Return a machine that moves with all of these mechanisms, with its effects, its motion and its imperfections."""
    for _ in range(TRIES):
        rig = draw()
        if not all(TABLE[name].fits(rig) if name in TABLE else rig.model in SPRUNG for name in names):
            continue
        with suppress(DataError):
            pilot = Pilot(rig, simulate_machine(rig, Hidden(), Disturbances(), rng))
            if "x0" in rig.values and not TOUCHES[0] < float(np.mean(np.abs(pilot.contact_sign))) < TOUCHES[1]:
                continue
            filled = fill(pilot)
            if 0.0 < float(np.std(filled[1])) < RUNAWAY * float(np.std(pilot.q)):
                return rig, filled
    raise DataError(f"no machine was drawn that can have {' and '.join(names) or 'nothing'}")


def _fill_perfect(names: Sequence[str], rng: np.random.Generator, pilot: Pilot) -> Filled:
    effects = tuple(draw_sized_effect(name, pilot, rng) for name in names)
    return effects, simulate_machine(pilot.rig, *convert_effects(pilot.rig, effects), rng), None


def _fill_imperfect(names: Sequence[str], kind: str, rng: np.random.Generator, pilot: Pilot) -> Filled:
    rig, world = pilot.rig, draw_world(kind, pilot, rng)
    effects = tuple(draw_effect(name, pilot, rng) for name in names)
    inside, disturbances = hidden = convert_effects(rig, effects)
    moved = Pilot(rig, simulate_machine(rig, inside, disturbances.leave_out_sensor(), rng))
    if not 0.0 < float(np.std(moved.q)) < RUNAWAY * float(np.std(pilot.q)):
        raise DataError("the machine hardly moves, or runs away, with what is hidden in it")
    world = follow_motion(world, moved, rng)
    return effects, simulate_imperfect(rig, hidden, world, rng), world


def _is_possible(name: str, kind: str) -> bool:
    """Return whether a mechanism can be hidden under a kind of drive: some need a constant frequency, or a joint.

    A joint is never driven by impacts.
    """
    mechanism = TABLE.get(name)
    if mechanism is None:
        return True
    return (kind == CYCLE or not mechanism.tone) and not (kind == IMPACTS and mechanism.models == ("robot_joint",))


def _record(
    rig: BlindMachine, truth: Array, step: float, variant: str, rng: np.random.Generator
) -> tuple[Array, Array, float]:
    """Return excitation and response (samples,) as recorded, and the standard deviation of the response noise."""
    clean = rig.signal.value(rig.time)
    noise = rig.noise * float(np.std(truth - clean if rig.based else truth))
    white = rng.standard_normal(len(truth))
    if variant == COLOURED:
        white = _filter_ar1(white, float(rng.uniform(0.3, 0.8)))
    if variant == OUTLIERS:
        hit = rng.random(len(truth)) < 10.0 ** rng.uniform(-3.0, -2.0)
        white = white + hit * rng.choice([-1.0, 1.0], len(truth)) * rng.uniform(5.0, 20.0, len(truth))
    shown = truth + noise * white
    if step:
        shown = step * np.round(shown / step)
    return clean + EXCITATION_NOISE * rig.signal.amplitude * rng.standard_normal(len(truth)), shown, noise


def _filter_ar1(white: Array, memory: float) -> Array:
    """Return AR(1) noise of unit standard deviation with the coefficient `memory`, from white noise."""
    from scipy.signal import lfilter

    return np.asarray(lfilter([(1.0 - memory**2) ** 0.5], [1.0, -memory], white), dtype=float)
