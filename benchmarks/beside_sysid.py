"""lostmotion beside `mujoco.sysid` on the same recordings: what each says, and the errors on held-out data.

    python benchmarks/beside_sysid.py --out FOLDER --write

Each arm of the trial (`lostmotion_trials.arms`) has the inertias of its model and one hidden effect. `mujoco.sysid`
(`pip install "mujoco[sysid]"`) has damping, dry friction and armature of each joint free, and mass and centre of each
body, in three settings: all with pieces of 0.5 s, all with pieces of 1 s, joints only. The setting with the lowest
*held-out* error counts, which is in its favour. Free runs of 0.2 s under the recorded torques, over the last 3 of 10 s,
begin at filtered states; the fitted model is stepped every 0.5 ms. One line of JSON for each arm goes to a file in
FOLDER as it is done; `--write` puts the table into docs/gallery/beside_sysid.md.
"""

from __future__ import annotations

import argparse
import json
import logging
import time
from pathlib import Path

import mujoco
import numpy as np
from mujoco import sysid

from gallery import write_into_pages
from lostmotion.registry import Registry
from lostmotion.robots.arm_case import load_robot_case
from lostmotion.robots.arm_hypothesis import ArmHypothesis
from lostmotion.robots.arm_run import diagnose_robot
from lostmotion.robots.free_runs import HORIZON
from lostmotion_plugins.simulators.mujoco import FoundSimulator
from lostmotion_trials.arms.draw import JOINTS, draw_arm, write_case

MARK = "figures of benchmarks/beside_sysid.py"
LACKED = ("backlash", "cogging", "excitation_delay", "stribeck_friction")
"""Effects that are no parameter of `mujoco.sysid`."""
OWNED = ("coulomb_friction", "viscous_damping", "payload")
SETTINGS = {"all free": (0.5, True), "all free, pieces of 1 s": (1.0, True), "joints only": (0.5, False)}
STEP, TRIES = 5e-4, 15
"""The step (s) of the fitted model on held-out data; the most iterations of a fit, which ends earlier as a rule."""


def fit_sysid(folder: Path, nominal: ArmHypothesis, piece: float, bodies: bool) -> tuple[object, dict[str, float]]:
    """Return the model that `mujoco.sysid` fits to the first part of a log, and its parameters."""
    text = (folder / "arm.xml").read_text()
    ends = "".join(f'<motor name="m_{j}" joint="{j}"/>' for j in JOINTS)
    seen = "".join(f'<jointpos name="q_{j}" joint="{j}"/>' for j in JOINTS)
    text = text.replace("</mujoco>", f"<actuator>{ends}</actuator><sensor>{seen}</sensor></mujoco>")
    spec = mujoco.MjSpec.from_string(text)
    spec.option.timestep = 1e-3
    model, free = spec.compile(), list_parameters(text, bodies)
    log, first = nominal.frame.arm.log, 50
    length = round(piece / log.dt)
    starts, controls, readings = [], [], []
    for k in range(first, nominal.frame.last - length, length):
        clock = log.dt * np.arange(length)
        state = nominal.kept.states[k]
        starts.append(sysid.create_initial_state(model, state[:2], state[2:4]))
        controls.append(sysid.TimeSeries.from_control_names(clock, log.torque[k : k + length], model))
        readings.append(sysid.TimeSeries.from_names(clock, log.readings[k : k + length], model))
    names = [f"piece{k}" for k in range(len(starts))]
    data = sysid.ModelSequences("arm", spec, names, starts, controls, readings)
    residual = sysid.build_residual_fn(models_sequences=[data], n_threads=1)
    found, _ = sysid.optimize(free, residual, optimizer="mujoco", verbose=False, max_iters=TRIES)
    fitted = sysid.apply_param_modifiers(found, mujoco.MjSpec.from_string((folder / "arm.xml").read_text()))
    return fitted, {name: float(found[name].value[0]) for name in found.keys()}  # noqa: SIM118 - its own mapping


def list_parameters(text: str, bodies: bool) -> sysid.ParameterDict:
    """Return the free parameters, from their nominal values; friction begins inside its bounds."""
    model, free = mujoco.MjModel.from_xml_string(text), sysid.ParameterDict()

    def set_damping(spec, x, joint):
        spec.joint(joint).damping = np.array([x.value[0], 0, 0]) if np.ndim(spec.joint(joint).damping) else x.value[0]

    def set_plain(spec, x, joint, kind):
        setattr(spec.joint(joint), kind, x.value[0])

    def set_mass(spec, x, body):
        spec.body(body).mass = x.value[0]

    def set_centre(spec, x, body):
        spec.body(body).ipos = np.array([x.value[0], 0.0, 0.0])

    def add(name, middle, low, high, change, **where):
        free.add(sysid.Parameter(name, middle, low, high, modifier=lambda spec, x: change(spec, x, **where)))

    for j in JOINTS:
        dof = int(model.joint(j).dofadr[0])
        damping, armature = float(np.ravel(model.dof_damping[dof])[0]), float(model.dof_armature[dof])
        add(f"{j}.damping", damping, 0.0, 5.0, set_damping, joint=j)
        add(f"{j}.frictionloss", 0.1, 0.0, 5.0, set_plain, joint=j, kind="frictionloss")
        add(f"{j}.armature", armature, 0.01, 1.0, set_plain, joint=j, kind="armature")
    for body in ("upper", "fore") if bodies else ():
        mass, centre = float(model.body(body).mass[0]), float(model.body(body).ipos[0])
        add(f"{body}.mass", mass, 0.5 * mass, 2.0 * mass, set_mass, body=body)
        add(f"{body}.centre", centre, 0.5 * centre, 2.0 * centre, set_centre, body=body)
    return free


def measure_error(model: object, nominal: ArmHypothesis) -> float:
    """Return the error of free runs of a model over held-out data, as a share of the motion, mean of both joints."""
    frame, log = nominal.frame, nominal.frame.arm.log
    length = round(HORIZON / log.dt)
    begins = np.arange(frame.last, log.samples - length, length)
    states = frame.run(nominal.at, last=log.samples, keep=True).states[begins]
    torque = log.torque[np.add.outer(begins, np.arange(length))]
    stepped = FoundSimulator("", JOINTS, model=model)
    rolled, _ = stepped.roll(states[:, :2], states[:, 2:4], torque, log.dt, step=STEP)
    seen = log.readings[np.add.outer(begins, np.arange(1, length + 1))]
    error = np.sqrt(np.mean((rolled - seen) ** 2, axis=(0, 1)))
    return float(np.mean(error / np.std(log.readings[frame.last :], axis=0)))


def compare(number: int, effect: str, options: argparse.Namespace, registry: Registry) -> dict[str, object]:
    """Return what both say about an arm."""
    folder = options.out / f"arm{number:03d}"
    model, truth, log = draw_arm(number, options.seed, effect)
    case = load_robot_case(write_case(folder, number, model, log), registry)
    begun = time.process_time()
    output = diagnose_robot(case, registry)
    ours, nominal = time.process_time() - begun, output.search.found[frozenset()]
    tried = []
    for name, (piece, bodies) in SETTINGS.items():
        begun = time.process_time()
        fitted, values = fit_sysid(folder, nominal, piece, bodies)
        tried.append((measure_error(fitted, nominal), name, values, time.process_time() - begun))
    error, setting, values, seconds = min(tried)
    start = {name: x.value[0] for name, x in list_parameters((folder / "arm.xml").read_text(), True).items()}
    moved = sorted(values, key=lambda k: -abs(np.log(max(values[k], 1e-3) / max(start[k], 1e-3))))[:3]
    result = output.result
    return {
        "number": number,
        "truth": f"{truth.mechanism} at {truth.at}",
        "named": [f"{m.mechanism} at {m.at} ({m.probability:.2f})" for m in result.found],
        "nominal": result.fit.before.nrmse,
        "ours": result.fit.after.nrmse,
        "seconds": ours,
        "sysid": error,
        "sysid_seconds": seconds,
        "setting": setting,
        "moved": {k: (start[k], values[k]) for k in moved},
    }


def format_rows(rows: list[dict]) -> str:
    """Return the table of the page."""
    lines = [
        "| hidden | lostmotion names | largest changes of `mujoco.sysid` (from, to) | error nominal | `mujoco.sysid` |"
        " lostmotion |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        moved = ", ".join(f"`{k}` {a:.3g} to {b:.3g}" for k, (a, b) in row["moved"].items())
        named = ", ".join(row["named"]) or "nothing"
        errors = " | ".join(f"{100 * row[k]:.2g} %" for k in ("nominal", "sysid", "ours"))
        lines.append(f"| {row['truth']} | {named} | {moved} | {errors} |")
    return "\n".join(lines)


def format_shares(rows: list[dict]) -> str:
    """Return in how many arms lostmotion has the smaller error, and in how many one that is larger by 10 %."""
    lines = ["| hidden | arms | lower error of lostmotion | larger by more than 10 % |", "|---|---|---|---|"]
    for effects in (LACKED, OWNED):
        own = [row for row in rows if row["truth"].partition(" ")[0] in effects]
        lower, worse = sum(r["ours"] < r["sysid"] for r in own), sum(r["ours"] > 1.1 * r["sysid"] for r in own)
        lines.append(f"| {', '.join(effects)} | {len(own)} | {lower} | {worse} |")
    return "\n".join(lines)


def main() -> None:
    """Compare on the arms that are not done yet, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--effects", default=",".join((*LACKED, *OWNED) * 3))
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--write", action="store_true", help="put the table into the page of the gallery")
    options = parser.parse_args()
    logging.disable(logging.CRITICAL)
    options.out.mkdir(parents=True, exist_ok=True)
    registry, file = Registry.discover(), options.out / "rows.jsonl"
    done = {json.loads(line)["number"] for line in file.read_text().splitlines()} if file.exists() else set()
    for number, effect in enumerate(options.effects.split(",")):
        if number not in done:
            row = compare(number, effect, options, registry)
            with file.open("a") as stream:
                stream.write(json.dumps(row) + "\n")
            print(json.dumps(row), flush=True)
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    tables = {MARK: format_rows(rows), f"{MARK} shares": format_shares(rows)}
    print("\n\n".join(tables.values()))
    if options.write:
        write_into_pages(tables)


if __name__ == "__main__":
    main()
