"""PySINDy for `benchmarks/beside_peers.py`: sparse regression of the acceleration, with derivatives or in weak form.

Position, velocity, drive and acceleration are divided by their standard deviations. A library has polynomials of degree
3, or the functions of the nominal model and of laws (`LAWS`), few or all; its half gap is the one with the smallest
residual. All settings are compared by free runs over a part of the fitted data.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from peer_tracks import Model, Track, choose_simplest, measure_error

WINDOWS, HALVES = (5, 9, 15), (12, 24, 48)
"""Samples of a smoothing polynomial of degree 3, and of half a test function of the weak form."""
THRESHOLDS = np.geomspace(1e-3, 0.2, 10)
"""Thresholds of STLSQ: shares of the standard deviation of the acceleration."""
DEGREE, TESTS, SUBSTEPS, BEFORE, RUNS, BEST = 3, 400, 2, 20, 40, 2
"""Degree of polynomials, test functions, steps for each sample, samples before a start, free runs of a comparison, and
settings whose sparse equations are all compared."""
EDGE = 10
"""Samples without a good derivative at the beginning."""
DRY = (
    "coulomb_friction", "stribeck_friction", "position_dependent_friction", "directional_friction", "dahl_friction",
    "lugre_friction",
)  # fmt: skip

Law = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]
LAWS: Mapping[str, tuple[Law, tuple[str, ...]]] = {
    "u": (lambda v, x, u, d: u, ()),
    "v": (lambda v, x, u, d: v, ()),
    "d": (lambda v, x, u, d: d, ()),
    "1": (lambda v, x, u, d: np.ones_like(v), ("offset_force",)),
    "x": (lambda v, x, u, d: x, ("linear_stiffness",)),
    "x^2": (lambda v, x, u, d: x**2, ("quadratic_stiffness",)),
    "x^3": (lambda v, x, u, d: x**3, ("cubic_stiffness",)),
    "sin(2x)": (lambda v, x, u, d: np.sin(2.0 * x), ("cogging",)),
    "cos(2x)": (lambda v, x, u, d: np.cos(2.0 * x), ("cogging",)),
    "sign(v)": (lambda v, x, u, d: np.sign(v), DRY),
    "sign(v)|x|": (lambda v, x, u, d: np.sign(v) * np.abs(x), DRY),
    "sign(v)exp(-4|v|)": (lambda v, x, u, d: np.sign(v) * np.exp(-4.0 * np.abs(v)), DRY),
    "|v|": (lambda v, x, u, d: np.abs(v), ("directional_damping",)),
    "v|v|": (lambda v, x, u, d: v * np.abs(v), ("quadratic_damping",)),
    "v[d!=0]": (lambda v, x, u, d: v * (d != 0.0), ("contact_damping",)),
    "v|d|": (lambda v, x, u, d: v * np.abs(d), ("hunt_crossley_contact",)),
    "d|d|^0.5": (lambda v, x, u, d: d * np.sqrt(np.abs(d)), ("hertz_contact",)),
}
"""Functions of scaled velocity, position, drive and spring deflection, and the mechanisms that each may stand for."""
CONTACT = ("v[d!=0]", "v|d|", "d|d|^0.5")
FEW = ("u", "v", "d", "1", "x", "x^3", "sign(v)")
POLYNOMIALS, SOME, ALL = "polynomials", "few laws", "all laws"


def list_functions(track: Track, library: str) -> dict[str, Law]:
    """Return the functions of a library by name; polynomials have none of the nominal spring."""
    if library != POLYNOMIALS:
        contact = "d" in track.nominal and not track.pendulum
        unused = {"u", "d"} - set(track.nominal) | set(() if contact else CONTACT)
        used = [name for name in (FEW if library == SOME else LAWS) if name not in unused]
        return {name: LAWS[name][0] for name in used}
    powers = [p for p in itertools.product(range(DEGREE + 1), repeat=3) if sum(p) <= DEGREE]
    powers = [p for p in powers if not (track.free and p[2])]
    return {name_power(p): lambda v, x, u, d, p=p: v ** p[0] * x ** p[1] * u ** p[2] for p in powers}


def name_power(powers: tuple[int, int, int]) -> str:
    """Return the name of a product of powers of velocity, position and drive; a constant is that of the laws."""
    return " ".join(f"{name}**{power}" for name, power in zip("vxu", powers, strict=True) if power) or "1"


@dataclass(frozen=True)
class Motion:
    """Smoothed position, velocity, drive and acceleration (samples,), divided by their `scales`."""

    x: np.ndarray
    v: np.ndarray
    u: np.ndarray
    a: np.ndarray
    scales: tuple[float, float, float, float]


def smooth(track: Track, window: int) -> Motion:
    """Return the motion by smoothed finite differences, twice."""
    from pysindy import SmoothedFiniteDifference

    def differ(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        method = SmoothedFiniteDifference(smoother_kws={"window_length": window, "polyorder": 3})
        slope = np.asarray(method(z[:, None], t=track.dt))[:, 0]
        return np.asarray(method.smoothed_x_)[:, 0], slope

    x, v = differ(track.position)
    v, a = differ(v)
    parts = (x, v, track.drive, a)
    scales = tuple(float(np.std(z)) or 1.0 for z in parts)
    return Motion(*(z / s for z, s in zip(parts, scales, strict=True)), scales)


@dataclass(frozen=True)
class Equation:
    """The scaled acceleration as a sum of functions; `size` is the unit of position, in rad, for a pendulum."""

    names: tuple[str, ...]
    coefficients: np.ndarray
    laws: tuple[Law, ...]
    gap: float
    size: float

    def __call__(self, v: np.ndarray, x: np.ndarray, u: np.ndarray) -> np.ndarray:
        """Return the scaled acceleration."""
        d = deflect(x, self.gap, self.size)
        return sum((c * law(v, x, u, d) for c, law in zip(self.coefficients, self.laws, strict=True)), 0.0 * v)


def deflect(x: np.ndarray, gap: float, size: float) -> np.ndarray:
    """Return the argument of the nominal spring: the path beyond the half gap, or the sine of an angle."""
    return np.sin(size * x) if size else x - np.clip(x, -gap, gap)


class Regression:
    """The regression on the fitted samples; `half` is the half width of its test functions in samples, 0 for none."""

    def __init__(self, motion: Motion, track: Track, half: int, library: str) -> None:
        import pysindy
        from pysindy.utils import AxesArray

        self.motion, self.half, self.cut = motion, half, slice(EDGE, track.begin)
        self.laws, self.gap, self.size = list_functions(track, library), 0.0, motion.scales[0] * track.pendulum
        self.library = pysindy.CustomLibrary([self.bind(law) for law in self.laws.values()])
        if half:
            speed = motion.scales[3] / motion.scales[1]
            time = track.dt * speed * np.arange(track.begin - EDGE)
            np.random.seed(0)  # noqa: NPY002 - PySINDy draws its test functions from it
            width = [(half + 0.5) * track.dt * speed]
            self.library = pysindy.WeakPDELibrary(self.library, spatiotemporal_grid=time, H_xt=width, K=TESTS)
        columns = np.column_stack([motion.v, motion.x, motion.u])[self.cut]
        self.data = AxesArray(columns, {"ax_time": 0, "ax_coord": 1})
        self.target = motion.a[self.cut, None]
        if half:
            self.target = np.asarray(self.library.convert_u_dot_integral(self.data[:, :1]))

    def bind(self, law: Law) -> Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]:
        """Return a law as a function of velocity, position and drive, with the present half gap."""
        return lambda v, x, u: law(v, x, u, deflect(x, self.gap, self.size))

    def assemble(self, gap: float) -> np.ndarray:
        """Return the values of all functions (rows, functions) with a half gap."""
        self.gap = gap
        return np.asarray(self.library.fit_transform(self.data))

    def find_gap(self) -> float:
        """Return the half gap with the smallest residual; 0 without a gap."""
        if "d" not in self.laws or self.size:
            return 0.0

        def residual(gap: float) -> float:
            values = self.assemble(gap)
            found = np.linalg.lstsq(values, self.target, rcond=None)[0]
            return float(np.sum((self.target - values @ found) ** 2))

        grid = np.linspace(0.02, 0.98, 25) * float(np.max(np.abs(self.motion.x)))
        best = int(np.argmin([residual(gap) for gap in grid]))
        return float(minimize_scalar(residual, bounds=(grid[max(best - 1, 0)], grid[min(best + 1, 24)]),
                                     method="bounded", options={"maxiter": 12}).x)  # fmt: skip

    def list_equations(self, gap: float) -> Iterator[Equation]:
        """Yield the equations of all optimizers, the one with all functions first."""
        from pysindy import FROLS, STLSQ

        values, done = self.assemble(gap), set()
        optimizers = [STLSQ(threshold=t, alpha=1e-9, max_iter=50) for t in (0.0, *THRESHOLDS)]
        for optimizer in (*optimizers, FROLS(alpha=1e-9, max_iter=len(self.laws))):
            optimizer.fit(values, self.target)
            for found in optimizer.history_ if isinstance(optimizer, FROLS) else [optimizer.coef_]:
                kept = tuple(int(k) for k in np.flatnonzero(found))
                if kept and kept not in done:
                    done.add(kept)
                    yield self.regress(gap, kept)

    def regress(self, gap: float, kept: tuple[int, ...]) -> Equation:
        """Return the equation with these functions, by least squares."""
        found = np.linalg.lstsq(self.assemble(gap)[:, kept], self.target, rcond=None)[0]
        names, laws = list(self.laws), list(self.laws.values())
        own = [names[k] for k in kept], [laws[k] for k in kept]
        return Equation(tuple(own[0]), np.ravel(found), tuple(own[1]), gap, self.size)


class Runs:
    """Free runs of an equation, from states that it fits to the readings before each start."""

    def __init__(self, equation: Equation, motion: Motion, track: Track) -> None:
        self.equation, self.motion, self.track = equation, motion, track
        nodes = np.arange(2 * SUBSTEPS * (len(motion.u) - 1) + 1) / (2 * SUBSTEPS)
        self.drive = CubicSpline(np.arange(len(motion.u)), motion.u)(nodes)

    def step(self, x: np.ndarray, v: np.ndarray, begin: np.ndarray, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """Return scaled positions (runs, steps) and the last velocity (runs,)."""
        f, h = self.equation, self.track.dt / SUBSTEPS
        rate, push = self.motion.scales[1] / self.motion.scales[0], self.motion.scales[3] / self.motion.scales[1]
        path = [x]
        for k in range(SUBSTEPS * (steps - 1)):
            u0, u1, u2 = (self.drive[2 * (SUBSTEPS * begin + k) + j] for j in range(3))
            p1, q1 = rate * v, push * f(v, x, u0)
            p2, q2 = rate * (v + 0.5 * h * q1), push * f(v + 0.5 * h * q1, x + 0.5 * h * p1, u1)
            p3, q3 = rate * (v + 0.5 * h * q2), push * f(v + 0.5 * h * q2, x + 0.5 * h * p2, u1)
            p4, q4 = rate * (v + h * q3), push * f(v + h * q3, x + h * p3, u2)
            x, v = x + h / 6.0 * (p1 + 2.0 * p2 + 2.0 * p3 + p4), v + h / 6.0 * (q1 + 2.0 * q2 + 2.0 * q3 + q4)
            if k % SUBSTEPS == SUBSTEPS - 1:
                path.append(x)
        return np.array(path).T, v

    def start(self, starts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return position and velocity (runs,) at the starts, by Gauss-Newton on the readings before them."""
        begin, length, small = starts - BEFORE, BEFORE + 1, 1e-4
        x, v = self.motion.x[begin], self.motion.v[begin]
        seen = self.track.position[np.add.outer(begin, np.arange(length))] / self.motion.scales[0]
        for _ in range(6):
            path = self.step(x, v, begin, length)[0]
            slopes = [
                self.step(x + small, v, begin, length)[0] - path,
                self.step(x, v + small, begin, length)[0] - path,
            ]
            design = np.stack(slopes, axis=-1) / small
            normal, slope = np.einsum("rki,rkj->ijr", design, design), np.einsum("rki,rk->ir", design, seen - path)
            (a, b), (_, d) = normal + 1e-9 * np.eye(2)[..., None]
            moved = np.array([d * slope[0] - b * slope[1], a * slope[1] - b * slope[0]]) / (a * d - b * b)
            x, v = x + np.clip(moved[0], -0.1, 0.1), v + np.clip(moved[1], -0.1, 0.1)
        path, v = self.step(x, v, begin, length)
        return path[:, -1], v

    def __call__(self, starts: np.ndarray, steps: int) -> np.ndarray:
        """Return positions (runs, steps) in the unit of the recording."""
        return self.step(*self.start(starts), starts, steps)[0] * self.motion.scales[0]


def fit(track: Track, *, laws: bool, weak: bool) -> Model:
    """Return the equation of PySINDy for the fitted part of a recording."""
    test = track.hold_out_more()

    def score(equation: Equation, motion: Motion) -> float:
        return measure_error(test, Runs(equation, motion, test), RUNS)[0]

    tried = []
    for window in WINDOWS[: 2 if weak else 3]:
        motion = smooth(test, window)
        for half, library in itertools.product(HALVES if weak else (0,), (SOME, ALL) if laws else (POLYNOMIALS,)):
            regression = Regression(motion, test, half, library)
            gap = regression.find_gap()
            first = next(regression.list_equations(gap))
            tried.append((score(first, motion), (window, half, library), regression, gap))
    tried = sorted(tried, key=lambda one: one[0])[:BEST]
    models = [
        (score(equation, regression.motion), len(equation.names), (setting, equation.names))
        for _, setting, regression, gap in tried
        for equation in regression.list_equations(gap)
    ]
    (window, half, library), names = choose_simplest(models)
    motion = smooth(track, window)
    regression = Regression(motion, track, half, library)
    gap = regression.find_gap()
    equation = regression.regress(gap, tuple(list(regression.laws).index(name) for name in names))
    says = f"{library}, {window} samples" + (f", test functions of {2 * half}" if half else "")
    return Model(tuple(n for n in equation.names if n not in track.nominal), Runs(equation, motion, track), says)
