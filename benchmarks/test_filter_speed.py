"""How fast the filter is, over the same filter with plain matrices in the same run: `pytest benchmarks`.

The work is that of the prototype: Case 1 with 3 N of dry friction, 160 samples a drive period, 1 % noise.
"""

import math

import numpy as np
import pytest
from reference import Reference

from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.points import Points, SensorNoises
from lostmotion.likelihood.system import System
from lostmotion.noises import NoiseBlock
from lostmotion_plugins.models.lin import LinBacklash
from lostmotion_plugins.terms.friction import CoulombFriction
from yardstick import ratio_of

WANTED = 30e6
"""Samples times points a second and core, at 32 points and three substeps."""
SUBSTEPS, PART, SAMPLES = 3, 200, 20_000
VALUES = {"m": 1.0, "c": 8.0, "k1": 0.0, "k0": 4e4, "x0": 0.005, "coulomb_friction.force": 3.0}
DT = 2.0 * math.pi / 40.0 / 160.0


def asked(samples, count):
    """Return a system, an observation, and points within a thousandth of the truth."""
    system, rng = System(LinBacklash(), (CoulombFriction(),)), np.random.default_rng(0)
    full = system.vector(VALUES)
    drive = Drive.smooth([lambda t: 100.0 * np.cos(40.0 * t)], DT, samples)
    truth = system.simulate(full, system.everything, np.array([0.003, 0.1]), drive, 8).states[:, 0]
    noise = 0.01 * 0.006
    z = truth + noise * rng.standard_normal(samples)
    observation = Observation.of("seen", z, drive.inputs, DT, "position")
    one, number = np.ones((count, 1)), np.zeros(count, dtype=np.int64)
    points = Points(
        full * (1.0 + 1e-3 * rng.standard_normal((count, len(full)))), np.full(count, 1e-2), number.astype(float),
        SensorNoises.of([[NoiseBlock(white=noise**2)]] * count),
        one, 0.0 * one, 0.0 * one, np.tile([truth[0], 0.1], (count, 1)),
        np.tile(np.diag([1e-8, 1e-2]), (count, 1, 1)), (drive,), number, number,
    )  # fmt: skip
    return system, observation, points


@pytest.mark.parametrize("count", [1, 16, 32], ids=["1 point", "16 points", "32 points"])
def test_filter_against_plain_matrices(benchmark, count):
    """20,000 samples in lanes, over 200 samples at one point with matrices; the speed of one core is printed."""
    (system, *work), (_, *part) = asked(SAMPLES, count), asked(PART, 1)
    fast, slow = (run(system, system.everything, SUBSTEPS) for run in (Lanes, Reference))
    assert fast.filter(*work).finite.all()
    benchmark.pedantic(lambda: fast.filter(*work), rounds=7, warmup_rounds=1)
    speed = SAMPLES * count / benchmark.stats.stats.min
    print(f"\n{speed / 1e6:.1f} million samples x points a second at {count} points; wanted {WANTED / 1e6:.0f} at 32")
    ratio = ratio_of(lambda: fast.filter(*work), lambda: slow.filter(*part))
    benchmark.extra_info.update(ratio=ratio, samples_per_second=speed)
    assert ratio * PART / (SAMPLES * count) < 0.01


if __name__ == "__main__":
    raise SystemExit(pytest.main([__file__, "-s"]))
