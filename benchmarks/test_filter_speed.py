"""How fast the filter is: `pytest benchmarks`. The promise is 1.5 million samples a second on one quiet core."""

import math

import numpy as np
import pytest

from lostmotion.forcing import Drive
from lostmotion.system import System
from lostmotion_plugins.models.lin import LinBacklash
from lostmotion_plugins.terms.friction import CoulombFriction
from yardstick import ratio_of

PROMISE = 1.5e6
SUBSTEPS = 3
VALUES = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005, "coulomb_friction.force": 3.0}


def filter_of(samples, *, compiled=True):
    """Return a call that filters `samples` of Case 1 with 3 N of friction, 1 % noise, 200 samples a period."""
    system = System(LinBacklash(), (CoulombFriction(),))
    full, active = system.vector(VALUES), system.everything
    drive = Drive.smooth([lambda t: 100.0 * np.cos(40.0 * t)], 2.0 * math.pi / 40.0 / 200.0, SUBSTEPS, samples)
    truth = system.simulate(full, active, np.array([0.003, 0.1]), drive).states[:, 0]
    noise = 0.01 * truth.std()
    z = truth + noise * np.random.default_rng(0).standard_normal(samples)
    base, own = system.pack(full, drive.dt / drive.nsub)
    track = system.kernel(active, compiled=compiled).track
    errors, variances, spare = np.zeros(samples), np.ones(samples), (np.zeros((1, 1)), np.zeros((1, 1, 1)))

    def call():
        return track(
            z, drive.u, 0.0, drive.dt, SUBSTEPS, base, own, *system.wiring(active), 0.0, 1e-4, noise**2, 0.0, 0.0,
            truth[:1].repeat(2), np.diag([1e-6, 1.0]),
            *system.channel("position"), errors, variances, False, *spare, *spare, spare[1],
        )  # fmt: skip

    assert call() == samples
    return call


def test_filter_against_its_plain_twin(benchmark):
    """200,000 samples compiled, over 300 samples of the same text run as plain Python; the promise is printed."""
    samples, fast = 200_000, filter_of(200_000)
    benchmark.pedantic(fast, rounds=7, warmup_rounds=1)
    speed = samples / benchmark.stats.stats.min
    kept = "kept" if speed > PROMISE else "not kept, here and now"
    print(f"\n{speed / 1e6:.1f} million samples a second at {SUBSTEPS} substeps: the promise is {kept}")
    ratio = ratio_of(fast, filter_of(300, compiled=False))
    benchmark.extra_info.update(ratio=ratio, samples_per_second=speed)
    assert ratio * 300 / samples < 0.01


if __name__ == "__main__":
    raise SystemExit(pytest.main([__file__, "-s"]))
