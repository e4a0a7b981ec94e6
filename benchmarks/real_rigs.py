"""Real machines beside what others have published: `python benchmarks/real_rigs.py --out OUT [NAME ...]`.

Diagnoses the recordings of the gallery and writes one line for each into OUT/rigs.jsonl: what is named, the intervals
beside the published values, held-out errors, processor time. `validation.py store OUT --name rigs` stores them for
`docs/validation.md`. A recording that this version has diagnosed already is left out, so a run can be resumed.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.registry import default
from lostmotion.results.diagnosis import Diagnosis

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "science"))

from machines import FRICTION, OFFSET, PUBLISHED  # noqa: E402 - these lie beside the tests
from rig_cases import CASES  # noqa: E402

RUBS = (
    "coulomb_friction",
    "stribeck_friction",
    "directional_friction",
    "dahl_friction",
    "lugre_friction",
    "bouc_wen_hysteresis",
    "position_dependent_friction",
    "load_dependent_friction",
    "friction_drift",
    "friction_drift_travel",
)
"""Laws of dry friction and hysteresis: each stands for friction that is published without a law."""
SENSED = "sensor_quantisation"
"""What a recording itself shows; it is not physics of the machine."""


@dataclass(frozen=True)
class Rig:
    """A real machine: the name of its page, what others have published, and the laws that stand for each effect.

    `values` are the published values of parameters by key, in the units of the case.
    """

    page: str
    published: str
    effects: Sequence[Sequence[str]]
    values: Mapping[str, float] = field(default_factory=dict)


EMPS = {key: PUBLISHED[key][0] for key in ("m", "c", FRICTION, OFFSET)}
RIGS = {
    "emps": Rig("emps", "dry friction and a constant force", (RUBS, ("offset_force",)), EMPS),
    "silverbox": Rig("silverbox", "a cubic spring", (("cubic_stiffness",),)),
    "damper": Rig("friction_device", "friction of the band, different in the two directions", (RUBS,)),
    "damper_36lb": Rig("friction_device", "friction of the band, different in the two directions", (RUBS,)),
    "motor_run": Rig("motor_drive", "nothing; least squares gives dry friction", (RUBS,)),
    "motor_drive": Rig(
        "motor_drive", "nothing; least squares gives dry friction and a constant torque", (RUBS, ("offset_force",))
    ),
    "reuss_beam": Rig("brake_reuss_beam", "friction in the joint", (RUBS,)),
    "bistable_beam": Rig(
        "bistable_beam",
        "unequal wells, and the circuit of the piezo",
        (("quadratic_stiffness", "offset_force", "bilinear_stiffness"), ()),
    ),
    "gear_wheel": Rig("gear_pair", "nothing; the deceleration shows dry friction", (RUBS,)),
}
"""The effects of the piezo circuit have no law in the library: it is never found."""


def describe_diagnosis(name: str, found: Diagnosis, seconds: float, code: str) -> dict:
    """Return the row of a rig."""
    rig, after = RIGS[name], found.parameters.after
    names = [[e.mechanism, round(e.probability, 3), e.state] for e in found.found]
    sure = {e.mechanism for e in found.found if e.state == "named" and e.probability > 0.95}
    meant = {law for laws in rig.effects for law in laws}
    said = {key: after[key] for key in rig.values if key in after and math.isfinite(after[key].low)}
    compared = [
        [key, rig.values[key], *(float(f"{x:.5g}") for x in (i.median, i.low, i.high)), i.unit]
        for key, i in said.items()
    ]
    errors = [found.fit.before.nrmse, found.fit.after.nrmse]
    return {
        "key": name,
        "page": rig.page,
        "published": rig.published,
        "found": [bool(sure & set(laws)) for laws in rig.effects],
        "further": sorted(sure - meant - {SENSED}),
        "names": names,
        "compared": compared,
        "errors": [round(error, 5) if math.isfinite(error) else None for error in errors],
        "cpu": round(seconds, 1),
        "code": code,
    }


def read_code() -> str:
    """Return the commit of this checkout, with a plus sign if files were changed."""
    git = ["git", "-C", str(ROOT)]
    code = subprocess.run([*git, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=True).stdout
    changed = subprocess.run(
        [*git, "status", "--porcelain", "framework", "plugins"], capture_output=True, text=True, check=True
    )
    return code.strip() + ("+" if changed.stdout.strip() else "")


def main() -> None:
    """Diagnose each rig that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="*", choices=[*RIGS, []], help="names; all without any")
    parser.add_argument("--out", type=Path, required=True, help="folder of the rows and of the reports")
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="where the recordings lie")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    path, code = args.out / "rigs.jsonl", read_code()
    lines = path.read_text().splitlines() if path.exists() else []
    done = {row["key"] for row in map(json.loads, lines) if row["code"] == code}
    for name in [one for one in args.which or RIGS if one not in done]:
        folder = args.out / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "case.toml").write_text(CASES[name](args.shared / "data", folder))
        begin = time.process_time()
        found = run_diagnosis(folder / "case.toml", folder / "result", default(), jobs=1, propose=False)
        row = describe_diagnosis(name, found, time.process_time() - begin, code)
        with path.open("a") as stream:
            print(json.dumps(row), file=stream, flush=True)
        print(name, row["names"], row["errors"], row["cpu"], flush=True)


if __name__ == "__main__":
    main()
