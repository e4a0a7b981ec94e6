"""What models and terms are made of: parameters, places at which forces act, and dimensionless numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lostmotion.quantities import Dimension

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Param:
    """A number that may be known or estimated: `low` and `high` are physical bounds, not a prior.

    Of a term: `null` is where all of it does nothing; `typical` the prior width in natural scales (drive force, rms
    position and velocity; if `lasting`, the time is that of the whole recording); `choices` are tried in turn and held,
    and `words` are what a sentence says in place of each; `far` lists multiples of `typical` tried as well. With
    `scale="log"` it is positive, known by order of magnitude.
    `scan` are the least and the largest multiple of `typical` between which a recording is searched for it; for an
    amplitude that a response is far from linear in, too.
    """

    name: str
    meaning: str
    dimension: Dimension
    low: float = -math.inf
    high: float = math.inf
    scale: Literal["linear", "log"] = "linear"
    null: float | None = None
    typical: float = 1.0
    aliases: tuple[str, ...] = ()
    choices: tuple[float, ...] = ()
    words: tuple[str, ...] = ()
    lasting: bool = False
    far: tuple[float, ...] = ()
    scan: tuple[float, float] | None = None


@dataclass(frozen=True)
class Interface:
    """A place where a force can act: `motion(y, u)` gives relative position and velocity there.

    The force over parameter `inertia` is added to `dydt[row]`, and taken off at `against`, row and inertia of a second
    body, times the parameter `lever` (a gear ratio), whose value then goes to `motion(y, u, lever)` too. Terms that
    need what a place `holds`, such as the gap, or its contact (`stiffness`, `play`), act nowhere else.
    """

    name: str
    row: int
    inertia: str
    motion: Callable[..., tuple[float, float]]
    holds: tuple[str, ...] = ()
    stiffness: str | None = None
    play: str | None = None
    against: tuple[int, str] | None = None
    lever: str | None = None


class Group(NamedTuple):
    """A dimensionless number of a model: setting it sets the parameter `target` to `law(values, number)`.

    `target` may also be "drive.amplitude"; `values` are the parameters in SI units, and "drive.omega" (rad/s).
    """

    name: str
    meaning: str
    formula: str
    target: str
    law: Callable[[Mapping[str, float], float], float]
