"""Errors of the sensor of the response: gain, offset, delay, periodic error and quantisation."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Param, SensorTerm, TermPrior, Values
from lostmotion.quantities import LENGTH, NUMBER, TIME
from lostmotion_plugins.laws import describe_wave
from lostmotion_plugins.terms.periodic import PITCH_PRIOR

_LEAST_DIFFERENCES = 30
"""At least so many differences of successive samples must be small multiples of the step. Chosen by experience; no
measurement recorded."""
_LATTICE_TOLERANCE = 0.01
"""So far 99 % of these differences may lie from a whole multiple of the step, as a share of the step. Chosen by
experience; no measurement recorded."""
SIZE = Param("size", "amplitude of the error", LENGTH)


@dataclass(frozen=True)
class SensorGain(SensorTerm):
    """A sensor of the response with a wrong gain."""

    at: str = "sensor"
    name: ClassVar[str] = "sensor_gain"
    physics: ClassVar[str] = "The sensor of the response reads too high by the fraction {error}"
    formula: ClassVar[str] = "(1 + error) * x"
    paper: ClassVar[str] = "Pintelon, Schoukens, System Identification: a Frequency Domain Approach (2012), section 1.6"
    params = (Param("error", "relative error of the gain", NUMBER, low=-0.9, null=0.0, prior=TermPrior(0.1)),)

    @staticmethod
    def gain(p: Values) -> float:
        return 1.0 + p[0]


@dataclass(frozen=True)
class SensorOffset(SensorTerm):
    """A sensor whose zero differs from that of the other sensors.

    With one sensor only, an offset has the effect of a constant force, or none. So the term is tried where there are
    several sensors. The parameter has the dimension of the channel.
    """

    at: str = "sensor"
    name: ClassVar[str] = "sensor_offset"
    physics: ClassVar[str] = "The sensor reads {offset} where the machine is at zero"
    formula: ClassVar[str] = "x + offset"
    paper: ClassVar[str] = "Pintelon, Schoukens, System Identification: a Frequency Domain Approach (2012), section 1.6"
    params = (Param("offset", "reading of the sensor at zero", LENGTH, null=0.0, prior=TermPrior(0.3)),)
    relative: ClassVar[bool] = True

    @staticmethod
    def offset(p: Values) -> float:
        return p[0]


@dataclass(frozen=True)
class SensorDelay(SensorTerm):
    """A sensor of the response with a pure delay."""

    at: str = "sensor"
    name: ClassVar[str] = "sensor_delay"
    physics: ClassVar[str] = "The sensor of the response is delayed by {delay}"
    formula: ClassVar[str] = "x(t - delay)"
    paper: ClassVar[str] = "Ljung, System Identification: Theory for the User (1999), section 4.2"
    params = (Param("delay", "delay of the sensor", TIME, low=0.0, null=0.0),)
    equals = ("excitation_delay",)

    @staticmethod
    def delay(p: Values) -> float:
        return p[0]


@dataclass(frozen=True)
class PositionRipple(SensorTerm):
    """A sensor with an error that is periodic in its reading: an eccentric disc, the lines of an encoder, a bent screw.

    The parameters have the dimension of the channel.
    """

    at: str = "sensor"
    name: ClassVar[str] = "position_ripple"
    physics: ClassVar[str] = (
        "The sensor has an error that repeats with every {pitch}: {cosine} as a cosine and {sine} as a sine"
    )
    formula: ClassVar[str] = "x + cosine * cos(2 pi x / pitch) + sine * sin(2 pi x / pitch)"
    paper: ClassVar[str] = "Heydemann, Applied Optics 20 (1981) 3382-3384: cyclic errors of encoders"
    params = (
        Param("cosine", "error as cos(2 pi x / pitch)", LENGTH, null=0.0, prior=TermPrior(0.02)),
        Param("sine", "error as sin(2 pi x / pitch)", LENGTH, null=0.0, prior=TermPrior(0.02)),
        Param("pitch", "travel after which it repeats", LENGTH, low=0.0, scale="log", prior=PITCH_PRIOR),
    )

    @staticmethod
    def derived(p: Values) -> Mapping[Param, float]:
        return describe_wave(SIZE, p[0], p[1])

    @staticmethod
    def bent(x: Array, p: Values) -> Array:
        angle = 2.0 * math.pi * x / p[2]
        return np.asarray(x + p[0] * np.cos(angle) + p[1] * np.sin(angle))


@dataclass(frozen=True)
class SensorQuantisation(SensorTerm):
    """A sensor with a finite step; the step is read from the stored values."""

    at: str = "sensor"
    name: ClassVar[str] = "sensor_quantisation"
    physics: ClassVar[str] = "The sensor of the response shows whole steps of {step} only"
    formula: ClassVar[str] = "step * round(z / step)"
    paper: ClassVar[str] = "Widrow, Kollar, Quantization Noise (2008), section 4.1"
    params = (Param("step", "step of the sensor", LENGTH, low=0.0, null=0.0, prior=TermPrior(0.01)),)

    @staticmethod
    def rounded(z: Array, p: Values) -> Array:
        return np.asarray(p[0] * np.round(z / p[0])) if p[0] > 0.0 else z

    @staticmethod
    def scatter(p: Values) -> float:
        return p[0] / math.sqrt(12.0)

    @staticmethod
    def quantisation(z: Array) -> tuple[Values, Values]:
        """Return the step whose multiples nearly all differences of successive values are, with its standard error."""
        seen = z[np.isfinite(z)]
        differences = np.abs(np.diff(seen))
        differences = differences[differences > 1e-9 * (float(np.ptp(seen)) or 1.0)]
        if len(differences) < _LEAST_DIFFERENCES:
            return (), ()
        step = float(np.min(differences))
        near = differences[differences < 50.5 * step]
        whole = np.round(near / step)
        step = float(np.sum(near * whole) / np.sum(whole * whole))
        off = np.abs(near / step - np.round(near / step))
        if len(near) < _LEAST_DIFFERENCES or float(np.quantile(off, 0.99)) > _LATTICE_TOLERANCE:
            return (), ()
        return (step,), (step * max(float(np.std(off)) / math.sqrt(float(np.sum(whole * whole))), 1e-9),)
