"""Sensors: each sees one channel of the model, with noise of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True)
class White:
    """Noise that is independent from sample to sample."""

    kind: ClassVar[str] = "white"


@dataclass(frozen=True)
class AR1:
    """White noise and, in addition, correlated noise: an autoregressive process of first order."""

    kind: ClassVar[str] = "ar1"


@dataclass(frozen=True)
class Quantised:
    """White noise of a sensor whose values are multiples of a quantisation step, `step` (unit of the channel)."""

    step: float = 0.0
    kind: ClassVar[str] = "quantised"

    @property
    def variance(self) -> float:
        """The variance that quantisation adds: that of a uniform density one step wide."""
        return self.step**2 / 12.0


Noise = White | AR1 | Quantised
NOISES: dict[str, type[Noise]] = {noise.kind: noise for noise in (White, AR1, Quantised)}


@dataclass(frozen=True)
class Sensor:
    """A sensor: a `channel` of the model, under a `name`, with noise of a kind.

    Gain, offset and delay of a sensor are parameters like others, and no fields.
    """

    channel: str
    name: str = ""
    noise: Noise = White()

    @property
    def place(self) -> str:
        """Where terms of this sensor act: at its name, or at "sensor" where it is the only one and has none."""
        return self.name or "sensor"

    @property
    def label(self) -> str:
        """The name, or the channel where it has none."""
        return self.name or self.channel
