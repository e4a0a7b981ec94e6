"""What one page works on: a recording of the folder, and the case that is made of it."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from lostmotion.case import dump_case
from lostmotion.case.reading import parse_case
from lostmotion.recording.outline import GivenRoles
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT
from lostmotion.storage import folder_for
from lostmotion_app.folder import WorkFolder

if TYPE_CHECKING:
    from lostmotion.notebook.case import Case
    from lostmotion.preparation.beginning import Draft

CASE, DIAGNOSIS = "case.toml", "diagnosis.json"
_MODEL_GUESSED = "the model is "
"""The beginning of what a first case says where no model was given."""
Changed = Callable[[], None]


@dataclass
class Desk:
    """A recording by its name in the folder, and the place of its case; `hold` is the share that is held out.

    `plugins` are files that the user named on the command line.
    """

    folder: WorkFolder
    registry: Registry
    plugins: tuple[str, ...] = ()
    recording: str = ""
    hold: float = DEFAULT.heldout.share
    changed: Changed | None = None

    @property
    def place(self) -> Path:
        """The folder of the case of this recording."""
        return self.folder.work / (re.sub(r"[^\w.-]+", "_", self.recording).strip("._") or "recording")

    @property
    def case(self) -> Path:
        """The path of the case of this recording, whether it exists or not."""
        return self.place / CASE

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
        content = self.content
        for entry in content["recordings"]:
            entry["file"] = Path(os.path.relpath(self.place / entry["file"], folder)).as_posix()
        if plugins := content.get("plugins"):
            content["plugins"] = [Path(os.path.relpath(self.place / one, folder)).as_posix() for one in plugins]
        dump_case(content, folder / CASE)

    def draft(self, roles: GivenRoles, factors: Mapping[str, float], model: str = "", *, keep: bool = False) -> Draft:
        """Return a first case of the recording after writing it, as `lostmotion init` does; a present one may be kept.

        The stretch stays, and so do the values and priors of a model that stays.
        """
        from lostmotion.preparation.beginning import write_first_case

        before, path = self.content, self.folder.find(self.recording)
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
        roles, gains = read_roles(before)
        self.draft(roles, gains, model)
        content = self.content
        supposed = [says for says in before.get("guessed", ()) if not says.startswith(_MODEL_GUESSED)]
        if supposed := list(dict.fromkeys([*supposed, *content.get("guessed", ())])):
            self.save({"title": content.pop("title"), "guessed": supposed, **content})

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
    for key in ("t_start", "t_end"):
        if key in before["recordings"][0]:
            after["recordings"][0][key] = before["recordings"][0][key]
    old, new = before["model"], after["model"]
    if old.get("name") == new.get("name") and old.get("equations") == new.get("equations"):
        after["model"] = dict(old)
    return after
