"""How often the stated 95 % intervals of D2 cover the truth, over independent records: run from this folder.

    python coverage_dimension.py [--records 50] [--seed 0] [--noise 0] [--cleaned]

Lorenz: D2 = 2.05 +- 0.01 (Grassberger, Procaccia, Phys. Rev. Lett. 50 (1983) 346). Lin's oscillator, Case 1:
2.43 +- 0.015, one more than the slope of the stroboscopic section, which is 1.43 at three phases (600,000 points each,
position and velocity, radii from 5e-4 to 3e-2 standard deviations).
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from dataclasses import replace

import numba
import numpy as np
from numpy.typing import NDArray

from labelled_series import CASE_1, backlash
from lostmotion.contracts import Quantifier, Series
from lostmotion.results import Embedding, Estimate
from lostmotion_chaos.analysis.denoise import denoise
from lostmotion_chaos.denoisers.projective import LocalProjective
from lostmotion_chaos.quantifiers.dimension import CorrelationDimension
from lostmotion_chaos.quantifiers.noise import NoiseLevel

Array = NDArray[np.float64]
PERIOD = 2.0 * math.pi / CASE_1[4]


@numba.njit(cache=True)
def lorenz(n, dt, start, skip):  # type: ignore[no-untyped-def]
    """Return x (n,) of the Lorenz system (10, 28, 8/3) by RK4 in steps of dt / 10."""
    y, out, h = start.copy(), np.empty(n), dt / 10
    k = np.zeros((4, 3))
    for i in range(skip + n):
        if i >= skip:
            out[i - skip] = y[0]
        for _ in range(10):
            for s in range(4):
                w = y.copy()
                if s > 0:
                    w = y + (h if s == 3 else 0.5 * h) * k[s - 1]
                k[s, 0] = 10.0 * (w[1] - w[0])
                k[s, 1] = w[0] * (28.0 - w[2]) - w[1]
                k[s, 2] = w[0] * w[1] - 8.0 / 3.0 * w[2]
            y = y + h / 6.0 * (k[0] + 2.0 * k[1] + 2.0 * k[2] + k[3])
    return out


def lorenz_record(rng: np.random.Generator, n: int) -> Series:
    x = lorenz(n, 0.02, np.array([1.0, 1.0, 20.0]) + rng.normal(size=3), 3000)
    return Series(x - x.mean(), 0.02, Embedding(8, 4, 100))


def lin_record(rng: np.random.Generator, n: int, per_period: int = 50) -> Series:
    start = (rng.uniform(-0.01, 0.01), rng.uniform(-0.5, 0.5))
    x = backlash(CASE_1, 100.0, start, per_period, n)
    lag = max(1, round(3 * per_period / 50))
    return Series(x - x.mean(), PERIOD / per_period, Embedding(lag, 4, per_period), PERIOD)


def noisy(series: Series, share: float, rng: np.random.Generator) -> Series:
    x = series.x + share * np.std(series.x) * rng.normal(size=series.n)
    return Series(x, series.dt, series.embedding, series.period)


def cleaned(series: Series, rng: np.random.Generator) -> Series:
    """Return the series as the chain would clean it."""
    new = denoise(series, LocalProjective(), NoiseLevel(), rng=rng).series
    return replace(new, x=new.x - new.x.mean())


def table(
    name: str,
    quantifier: Quantifier[Series],
    make: Callable[[np.random.Generator], Series],
    truth: float,
    records: int,
    first: int = 0,
) -> list[Estimate]:
    """Print one line, and return the estimates."""
    found = []
    for seed in range(first, first + records):
        rng = np.random.default_rng(seed)
        found.append(quantifier.estimate(make(rng), rng=rng))
    good = [e for e in found if e.ok]
    cover = sum(e.low <= truth <= e.high for e in good)
    value = np.array([e.value for e in good])
    half = np.array([0.5 * (e.high - e.low) for e in good])
    print(
        f"{name:24s} truth {truth:.3f}  ok {len(good)}/{records}  covers {cover}/{len(good)}  mean {value.mean():.3f}  "
        f"scatter {value.std():.3f}  half-width median {np.median(half):.3f} largest {half.max():.3f}",
        flush=True,
    )
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--records", type=int, default=50)
    parser.add_argument("--samples", type=int, default=20_000)
    parser.add_argument("--noise", type=float, default=0.0)
    parser.add_argument("--seed", type=int, default=0, help="seed of the first record")
    parser.add_argument("--cleaned", action="store_true", help="after local projective noise reduction")
    parser.add_argument("--only", default="", help="part of the name of a system")
    asked = parser.parse_args()
    n, noise = asked.samples, asked.noise
    makers: list[tuple[str, Callable[[np.random.Generator], Series], float]] = [
        ("lorenz x, dt 0.02", lambda rng: noisy(lorenz_record(rng, n), noise, rng), 2.05),
        ("lin case 1, 50 a period", lambda rng: noisy(lin_record(rng, n), noise, rng), 2.43),
        ("lin case 1, 200 a period", lambda rng: noisy(lin_record(rng, n, 200), noise, rng), 2.43),
    ]
    for name, make, truth in makers:
        if asked.only in name:
            taken = (lambda rng, make=make: cleaned(make(rng), rng)) if asked.cleaned else make
            table(name, CorrelationDimension(), taken, truth, asked.records, asked.seed)


if __name__ == "__main__":
    main()
