"""The description of one recording in a case: file, columns and units."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePath
from typing import Literal

Hold = Literal["smooth", "step"]
"""The inputs between samples: smooth, or constant as a digital controller holds them."""

EXCITATIONS = ("force", "torque", "base_position", "base_acceleration", "voltage", "current")
RESPONSES = ("position", "velocity", "acceleration", "force", "torque", "voltage", "current")


@dataclass(frozen=True)
class Channel:
    """A column of a file and its quantity; values are multiplied by `factor` before the unit, as by newtons per volt.

    `of` is the input or the channel of the model, `quantity` its quantity. A sensor has a `name`, at which sensor terms
    act, and names of `noise` with plus signs between them. A sensor without a name is the only one of its recording.
    With `differences` each value is the change since the row before; the zero is then `loose`, that is unknown.
    """

    column: str
    quantity: str
    unit: str
    factor: float = 1.0
    of: str = ""
    name: str = ""
    noise: str = "white"
    differences: bool = False
    loose: bool = False

    @property
    def target(self) -> str:
        """The input or the channel of the model; a torque counts as the force of a rotation."""
        return self.of or ("force" if self.quantity == "torque" else self.quantity)


@dataclass(frozen=True)
class RecordingSpec:
    """One recording: either `time` (a column) or `rate` (Hz); `t_start` and `t_end` (s) select a part of it.

    `inputs` are the measured drives, none in a free decay; `sensors` are the readings, at least one. `time_unit` is the
    unit of the time column, or None where the file gives it; `start` is the time of the recording.
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
        """The name of this recording in results; the stem of the file where no name was given."""
        return self.name or PurePath(self.file).stem
