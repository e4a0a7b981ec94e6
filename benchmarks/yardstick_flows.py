"""Model flows: the exact oscillator with backlash, the general kernel, SciPy and (where installed) heyoka in one run.

`python benchmarks/yardstick_flows.py` prints seconds for 10,000 drive periods of Case 1 (SciPy and heyoka follow fewer
and are scaled; they carry no tangent), and the error of position after 8 periods in half gaps, against 40 digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from lostmotion.likelihood.system import System
from lostmotion_chaos.flows.flow import flow_of, make_stepped_flow
from lostmotion_chaos.quantifiers.flows import LyapunovMax
from lostmotion_plugins.models.lin import LinBacklash
from yardstick import Case, clocked

CASE_1 = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005}
DRIVE = (100.0, 40.0)
START = np.array([0.001, 0.1])
AFTER_8 = 0.0093999563898351222999
"""Position after 8 periods, in 40-digit arithmetic (see tests/chaos/test_exact.py)."""
WHOLE = 10_000
EXACT = flow_of(LinBacklash(), CASE_1, drive=DRIVE, start=START)
GENERAL = make_stepped_flow(System.of(LinBacklash()), CASE_1, drive=DRIVE, start=START)

Followed = Callable[[int], NDArray[np.float64]]


def by_scipy(periods: int) -> NDArray[np.float64]:
    """Return states (periods + 1, 2) by DOP853 at rtol 1e-9, atol 1e-12."""

    def rates(t: float, y: NDArray[np.float64]) -> tuple[float, float]:
        x = y[0]
        contact = 4e4 * (x - 0.005) if x > 0.005 else (4e4 * (x + 0.005) if x < -0.005 else 0.0)
        return y[1], 100.0 * math.cos(40.0 * t) - 8.0 * y[1] - contact

    looks = np.arange(periods + 1) * EXACT.period
    return solve_ivp(rates, (0.0, looks[-1]), START, "DOP853", t_eval=looks, rtol=1e-9, atol=1e-12).y.T


def by_heyoka() -> Followed | None:
    """Return a Taylor integrator with terminal events at the boundaries, or None where heyoka is absent."""
    try:
        import heyoka
    except ImportError:
        return None
    x, v = heyoka.make_vars("x", "v")
    middle, stiffness = heyoka.par[0], heyoka.par[1]
    push = 100.0 * heyoka.cos(40.0 * heyoka.time) - 8.0 * v - stiffness * (x - middle)

    def turned(sign: float) -> Callable[..., bool]:
        def call(machine: object, direction: int) -> bool:
            inside = direction * sign < 0
            machine.pars[0], machine.pars[1] = (0.0, 0.0) if inside else (0.005 * sign, 4e4)  # type: ignore[attr-defined]
            return True

        return call

    events = [heyoka.t_event(x - sign * 0.005, callback=turned(sign)) for sign in (1.0, -1.0)]
    machine = heyoka.taylor_adaptive([(x, v), (v, push)], [0.001, 0.1], tol=1e-15, t_events=events)

    def follow(periods: int) -> NDArray[np.float64]:
        machine.time, machine.state[:], machine.pars[:] = 0.0, START, 0.0
        machine.reset_cooldowns()
        return machine.propagate_grid(np.arange(periods + 1) * EXACT.period)[-1]

    return follow


def followed(flow: object, tangents: int) -> Followed:
    return lambda periods: flow.strobe(START, periods=periods, tangents=tangents).states  # type: ignore[attr-defined]


CASES = [
    Case("exact flow, 10,000 periods with tangent, against the general kernel",
         lambda: EXACT.strobe(START, periods=WHOLE, tangents=2),
         lambda: GENERAL.strobe(START, periods=WHOLE, tangents=2),
         0.05),
    Case("exact flow, 100 periods with tangent, against DOP853 without",
         lambda: EXACT.strobe(START, periods=100, tangents=2), lambda: by_scipy(100)),
    Case("general kernel, 100 periods with tangent, against DOP853 without",
         lambda: GENERAL.strobe(START, periods=100, tangents=2), lambda: by_scipy(100)),
    Case("exponent of Case 1 to 0.1 %",
         lambda: LyapunovMax(periods=400_000).estimate(EXACT, rng=np.random.default_rng(0)), None, 5.0),
]  # fmt: skip


def main() -> None:
    """Print the table."""
    ways: list[tuple[str, Followed | None, int]] = [
        ("exact, state and tangent", followed(EXACT, 2), WHOLE),
        ("exact, state", followed(EXACT, 0), WHOLE),
        ("general kernel, state and tangent", followed(GENERAL, 2), WHOLE),
        ("general kernel, state", followed(GENERAL, 0), WHOLE),
        ("heyoka, Taylor with events, state", by_heyoka(), WHOLE),
        ("scipy DOP853 at 1e-9, state", by_scipy, 100),
    ]
    for name, follow, periods in ways:
        if follow is None:
            print(f"{name:<36} absent")
            continue
        seconds = clocked(lambda f=follow, n=periods: f(n), 5 if periods == WHOLE else 1) * WHOLE / periods
        error = abs(follow(8)[8, 0] - AFTER_8) / CASE_1["x0"]
        print(f"{name:<36} {seconds:10.4f} s {error:10.1e} x0")
    found = LyapunovMax(periods=400_000).estimate(EXACT, rng=np.random.default_rng(0))
    print(f"exponent {found.value:.4f} 1/s [{found.low:.4f}, {found.high:.4f}], error {found.details['stderr']:.4f}")
    print(f"in {clocked(CASES[-1].ours, 3):.2f} s")


if __name__ == "__main__":
    main()
