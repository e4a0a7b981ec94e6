"""Hidden mechanisms, and the motion of a machine without them, from which their size is chosen.

The expected gain in log-likelihood comes from a rough formula: the force that a mechanism would have along the motion
without it, minus the part that damping and gap can explain, over the force noise due to the sensors, at each frequency.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lostmotion.codec import described
from lostmotion.contracts import Array
from lostmotion_trials.blind.simulator import EXCITATION_NOISE, BlindMachine


@dataclass(frozen=True)
class Effect:
    """One hidden mechanism; `what` names a mechanism outside the library, which a diagnosis should call unknown."""

    mechanism: str = described("its name in a diagnosis")
    at: str = described("the place at which it acts; empty if it has no place")
    parameters: Mapping[str, float] = described("its parameters, in SI units")
    what: str = described("what it is, if the library does not contain it", default="")


@dataclass(frozen=True)
class Pilot:
    """The motion of a machine without a hidden mechanism: position `q` (samples,) in m or rad, without noise."""

    rig: BlindMachine
    q: Array

    @cached_property
    def v(self) -> Array:
        """Return the velocity (samples,)."""
        return np.gradient(self.q, 1.0 / self.rig.rate)

    @cached_property
    def u(self) -> Array:
        """Return the drive (samples,)."""
        return self.rig.signal.value(self.rig.time)

    @cached_property
    def du(self) -> Array:
        """Return the time derivative of the drive (samples,)."""
        return self.rig.signal.slope(self.rig.time)

    def compute_motion(self, at: str) -> tuple[Array, Array]:
        """Return position and velocity (samples,) relative to a place: the base, or else the ground."""
        return (self.q - self.u, self.v - self.du) if at == "base" else (self.q, self.v)

    @property
    def gap_place(self) -> str:
        """Return the place of the gap."""
        return "base" if self.rig.based else "ground"

    @cached_property
    def contact_sign(self) -> Array:
        """Return 1 or -1 in contact and 0 in the gap (samples,)."""
        gap = self.compute_motion(self.gap_place)[0]
        return np.where(np.abs(gap) > self.rig.body.x0, np.sign(gap), 0.0)

    @cached_property
    def noise(self) -> float:
        """Return the standard deviation of the measurement noise in m or rad."""
        return self.rig.noise * float(np.std(self.compute_motion(self.gap_place)[0]))

    @cached_property
    def inertial_force(self) -> float:
        """Return the rms of the force of inertia in N."""
        return self.rig.body.m * float(np.std(np.gradient(self.v, 1.0 / self.rig.rate)))

    @cached_property
    def usual_force(self) -> float:
        """Return the rms force (N), independent from sample to sample, of the usual noise of the excitation."""
        return EXCITATION_NOISE * self.rig.signal.amplitude * (self.rig.body.k0 if self.rig.based else 1.0)

    @cached_property
    def _stiff(self) -> Array:
        """Return the force per displacement (N/m) at each frequency."""
        body, rate = self.rig.body, self.rig.rate
        omega = 2.0 * math.pi * np.fft.rfftfreq(len(self.q), 1.0 / rate)
        still = body.k + body.k0 * float(np.mean(np.abs(self.contact_sign)))
        return np.asarray(np.hypot(still - body.m * omega**2, body.c * omega) + 0.1 * (still + body.m * omega**2))

    def expect_gain(self, draft: EffectDraft) -> float:
        """Return the expected gain in log-likelihood of a mechanism of unit size over simpler forces."""
        force = draft.force
        x, v = self.compute_motion(self.gap_place)
        if draft.on_sensor:
            force = np.fft.irfft(np.fft.rfft(force) * self._stiff, len(force))
        linear = [v, self.contact_sign, x * np.abs(self.contact_sign)] if self.rig.body.k0 else [v, x]
        explained = np.stack([*linear, *draft.simpler], axis=1)
        rest = force - explained @ np.linalg.lstsq(explained, force, rcond=None)[0]
        noise = (self.noise * self._stiff) ** 2 + self.usual_force**2
        return float(np.sum(np.abs(np.fft.rfft(rest)) ** 2 / noise) / len(force))


@dataclass(frozen=True)
class EffectDraft:
    """A mechanism of unit size: its force (samples,), or error if `on_sensor`, and its parameters at a size.

    `simpler` are simpler forces (samples,) that a diagnosis could name instead.
    """

    force: Array
    parameters: Callable[[float], dict[str, float]]
    on_sensor: bool = False
    simpler: tuple[Array, ...] = ()
