"""A recording of an arm with two joints that is not made with a step of ours: Lagrange's equations by DOP853.

The template's class is written in closed form with RK4; here the mass matrix is solved, and steps adapt themselves.
"""

import numpy as np
from scipy.integrate import solve_ivp

from lostmotion.recording import Recording

GRAVITY, LENGTH, DT = 9.81, 0.4, 0.01
TRUE = {"fore_inertia": 0.0722, "shoulder_damping": 0.8, "elbow_damping": 0.3}
NOISE = 2e-4
UNITS = {"shoulder": "rad", "elbow": "rad", "shoulder_force": "N m", "elbow_force": "N m"}


def rates(_, y, torque, friction):
    """Return the derivatives of angles and speeds under held torques; `friction` (N m) is dry, in the elbow."""
    far, fore_mass = TRUE["fore_inertia"], TRUE["fore_inertia"] / 0.19**2
    first, second, v = y[0], y[1], y[2:]
    near, lever = 0.05 + 3.0 * 0.2**2 + fore_mass * LENGTH**2, fore_mass * LENGTH * 0.15
    mass = np.array([[near + far + 2.0 * lever * np.cos(second), far + lever * np.cos(second)], [0.0, far]])
    mass[1, 0] = mass[0, 1]
    turning = lever * np.sin(second) * np.array([-(2.0 * v[0] + v[1]) * v[1], v[0] ** 2])
    tip = fore_mass * 0.15 * GRAVITY * np.cos(first + second)
    weight = np.array([(3.0 * 0.2 + fore_mass * LENGTH) * GRAVITY * np.cos(first) + tip, tip])
    lost = np.array([TRUE["shoulder_damping"] * v[0], TRUE["elbow_damping"] * v[1]])
    lost[1] += friction * np.tanh(v[1] / 0.005)
    return [*v, *np.linalg.solve(mass, torque - lost - turning - weight)]


def swing(samples, *, seed=0, friction=0.0):
    """Return the recording of an arm under a held torque, with readings of both angles, and the true states."""
    rng, y = np.random.default_rng(seed), np.array([-1.2, 0.3, 0.0, 0.0])
    phase, states, torques = rng.uniform(0.0, 6.0, 4), [], []
    for k in range(samples):
        t = k * DT
        wish = np.array([-1.2 + 0.5 * np.sin(2.0 * t + phase[0]) + 0.2 * np.sin(5.1 * t + phase[1]),
                         0.3 + 0.8 * np.sin(3.1 * t + phase[2]) + 0.2 * np.sin(7.0 * t + phase[3])])  # fmt: skip
        held = np.array([14.0 * np.cos(y[0]), 2.9 * np.cos(y[0] + y[1])])
        torque = held + np.array([60.0, 25.0]) * (wish - y[:2]) - np.array([6.0, 2.0]) * y[2:]
        states.append(y)
        torques.append(torque)
        y = solve_ivp(rates, (0.0, DT), y, args=(torque, friction), method="DOP853", rtol=1e-8, atol=1e-10).y[:, -1]
    states, torques = np.array(states), np.array(torques)
    seen = states[:, :2] + NOISE * rng.standard_normal((samples, 2))
    recording = Recording.from_arrays(
        sensors={"shoulder": seen[:, 0], "elbow": seen[:, 1]},
        inputs={"shoulder_force": torques[:, 0], "elbow_force": torques[:, 1]},
        units=UNITS, rate=1.0 / DT, hold="step", name="arm",
    )  # fmt: skip
    return recording, states
