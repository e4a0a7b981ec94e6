"""How fast the chaos laboratory is: against plain NumPy and SciPy, against its peers, and as recordings grow.

python benchmarks/chaos.py table  [--only WORD] [--repeats 5]    ours / plain, in one run
python benchmarks/chaos.py growth [--longest 200000]             time over N, with the exponent of its growth
python benchmarks/chaos.py peers                                 other packages, those that are installed (extra: peers)
"""

from __future__ import annotations

import argparse
import importlib
import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from yardstick import Case, clocked, lorenz

AREAS = ("embedding", "exponents", "dimension", "surrogates", "denoising", "flows")
LENGTHS = (2_000, 5_000, 10_000, 20_000, 50_000, 100_000, 200_000)
ENOUGH = 1.0


def table(only: str, repeats: int) -> None:
    """Print for each task our time, the goal, the time of the plain version and the ratio."""
    print(f"{'Lorenz x, N = 20,000':<58} {'ours':>10} {'goal':>9} {'plain':>10} {'ratio':>8}")
    for area in AREAS:
        for case in importlib.import_module(f"yardstick_{area}").CASES:
            if only in case.name or only == area:
                print(_row(case, repeats), flush=True)


def _row(case: Case, repeats: int) -> str:
    ours = clocked(case.ours, repeats)
    plain = clocked(case.plain, 1) if case.plain else math.nan
    goal = f"{1e3 * case.goal:.0f} ms" if case.goal else ""
    return f"{case.name:<58} {1e3 * ours:7.1f} ms {goal:>9} {1e3 * plain:7.1f} ms {ours / plain:8.3f}"


def growth(longest: int) -> None:
    """Print the time of each method over the length of the recording, and how it grows from 20,000 samples on."""
    from lostmotion.contracts import Series
    from lostmotion.registry import default
    from lostmotion.results import Embedding

    made, embedding = default(), Embedding(8, 5, 100)

    def series(n: int) -> Series:
        return Series(lorenz(longest)[:n] - lorenz(longest)[:n].mean(), 0.02, embedding)

    def quantity(name: str) -> Callable[[int], Any]:
        tool = made.make("quantifier", name)
        return lambda n: tool.estimate(series(n), rng=np.random.default_rng(0))

    tasks: dict[str, Callable[[int], Any]] = {
        "ami_cao": lambda n: made.make("embedder", "ami_cao").choose(series(n).x, dt=0.02),
        **{
            name: quantity(name)
            for name in ("lyapunov_rosenstein", "lyapunov_kantz", "correlation_dimension", "correlation_entropy")
        },
        "iaaft, 39": lambda n: made.make("surrogate", "iaaft").draw(series(n), draws=39, rng=np.random.default_rng(0)),
        "simple_nonlinear, 2 %": lambda n: _cleaned(made.make("denoiser", "simple_nonlinear"), series(n)),
        "local_projective, 2 %": lambda n: _cleaned(made.make("denoiser", "local_projective"), series(n)),
    }
    lengths = [n for n in LENGTHS if n <= longest]
    print(f"{'seconds at N =':<24}" + "".join(f"{n:>9,}" for n in lengths) + "   grows as N to the power")
    for name, task in tasks.items():
        task(lengths[0])
        spent = [_once(task, n) for n in lengths]
        late = [(math.log(n), math.log(t)) for n, t in zip(lengths, spent, strict=True) if n >= 20_000]
        power = np.polyfit(*zip(*late, strict=True), 1)[0] if len(late) > 1 else math.nan
        print(f"{name:<24}" + "".join(f"{t:9.3f}" for t in spent) + f"   {power:.2f}", flush=True)


def _once(task: Callable[[int], Any], n: int) -> float:
    begin = time.perf_counter()
    task(n)
    spent = time.perf_counter() - begin
    return min(spent, clocked(lambda: task(n), 2)) if spent < ENOUGH else spent


def _cleaned(denoiser: Any, series: Any) -> Any:
    from dataclasses import replace

    sigma = 0.02 * float(np.std(series.x))
    noisy = replace(series, x=series.x + sigma * np.random.default_rng(0).normal(size=series.n))
    return denoiser.clean(noisy, noise=sigma, rng=np.random.default_rng(0))


def peers() -> None:
    """Print the time and the number of each package that is installed, for Lorenz x with N = 5,000."""
    x = lorenz()[:5_000]
    print(f"{'Lorenz x, N = 5,000: true exponent 0.906, dimension 2.05':<64} {'s':>8} {'found':>9}")
    for what, call in {**_ours(x), **_theirs(x)}.items():
        try:
            begin = time.perf_counter()
            found = call()
            print(f"{what:<64} {time.perf_counter() - begin:8.3f} {found:9.4f}", flush=True)
        except ImportError as err:
            print(f"{what:<64}   absent ({err.name or err})")
        except Exception as err:  # a peer may fail in any way: nolds 0.6.3 cannot be imported on Python 3.11
            print(f"{what:<64}   failed ({type(err).__name__}: {str(err)[:60]})")


def _ours(x: Any) -> dict[str, Callable[[], float]]:
    from lostmotion.contracts import Series
    from lostmotion.registry import default
    from lostmotion.results import Embedding

    series = Series(x - x.mean(), 0.02, Embedding(8, 5, 100))

    def value(name: str) -> float:
        tool = default().make("quantifier", name)
        return float(tool.estimate(series, rng=np.random.default_rng(0)).value)

    for name in ("lyapunov_rosenstein", "correlation_dimension"):
        value(name)
    return {
        "lostmotion lyapunov_rosenstein (1/s)": lambda: value("lyapunov_rosenstein"),
        "lostmotion correlation_dimension": lambda: value("correlation_dimension"),
    }


def _theirs(x: Any) -> dict[str, Callable[[], float]]:
    def nolds_lyapunov() -> float:
        import nolds

        return float(nolds.lyap_r(x, emb_dim=5, lag=8, min_tsep=100, tau=0.02, trajectory_len=150))

    def nolds_dimension() -> float:
        import nolds

        return float(nolds.corr_dim(x, 5, lag=8))

    def neurokit_lyapunov() -> float:
        import neurokit2

        return (
            float(neurokit2.complexity_lyapunov(x, delay=8, dimension=5, separation=100, len_trajectory=150)[0]) / 0.02
        )

    def neurokit_dimension() -> float:
        import neurokit2

        return float(neurokit2.fractal_correlation(x, delay=8, dimension=5)[0])

    return {
        "nolds lyap_r (1/s)": nolds_lyapunov,
        "neurokit2 complexity_lyapunov (1/s)": neurokit_lyapunov,
        "nolds corr_dim: self-matches, no Theiler window": nolds_dimension,
        "neurokit2 fractal_correlation: no Theiler window": neurokit_dimension,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("table", "growth", "peers"))
    parser.add_argument("--only", default="")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--longest", type=int, default=200_000)
    args = parser.parse_args()
    {"table": lambda: table(args.only, args.repeats), "growth": lambda: growth(args.longest), "peers": peers}[
        args.what
    ]()


if __name__ == "__main__":
    main()
