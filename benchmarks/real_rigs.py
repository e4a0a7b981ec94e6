"""Real machines beside what others have published: `python benchmarks/real_rigs.py --out OUT [NAME ...]`.

Diagnoses the recordings of the gallery and writes one line for each into OUT/rigs.jsonl: what is named, the intervals
beside the published values, held-out errors, processor time. `validation.py store OUT --name rigs` stores them for
`docs/validation.md`. A recording that this version has diagnosed already is left out, so a run can be resumed.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from judge import describe_code
from judge_rows import SURE
from lostmotion.diagnosis.diagnosis_run import run_diagnosis
from lostmotion.registry import default
from lostmotion.results.diagnosis import Diagnosis
from lostmotion_trials.blind.judging import FRICTION_TERMS

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "science"))

from machines import FRICTION, OFFSET, PUBLISHED  # noqa: E402 - these lie beside the tests
from rig_cases import CASES  # noqa: E402

SENSED = "sensor_quantisation"
"""What a recording itself shows; it is not physics of the machine."""


@dataclass(frozen=True)
class Rig:
    """A real machine: the name of its page, what others have published, and the laws that stand for each effect.

    Each law of dry friction or hysteresis stands for friction that is published without a law. `values` are the
    published values of parameters by key, in the units of the case.
    """

    page: str
    published: str
    effects: Sequence[Sequence[str]]
    values: Mapping[str, float] = field(default_factory=dict)


EMPS = {key: PUBLISHED[key][0] for key in ("m", "c", FRICTION, OFFSET)}
RIGS = {
    "emps": Rig("emps", "dry friction and a constant force", (FRICTION_TERMS, ("offset_force",)), EMPS),
    "silverbox": Rig("silverbox", "a cubic spring", (("cubic_stiffness",),)),
    "damper": Rig("friction_device", "friction of the band, different in the two directions", (FRICTION_TERMS,)),
    "damper_36lb": Rig("friction_device", "friction of the band, different in the two directions", (FRICTION_TERMS,)),
    "motor_run": Rig("motor_drive", "nothing; least squares gives dry friction", (FRICTION_TERMS,)),
    "motor_drive": Rig(
        "motor_drive",
        "nothing; least squares gives dry friction and a constant torque",
        (FRICTION_TERMS, ("offset_force",)),
    ),
    "reuss_beam": Rig("brake_reuss_beam", "friction in the joint", (FRICTION_TERMS,)),
    "bistable_beam": Rig(
        "bistable_beam",
        "unequal wells, and the circuit of the piezo",
        (("quadratic_stiffness", "offset_force", "bilinear_stiffness"), ()),
    ),
    "gear_wheel": Rig("gear_pair", "nothing; the deceleration shows dry friction", (FRICTION_TERMS,)),
}
"""The effects of the piezo circuit have no law in the library: it is never found."""


def describe_diagnosis(name: str, found: Diagnosis, seconds: float, code: str) -> dict:
    """Return the row of a rig."""
    rig, after = RIGS[name], found.parameters.after
    names = [[e.mechanism, round(e.probability, 3), e.state] for e in found.found]
    sure = {e.mechanism for e in found.found if e.state == "named" and e.probability > SURE}
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


def main() -> None:
    """Diagnose each rig that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "which", nargs="*", choices=[*RIGS, []], metavar="NAME", help=f"{', '.join(RIGS)}; all without any"
    )
    parser.add_argument("--out", type=Path, required=True, help="folder of the rows and of the reports")
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="where the recordings lie")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    path, code = args.out / "rigs.jsonl", describe_code(ROOT)
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
