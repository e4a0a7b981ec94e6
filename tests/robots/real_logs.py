"""The cases of the gallery with logs of real robots: `LOGS` has a function for each.

It writes the log and the simulation into a folder and returns the text of the case; `data` is the folder of recordings.
"""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

PANDA_SECONDS = 10.0
"""So much of the log of the Panda is read."""
PARTS = ("hip", "thigh", "calf")
LEG = """<mujoco model="front left leg">
<compiler angle="radian"/>
<option timestep="0.002"/>
<worldbody>
<body name="hip">
<inertial pos="-0.0054 0.00194 -0.000105" quat="0.497014 0.499245 0.505462 0.498237" mass="0.678"
 diaginertia="0.000884 0.000596 0.00048"/>
<joint name="hip" axis="1 0 0" armature="0.01" damping="0.1"/>
<body name="thigh" pos="0 0.0955 0">
<inertial pos="-0.00374 -0.0223 -0.0327" quat="0.829533 0.0847635 -0.0200632 0.551623" mass="1.152"
 diaginertia="0.00595 0.00584 0.000879"/>
<joint name="thigh" axis="0 1 0" armature="0.01" damping="0.1"/>
<body name="calf" pos="0 0 -0.213">
<inertial pos="0.00566 -0.00057 -0.1469" quat="0.710672 0.00154099 -0.00450087 0.703508" mass="0.261"
 diaginertia="0.00158 0.00156 0.0000531"/>
<joint name="calf" axis="0 1 0" armature="0.03" damping="0.1"/>
</body></body></body>
</worldbody></mujoco>
"""
"""One leg of the Unitree Go2, its base fixed: lengths, masses and inertias of the maker's description."""
PENDULUM = '''"""Two links: angles from hanging, the second one relative to the first (design C.0, model 3.0)."""

import numpy as np

M1, M2, R1, R2, L1, I1, I2, G = 0.6417, 0.5639, 0.2, 0.3213, 0.2, 0.02671, 0.05388, 9.81
ROTOR = 6.0**2 * 9.937e-5


def inverse(q, v, a):
    c, s, bend = np.cos(q[:, 1]), np.sin(q[:, 1]), M2 * L1 * R2
    m11 = I1 + I2 + M2 * L1**2 + 2.0 * bend * c + ROTOR
    m12, m22 = I2 + bend * c, I2 + ROTOR
    tip = G * M2 * R2 * np.sin(q.sum(axis=1))
    root = G * (M1 * R1 + M2 * L1) * np.sin(q[:, 0]) + tip
    one = m11 * a[:, 0] + m12 * a[:, 1] - bend * s * (2.0 * v[:, 0] * v[:, 1] + v[:, 1] ** 2) + root
    two = m12 * a[:, 0] + m22 * a[:, 1] + bend * s * v[:, 0] ** 2 + tip
    return np.stack([one, two], axis=1)
'''


def write_panda(data: Path, folder: Path) -> str:
    """Return the case of a Franka Panda with torque sensors behind its gears."""
    logs = data / "panda_exciting"
    time = np.loadtxt(logs / "rbt_time.txt")
    both = [np.loadtxt(logs / f"rbt_{name}.txt").reshape(-1, 7) for name in ("positions", "torques")]
    names = [f"{word}{j}" for word in ("q", "tau") for j in range(1, 8)]
    _write_log(folder, ["t", *names], [time, *both])
    (folder / "panda.xml").write_text((logs / "panda.xml").read_text())
    joints = [f"joint{j}" for j in range(1, 8)]
    lists = format_lists(joints, [f"tau{j}" for j in range(1, 8)], [f"q{j}" for j in range(1, 8)])
    recording = f'[[recordings]]\nfile = "log.csv"\ntime = "t"\nt_end = {PANDA_SECONDS}\n{lists}'
    return f'title = "Franka Panda"\n{recording}\n[model]\nmujoco = "panda.xml"\ntorque = "link"\n'


def write_leg(data: Path, folder: Path) -> str:
    """Return the case of the front left leg of a Unitree Go2 that follows set points."""
    with zipfile.ZipFile(data / "go2_legs" / "go2_traj_0.pt") as archive:
        time, seen, wanted = (np.frombuffer(archive.read(f"traj_0/data/{k}"), "<f4").astype(float) for k in range(3))
    names = [f"{word}_{part}" for word in ("q", "set") for part in PARTS]
    _write_log(folder, ["t", *names], [time, *(x.reshape(-1, 12)[:, :3] for x in (seen, wanted))])
    (folder / "leg.xml").write_text(LEG)
    lists = format_lists(PARTS, [f"set_{p}" for p in PARTS], [f"q_{p}" for p in PARTS], ("setpoint", "rad"))
    gains = "\n".join(f"{part} = {{ kp = 20.0, kd = 1.5 }}" for part in PARTS)
    free = "\n".join(
        f'"{part}.{word}" = {{ low = {low}, high = {high}, scale = "log" }}'
        for part in PARTS
        for word, low, high in (("armature", 0.001, 0.1), ("damping", 0.01, 1.0))
    )
    return (
        f'title = "Unitree Go2, front left leg"\n[[recordings]]\nfile = "log.csv"\ntime = "t"\n{lists}\n[model]\n'
        f'mujoco = "leg.xml"\ntorque = "motor"\n[model.gains]\n{gains}\n[model.estimate]\n{free}\n'
    )


def write_pendulum(data: Path, folder: Path) -> str:
    """Return the case of a double pendulum with two motors; friction and damping are those that were published."""
    (folder / "pendulum.py").write_text(PENDULUM)
    joints, log = ("shoulder", "elbow"), (data / "dfki_double_pendulum" / "sys_id_C0.csv").resolve()
    lists = format_lists(joints, ("tau_meas1", "tau_meas2"), ("pos_meas1", "pos_meas2"))
    known = {
        "shoulder.frictionloss": 0.093,
        "elbow.frictionloss": 0.078,
        "shoulder.damping": 1e-3,
        "elbow.damping": 1e-3,
    }
    if not log.is_file():
        raise FileNotFoundError(2, "no recording", str(log))
    return (
        f'title = "Double pendulum"\n[[recordings]]\nfile = "{log}"\ntime = "time"\n{lists}\n[model]\n'
        'inverse = "pendulum.py:inverse"\njoints = ["shoulder", "elbow"]\ntorque = "motor"\n[model.known]\n'
        + "\n".join(f'"{key}" = {value}' for key, value in known.items())
        + "\n"
    )


def format_lists(
    joints: Sequence[str], driven: Sequence[str], seen: Sequence[str], drive: tuple[str, str] = ("torque", "N m")
) -> str:
    """Return the inputs and sensors of a case."""
    word, unit = drive
    inputs = [
        f'  {{ input = "{j}.{word}", column = "{c}", unit = "{unit}" }},' for j, c in zip(joints, driven, strict=True)
    ]
    sensors = [f'  {{ channel = "{j}", column = "{c}", unit = "rad" }},' for j, c in zip(joints, seen, strict=True)]
    return "\n".join(["inputs = [", *inputs, "]", "sensors = [", *sensors, "]"])


def _write_log(folder: Path, names: Sequence[str], columns: Iterable[np.ndarray]) -> None:
    np.savetxt(folder / "log.csv", np.column_stack(list(columns)), "%.9g", ",", header=",".join(names), comments="")


LOGS: Mapping[str, Callable[[Path, Path], str]] = {
    "panda": write_panda,
    "go2_leg": write_leg,
    "double_pendulum": write_pendulum,
}
