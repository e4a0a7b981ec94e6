"""Free runs and derivatives of a system at many points: calls of the kernels of `kernels/motion.py`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.errors import ContractError
from lostmotion.kernels.inputs import DRIVES
from lostmotion.kernels.vector import STRIDE, WIDTH
from lostmotion.likelihood.compose import FIRST, SENSOR, STATES, X, compile_law
from lostmotion.likelihood.drive import Drive, pad_inputs
from lostmotion.likelihood.kernels import build_motion
from lostmotion.likelihood.layout import Layout


def make_block(rows: int) -> Array:
    """Return a block of zeros (rows, STRIDE), aligned to a vector register."""
    raw = np.zeros(rows * STRIDE + WIDTH)
    skip = (-raw.ctypes.data // 8) % WIDTH
    return raw[skip : skip + rows * STRIDE].reshape(rows, STRIDE)


def count_lanes(points: int) -> int:
    """Return the number of lanes that a kernel computes for so many points: whole vectors."""
    return -(-points // WIDTH) * WIDTH


def spread_points(values: Array) -> Array:
    """Return values (points, rows) as a block (rows, STRIDE); lanes without a point repeat the last one."""
    made = make_block(values.shape[1])
    made[:] = values[np.minimum(np.arange(STRIDE), len(values) - 1)].T
    return made


def make_model_block(system: Layout, packed: Array) -> Array:
    """Return the block of a model with its parameters, packed by `System.pack`, (points, params)."""
    rows = system.blueprint.rows
    made = make_block(rows.total)
    made[rows.params :] = spread_points(packed)
    return made


def make_model_wires(
    system: Layout,
    active: frozenset[str],
    latent: tuple[int, ...] = (),
    *,
    muted: str | None = None,
    compiled: bool = True,
) -> NDArray[np.int64]:
    """Return the wires of a model: rows, number of active laws, rows of latent forces, and a table for each law.

    The law with the key `muted` does not act, and its states stay.
    """
    plan, (on, at) = system.blueprint, system.wiring(active)
    forces = [*latent, *(-1 for _ in plan.bodies[len(latent) :])]
    heard = [i for i, (key, _) in enumerate(system.forces) if on[i] and key != muted]
    chosen = sorted(heard, key=lambda i: plan.laws[i].channel is not None)
    sensing = sum(plan.laws[i].channel is not None for i in chosen)
    paced = sum(1 << int(at[i] + a) for i in chosen if plan.laws[i].steps for a in range(plan.laws[i].states))
    tables = [_make_law_table(system, i, int(at[i]), compiled) for i in chosen]
    begin = FIRST + 2 + len(forces) + len(tables)
    offsets = [begin + sum(map(len, tables[:i])) for i in range(len(tables))]
    head = [*plan.rows[:5], 0, 0, plan.inputs, 1, plan.rows.step, paced, len(chosen) - sensing, sensing]
    return np.array([*head, *forces, *offsets, *(n for table in tables for n in table)], dtype=np.int64)


def _make_law_table(system: Layout, number: int, at: int, compiled: bool) -> list[int]:
    """Return the table of a law: its address, and the rows that are copied to its desk and back.

    `at` is the index of its first state among those of the model.
    """
    plan, law = system.blueprint, system.blueprint.laws[number]
    rows, own, place = plan.rows, plan.starts[number], plan.places[law.place]
    desk = rows.desk + STATES
    copies = [(rows.states + at + a, desk + a) for a in range(law.states)]
    copies += [(rows.inputs + i, desk + 2 * law.states + i) for i in range(plan.inputs_of(law))]
    copies += [(rows.step, own + a) for a in law.steps] + [(rows.derivatives + place.row, own + a) for a in law.felt]
    copies += [] if law.channel is None else [(rows.channels + law.channel, rows.desk + X)]
    returns = [(desk + law.states + a, rows.derivatives + at + a) for a in range(law.states)]
    address = compile_law(law, plan.inputs_of(law))[0] if compiled else 0
    where = SENSOR if law.channel is not None else law.place
    head = [address, number, where, own, rows.onset + number, len(copies), len(returns)]
    return [*head, *(row for pair in (*copies, *returns) for row in pair)]


def require_no_failure(failed: int, system: Layout, made: Array, wires: NDArray[np.int64]) -> None:
    """Raise a `ContractError` where a law raised an error: the law's own error, at the points of the block."""
    if failed:
        plain = system.functions(compiled=False)
        plain.derive(made, wires, STRIDE)
        plain.observe(made, wires, STRIDE)
        raise ContractError("a model or term raised an error: let it return a number for any motion")


def run_freely(
    system: Layout,
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
    """Return states (points, steps, n) of free runs, NaN after a divergence, and the number of finite samples of each.

    `packed` are the parameters (points, params) of all runs, or (1, params) where they share them. They start at the
    samples `first` of the drive, from `start` (points, n); `kicks` (points, steps, n) are added at each later sample.
    """
    points, n = start.shape
    states, reached = np.full((points, steps, n), np.nan), np.zeros(points, dtype=np.int64)
    wires, made = make_model_wires(system, active, compiled=compiled), system.functions(compiled)
    wires[DRIVES] = 2  # each run reads the drive from a place of its own
    cubics = drive.pad_inputs(len(system.model.inputs)).cubics
    kernel, pushed = build_motion(compiled)["run_freely"], np.zeros((points, 0, n)) if kicks is None else kicks
    for begin in range(0, points, STRIDE):
        part = slice(begin, begin + STRIDE)
        states[part, 0] = start[part]
        lanes = count_lanes(len(start[part]))
        which = first[part][np.minimum(np.arange(STRIDE), len(start[part]) - 1)]
        blocks = (
            make_model_block(system, packed[part] if len(packed) > 1 else packed),
            make_block(2 * n),
            spread_points(np.asarray(drive.begin + which[:, None] * drive.dt, dtype=float)),
        )
        both = (made.derive, made.observe)
        told = (states[part], np.ascontiguousarray(pushed[part]), reached[part], lanes)
        failed = kernel(both, blocks, wires, cubics, which, drive.dt, nsub, *told)
        require_no_failure(failed, system, blocks[0], wires)
    for point, count in enumerate(reached):
        states[point, count:] = np.nan
    return states, reached


def compute_each(
    system: Layout,
    active: frozenset[str],
    packed: Array,
    states: Array,
    inputs: Array,
    times: Any = None,
    *,
    muted: str | None = None,
    latent: tuple[int, ...] = (),
) -> tuple[Array, Array]:
    """Return the derivatives and channels of a system, as `System.compute_each` does; missing inputs are zero."""
    shape = (len(packed), len(states))
    rates, seen = np.zeros((*shape, states.shape[1])), np.zeros((*shape, len(system.model.channels)))
    made, wires = system.functions(), make_model_wires(system, active, latent, muted=muted)
    rows, kernel = system.blueprint.rows, build_motion()["evaluate"]
    told: list[Any] = [
        np.ascontiguousarray(a, dtype=float)
        for a in (
            np.zeros(len(states)) if times is None else times,
            states,
            pad_inputs(inputs, len(system.model.inputs)),
        )
    ]
    block = make_block(rows.total)
    for one, to, shown in zip(packed, rates, seen, strict=True):
        block[:] = 0.0
        block[rows.params :] = one[:, None]
        failed = kernel((made.derive, made.observe), (block,), wires, *told, to, shown)
        require_no_failure(failed, system, block, wires)
    return rates, seen
