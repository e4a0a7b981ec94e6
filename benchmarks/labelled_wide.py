"""Series that the rules of `analyse` were not made on: closed forms, maps, noise, and flows by SciPy's DOP853.

What each flow is was found apart from `analyse`: `python benchmarks/labelled_wide.py` integrates the tangent equations
and prints the largest exponent of each.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.signal import lfilter

from labelled_series import LabelledSeries, autoregressive, lines, noisy

Array = NDArray[np.float64]
Draw = Callable[[np.random.Generator], Array]
Flow = Callable[[float, Array], Array]
GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
TURN = 2.0 * math.pi
TOLERANCE = {"rtol": 1e-9, "atol": 1e-10}
TRANSIENT = 400
"""Samples that are left out, in units of ten: the motion has settled by then."""


def duffing(amplitude: float, pace: float, damping: float, stiffness: float = -1.0) -> Flow:
    """Return x'' + damping x' + stiffness x + x^3 = amplitude cos(pace t) as a flow."""

    def rate(t: float, y: Array) -> Array:
        return np.array([y[1], amplitude * math.cos(pace * t) - damping * y[1] - stiffness * y[0] - y[0] ** 3])

    return rate


def van_der_pol(mu: float, amplitude: float, pace: float) -> Flow:
    """Return x'' - mu (1 - x^2) x' + x = amplitude cos(pace t) as a flow."""

    def rate(t: float, y: Array) -> Array:
        return np.array([y[1], amplitude * math.cos(pace * t) + mu * (1.0 - y[0] ** 2) * y[1] - y[0]])

    return rate


def two_drives(t: float, y: Array) -> Array:
    """Return the rate of a hardening oscillator under two drives whose frequencies have no common measure."""
    push = 1.0 * math.cos(1.3 * t) + 0.7 * math.cos(1.3 * GOLDEN * t)
    return np.array([y[1], push - 0.3 * y[1] - y[0] - 0.15 * y[0] ** 3])


def pendulum(t: float, y: Array) -> Array:
    """Return the rate of a driven pendulum in a chaotic range; its velocity comes first."""
    return np.array([1.15 * math.cos(2.0 * t / 3.0) - 0.5 * y[0] - math.sin(y[1]), y[0]])


def lorenz(_t: float, y: Array) -> Array:
    """Return the rate of the Lorenz system (10, 28, 8/3)."""
    return np.array([10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 * y[2] / 3.0])


def roessler(_t: float, y: Array) -> Array:
    """Return the rate of the Roessler system (0.15, 0.2, 10)."""
    return np.array([-y[1] - y[2], y[0] + 0.15 * y[1], 0.2 + y[2] * (y[0] - 10.0)])


def hyperchaos(_t: float, y: Array) -> Array:
    """Return the rate of Roessler's system with two positive exponents (Phys. Lett. A 71 (1979) 155)."""
    return np.array([-y[1] - y[2], y[0] + 0.25 * y[1] + y[3], 3.0 + y[0] * y[2], 0.05 * y[3] - 0.5 * y[2]])


START = {"hyperchaos": np.array([-10.0, -6.0, 0.0, 10.1]), "lorenz": np.array([1.0, 1.0, 25.0])}
FLOWS: dict[str, tuple[str, Flow, int, float, float | None]] = {
    "lorenz": ("chaotic", lorenz, 3, 0.04, None),
    "roessler c 10": ("chaotic", roessler, 3, 0.12, None),
    "hyperchaos": ("chaotic", hyperchaos, 4, 0.1, None),
    "duffing chaos": ("chaotic", duffing(0.5, 1.2, 0.3), 2, TURN / 1.2 / 40, TURN / 1.2),
    "ueda": ("chaotic", duffing(7.5, 1.0, 0.05, 0.0), 2, TURN / 60, TURN),
    "pendulum": ("chaotic", pendulum, 2, TURN / 40 * 1.5, 1.5 * TURN),
    "duffing period 2": ("periodic", duffing(0.28, 1.2, 0.3), 2, TURN / 1.2 / 40, TURN / 1.2),
    "duffing period 5": ("periodic", duffing(0.37, 1.2, 0.3), 2, TURN / 1.2 / 40, TURN / 1.2),
    "duffing two wells": ("periodic", duffing(0.65, 1.2, 0.3), 2, TURN / 1.2 / 40, TURN / 1.2),
    "van der pol": ("periodic", van_der_pol(2.0, 0.0, 1.0), 2, 0.19, None),
    "van der pol locked": ("periodic", van_der_pol(1.0, 1.2, 0.9), 2, TURN / 0.9 / 37, TURN / 0.9),
    "van der pol driven": ("quasiperiodic", van_der_pol(0.2, 0.4, 1.45), 2, TURN / 1.45 / 33, TURN / 1.45),
    "van der pol, strong": ("quasiperiodic", van_der_pol(1.0, 0.6, 2.2), 2, TURN / 2.2 / 33, TURN / 2.2),
    "duffing, two drives": ("quasiperiodic", two_drives, 2, TURN / 1.3 / 33, TURN / 1.3),
}


def settled(rate: Flow, start: tuple[float, ...], dt: float, n: int, skip: int = 8000) -> Draw:
    """Return a maker of the first state (n,) of a flow, begun beside `start` and left alone for `skip` samples."""

    def draw(rng: np.random.Generator) -> Array:
        begin = np.array(start) + 0.1 * rng.normal(size=len(start))
        t = dt * np.arange(skip + n)
        return np.asarray(solve_ivp(rate, (0.0, t[-1]), begin, "DOP853", t[skip:], **TOLERANCE).y[0])

    return draw


def moved(name: str, n: int) -> Draw:
    """Return a maker of the first state (n,) of a flow, begun beside the usual start and settled."""
    _, rate, size, dt, period = FLOWS[name]
    skip = 10 * TRANSIENT if period is None else round(150 * period / dt)
    return settled(rate, tuple(START.get(name, np.zeros(size))), dt, n, skip)


def mackey_glass(delay: float, n: int, dt: float) -> Draw:
    """Return a maker of x' = 0.2 x(t - delay) / (1 + x(t - delay)^10) - 0.1 x, one delay after the other by DOP853."""

    def draw(rng: np.random.Generator) -> Array:
        first = 1.2 + 0.1 * rng.normal()
        late: Callable[[float], Array] = lambda _t: np.array([first])  # noqa: E731
        end, pieces, begin = np.array([1.2]), [], 0.0
        while begin < (n + TRANSIENT) * dt:

            def rate(t: float, y: Array, late: Callable[[float], Array] = late) -> Array:
                past = late(t - delay)[0]
                return np.asarray(0.2 * past / (1.0 + past**10) - 0.1 * y)

            done = solve_ivp(rate, (begin, begin + delay), end, "DOP853", dense_output=True, **TOLERANCE)
            pieces.append(done.sol)
            late, end, begin = done.sol, done.y[:, -1], begin + delay
        t = dt * (TRANSIENT + np.arange(n))
        which = (t // delay).astype(int)
        return np.concatenate([pieces[k](t[which == k])[0] for k in np.unique(which)])

    return draw


def iterated(step: Callable[[Array], Array], start: tuple[float, ...], n: int, seen: int = 0) -> Draw:
    """Return a maker of one coordinate of a map."""

    def draw(rng: np.random.Generator) -> Array:
        y = np.array(start) + 0.01 * rng.random(len(start))
        out = np.empty(n)
        for k in range(-1000, n):
            y = step(y)
            if k >= 0:
                out[k] = y[seen]
        return out

    return draw


def _ikeda(y: Array) -> Array:
    turn = 0.4 - 6.0 / (1.0 + y @ y)
    c, s = math.cos(turn), math.sin(turn)
    return np.array([1.0 + 0.9 * (y[0] * c - y[1] * s), 0.9 * (y[0] * s + y[1] * c)])


def _gopy(y: Array) -> Array:
    """Return a step of the strange attractor without chaos of Grebogi, Ott, Pelikan, Yorke, Physica D 13 (1984) 261."""
    return np.array([3.0 * math.tanh(y[0]) * math.cos(TURN * y[1]), (y[1] + GOLDEN) % 1.0])


def _circle(y: Array) -> Array:
    phase = y[1] + GOLDEN - 0.8 / TURN * math.sin(TURN * y[1])
    return np.array([math.cos(TURN * phase), phase % 1.0])


def logistic(r: float, n: int) -> Draw:
    """Return a maker of the logistic map."""
    return iterated(lambda y: r * y * (1.0 - y), (0.3,), n)


def telegraph(rate: float, n: int, soft: float = 0.0) -> Draw:
    """Return a maker of a random telegraph signal that switches with this chance a sample, behind a first order."""

    def draw(rng: np.random.Generator) -> Array:
        x = 1.0 - 2.0 * (np.cumsum(rng.random(n) < rate) % 2)
        return np.asarray(lfilter([1.0 - soft], [1.0, -soft], x)) + 0.02 * rng.normal(size=n)

    return draw


def coloured(slope: float, n: int) -> Draw:
    """Return a maker of Gaussian noise whose spectrum falls with this power of the frequency."""

    def draw(rng: np.random.Generator) -> Array:
        f = np.fft.rfftfreq(2 * n)
        f[0] = f[1]
        return np.asarray(np.fft.irfft(np.fft.rfft(rng.normal(size=2 * n)) * f ** (-slope / 2.0))[:n])

    return draw


def bent(maker: Draw, how: Callable[[Array], Array]) -> Draw:
    """Return a maker of a series seen through a static nonlinearity."""

    def draw(rng: np.random.Generator) -> Array:
        x = maker(rng)
        return how(x / np.std(x))

    return draw


def shaken(stiffness: float, cubic: float, push: float, n: int, *, damping: float = 0.1, sine: float = 0.0) -> Draw:
    """Return a maker of an oscillator under white noise (and a sine of pace 1), by Euler-Maruyama in steps of dt/25."""

    def draw(rng: np.random.Generator) -> Array:
        dt, fine = 0.15, 25
        h = dt / fine
        kicks = push * math.sqrt(h) * rng.normal(size=(n + TRANSIENT) * fine)
        tones = h * sine * np.cos(h * np.arange(len(kicks)))
        x, v, out = 0.5, 0.0, np.empty(n + TRANSIENT)
        for k in range(len(kicks)):
            v += h * (-damping * v - stiffness * x - cubic * x * x * x) + kicks[k] + tones[k]
            x += h * v
            if k % fine == 0:
                out[k // fine] = x
        return out[TRANSIENT:]

    return draw


def wandering(n: int, spread: float) -> Draw:
    """Return a maker of a limit cycle with three harmonics whose phase and size wander at random."""

    def draw(rng: np.random.Generator) -> Array:
        phase = np.cumsum(0.15 + spread * rng.normal(size=n))
        size = 1.0 + 0.1 * lfilter([0.1], [1.0, -0.99], rng.normal(size=n))
        return np.asarray(size * (np.sin(phase) + 0.4 * np.sin(2.0 * phase + 1.0) + 0.2 * np.sin(3.0 * phase)))

    return draw


def threshold(n: int) -> Draw:
    """Return a maker of an autoregression with two regimes, which noise drives through both."""

    def draw(rng: np.random.Generator) -> Array:
        x, e = np.zeros(n + 100), rng.normal(size=n + 100)
        for k in range(2, n + 100):
            a, b = (1.5, -0.9) if x[k - 1] > 0 else (0.6, -0.5)
            x[k] = a * x[k - 1] + b * x[k - 2] + e[k]
        return x[100:]

    return draw


def loud_and_quiet(n: int) -> Draw:
    """Return a maker of noise in a narrow band whose loudness wanders by itself."""
    tone = autoregressive((0.98 * np.exp(0.5j),), n)
    slow = autoregressive((0.998,), n)

    def draw(rng: np.random.Generator) -> Array:
        x, z = tone(rng), slow(rng)
        return np.asarray(x * np.exp(0.6 * z / np.std(z)))

    return draw


def pulses(n: int) -> Draw:
    """Return a maker of shot noise: ringing pulses of random size at random times."""
    poles = 0.97 * np.exp(np.array([0.35j, -0.35j]))

    def draw(rng: np.random.Generator) -> Array:
        hits = np.where(rng.random(n) < 0.02, rng.exponential(size=n), 0.0)
        return np.asarray(lfilter([1.0], np.real(np.poly(poles)), hits)) + 0.005 * rng.normal(size=n)

    return draw


def dying(n: int) -> Draw:
    """Return a maker of a decay whose frequency goes with its size, with noise."""

    def draw(rng: np.random.Generator) -> Array:
        size = np.exp(-4.0 * np.arange(n) / n)
        phase = np.cumsum(0.2 * (1.0 + 0.2 * size)) + rng.uniform(0.0, TURN)
        return np.asarray(size * np.sin(phase) + 0.002 * rng.normal(size=n))

    return draw


def swept(n: int) -> Draw:
    """Return a maker of a sine whose frequency rises tenfold, with a third harmonic and noise."""

    def draw(rng: np.random.Generator) -> Array:
        phase = np.cumsum(np.geomspace(0.05, 0.5, n)) + rng.uniform(0.0, TURN)
        return np.asarray(np.sin(phase) + 0.3 * np.sin(3.0 * phase) + 0.01 * rng.normal(size=n))

    return draw


def _louder(animal: LabelledSeries, share: float) -> LabelledSeries:
    return replace(animal, name=f"{animal.name} {share:.0%}", draw=noisy(animal.draw, share))


def wide_series(n: int = 10_000) -> list[LabelledSeries]:
    """Return series that the rules were not made on, with what each of them is.

    `unsteady` is what is none of the four: it dies away or is swept, and `undecided` is right of it.
    """
    flows = [LabelledSeries(name, f[0], moved(name, n), f[3], f[4]) for name, f in FLOWS.items()]
    by_name = {a.name: a for a in flows}
    shares = (("duffing chaos", 0.03), ("ueda", 0.10), ("lorenz", 0.05), ("duffing period 5", 0.03),
              ("van der pol", 0.05), ("van der pol driven", 0.03), ("duffing, two drives", 0.05))  # fmt: skip
    loud = [_louder(by_name[name], share) for name, share in shares]
    ar4 = autoregressive((0.985 * np.exp(0.25j), 0.97 * np.exp(0.8j)), n)
    ar2 = autoregressive((0.98 * np.exp(0.35j),), n)
    three = lines(((1.0, 1.0), (0.7, GOLDEN), (0.5, math.sqrt(2.0) - 1.0)), n, 0.03)
    return [
        *flows,
        *loud,
        LabelledSeries("mackey-glass 30", "chaotic", mackey_glass(30.0, n, 1.0), 1.0),
        LabelledSeries("mackey-glass 17, 3 %", "chaotic", noisy(mackey_glass(17.0, n, 1.0), 0.03), 1.0),
        LabelledSeries("ikeda", "chaotic", iterated(_ikeda, (0.1, 0.1), n), 1.0),
        LabelledSeries("ikeda 5 %", "chaotic", noisy(iterated(_ikeda, (0.1, 0.1), n), 0.05), 1.0),
        LabelledSeries("logistic 3.9", "chaotic", logistic(3.9, n), 1.0),
        LabelledSeries("intermittent logistic", "chaotic", logistic(1.0 + math.sqrt(8.0) - 2e-4, n), 1.0),
        LabelledSeries("intermittent map", "chaotic", iterated(lambda y: (y + y**1.6) % 1.0, (0.3,), n), 1.0),
        LabelledSeries("logistic period 4, 2 %", "periodic", noisy(logistic(3.5, n), 0.02), 1.0),
        LabelledSeries("circle map", "quasiperiodic", iterated(_circle, (0.0, 0.1), n), 1.0),
        LabelledSeries("three tones", "quasiperiodic", three, 0.03),
        LabelledSeries("strange, no chaos", "quasiperiodic", iterated(_gopy, (0.5, 0.1), n), 1.0),
        LabelledSeries("AR(4)", "stochastic", ar4, 0.01),
        LabelledSeries("AR(2) cubed", "stochastic", bent(ar2, lambda x: x**3), 0.01),
        LabelledSeries("AR(2) clipped", "stochastic", bent(ar2, np.tanh), 0.01),
        LabelledSeries("AR(4) squared", "stochastic", bent(ar4, lambda x: x + 0.5 * x**2), 0.01),
        LabelledSeries("1/f noise", "stochastic", coloured(1.0, n), 0.01),
        LabelledSeries("1/f^1.7 noise", "stochastic", coloured(1.7, n), 0.01),
        LabelledSeries("telegraph", "stochastic", telegraph(0.02, n), 0.01),
        LabelledSeries("telegraph, smoothed", "stochastic", telegraph(0.02, n, 0.9), 0.01),
        LabelledSeries("threshold AR", "stochastic", threshold(n), 0.01),
        LabelledSeries("loud and quiet", "stochastic", loud_and_quiet(n), 0.01),
        LabelledSeries("ringing pulses", "stochastic", pulses(n), 0.01),
        LabelledSeries("shaken, hardening", "stochastic", shaken(1.0, 1.0, 0.5, n), 0.15),
        LabelledSeries("shaken, two wells", "stochastic", shaken(-1.0, 1.0, 0.3, n), 0.15),
        LabelledSeries("shaken and driven", "stochastic", shaken(-1.0, 1.0, 0.2, n, damping=0.3, sine=0.2), 0.15, TURN),
        LabelledSeries("cycle, wandering", "stochastic", wandering(n, 0.03), 0.01),
        LabelledSeries("cycle, wandering far", "stochastic", wandering(n, 0.1), 0.01),
        LabelledSeries("decay", "unsteady", dying(n), 0.01),
        LabelledSeries("sweep", "unsteady", swept(n), 0.01),
    ]  # fmt: skip


def largest_exponent(name: str, periods: float = 4000.0) -> float:
    """Return the largest exponent (1/s) of a flow by a second orbit that is drawn back to 1e-7 again and again."""
    _, rate, size, dt, period = FLOWS[name]
    step = period or 40.0 * dt
    y = START.get(name, np.zeros(size)) + 0.05
    grown, away = 0.0, 1e-7
    other = y + away / math.sqrt(size)
    settle = round(0.1 * periods)
    for k in range(-settle, round(periods)):
        both = [
            solve_ivp(rate, (k * step, (k + 1) * step), z, "DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
            for z in (y, other)
        ]
        y, gap = both[0], both[1] - both[0]
        size_now = float(np.linalg.norm(gap))
        grown += math.log(size_now / away) if k >= 0 else 0.0
        other = y + gap * (away / size_now)
    return grown / (round(periods) * step)


if __name__ == "__main__":
    for flow in FLOWS:
        print(f"{flow:<24} {FLOWS[flow][0]:<14} {largest_exponent(flow, 400.0):+.4f} 1/s", flush=True)
