"""Differences between the recorded excitation and the one that acts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, DriveTerm, Input, Param, TermPrior, Values
from lostmotion.quantities import FORCE, NUMBER, TIME
from lostmotion_plugins.laws import describe_wave
from lostmotion_plugins.terms.changing import RATIO

SHARE = Param("share", "share of the amplitude of the drive", NUMBER)


@dataclass(frozen=True)
class ExcitationHarmonic(DriveTerm):
    """A harmonic of the drive that was not recorded.

    Cosine and sine are shares of the amplitude of the recorded drive.
    """

    at: str = "drive"
    name: ClassVar[str] = "excitation_harmonic"
    physics: ClassVar[str] = (
        "The drive has a component of {ratio} times its frequency that was not recorded: {cosine} of its amplitude as a"
        " cosine and {sine} as a sine"
    )
    formula: ClassVar[str] = "u + amplitude * (cosine * cos(ratio omega t) + sine * sin(ratio omega t))"
    paper: ClassVar[str] = "Pintelon, Schoukens, System Identification: a Frequency Domain Approach (2012), section 3.2"
    params = (
        Param("cosine", "share of the drive as cos(ratio omega t)", NUMBER, null=0.0, prior=TermPrior(0.1)),
        Param("sine", "share of the drive as sin(ratio omega t)", NUMBER, null=0.0, prior=TermPrior(0.1)),
        replace(RATIO, prior=TermPrior(choices=(2.0, 3.0, 4.0, 5.0, 0.5, 1.5))),
    )
    needs = ("omega", "amplitude")

    @staticmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        omega = p[2] * p[3]
        angle = omega * t + 0.5 * math.pi * order
        harmonic = p[0] * np.cos(angle) + p[1] * np.sin(angle)
        return np.asarray(u(t, order) + p[4] * omega**order * harmonic)

    @staticmethod
    def derived(p: Values) -> Mapping[Param, float]:
        return describe_wave(SHARE, p[0], p[1])


@dataclass(frozen=True)
class ExcitationGain(DriveTerm):
    """A sensor of the drive with a wrong gain."""

    at: str = "drive"
    name: ClassVar[str] = "excitation_gain"
    physics: ClassVar[str] = "The drive that acts is larger than the recorded one by the fraction {error}"
    formula: ClassVar[str] = "(1 + error) * u"
    paper: ClassVar[str] = "Pintelon, Schoukens, System Identification: a Frequency Domain Approach (2012), section 1.6"
    params = (Param("error", "relative error of the gain", NUMBER, low=-0.9, null=0.0, prior=TermPrior(0.1)),)

    @staticmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        return np.asarray((1.0 + p[0]) * u(t, order))


@dataclass(frozen=True)
class ExcitationDelay(DriveTerm):
    """A drive that acts later than it was recorded, or earlier (negative) where its sensor is slow."""

    at: str = "drive"
    name: ClassVar[str] = "excitation_delay"
    physics: ClassVar[str] = "The drive acts {delay} after it was recorded"
    formula: ClassVar[str] = "u(t - delay)"
    paper: ClassVar[str] = "Ljung, System Identification: Theory for the User (1999), section 4.2"
    params = (Param("delay", "delay of the drive", TIME, null=0.0, prior=TermPrior(scan=(0.1, 6.0))),)
    equals = ("sensor_delay",)

    @staticmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        return u(t - p[0], order)


@dataclass(frozen=True)
class DriveSaturation(DriveTerm):
    """A drive that saturates: a share of what exceeds a limit is lost, all of it where the share is 1.

    The limit has the dimension of the input.
    """

    at: str = "drive"
    name: ClassVar[str] = "drive_saturation"
    physics: ClassVar[str] = "The drive saturates: of what exceeds {limit}, the share {share} is lost"
    formula: ClassVar[str] = "u - share * (u - clip(u, -limit, limit))"
    paper: ClassVar[str] = (
        "Tao, Kokotovic, Adaptive Control of Systems with Actuator Nonlinearities (1996), section 2.1"
    )
    params = (
        Param("share", "share of the excess that is lost", NUMBER, low=0.0, high=1.0, null=0.0),
        Param("limit", "largest drive", FORCE, low=0.0, scale="log", prior=TermPrior(0.7, scan=(0.03, 4.0))),
    )
    extends = ("excitation_gain",)

    @staticmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        demand = u(t, 0)
        if order == 0:
            return np.asarray(demand - p[0] * (demand - np.clip(demand, -p[1], p[1])))
        return np.asarray(u(t, order) * (1.0 - p[0] * (np.abs(demand) > p[1])))


@dataclass(frozen=True)
class DriveDeadZone(DriveTerm):
    """A drive with a dead zone: a share of the first part of the demand is lost, as in a valve with overlap.

    The width has the dimension of the input.
    """

    at: str = "drive"
    name: ClassVar[str] = "drive_dead_zone"
    physics: ClassVar[str] = "The drive has a dead zone: of the first {width} of it, the share {share} is lost"
    formula: ClassVar[str] = "u - share * clip(u, -width, width)"
    paper: ClassVar[str] = (
        "Tao, Kokotovic, Adaptive Control of Systems with Actuator Nonlinearities (1996), section 2.2"
    )
    params = (
        Param("share", "share of the drive in the zone that is lost", NUMBER, low=0.0, high=1.0, null=0.0),
        Param("width", "half width of the zone", FORCE, low=0.0, scale="log", prior=TermPrior(0.2, scan=(0.1, 10.0))),
    )
    extends = ("excitation_gain",)

    @staticmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        demand = u(t, 0)
        if order == 0:
            return np.asarray(demand - p[0] * np.clip(demand, -p[1], p[1]))
        return np.asarray(u(t, order) * (1.0 - p[0] * (np.abs(demand) < p[1])))
