"""What a case says of one recording: which file, which columns, in which units."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePath
from typing import Literal

Hold = Literal["smooth", "step"]
"""How the excitation runs between samples: smoothly, or held as a digital controller holds it."""

EXCITATIONS = ("force", "torque", "base_position")
RESPONSES = ("position", "velocity", "acceleration", "force", "torque")


@dataclass(frozen=True)
class Channel:
    """A column of a file and what it measures; `factor` comes before the unit, for instance newtons per volt."""

    column: str
    quantity: str
    unit: str
    factor: float = 1.0


@dataclass(frozen=True)
class RecordingSpec:
    """One recording: either `time` (a column in s) or `rate` (Hz); `t_start` and `t_end` (s) cut a piece out of it."""

    file: str
    time: str | None
    rate: float | None
    excitation: Channel
    response: Channel
    hold: Hold = "smooth"
    t_start: float | None = None
    t_end: float | None = None
    name: str | None = None

    @property
    def label(self) -> str:
        """The name by which results speak of this recording; the stem of the file where none was given."""
        return self.name or PurePath(self.file).stem
