"""What one page works on: a recording of the folder, and the case that is made of it."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from lostmotion.case import dump_case
from lostmotion.case.reading import parse_case
from lostmotion.errors import CaseError
from lostmotion.recording.outline import GivenRoles
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT
from lostmotion.simulators import INVERSE
from lostmotion.storage import folder_for
from lostmotion_app.case_content import list_code, move_paths
from lostmotion_app.folder import WorkFolder, is_case

if TYPE_CHECKING:
    from lostmotion.notebook.case import Case
    from lostmotion.preparation.beginning import Draft

STRETCH = ("t_start", "t_end")
"""The keys of a recording that say which part of it is used."""
CASE, DIAGNOSIS = "case.toml", "diagnosis.json"
_MODEL_GUESSED = "the model is "
"""The beginning of what a first case says where no model was given."""
Changed = Callable[[], None]


@dataclass
class Desk:
    """A recording, or a case file of the user, by its name in the folder, and the place of what is made of it.

    `hold` is the share that is held out. `plugins` are files that the user named on the command line, and `agreed` the
    case files whose Python files may run.
    """

    folder: WorkFolder
    registry: Registry
    plugins: tuple[str, ...] = ()
    recording: str = ""
    hold: float = DEFAULT.heldout.share
    changed: Changed | None = None
    agreed: set[str] = field(default_factory=set)

    @property
    def place(self) -> Path:
        """The folder of the case of this recording."""
        return self.folder.work / (re.sub(r"[^\w.-]+", "_", self.recording).strip("._") or "recording")

    @property
    def is_given(self) -> bool:
        """Whether the user chose a case file, which the page does not change."""
        return is_case(self.recording)

    @property
    def case(self) -> Path:
        """The path of the case, whether it exists or not."""
        return self.folder.find(self.recording) if self.is_given else self.place / CASE

    @property
    def is_robot(self) -> bool:
        """Whether the model of the case is a simulation of a robot."""
        return bool({INVERSE, *self.registry.names("simulator")} & self.content.get("model", {}).keys())

    def require_agreed(self) -> None:
        """Raise `CaseError` where the case runs Python files, and the user has not agreed."""
        if self.is_given and (files := list_code(self.content)) and self.recording not in self.agreed:
            raise CaseError(f"{self.recording} runs {', '.join(files)}: agree to it on the screen Data")

    @property
    def content(self) -> dict[str, Any]:
        """The content of the case file; empty where there is none."""
        return parse_case(self.case) if self.recording and self.case.is_file() else {}

    def read_case(self) -> Case:
        """Return the case with its recording; raises `CaseError` or `DataError` where it cannot be read."""
        from lostmotion.notebook.case import Case

        return Case.read(self.case)

    def list_results(self) -> list[Path]:
        """Return the folders with a diagnosis of this recording, the newest first."""
        folders = self.folder.list_results(DIAGNOSIS) if self.recording else []
        return [one for one in folders if one.is_relative_to(self.place)]

    @property
    def settings(self) -> Mapping[str, float]:
        """The settings that differ from the defaults."""
        return {} if self.hold == DEFAULT.heldout.share else {"heldout.share": self.hold}

    def save(self, content: Mapping[str, Any]) -> None:
        """Write the case file."""
        folder_for(self.place)
        dump_case(content, self.case)

    def copy_case(self, folder: Path) -> None:
        """Write a copy of the case into another folder, with the paths of its files as they are seen from there."""
        moved = move_paths(self.content, self.case.parent, folder, self.registry.names("simulator"))
        dump_case(moved, folder / CASE)

    def draft(self, roles: GivenRoles, factors: Mapping[str, float], model: str = "", *, keep: bool = False) -> Draft:
        """Return a first case of the recording after writing it, as `lostmotion init` does; a present one may be kept.

        The stretch stays, and so do the values and priors of a model that stays.
        """
        from lostmotion.preparation.beginning import write_first_case

        before, path = {} if self.is_robot else self.content, self.folder.find(self.recording)
        with TemporaryDirectory() as spare:
            made = write_first_case(path, Path(spare) / CASE, roles, self.registry, model, factors)
            content = parse_case(Path(spare) / CASE)
        if not (keep and before):
            content["recordings"][0]["file"] = Path(os.path.relpath(path, self.place)).as_posix()
            self.save(keep_entries(before, content))
        return made

    def redraft(self, model: str) -> None:
        """Write the case anew with another model; columns, units and stretch stay, and so does what was supposed."""
        before = self.content
        if not before or self.is_robot:
            self.draft(GivenRoles(), {}, model)
            return
        roles, gains = read_roles(before)
        self.draft(roles, gains, model)
        content = self.content
        supposed = [says for says in before.get("guessed", ()) if not says.startswith(_MODEL_GUESSED)]
        if supposed := list(dict.fromkeys([*supposed, *content.get("guessed", ())])):
            self.save({"title": content.pop("title"), "guessed": supposed, **content})

    def add_recordings(self, names: Sequence[str]) -> None:
        """Write the case with further recordings that have the same columns, and with no other ones."""
        content = self.content
        first = content["recordings"][0]
        same = {key: value for key, value in first.items() if key not in STRETCH}
        files = [Path(os.path.relpath(self.folder.find(name), self.place)).as_posix() for name in names]
        content["recordings"] = [first, *({**same, "file": file} for file in files)]
        self.save(content)

    def list_further(self) -> list[str]:
        """Return the names of the recordings of the case after the first one."""
        entries = self.content.get("recordings", ())[1:]
        return [self.folder.name_of((self.place / entry["file"]).resolve()) for entry in entries]

    def draft_robot(self, model: str, torque: str) -> Sequence[str]:
        """Return what was found, after writing the case of a robot: the recording, and a model of the folder.

        The `torque` is that of the "motor" or of the "link". Raises `DataError` or `CaseError` as `lostmotion init`.
        """
        from lostmotion.robots.arm_first_case import RobotRoles, write_robot_case

        path, file = self.folder.find(self.recording), self.folder.find(model)
        folder_for(self.place)
        kind = "urdf" if file.suffix.lower() == ".urdf" else "mujoco"
        with TemporaryDirectory(dir=self.place) as spare:
            draft = write_robot_case(path, Path(spare) / CASE, kind, file, RobotRoles(torque=torque), self.registry)
            content = parse_case(Path(spare) / CASE)
            content = move_paths(content, Path(spare), self.place, self.registry.names("simulator"))
        self.save(content)
        return [*draft.found, *draft.notes]

    def tell(self) -> None:
        """Tell the page that the case has changed."""
        if self.changed is not None:
            self.changed()


def read_roles(content: Mapping[str, Any]) -> tuple[GivenRoles, dict[str, float]]:
    """Return the roles of the columns in a case, and the factors on them, as options of `lostmotion init`."""
    first = content["recordings"][0]
    time = first.get("time")
    named = time["column"] if isinstance(time, Mapping) else time
    drives, response = first.get("inputs", []), first["sensors"][0]
    channels = [*drives[:1], response]
    units = {one["column"]: one["unit"] for one in channels}
    gains = {one["column"]: float(one["factor"]) for one in channels if "factor" in one}
    drive = drives[0]["column"] if drives else "none"
    return GivenRoles(named, first.get("rate"), drive, response["column"], units), gains


def keep_entries(before: Mapping[str, Any], after: dict[str, Any]) -> dict[str, Any]:
    """Return a new case with the stretch, and the values and priors, of the case before it."""
    if not before:
        return after
    for key in STRETCH:
        if key in before["recordings"][0]:
            after["recordings"][0][key] = before["recordings"][0][key]
    same = {key: value for key, value in after["recordings"][0].items() if key not in STRETCH}
    after["recordings"] += [{**same, "file": entry["file"]} for entry in before["recordings"][1:]]
    old, new = before["model"], after["model"]
    if old.get("name") == new.get("name") and old.get("equations") == new.get("equations"):
        after["model"] = dict(old)
    return after
