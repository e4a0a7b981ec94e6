"""What lies between the motion and its recording."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from lostmotion.contracts import Array, Param, SensorTerm, Values
from lostmotion.quantities import LENGTH, NUMBER, TIME
from lostmotion_plugins.terms.changing import ParametricStiffness
from lostmotion_plugins.terms.drive import FAR
from lostmotion_plugins.terms.periodic import PITCHES, TYPICAL

_LEVELS = 30
"""At least so many differences of neighbouring values have to lie on the lattice."""
_WHOLE = 0.01
_AWAY = (-4.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 4.0)
"""Offsets beyond the reach of a score test that are tried: where there is a gap, a large one looks like a force."""


@dataclass(frozen=True)
class SensorGain(SensorTerm):
    """A sensor of the response that shows too little or too much."""

    at: str = "sensor"
    name: ClassVar[str] = "sensor_gain"
    physics: ClassVar[str] = "The sensor of the response shows too much by {error} of it"
    formula: ClassVar[str] = "(1 + error) * x"
    paper: ClassVar[str] = "Pintelon, Schoukens, System Identification: a Frequency Domain Approach (2012), section 1.6"
    params = (Param("error", "relative error of the gain", NUMBER, low=-0.9, null=0.0, typical=0.1),)
    resembles = ("excitation_gain",)

    @staticmethod
    def gain(p: Values) -> float:
        return 1.0 + p[0]


@dataclass(frozen=True)
class SensorOffset(SensorTerm):
    """A sensor whose zero lies elsewhere than that of the other sensors.

    Of a sensor alone it does what a constant force does, or nothing, so it is tried where there are several. The
    parameter is of the dimension of the channel.
    """

    at: str = "sensor"
    name: ClassVar[str] = "sensor_offset"
    physics: ClassVar[str] = "The sensor shows {offset} where the machine stands at zero"
    formula: ClassVar[str] = "x + offset"
    paper: ClassVar[str] = "Pintelon, Schoukens, System Identification: a Frequency Domain Approach (2012), section 1.6"
    params = (Param("offset", "what the sensor shows at zero", LENGTH, null=0.0, typical=0.3, far=_AWAY),)
    resembles = ("offset_force",)
    relative: ClassVar[bool] = True

    @staticmethod
    def offset(p: Values) -> float:
        return p[0]


@dataclass(frozen=True)
class SensorDelay(SensorTerm):
    """A sensor of the response that is late: what it shows was there `delay` ago."""

    at: str = "sensor"
    name: ClassVar[str] = "sensor_delay"
    unlikely: ClassVar[float] = 3.0
    physics: ClassVar[str] = "The sensor of the response is late by {delay}"
    formula: ClassVar[str] = "x(t - delay)"
    paper: ClassVar[str] = "Ljung, System Identification: Theory for the User (1999), section 4.2"
    params = (Param("delay", "delay of the sensor", TIME, low=0.0, null=0.0, far=FAR),)
    resembles = ("excitation_delay",)
    equals = ("excitation_delay",)

    @staticmethod
    def delay(p: Values) -> float:
        return p[0]


@dataclass(frozen=True)
class PositionRipple(SensorTerm):
    """A sensor with an error that repeats over what it shows: a disc off its middle, lines of an encoder, a bent screw.

    The parameters are of the dimension of the channel.
    """

    at: str = "sensor"
    name: ClassVar[str] = "position_ripple"
    physics: ClassVar[str] = (
        "The sensor has an error that repeats with every {pitch}: {cosine} as a cosine and {sine} as a sine"
    )
    formula: ClassVar[str] = "x + cosine * cos(2 pi x / pitch) + sine * sin(2 pi x / pitch)"
    paper: ClassVar[str] = "Heydemann, Applied Optics 20 (1981) 3382-3384: cyclic errors of encoders"
    params = (
        Param("cosine", "error as cos(2 pi x / pitch)", LENGTH, null=0.0, typical=0.02),
        Param("sine", "error as sin(2 pi x / pitch)", LENGTH, null=0.0, typical=0.02),
        Param("pitch", "way after which it repeats", LENGTH, low=0.0, scale="log", typical=TYPICAL, scan=PITCHES),
    )
    further = (Param("size", "amplitude of the error", LENGTH), Param("phase", "phase in rad", NUMBER))
    derived = staticmethod(ParametricStiffness.derived)
    resembles = ("cogging",)

    @staticmethod
    def bent(x: Array, p: Values) -> Array:
        angle = 2.0 * math.pi * x / p[2]
        return np.asarray(x + p[0] * np.cos(angle) + p[1] * np.sin(angle))


@dataclass(frozen=True)
class SensorQuantisation(SensorTerm):
    """A sensor that shows whole steps only; the stored values themselves tell."""

    at: str = "sensor"
    name: ClassVar[str] = "sensor_quantisation"
    physics: ClassVar[str] = "The sensor of the response shows whole steps of {step} only"
    formula: ClassVar[str] = "step * round(z / step)"
    paper: ClassVar[str] = "Widrow, Kollar, Quantization Noise (2008), section 4.1"
    params = (Param("step", "step of the sensor", LENGTH, low=0.0, null=0.0, typical=0.01),)

    @staticmethod
    def rounded(z: Array, p: Values) -> Array:
        return np.asarray(p[0] * np.round(z / p[0])) if p[0] > 0.0 else z

    @staticmethod
    def scatter(p: Values) -> float:
        return p[0] / math.sqrt(12.0)

    @staticmethod
    def quantisation(z: Array) -> tuple[Values, Values]:
        """Return the step of the lattice on which nearly all differences of the values lie, with its error."""
        seen = z[np.isfinite(z)]
        differences = np.abs(np.diff(seen))
        differences = differences[differences > 1e-9 * (float(np.ptp(seen)) or 1.0)]
        if len(differences) < _LEVELS:
            return (), ()
        step = float(np.min(differences))
        near = differences[differences < 50.5 * step]
        whole = np.round(near / step)
        step = float(np.sum(near * whole) / np.sum(whole * whole))
        off = np.abs(near / step - np.round(near / step))
        if len(near) < _LEVELS or float(np.quantile(off, 0.99)) > _WHOLE:
            return (), ()
        return (step,), (step * max(float(np.std(off)) / math.sqrt(float(np.sum(whole * whole))), 1e-9),)
