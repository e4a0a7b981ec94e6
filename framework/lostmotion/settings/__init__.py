"""The thresholds on which conclusions depend: significance, naming, held-out comparison, convergence of chains.

Each has a reason and, where one exists, a source. They are passed as arguments, are recorded in the provenance of each
result, and can be changed: `lostmotion diagnose CASE.toml --set select.decisive=4`, or
`lostmotion.diagnose(case, settings={"select.decisive": 4.0})`. `lostmotion settings` lists them. Numerical
options, which no user has a reason to change, are `Options` of the module that uses them; those of the numerical core
are class attributes of its stage here.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field, fields, replace
from typing import NamedTuple

from lostmotion.arguments import anything, error, mapping, to_number
from lostmotion.errors import CaseError, nearest
from lostmotion.settings.diagnosis_settings import (
    HeldOutSettings,
    LocateSettings,
    NameSettings,
    RivalSettings,
    SelectSettings,
    SharedSettings,
    UnknownSettings,
)
from lostmotion.settings.identification_settings import ChainSettings, LevelSettings, ModeSettings
from lostmotion.settings.motion_settings import MotionSettings
from lostmotion.settings.notes_settings import ExperimentSettings, NoteSettings
from lostmotion.settings.recording_settings import RecordingSettings

__all__ = [
    "DEFAULT",
    "ChainSettings",
    "ExperimentSettings",
    "HeldOutSettings",
    "LevelSettings",
    "LocateSettings",
    "ModeSettings",
    "MotionSettings",
    "NameSettings",
    "NoteSettings",
    "RecordingSettings",
    "RivalSettings",
    "SelectSettings",
    "Setting",
    "Settings",
    "SharedSettings",
    "UnknownSettings",
    "read",
    "restore",
]


class Setting(NamedTuple):
    """One threshold: its key `stage.name`, value, default and unit, the reason for it, its source and its range."""

    key: str
    value: float
    default: float
    unit: str
    why: str
    source: str
    least: float
    most: float


@dataclass(frozen=True)
class Settings:
    """All thresholds, by stage; frozen. `Settings().changed({"select.decisive": 4.0})` returns changed ones."""

    recording: RecordingSettings = field(default_factory=RecordingSettings)
    locate: LocateSettings = field(default_factory=LocateSettings)
    select: SelectSettings = field(default_factory=SelectSettings)
    rival: RivalSettings = field(default_factory=RivalSettings)
    unknown: UnknownSettings = field(default_factory=UnknownSettings)
    heldout: HeldOutSettings = field(default_factory=HeldOutSettings)
    name: NameSettings = field(default_factory=NameSettings)
    note: NoteSettings = field(default_factory=NoteSettings)
    experiment: ExperimentSettings = field(default_factory=ExperimentSettings)
    shared: SharedSettings = field(default_factory=SharedSettings)
    mode: ModeSettings = field(default_factory=ModeSettings)
    chain: ChainSettings = field(default_factory=ChainSettings)
    levels: LevelSettings = field(default_factory=LevelSettings)
    motion: MotionSettings = field(default_factory=MotionSettings)

    def changed(self, values: Mapping[str, float | str]) -> Settings:
        """Return the settings with some values changed, by `stage.name`; unknown keys or values raise `CaseError`."""
        made, known = self, {setting.key: setting for setting in self}
        for key, value in mapping(anything, "{'select.decisive': 4.0}")(values, "settings").items():
            if key not in known:
                raise CaseError(f"there is no setting {key!r}{nearest(key, known)}: `lostmotion settings` lists them")
            stage, _, name = key.partition(".")
            made = replace(made, **{stage: replace(getattr(made, stage), **{name: _check_value(known[key], value)})})
        return made

    def __iter__(self) -> Iterator[Setting]:
        """Yield every setting."""
        for stage in fields(self):
            own = getattr(self, stage.name)
            for f in fields(own):
                yield Setting(f"{stage.name}.{f.name}", getattr(own, f.name), **f.metadata)

    def as_dict(self) -> dict[str, dict[str, float]]:
        """Return all values as nested mappings, `{stage: {name: value}}`, for the provenance of a result."""
        return asdict(self)


DEFAULT = Settings()
"""The default settings."""


def _check_value(setting: Setting, value: object) -> float:
    """Return a value for a setting as a number; raise `CaseError` where it is no number in the allowed range."""
    number = math.nan
    if isinstance(value, str):  # as the command line has it
        with suppress(ValueError):
            number = float(value)
    elif (found := to_number(value)) is not None:
        number = found
    if not setting.least <= number <= setting.most or not math.isfinite(number):
        raise error(value, f"the setting {setting.key}", f"a number from {setting.least:g} to {setting.most:g}")
    return number


def read(pairs: Mapping[str, float | str] | Settings | None) -> Settings:
    """Return settings from the argument of a caller: settings, a mapping of changes, or None."""
    return pairs if isinstance(pairs, Settings) else DEFAULT.changed({} if pairs is None else pairs)


def restore(stages: object) -> Settings:
    """Return the settings stored in the provenance of a result; absent, unknown or invalid values are the defaults."""
    known, changes = {setting.key: setting for setting in DEFAULT}, dict[str, float]()
    for stage, values in stages.items() if isinstance(stages, Mapping) else ():
        for name, value in values.items() if isinstance(values, Mapping) else ():
            if (setting := known.get(f"{stage}.{name}")) is not None:
                with suppress(CaseError):
                    changes[setting.key] = _check_value(setting, value)
    return DEFAULT.changed(changes)
