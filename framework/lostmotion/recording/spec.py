"""What a case says of one recording: which file, which columns, in which units."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePath
from typing import Literal

Hold = Literal["smooth", "step"]
"""How the inputs run between samples: smoothly, or held as a digital controller holds them."""
Kind = Literal["white", "ar1", "quantised"]
"""The noise of a sensor, as `lostmotion.likelihood.sensors` names it."""

EXCITATIONS = ("force", "torque", "base_position", "base_acceleration")
RESPONSES = ("position", "velocity", "acceleration", "force", "torque")
KINDS: tuple[Kind, ...] = ("white", "ar1", "quantised")


@dataclass(frozen=True)
class Channel:
    """A column of a file and what it measures; `factor` comes before the unit, for instance newtons per volt.

    `of` is the input or the channel of the model that it shows, `quantity` of what kind that is. A sensor has a `name`,
    at which terms of a sensor act, and `noise` of a kind. One without a name is the only sensor of its recording.
    """

    column: str
    quantity: str
    unit: str
    factor: float = 1.0
    of: str = ""
    name: str = ""
    noise: Kind = "white"

    @property
    def target(self) -> str:
        """The input or the channel of the model; a torque is the force of a rotation."""
        return self.of or ("force" if self.quantity == "torque" else self.quantity)


@dataclass(frozen=True)
class RecordingSpec:
    """One recording: either `time` (a column) or `rate` (Hz); `t_start` and `t_end` (s) cut a piece out of it.

    `inputs` are what drove the machine, none of them in a free decay; `sensors` what was measured, at least one.
    `time_unit` is the unit of the time column, or None where the file tells; `start` is when it was recorded.
    """

    file: str
    time: str | None
    rate: float | None
    inputs: tuple[Channel, ...]
    sensors: tuple[Channel, ...]
    hold: Hold = "smooth"
    t_start: float | None = None
    t_end: float | None = None
    name: str | None = None
    time_unit: str | None = None
    start: str | None = None

    @property
    def label(self) -> str:
        """The name by which results speak of this recording; the stem of the file where none was given."""
        return self.name or PurePath(self.file).stem
