"""What may be hidden in a machine, and the motion of the machine without it, from which its size follows.

Sizes come from a rough formula: the force that a mechanism would have along the motion without it, less what damping
and gap could explain of it, over the noise that sensors leave on forces, frequency by frequency.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lostmotion.codec import described
from lostmotion.contracts import Array
from lostmotion_trials.blind.simulator import USUAL, BlindMachine


@dataclass(frozen=True)
class Effect:
    """One hidden mechanism; `what` tells those apart that no library has, and which a diagnosis should call unknown."""

    mechanism: str = described("its name in a diagnosis")
    at: str = described("the place at which it acts; empty where any will do")
    parameters: Mapping[str, float] = described("its parameters, in SI units")
    what: str = described("what it is, where no library has it", default="")


@dataclass(frozen=True)
class Pilot:
    """The motion of a machine with nothing hidden: position `q` (samples,) in m or rad, before the noise."""

    rig: BlindMachine
    q: Array

    @cached_property
    def v(self) -> Array:
        """The velocity."""
        return np.gradient(self.q, 1.0 / self.rig.rate)

    @cached_property
    def u(self) -> Array:
        """The drive."""
        return self.rig.signal.value(self.rig.time)

    @cached_property
    def du(self) -> Array:
        """The slope of the drive."""
        return self.rig.signal.slope(self.rig.time)

    def motion(self, at: str) -> tuple[Array, Array]:
        """Return position and velocity relative to a place."""
        return (self.q - self.u, self.v - self.du) if at == "base" else (self.q, self.v)

    @property
    def own(self) -> str:
        """The place of the gap."""
        return "base" if self.rig.based else "ground"

    @cached_property
    def touching(self) -> Array:
        """1 or -1 in contact, 0 in the gap."""
        gap = self.motion(self.own)[0]
        return np.where(np.abs(gap) > self.rig.body.x0, np.sign(gap), 0.0)

    @cached_property
    def noise(self) -> float:
        """The deviation of the measurement noise, in m or rad."""
        return self.rig.noise * float(np.std(self.motion(self.own)[0]))

    @cached_property
    def inertial(self) -> float:
        """The rms of the inertial force, in N."""
        return self.rig.body.m * float(np.std(np.gradient(self.v, 1.0 / self.rig.rate)))

    @cached_property
    def usual(self) -> float:
        """The force (N) from sample to sample that the usual noise of the excitation makes, rms."""
        return USUAL * self.rig.signal.amplitude * (self.rig.body.k0 if self.rig.based else 1.0)

    @cached_property
    def _stiff(self) -> Array:
        """The force per displacement (N/m) at each frequency."""
        body, rate = self.rig.body, self.rig.rate
        omega = 2.0 * math.pi * np.fft.rfftfreq(len(self.q), 1.0 / rate)
        still = body.k + body.k0 * float(np.mean(np.abs(self.touching)))
        return np.asarray(np.hypot(still - body.m * omega**2, body.c * omega) + 0.1 * (still + body.m * omega**2))

    def gain(self, draft: EffectDraft) -> float:
        """Return the gain in log-likelihood to expect of a mechanism of unit size, beyond what is simpler."""
        felt = draft.felt
        x, v = self.motion(self.own)
        if draft.shown:
            felt = np.fft.irfft(np.fft.rfft(felt) * self._stiff, len(felt))
        moved = [v, self.touching, x * np.abs(self.touching)] if self.rig.body.k0 else [v, x]
        explained = np.stack([*moved, *draft.beside], axis=1)
        rest = felt - explained @ np.linalg.lstsq(explained, felt, rcond=None)[0]
        noise = (self.noise * self._stiff) ** 2 + self.usual**2
        return float(np.sum(np.abs(np.fft.rfft(rest)) ** 2 / noise) / len(felt))


@dataclass(frozen=True)
class EffectDraft:
    """A mechanism of unit size: its force `felt` (samples,), or error if `shown`, and its parameters at a size.

    `beside` are forces of what is simpler and would be named in its place.
    """

    felt: Array
    parameters: Callable[[float], dict[str, float]]
    shown: bool = False
    beside: tuple[Array, ...] = ()
