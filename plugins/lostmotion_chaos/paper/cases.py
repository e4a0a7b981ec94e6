"""The three cases of Table 1 with the force amplitudes given in the text, in SI units and in normalised form."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from lostmotion_chaos.paper.lab import Lab, SampledFlow


@dataclass(frozen=True)
class PaperCase:
    """An oscillator m x'' + c x' + k1 x + F(x) = A cos(omega t) in SI units."""

    m: float
    k1: float
    k0: float
    c: float
    x0: float
    amplitude: float
    omega: float

    @property
    def natural(self) -> float:
        """Return omega_0 = sqrt(k0 / m) in rad/s; the unit of normalised time is 1/omega_0."""
        return math.sqrt(self.k0 / self.m)

    @property
    def damping(self) -> float:
        """Return 2 zeta = c / sqrt(k0 m)."""
        return self.c / math.sqrt(self.k0 * self.m)

    @property
    def alpha(self) -> float:
        """Return alpha = A / (k0 x0)."""
        return self.amplitude / (self.k0 * self.x0)

    @property
    def ratio(self) -> float:
        """Return omega / omega_0."""
        return self.omega / self.natural

    @property
    def bit(self) -> float:
        """Return the factor that converts an exponent in 1/s to bit per unit of normalised time."""
        return 1.0 / (self.natural * math.log(2.0))

    def vary(self, *, alpha: float | None = None, damping: float | None = None) -> PaperCase:
        """Return the case with another alpha (the force changes), another 2 zeta (the damper changes), or both."""
        force = self.amplitude if alpha is None else alpha * self.k0 * self.x0
        c = self.c if damping is None else damping * math.sqrt(self.k0 * self.m)
        return replace(self, amplitude=force, c=c)

    def make_flow(self, lab: Lab) -> SampledFlow:
        """Return the flow of the case."""
        values = {"m": self.m, "c": self.c, "k1": self.k1, "k0": self.k0, "x0": self.x0}
        return lab.make_flow("lin_backlash", values, (self.amplitude, self.omega))


CASES = {
    1: PaperCase(1.0, 0.0, 40000.0, 8.0, 0.005, 100.0, 40.0),
    2: PaperCase(1.0, 1000.0, 31000.0, 8.0, 0.005, 240.0, 40.0),
    3: PaperCase(3.0, 0.0, 2250.0, 8.0, 0.02, 108.0, 0.3602 * math.sqrt(750.0)),
}
"""The frequency of Case 3 follows from the rounded omega/omega_0 = 0.3602. It agrees with 1.57 Hz to all printed
digits, but the exponent changes with the fifth digit; `PRINTED` is 1.57 Hz exactly."""
PRINTED = 2.0 * math.pi * 1.57
"""The printed frequency of Case 3 (1.57 Hz exactly), in rad/s."""
