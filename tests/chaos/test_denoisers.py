"""Noise reduction: against plain twins and published programs, on clean, noisy, driven and awkward series."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lostmotion.contracts import Series
from lostmotion.results import Embedding
from lostmotion_chaos.denoisers._kernels_projection import project
from lostmotion_chaos.denoisers.projective import LocalProjective
from lostmotion_chaos.denoisers.simple import SimpleNonlinear

BOTH = [SimpleNonlinear(), LocalProjective()]
RNG = np.random.default_rng(0)


def series(x, period=None):
    return Series(x - np.mean(x), 0.02, Embedding(8, 3, 50), period)


def ratio(cleaned, clean, noise):
    return float(np.sqrt(np.mean((cleaned - (clean - clean.mean())) ** 2))) / noise


@pytest.fixture(scope="module")
def lorenz():
    """x (5000,) of the Lorenz system, every 0.02 s."""

    def rates(_, y):
        return [10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3.0 * y[2]]

    t = 20.0 + 0.02 * np.arange(5000)
    return solve_ivp(rates, (0.0, t[-1]), [1.0, 2.0, 20.0], "DOP853", t_eval=t, rtol=1e-9, atol=1e-9).y[0]


def noisy(clean, level, seed=1):
    noise = level * float(np.std(clean))
    x = clean + noise * np.random.default_rng(seed).normal(size=len(clean))
    return x - clean.mean(), noise


def plain_simple(x, dim, radius):
    """The scheme of Schreiber (1993) as written there, point by point."""
    rows = np.lib.stride_tricks.sliding_window_view(x, dim)
    out = x.copy()
    for i, row in enumerate(rows):
        near = np.abs(rows - row).max(axis=1) <= radius
        out[i + dim // 2] = rows[near, dim // 2].mean()
    return out


@pytest.mark.parametrize("period", [None, 0.61])
def test_simple_scheme_is_its_plain_twin(lorenz, period):
    x, noise = noisy(lorenz[:1500], 0.05)
    ours = SimpleNonlinear(iterations=1, phase=False).clean(series(x, period), noise=noise, rng=RNG)
    assert np.allclose(ours, plain_simple(x - x.mean(), 7, 3.0 * noise), atol=1e-12)


@pytest.mark.slow
def test_projection_is_the_limit_of_the_weighted_metric(lorenz):
    """Against `eigh` of the covariance with the metric (1000, 1, ..., 1, 1000) of Grassberger et al. (1993)."""
    x, _ = noisy(lorenz[:600], 0.05)
    dim, keep, rng = 7, 4, np.random.default_rng(2)
    rows = np.lib.stride_tricks.sliding_window_view(x, dim)
    members = np.array([np.argsort(np.abs(rows - row).max(axis=1))[:40] for row in rows], dtype=np.int32)
    sizes = rng.integers(30, 41, len(rows)).astype(np.int32)
    ours = np.empty((len(rows), dim - 2))
    project(x, dim, keep - 2, members, sizes, (0, len(rows)), ours)
    metric = np.ones(dim)
    metric[[0, -1]] = 1e3
    theirs = np.empty((len(rows), dim))
    for i, row in enumerate(rows):
        near = rows[members[i, : sizes[i]]]
        cov = np.cov(near.T, bias=True) * np.outer(metric, metric)
        small = np.linalg.eigh(cov)[1][:, : dim - keep]
        theirs[i] = small @ (small.T @ ((row - near.mean(axis=0)) * metric)) / metric
    off = np.sqrt(np.mean((ours - theirs[:, 1:-1]) ** 2)) / np.sqrt(np.mean(theirs**2))
    assert off < 0.02


@pytest.mark.parametrize("denoiser", BOTH, ids=lambda d: d.name)
def test_clean_data_is_left_alone(lorenz, denoiser):
    """Noise of zero changes nothing; of a millionth, no sample by more than some millionths."""
    data = series(lorenz)
    assert np.array_equal(denoiser.clean(data, noise=0.0, rng=RNG), data.x)
    tiny = 1e-6 * float(np.std(data.x))
    moved = denoiser.clean(data, noise=tiny, rng=RNG) - data.x
    assert np.sqrt(np.mean(moved**2)) <= tiny


@pytest.mark.parametrize("denoiser", BOTH, ids=lambda d: d.name)
@pytest.mark.parametrize("level", [0.02, 0.2, *(pytest.param(level, marks=pytest.mark.slow) for level in (0.05, 0.1))])
def test_more_iterations_never_make_the_data_worse(lorenz, denoiser, level):
    """An established program with a neighbourhood that is not shrunk ends above the raw noise after three.

    Seeded; ten iterations leave at most 3 % more than the default's two, and less than the raw noise by far.
    """
    x, noise = noisy(lorenz, level)
    options = {k: getattr(denoiser, k) for k in ("dim", "radius")}
    few = denoiser.clean(series(x), noise=noise, rng=RNG)
    many = type(denoiser)(**options, iterations=10).clean(series(x), noise=noise, rng=RNG)
    assert ratio(many, lorenz, noise) < 1.03 * ratio(few, lorenz, noise)
    assert ratio(few, lorenz, noise) < 0.9


def test_projection_beats_the_simple_scheme_at_low_noise(lorenz):
    """At 1 and 2 %, where the windows of the simple scheme have few neighbours. Seeded."""
    for level in (0.01, 0.02):
        x, noise = noisy(lorenz, level)
        left = [ratio(d.clean(series(x), noise=noise, rng=RNG), lorenz, noise) for d in BOTH]
        assert left[1] < 0.7 * left[0]


@pytest.mark.parametrize("denoiser", BOTH, ids=lambda d: d.name)
@pytest.mark.parametrize(
    "x",
    [
        np.round(8 * np.sin(0.3 * np.arange(600))) / 8,
        np.tile(np.arange(10.0), 60),
        np.concatenate([np.zeros(300), np.sin(np.arange(300))]),
        np.sin(np.arange(20.0)),
        np.random.default_rng(3).normal(size=600),
        1e9 + np.sin(0.1 * np.arange(600)),
    ],
    ids=["quantised", "exact repeats", "constant stretch", "20 samples", "white noise", "offset"],
)
def test_awkward_series(denoiser, x):
    data = series(x, 0.63)
    for noise in (1e-12, 0.02, 1.0, 100.0):
        cleaned = denoiser.clean(data, noise=noise, rng=RNG)
        assert cleaned.shape == data.x.shape
        assert np.isfinite(cleaned).all()


@pytest.mark.parametrize("denoiser", BOTH, ids=lambda d: d.name)
def test_outcome_does_not_depend_on_threads(lorenz, denoiser, monkeypatch):
    x, noise = noisy(lorenz[:2000], 0.05)
    two = denoiser.clean(series(x), noise=noise, rng=RNG)
    monkeypatch.setattr("lostmotion.kernels.threads.cores", lambda: 1)
    assert np.array_equal(two, denoiser.clean(series(x), noise=noise, rng=RNG))


@pytest.fixture(scope="module")
def reference(shared):
    """Recordings with noise, their clean originals, and what a published program made of them."""
    folder = shared / "reference"
    if not (folder / "noisy_and_denoised.npz").is_file():
        pytest.skip("no reference arrays: noisy_and_denoised.npz is absent")
    arrays = dict(np.load(folder / "noisy_and_denoised.npz"))
    arrays["L20"] = np.load(folder / "lorenz_100k.npz")["x"][:20000]
    arrays["B50"] = np.load(folder / "lin_backlash.npz")["x_50pp"][:20000]
    return arrays


KEYS = [("L20_n2", 0.02, 0.58007), ("L20_n10", 0.10, 0.44822), ("B50_n2", 0.02, 0.86549), ("B50_n10", 0.10, 0.64094)]


@pytest.mark.real
@pytest.mark.parametrize(("key", "level", "left"), KEYS)
def test_simple_scheme_agrees_with_a_published_program(reference, key, level, left):
    """TISEAN 3.0.1 `lazy`, m = 7, r = 3 sigma, once: each sample, to the single precision that it writes."""
    x, clean = reference[key], reference[key[:3]]
    noise = level * float(np.std(clean))
    ours = SimpleNonlinear(iterations=1, phase=False).clean(Series(x, 1.0, Embedding(1, 3)), noise=noise, rng=RNG)
    theirs = reference[f"{key}_tisean_lazy_m7_r3s_i1"]
    off = np.abs(ours - theirs) / noise
    assert np.quantile(off, 0.999) < 1e-4
    assert float(np.sqrt(np.mean((ours - clean) ** 2))) / noise == pytest.approx(left, rel=2e-3)


@pytest.mark.real
@pytest.mark.parametrize(("key", "level", "left"), KEYS)
def test_projection_agrees_with_a_published_program(reference, key, level, left):
    """TISEAN 3.0.1 `ghkss`, m = 7, q = 3, k = 30, once: the noise left, within 2 %; and the default leaves less.

    Neighbourhoods begin at a thousandth of the range there, and all their members count.
    """
    x, clean = reference[key], reference[key[:3]]
    noise = level * float(np.std(clean))
    data = Series(x, 1.0, Embedding(1, 3))
    same = LocalProjective(dim=7, keep=3, radius=float(np.ptp(x)) / 1000 / noise, most=400, iterations=1)
    errors = [
        float(np.sqrt(np.mean((y - clean) ** 2)))
        for y in (
            same.clean(data, noise=noise, rng=RNG),
            reference[f"{key}_tisean_ghkss_m7_q3_k30_i1"],
            LocalProjective().clean(data, noise=noise, rng=RNG),
        )
    ]
    assert errors[0] == pytest.approx(errors[1], rel=0.02)
    assert errors[2] < 0.8 * min(errors[1], left * noise)
