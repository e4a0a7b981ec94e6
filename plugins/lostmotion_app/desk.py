"""What one page works on: a recording of the folder, and the case that is made of it."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from lostmotion.case import dump_case, load_case
from lostmotion.case.reading import parse_case
from lostmotion.errors import CaseError, LostMotionError
from lostmotion.recording.outline import GivenRoles
from lostmotion.registry import Registry
from lostmotion.settings import DEFAULT
from lostmotion.simulators import INVERSE
from lostmotion.storage import folder_for
from lostmotion_app.case_content import list_code, move_paths
from lostmotion_app.folder import WorkFolder, is_case
from lostmotion_app.used_parts import STRETCH, cut_entry, drop_stretch, part_entries

if TYPE_CHECKING:
    from lostmotion.notebook.case import Case
    from lostmotion.preparation.beginning import Draft
    from lostmotion.recording.spec import RecordingSpec
    from lostmotion.recording.table import Table

PARAMETERS = ("known", "estimate")
"""The keys of a model that say which parameters are known, and which are estimated."""
CASE, DIAGNOSIS = "case.toml", "diagnosis.json"
_MODEL_GUESSED = "the model is "
"""The beginning of what a first case says where no model was given."""
Changed = Callable[[], None]


@dataclass
class Desk:
    """A recording, or a case file of the user, by its name in the folder, and the place of what is made of it.

    `hold` is the share that is held out. `plugins` are files that the user named on the command line, and `agreed` the
    case files whose Python files may run. `confirmed` are recordings with what a first case supposed, and the user has
    confirmed.
    """

    folder: WorkFolder
    registry: Registry
    plugins: tuple[str, ...] = ()
    recording: str = ""
    hold: float = DEFAULT.heldout.share
    changed: Changed | None = None
    agreed: set[str] = field(default_factory=set)
    confirmed: set[tuple[str, str]] = field(default_factory=set)

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

    def read_specs(self, content: Mapping[str, Any]) -> tuple[RecordingSpec, ...]:
        """Return the recordings that a content of the case describes; raises `CaseError` for a content that is none."""
        with TemporaryDirectory() as spare:
            place = Path(spare).resolve()
            dump_case(move_paths(content, self.case.parent, place, self.registry.names("simulator")), place / CASE)
            return load_case(place / CASE).recordings

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
        dump_case(self._move_content(folder), folder / CASE)

    def has_changed(self, folder: Path) -> bool:
        """Return whether the case differs from its copy in another folder."""
        return parse_case(folder / CASE) != self._move_content(folder)

    def _move_content(self, folder: Path) -> dict[str, Any]:
        return move_paths(self.content, self.case.parent, folder, self.registry.names("simulator"))

    def draft(self, roles: GivenRoles, factors: Mapping[str, float], model: str = "", *, keep: bool = False) -> Draft:
        """Return a first case of the recording after writing it, as `lostmotion init` does; a present one may be kept.

        The stretch stays, and so do the values and priors of a model that stays. Raises `CaseError` or `DataError` as
        `lostmotion init`; the case is written where only the readings cannot be used, since a stretch of them may be.
        """
        from lostmotion.preparation.beginning import write_first_case

        before, path = {} if self.is_robot else self.content, self.folder.find(self.recording)
        with TemporaryDirectory() as spare:
            file = Path(spare) / CASE
            try:
                return write_first_case(path, file, roles, self.registry, model, factors)
            finally:
                if file.is_file() and not (keep and before):
                    content = self._find_file(parse_case(file))
                    drafted = self._draft_again(before) if before and (roles, factors) != read_roles(before) else {}
                    self.save(self._leave_confirmed(keep_entries(before, content, drafted)))

    def change(self, content: dict[str, Any]) -> None:
        """Write a changed content of the case; where its columns have changed, so do the priors that follow from them.

        Values and priors of the user stay. The model stays too, unless nobody has chosen it.
        """
        before = self.content
        self.confirm(content)
        if read_roles(content) != read_roles(before) and (made := self._draft_again(content)):
            content = keep_entries({**content, "model": before["model"]}, made, self._draft_again(before))
            content = self._leave_confirmed(content)
        self.save(content)

    def _draft_again(self, content: Mapping[str, Any]) -> dict[str, Any]:
        """Return the first case for the columns of a content, empty where there is none; nothing is written."""
        from lostmotion.preparation.beginning import write_first_case

        roles, factors = read_roles(content)
        with TemporaryDirectory() as spare:
            file = Path(spare) / CASE
            with suppress(LostMotionError):
                path, model = self.folder.find(self.recording), choose_model(content)
                write_first_case(path, file, roles, self.registry, model, factors)
            return self._find_file(parse_case(file)) if file.is_file() else {}

    def _find_file(self, content: dict[str, Any]) -> dict[str, Any]:
        """Return a first case with the path of its recording as it is seen from the place of the case."""
        file = Path(os.path.relpath(self.folder.find(self.recording), self.place)).as_posix()
        for entry in content["recordings"]:
            entry["file"] = file
        return content

    def confirm(self, content: Mapping[str, Any]) -> None:
        """Keep in mind which sentences on what is supposed a new content of the case no longer has."""
        before, after = ({(self.recording, says) for says in one.get("guessed", ())} for one in (self.content, content))
        self.confirmed = (self.confirmed | before) - after

    def _leave_confirmed(self, content: dict[str, Any]) -> dict[str, Any]:
        """Return a new case without the sentences that the user has confirmed."""
        kept = [says for says in content.pop("guessed", ()) if (self.recording, says) not in self.confirmed]
        return {**content, "guessed": kept} if kept else content

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
            self.save(self._leave_confirmed({**content, "guessed": supposed}))

    def add_recordings(self, names: Sequence[str]) -> None:
        """Write the case with further recordings that have the same columns, and with no other ones."""
        content = self.content
        own, _ = part_entries(content)
        files = [Path(os.path.relpath(self.folder.find(name), self.place)).as_posix() for name in names]
        content["recordings"] = [*own, *({**drop_stretch(own[0]), "file": file} for file in files)]
        self.save(content)

    def use_stretch(self, start: float | None, end: float | None, table: Table) -> None:
        """Write the case with one stretch of its first file (s; None: its end), which is cut where its time has gaps.

        `table` is that of the file. Nothing is written where the stretch is that of the case.
        """
        content = self.content
        own, others = part_entries(content)
        keys = {key: value for key, value in zip(STRETCH, (start, end), strict=True) if value is not None}
        whole = {**drop_stretch(own[0]), **keys}
        if self.is_robot:
            content["recordings"] = [whole, *others]
        else:
            spec = replace(self.read_specs(content)[0], t_start=start, t_end=end)
            content["recordings"] = [*cut_entry(whole, spec, table), *others]
        self.save(content)

    def list_further(self) -> list[str]:
        """Return the names of the recordings of the case after the first one."""
        content = self.content
        others = part_entries(content)[1] if content else []
        return [self.folder.name_of((self.place / entry["file"]).resolve()) for entry in others]

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


def choose_model(content: Mapping[str, Any]) -> str:
    """Return the name or the equations of the model of a case; empty where nobody has chosen it."""
    if any(says.startswith(_MODEL_GUESSED) for says in content.get("guessed", ())):
        return ""
    model = content.get("model", {})
    return str(model.get("name", "")) or ";".join(model.get("equations", ()))


def keep_entries(before: Mapping[str, Any], after: dict[str, Any], drafted: Mapping[str, Any]) -> dict[str, Any]:
    """Return a new case with the stretches, the further recordings, and the values and priors of the case before it.

    Entries that are those of the first case before, `drafted`, are not the user's: they become those of the new case.
    With another time the stretches between its gaps are those of the new case.
    """
    if not before:
        return after
    (own, others), same = part_entries(before), drop_stretch(after["recordings"][0])
    if all(own[0].get(key) == same.get(key) for key in ("time", "rate")) or len(after["recordings"]) == 1:
        after["recordings"] = [{**same, **{k: one[k] for k in STRETCH if k in one}} for one in own]
    after["recordings"] += [{**same, "file": entry["file"]} for entry in others]
    old, new, first = before["model"], after["model"], drafted.get("model", {})
    if all(old.get(key) == new.get(key) for key in ("name", "equations")):
        after["model"] = keep_parameters(old, new, first)
    return after


def keep_parameters(old: Mapping[str, Any], new: Mapping[str, Any], first: Mapping[str, Any]) -> dict[str, Any]:
    """Return a model with the parameters `new`, but for those of `old` that a user has changed since `first`."""
    made = {**new, **old, **{group: dict(new.get(group, {})) for group in PARAMETERS}}
    for group in PARAMETERS:
        for name, entry in old.get(group, {}).items():
            if first.get(group, {}).get(name) != entry:
                for other in PARAMETERS:
                    made[other].pop(name, None)
                made[group][name] = entry
    return {key: value for key, value in made.items() if value or key not in PARAMETERS}
