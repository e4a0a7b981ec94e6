"""Two recordings of real machines as a set of `benchmarks/judge.py`; what is missing is what others have published."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from judge_truth import Hiding, Truth, is_complete, save_truth

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "science"))

from machines import CARRIAGE, EMPS, EMPS_FILES, FRICTION, OFFSET, PUBLISHED  # noqa: E402 - they lie beside the tests
from rig_cases import PIECE, silverbox  # noqa: E402

DATA = ROOT.parent / "shared" / "data"
SPRING = Hiding("cubic_stiffness", "ground", {}, ("cubic_stiffness",))
CARRIAGE_FORCES = (
    Hiding("coulomb_friction", "ground", {"force": PUBLISHED[FRICTION][0]}, ("coulomb_friction",)),
    Hiding("offset_force", "ground", {"force": PUBLISHED[OFFSET][0]}, ("offset_force",)),
)


def make_emps(data: Path, _: Path) -> str:
    """Return the case of the EMPS carriage, with six seconds of the recording without pulses."""
    return EMPS.format(file=(data / "emps" / f"{EMPS_FILES[0]}.mat").resolve()) + PIECE + CARRIAGE


SET = {
    "emps": (make_emps, CARRIAGE_FORCES, "trajectory", "dry friction and offset, by the authors of the recording"),
    "silverbox": (silverbox, (SPRING,), "multisine", "a cubic spring, by the authors of the recording"),
}


def make_real(out: Path, limit: int = 0, fresh: int = 0) -> Sequence[Path]:
    """Return the folders of the recordings; `fresh` changes nothing."""
    folders = [out / key for key in list(SET)[: limit or None]]
    for folder in folders:
        if not is_complete(folder):
            make, missing, drive, says = SET[folder.name]
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "case.toml").write_text(make(DATA, folder))
            save_truth(folder, Truth(folder.name, missing, {}, drive, says))
    return folders
