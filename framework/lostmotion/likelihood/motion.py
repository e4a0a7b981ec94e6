"""Free motion and derivatives of a system at many points: the kernels of `kernels/motion.py` handed what they need."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.errors import ContractError
from lostmotion.kernels.inputs import DRIVES
from lostmotion.kernels.vector import STRIDE, WIDTH
from lostmotion.likelihood.compose import FIRST, SENSOR, STATES, X, law_kernel
from lostmotion.likelihood.drive import Drive, widened
from lostmotion.likelihood.kernels import motion_kernels

if TYPE_CHECKING:
    from lostmotion.likelihood.system import System


def block(rows: int) -> Array:
    """Return a block of zeros (rows, STRIDE) that begins where a vector register likes it to."""
    raw = np.zeros(rows * STRIDE + WIDTH)
    skip = (-raw.ctypes.data // 8) % WIDTH
    return raw[skip : skip + rows * STRIDE].reshape(rows, STRIDE)


def lanes_for(points: int) -> int:
    """Return how many lanes a kernel takes for so many points: whole vectors."""
    return -(-points // WIDTH) * WIDTH


def spread(values: Array) -> Array:
    """Return values (points, rows) as a block (rows, STRIDE); lanes without a point repeat the last one."""
    made = block(values.shape[1])
    made[:] = values[np.minimum(np.arange(STRIDE), len(values) - 1)].T
    return made


def model_block(system: System, packed: Array) -> Array:
    """Return the block of a model with its parameters, packed by `System.pack`, (points, params)."""
    rows = system.blueprint.rows
    made = block(rows.total)
    made[rows.params :] = spread(packed)
    return made


def model_wires(
    system: System,
    active: frozenset[str],
    latent: tuple[int, ...] = (),
    *,
    muted: str | None = None,
    compiled: bool = True,
) -> NDArray[np.int64]:
    """Return the wires of a model: rows, how many laws act, where latent forces stand, and a table for each law.

    The law with the key `muted` does not act, and its states stay.
    """
    plan, (on, at) = system.blueprint, system.wiring(active)
    forces = [*latent, *(-1 for _ in plan.bodies[len(latent) :])]
    heard = [i for i, (key, _) in enumerate(system.forces) if on[i] and key != muted]
    chosen = sorted(heard, key=lambda i: plan.laws[i].channel is not None)
    sensing = sum(plan.laws[i].channel is not None for i in chosen)
    paced = sum(1 << int(at[i] + a) for i in chosen if plan.laws[i].steps for a in range(plan.laws[i].states))
    tables = [_table(system, i, int(at[i]), compiled) for i in chosen]
    begin = FIRST + 2 + len(forces) + len(tables)
    offsets = [begin + sum(map(len, tables[:i])) for i in range(len(tables))]
    head = [*plan.rows[:5], 0, 0, plan.inputs, 1, plan.rows.step, paced, len(chosen) - sensing, sensing]
    return np.array([*head, *forces, *offsets, *(n for table in tables for n in table)], dtype=np.int64)


def _table(system: System, number: int, at: int, compiled: bool) -> list[int]:
    """Return what the kernel of a model knows of a law: where it is, and which rows are copied to its desk and back.

    `at` is where its states begin among those of the model.
    """
    plan, law = system.blueprint, system.blueprint.laws[number]
    rows, own, place = plan.rows, plan.starts[number], plan.places[law.place]
    desk = rows.desk + STATES
    copies = [(rows.states + at + a, desk + a) for a in range(law.states)]
    copies += [(rows.inputs + i, desk + 2 * law.states + i) for i in range(plan.inputs_of(law))]
    copies += [(rows.step, own + a) for a in law.steps] + [(rows.derivatives + place.row, own + a) for a in law.felt]
    copies += [] if law.channel is None else [(rows.channels + law.channel, rows.desk + X)]
    returns = [(desk + law.states + a, rows.derivatives + at + a) for a in range(law.states)]
    address = law_kernel(law, plan.inputs_of(law))[0] if compiled else 0
    where = SENSOR if law.channel is not None else law.place
    head = [address, number, where, own, rows.onset + number, len(copies), len(returns)]
    return [*head, *(row for pair in (*copies, *returns) for row in pair)]


def require_sound(failed: int, system: System, made: Array, wires: NDArray[np.int64]) -> None:
    """Raise a `ContractError` where a law raised an error of its own: what it raises, at the points of the block."""
    if failed:
        plain = system.functions(compiled=False)
        plain.derive(made, wires, STRIDE)
        plain.observe(made, wires, STRIDE)
        raise ContractError("a model or term raised an error: let it return a number for any motion")


def run(
    system: System,
    active: frozenset[str],
    packed: Array,
    start: Array,
    drive: Drive,
    nsub: int,
    first: NDArray[np.int64],
    steps: int,
    *,
    kicks: Array | None = None,
    compiled: bool = True,
) -> tuple[Array, NDArray[np.int64]]:
    """Return states (points, steps, n) of free runs, NaN where they left all numbers, and how far each one got.

    `packed` are the parameters (points, params) of all runs, or (1, params) where they share them. They start at the
    samples `first` of the drive, from `start` (points, n); `kicks` (points, steps, n) are added at each later sample.
    """
    points, n = start.shape
    states, reached = np.full((points, steps, n), np.nan), np.zeros(points, dtype=np.int64)
    wires, made = model_wires(system, active, compiled=compiled), system.functions(compiled)
    wires[DRIVES] = 2  # each run reads the drive from a place of its own
    cubics = drive.widened(len(system.model.inputs)).cubics
    kernel, pushed = motion_kernels(compiled)["run_freely"], np.zeros((points, 0, n)) if kicks is None else kicks
    for begin in range(0, points, STRIDE):
        part = slice(begin, begin + STRIDE)
        states[part, 0] = start[part]
        lanes = lanes_for(len(start[part]))
        which = first[part][np.minimum(np.arange(STRIDE), len(start[part]) - 1)]
        blocks = (
            model_block(system, packed[part] if len(packed) > 1 else packed),
            block(2 * n),
            spread(np.asarray(drive.begin + which[:, None] * drive.dt, dtype=float)),
        )
        both = (made.derive, made.observe)
        told = (states[part], np.ascontiguousarray(pushed[part]), reached[part], lanes)
        failed = kernel(both, blocks, wires, cubics, which, drive.dt, nsub, *told)
        require_sound(failed, system, blocks[0], wires)
    for point, count in enumerate(reached):
        states[point, count:] = np.nan
    return states, reached


def derivatives(
    system: System,
    active: frozenset[str],
    packed: Array,
    states: Array,
    inputs: Array,
    times: Any = None,
    *,
    muted: str | None = None,
) -> tuple[Array, Array]:
    """Return derivatives (points, n) of the states (points, n) under inputs (points, inputs), and channels there.

    `packed` are the parameters (1, params), `times` (points,) in s, zero if not given. Inputs that lack are zero. The
    force with the key `muted` is switched off, and its states stay.
    """
    rates, seen = np.zeros(states.shape), np.zeros((len(states), len(system.model.channels)))
    made, wires = system.functions(), model_wires(system, active, muted=muted)
    told: list[Any] = [
        np.ascontiguousarray(a, dtype=float)
        for a in (np.zeros(len(states)) if times is None else times, states, widened(inputs, len(system.model.inputs)))
    ]
    blocks = (model_block(system, packed),)
    failed = motion_kernels()["evaluate"]((made.derive, made.observe), blocks, wires, *told, rates, seen)
    require_sound(failed, system, blocks[0], wires)
    return rates, seen
