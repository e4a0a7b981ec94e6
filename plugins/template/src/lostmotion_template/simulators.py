"""A machine with two joints in plain NumPy: the inverse dynamics of an arm in a vertical plane."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Simulator

GRAVITY = 9.81
USUAL = {
    "length": 0.4, "upper_mass": 3.0, "upper_centre": 0.2, "upper_inertia": 0.05, "fore_mass": 2.0, "fore_centre": 0.15,
    "fore_inertia": 0.03, "reach": 0.35,
}  # fmt: skip


@dataclass(frozen=True)
class TwoLink(Simulator):
    """An arm of two links, `shoulder` and `elbow`; angles are from the horizontal, and relative at the elbow.

    `file` is a TOML file with the numbers of `USUAL` that differ; `moving` repeats the names of the joints. `payload`
    (kg) is carried at the tip.
    """

    file: str = ""
    moving: tuple[str, ...] = ()
    payload: float = 0.0
    name: ClassVar[str] = "two_link"
    paper: ClassVar[str] = "Spong, Hutchinson, Vidyasagar, Robot Modeling and Control (2006), section 7.3"

    @property
    def joints(self) -> tuple[str, ...]:
        return ("shoulder", "elbow")

    @cached_property
    def numbers(self) -> dict[str, float]:
        """The numbers of the arm, in SI units."""
        return USUAL | (tomllib.loads(Path(self.file).read_text(encoding="utf-8")) if self.file else {})

    @property
    def points(self) -> tuple[str, ...]:
        return ("tip",)

    def inverse(self, q: Array, v: Array, a: Array) -> Array:
        p = self.numbers
        moment = p["fore_mass"] * p["fore_centre"] + self.payload * p["reach"]
        far = p["fore_inertia"] + p["fore_mass"] * p["fore_centre"] ** 2 + self.payload * p["reach"] ** 2
        mass = p["fore_mass"] + self.payload
        near = p["upper_inertia"] + p["upper_mass"] * p["upper_centre"] ** 2 + mass * p["length"] ** 2
        bend = p["length"] * moment
        c, s = np.cos(q[:, 1]), np.sin(q[:, 1])
        m11, m12 = near + far + 2.0 * bend * c, far + bend * c
        tip = GRAVITY * moment * np.cos(q[:, 0] + q[:, 1])
        root = GRAVITY * (p["upper_mass"] * p["upper_centre"] + mass * p["length"]) * np.cos(q[:, 0]) + tip
        turning = bend * s * (2.0 * v[:, 0] * v[:, 1] + v[:, 1] ** 2)
        one = m11 * a[:, 0] + m12 * a[:, 1] - turning + root
        two = m12 * a[:, 0] + far * a[:, 1] + bend * s * v[:, 0] ** 2 + tip
        return np.stack([one, two], axis=1)

    def changed(self, values: Mapping[str, float]) -> TwoLink:
        return replace(self, payload=values.get("tip.payload", self.payload))
