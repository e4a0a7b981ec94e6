"""The three cases of Table 1 with the forces that the text gives them, in SI units and in normalised form."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from lostmotion_trials.paper.lab import Lab, SampledFlow


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
        """omega_0 = sqrt(k0 / m) in rad/s: the unit of normalised time is 1/omega_0."""
        return math.sqrt(self.k0 / self.m)

    @property
    def damping(self) -> float:
        """2 zeta = c / sqrt(k0 m)."""
        return self.c / math.sqrt(self.k0 * self.m)

    @property
    def alpha(self) -> float:
        """Alpha = A / (k0 x0)."""
        return self.amplitude / (self.k0 * self.x0)

    @property
    def ratio(self) -> float:
        """Omega / omega_0."""
        return self.omega / self.natural

    @property
    def bit(self) -> float:
        """What turns an exponent in 1/s into bit per unit of normalised time."""
        return 1.0 / (self.natural * math.log(2.0))

    def at(self, *, alpha: float | None = None, damping: float | None = None) -> PaperCase:
        """Return the case with another alpha (by its force), another 2 zeta (by its damper), or both."""
        force = self.amplitude if alpha is None else alpha * self.k0 * self.x0
        c = self.c if damping is None else damping * math.sqrt(self.k0 * self.m)
        return replace(self, amplitude=force, c=c)

    def flow(self, lab: Lab) -> SampledFlow:
        """Return the flow of the case."""
        values = {"m": self.m, "c": self.c, "k1": self.k1, "k0": self.k0, "x0": self.x0}
        return lab.flow("lin_backlash", values, (self.amplitude, self.omega))


CASES = {
    1: PaperCase(1.0, 0.0, 40000.0, 8.0, 0.005, 100.0, 40.0),
    2: PaperCase(1.0, 1000.0, 31000.0, 8.0, 0.005, 240.0, 40.0),
    3: PaperCase(3.0, 0.0, 2250.0, 8.0, 0.02, 108.0, 0.3602 * math.sqrt(750.0)),
}
"""The frequency of Case 3 is 1.57 Hz to all digits that are given: omega/omega_0 is rounded, since the exponent changes
with the fifth digit there (`PRINTED` is 1.57 Hz exactly)."""
PRINTED = 2.0 * math.pi * 1.57
