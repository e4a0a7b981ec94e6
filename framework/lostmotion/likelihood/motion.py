"""Free motion and derivatives of a system at many points: the kernels of `kernels/motion.py` handed what they need."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.errors import ContractError
from lostmotion.kernels.inputs import DRIVES
from lostmotion.kernels.vector import STRIDE, WIDTH
from lostmotion.likelihood.compose import FIRST
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


def model_wires(system: System, active: frozenset[str], latent: tuple[int, ...] = ()) -> NDArray[np.int64]:
    """Return the wires of a model: rows, switches, where the states of each law begin, and those of latent forces."""
    plan, (on, at) = system.blueprint, system.wiring(active)
    forces = [*latent, *(-1 for _ in plan.bodies[len(latent) :])]
    paced = sum(
        1 << int(a + i) for law, a in zip(plan.laws, at, strict=True) if a and law.steps for i in range(law.states)
    )
    wires = np.array([*plan.rows[:5], 0, 0, plan.inputs, 1, plan.rows.step, paced, *on, *at, *forces], dtype=np.int64)
    assert len(wires) == FIRST + 2 * len(plan.laws) + len(plan.bodies)  # noqa: S101
    return wires


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
    wires, made = model_wires(system, active), system.functions(compiled)
    wires[DRIVES] = 2  # each run reads the drive from a place of its own
    cubics = drive.widened(len(system.model.inputs)).cubics
    kernel, pushed = motion_kernels(compiled)["run"], np.zeros((points, 0, n)) if kicks is None else kicks
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
    made, wires = system.functions(), model_wires(system, active)
    if muted is not None:
        wires[FIRST + [key for key, _ in system.forces].index(muted)] = 0
    told: list[Any] = [
        np.ascontiguousarray(a, dtype=float)
        for a in (np.zeros(len(states)) if times is None else times, states, widened(inputs, len(system.model.inputs)))
    ]
    blocks = (model_block(system, packed),)
    failed = motion_kernels()["evaluate"]((made.derive, made.observe), blocks, wires, *told, rates, seen)
    require_sound(failed, system, blocks[0], wires)
    return rates, seen
