"""What a blind trial may hide in a machine, how large it has to be to show, and how it goes into the integrator.

Sizes come from a rough formula: the force that a mechanism would have along the motion without it, less what damping
and gap could explain of it, over the noise that sensors leave on forces, frequency by frequency.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lostmotion.contracts import Array
from lostmotion.workflow.zoo import GAPPED, USUAL, Rig

LARGEST = 0.3
"""A hidden force has at the most this share of the inertial force, rms."""
GAIN = (5.0, 1000.0)


@dataclass(frozen=True)
class Effect:
    """One hidden mechanism: its name in a diagnosis, place ("" where any will do) and parameters in SI units.

    `what` tells mechanisms apart that no library has, and which a diagnosis should call "unknown".
    """

    mechanism: str
    at: str
    parameters: Mapping[str, float]
    what: str = ""


@dataclass(frozen=True)
class Pilot:
    """The motion of a machine with nothing hidden: position `q` (samples,) in m or rad, before the noise."""

    rig: Rig
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

    def gain(self, felt: Array, *, shown: bool = False) -> float:
        """Return the gain in log-likelihood to expect of a force (samples,) in N, or with `shown` of an error in m."""
        x, v = self.motion(self.own)
        if shown:
            felt = np.fft.irfft(np.fft.rfft(felt) * self._stiff, len(felt))
        explained = np.stack([v, self.touching, x * np.abs(self.touching)], axis=1)
        rest = felt - explained @ np.linalg.lstsq(explained, felt, rcond=None)[0]
        noise = (self.noise * self._stiff) ** 2 + self.usual**2
        return float(np.sum(np.abs(np.fft.rfft(rest)) ** 2 / noise) / len(felt))


@dataclass(frozen=True)
class Draft:
    """A mechanism of unit size: its force `felt` (samples,), or error if `shown`, and its parameters at a size."""

    felt: Array
    parameters: Callable[[float], dict[str, float]]
    shown: bool = False


Plan = Callable[[Pilot, str, np.random.Generator], Draft]


def _one(name: str, force: Callable[[Array, Array], Array]) -> Plan:
    """Return the plan of a mechanism of one parameter, a force of position and velocity relative to its place."""
    return lambda pilot, at, _rng: Draft(force(*pilot.motion(at)), lambda size: {name: size})


def _stribeck(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    v = pilot.motion(at)[1]
    share, velocity = rng.uniform(0.3, 1.0), float(np.std(v)) * math.exp(rng.uniform(-3.0, -1.0))
    felt = np.sign(v) * (1.0 + share * np.exp(-((v / velocity) ** 2)))
    return Draft(felt, lambda size: {"force": size, "excess": float(share * size), "velocity": velocity})


def _bristle(*, excess: bool = False, name: str = "deflection", low: float = 0.01, high: float = 0.1) -> Plan:
    def plan(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
        x, v = pilot.motion(at)
        travel = float(np.std(x)) * math.exp(rng.uniform(math.log(low), math.log(high)))
        more = _stribeck(pilot, at, rng).parameters(1.0) if excess else {}
        return Draft(np.sign(v), lambda size: {"force": size, **_grown(more, size), name: travel})

    return plan


def _grown(more: Mapping[str, float], size: float) -> dict[str, float]:
    return {key: value * size if key == "excess" else value for key, value in more.items() if key != "force"}


def _parametric(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    ratio, phase, body = float(rng.integers(1, 3)), float(rng.uniform(0.0, 2.0 * math.pi)), pilot.rig.body
    x = pilot.motion(pilot.own)[0]
    spring = body.k0 * (x - body.x0 * pilot.touching) * np.abs(pilot.touching) if body.k0 else body.k * x
    wave = np.cos(ratio * pilot.rig.signal.omega * pilot.rig.time + phase)
    return Draft(spring * wave, lambda size: {"depth": size, "phase": phase, "ratio": ratio})


def _harmonic(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    ratio, phase = float(rng.integers(2, 4)), float(rng.uniform(0.0, 2.0 * math.pi))
    pace = ratio * pilot.rig.signal.omega
    angle = pace * pilot.rig.time + phase
    felt = _driven(pilot, np.cos(angle), -pace * np.sin(angle))
    return Draft(felt, lambda size: {"amplitude": size, "phase": phase, "ratio": ratio})


def _driven(pilot: Pilot, value: Array, slope: Array) -> Array:
    """Return the force (samples,) of a change of the drive."""
    body = pilot.rig.body
    return body.c * slope + body.k0 * np.abs(pilot.touching) * value if pilot.rig.based else value


def _late_drive(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    bend = np.gradient(pilot.du, 1.0 / pilot.rig.rate)
    return Draft(_driven(pilot, pilot.du, bend), lambda size: {"delay": size})


def _more_drive(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    return Draft(_driven(pilot, pilot.u, pilot.du), lambda size: {"error": size})


def _late_sensor(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    if not pilot.rig.based:
        return _late_drive(pilot, at, rng)
    return Draft(pilot.v, lambda size: {"delay": size}, shown=True)


def _more_sensor(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    return Draft(pilot.q, lambda size: {"error": size}, shown=True)


def _drift(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    return Draft(pilot.rig.body.k0 * pilot.touching * pilot.rig.time, lambda size: {"rate": size})


def _asymmetric(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    return Draft(pilot.rig.body.k0 * np.abs(pilot.touching), lambda size: {"shift": size})


def _contact_drag(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    slide = pilot.motion(pilot.own)[1]
    return Draft(slide * np.abs(pilot.touching), lambda size: {"coefficient": size})


def _ripple(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    length = float(np.ptp(pilot.q)) / float(rng.uniform(3.0, 8.0))
    return Draft(np.sin(2.0 * math.pi * pilot.q / length), lambda size: {"force": size, "length": length})


def _rough(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    length = float(np.std(pilot.q))
    return Draft(np.sign(pilot.v) * (pilot.q / length) ** 2, lambda size: {"force": size, "length": length})


def _bump(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    low, high = np.quantile(pilot.q, [0.2, 0.8])
    middle, width = float(rng.uniform(low, high)), float(0.08 * np.ptp(pilot.q))
    felt = np.exp(-(((pilot.q - middle) / width) ** 2))
    return Draft(felt, lambda size: {"force": size, "middle": middle, "width": width})


def _mixed(pilot: Pilot, at: str, rng: np.random.Generator) -> Draft:
    return Draft(pilot.q**2 * pilot.v, lambda size: {"coefficient": size})


@dataclass(frozen=True)
class Mechanism:
    """How a mechanism is planned; where it can act ("own": where the gap is; "": any); which machines it fits.

    `kin` are those of which one machine has one at the most; `tone`: it needs a drive whose frequency stays.
    """

    plan: Plan
    kin: str
    at: tuple[str, ...] = ("",)
    models: tuple[str, ...] = (*GAPPED, "linear_oscillator", "rigid_drive")
    tone: bool = False
    signed: bool = False

    def fits(self, rig: Rig) -> bool:
        """Return whether the mechanism is something else there than what is estimated anyway."""
        return rig.model in self.models and bool(self.spots(rig)) and not (self.tone and rig.signal.sweep)

    def spots(self, rig: Rig) -> tuple[str, ...]:
        """Return the places where it can act."""
        own = {"own": "base" if rig.based else "ground"}
        return tuple(p for p in (own.get(a, a) for a in self.at) if not p or p in rig.places)


ANYWHERE = ("ground", "base")
SPRUNG = (*GAPPED, "linear_oscillator")
TABLE: Mapping[str, Mechanism] = {
    "coulomb_friction": Mechanism(_one("force", lambda _, v: np.sign(v)), "rub", ANYWHERE),
    "stribeck_friction": Mechanism(_stribeck, "rub", ANYWHERE),
    "dahl_friction": Mechanism(_bristle(low=0.05, high=0.5), "rub", ANYWHERE),
    "lugre_friction": Mechanism(_bristle(excess=True), "rub", ANYWHERE),
    "bouc_wen_hysteresis": Mechanism(_bristle(name="travel", low=0.1, high=1.0), "rub", ANYWHERE),
    "viscous_damping": Mechanism(_one("coefficient", lambda _, v: v), "drag", ("ground",), ("robot_joint",)),
    "quadratic_damping": Mechanism(_one("coefficient", lambda _, v: v * np.abs(v)), "drag", ANYWHERE),
    "contact_damping": Mechanism(_contact_drag, "contact", ("own",), GAPPED),
    "linear_stiffness": Mechanism(_one("coefficient", lambda x, _: x), "spring", ANYWHERE, (*GAPPED, "rigid_drive")),
    "cubic_stiffness": Mechanism(_one("coefficient", lambda x, _: x**3), "spring", ANYWHERE, SPRUNG, signed=True),
    "asymmetric_gap": Mechanism(_asymmetric, "gap", ("own",), GAPPED, signed=True),
    "gap_drift": Mechanism(_drift, "gap", ("",), GAPPED),
    "offset_force": Mechanism(_one("force", lambda x, _: np.ones_like(x)), "push", ("",), SPRUNG, signed=True),
    "parametric_stiffness": Mechanism(_parametric, "wave", ("",), SPRUNG, tone=True),
    "excitation_harmonic": Mechanism(_harmonic, "wave", ("",), tone=True),
    "excitation_delay": Mechanism(_late_drive, "late"),
    "excitation_gain": Mechanism(_more_drive, "more", ("",), SPRUNG, signed=True),
    "sensor_delay": Mechanism(_late_sensor, "late"),
    "sensor_gain": Mechanism(_more_sensor, "more", ("",), SPRUNG, signed=True),
    "sensor_quantisation": Mechanism(lambda p, _a, _r: Draft(p.q, lambda s: {"step": s}), "round"),
    "random_force": Mechanism(lambda p, _a, _r: Draft(p.q, lambda s: {"rms": s}), "chance"),
}
UNKNOWN: Mapping[str, Mechanism] = {
    "ripple over position": Mechanism(_ripple, "unknown"),
    "friction that depends on position": Mechanism(_rough, "unknown"),
    "bump at one position": Mechanism(_bump, "unknown"),
    "drag that grows with position": Mechanism(_mixed, "unknown", models=SPRUNG),
}
"""What no library has."""
NAMES = (*TABLE, "unknown")
NOISY: Mapping[str, Callable[[Pilot, float], float]] = {
    "sensor_quantisation": lambda pilot, share: pilot.noise * 10.0 ** (1.2 * share),
    "random_force": lambda pilot, share: pilot.usual * 3.2 * 10.0 ** (0.7 * share),
}
"""Sizes of what has no force that could be foretold, from a share between 0 and 1."""


def drawn(name: str, pilot: Pilot, rng: np.random.Generator) -> Effect:
    """Return a mechanism of a size at which it should show in `pilot` as well as a random gain in log-likelihood."""
    what = str(rng.choice(list(UNKNOWN))) if name == "unknown" else ""
    mechanism = UNKNOWN[what] if what else TABLE[name]
    at = str(rng.choice(mechanism.spots(pilot.rig)))
    draft = mechanism.plan(pilot, at, rng)
    wanted = math.exp(rng.uniform(math.log(GAIN[0]), math.log(GAIN[1])))
    if name in NOISY:
        return Effect(name, at, draft.parameters(NOISY[name](pilot, float(rng.random()))))
    size = math.sqrt(wanted / max(pilot.gain(draft.felt, shown=draft.shown), 1e-300))
    loud = size * float(np.std(draft.felt)) / (float(np.std(pilot.q)) if draft.shown else pilot.inertial)
    size *= min(1.0, LARGEST / max(loud, 1e-300)) * (rng.choice([-1.0, 1.0]) if mechanism.signed else 1.0)
    return Effect(name, at, draft.parameters(float(size)), what)
