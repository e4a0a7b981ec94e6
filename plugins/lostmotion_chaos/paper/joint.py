"""Eight simulated recordings that replace the experiment of section 6, whose recordings were never published."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion_chaos.paper.chain import embed_recording
from lostmotion_chaos.paper.lab import FollowedMotions, Lab, SampledFlow

FREQUENCY = 1.54
"""Frequency of the input in Hz."""
LEVELS = (1.34, 2.07, 2.68, 3.41, 3.65, 3.78, 4.87, 5.73)
"""Amplitudes of the input in degrees."""
PAPER = (math.nan, math.nan, 1.423, 1.322, 1.533, 1.802, math.nan, math.nan)
"""Exponents of Table 2 in bit/s; NaN where the paper calls the motion periodic."""
SUSPECT = (2.68, 3.41, 3.65, 3.78)
"""Levels (degrees) at which the paper finds chaos."""
RATIO, DAMPING, HALF = 0.2615, 0.1116, 0.7589
"""omega/omega_0, 2 zeta = c / sqrt(k0 m) and half of the backlash (degrees) of the joint.

Found with `python benchmarks/search_joint.py`. It computes 3840 joints on a grid of ratio and damping, with the exact
flow from several starts at all eight levels, and keeps those that are chaotic at the four middle levels only, with an
amplitude that an encoder can measure. This joint is one of the nearest to Table 2 among these and joints close to them
(its exponents differ by 0.31 bit/s, rms). The nearest of all (0.252, 0.1212, 0.7436: 0.14 bit/s) is not used, since it
is also chaotic at 5.73 degrees when its last digit changes. The link has no weight, and viscous damping only.
"""
NOISE, STEP = 0.03, 360.0 / 65536.0
"""Standard deviation of the noise of the encoder, and its step (degrees)."""


@dataclass(frozen=True, eq=False)
class JointRecording:
    """The readings of both encoders at one level and the motion without noise, in degrees; the series is embedded."""

    level: float
    time: Array
    base: Array
    link: Array
    true: Array
    series: Series
    period: float


def make_joint_flow(lab: Lab, level: float) -> SampledFlow:
    """Return the flow of the joint (angles in rad) at an input amplitude of `level` degrees."""
    omega = 2.0 * math.pi * FREQUENCY
    natural = omega / RATIO
    values = {"m": 1.0, "c": DAMPING * natural, "k0": natural**2, "x0": math.radians(HALF), "mgl": 0.0}
    return lab.make_flow("robot_joint", values, (math.radians(level), omega))


def follow_joint(lab: Lab, level: float) -> FollowedMotions:
    """Return the motions of the joint at a level (degrees) from several starts; computed once for all figures."""

    def make() -> FollowedMotions:
        flow = make_joint_flow(lab, level)
        starts = lab.draw_starts(flow, lab.pick(24, 6))
        return lab.follow(flow, starts, periods=lab.pick(3000, 600), transient=300)

    return lab.compute_once(f"joint {level}", make)


def make_recording(lab: Lab, level: float) -> JointRecording:
    """Return the recording at a level (degrees): both angles with encoder noise, rounded to encoder steps."""
    return lab.compute_once(f"recording {level}", lambda: _simulate_recording(lab, level))


def _simulate_recording(lab: Lab, level: float) -> JointRecording:
    flow, rng = make_joint_flow(lab, level), lab.make_rng(f"encoder {level}")
    looks, periods = lab.pick((80, 400), (60, 160))
    true = np.degrees(flow.sample(follow_joint(lab, level).states[0, -1], periods=periods, looks=looks)[:-1, 0])
    time = np.arange(len(true)) * flow.period / looks
    base = level * np.cos(2.0 * math.pi * FREQUENCY * time)
    link, read = (STEP * np.round((x + NOISE * rng.standard_normal(len(x))) / STEP) for x in (true, base))
    series = embed_recording(lab, link, float(time[1]), flow.period)
    return JointRecording(level, time, read, link, true, series, flow.period)
