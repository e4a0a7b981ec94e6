"""Noises of a sensor: each is found with its true size in a simulated recording, and is told from none."""

import math
from dataclasses import replace

import numpy as np
import pytest

import lostmotion as lm
from lostmotion.errors import LostMotionError
from lostmotion.inference.fit import maximise
from lostmotion.inference.setup import make_posterior
from lostmotion.likelihood.lanes import Lanes
from lostmotion.likelihood.noise_levels import make_noise_levels
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.sensors import Sensor
from lostmotion.likelihood.space import FreeParameter, ParameterSpace, Scales
from lostmotion.likelihood.system import System
from lostmotion.noises import AR1, NoiseBlock, White
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import Registry
from lostmotion_plugins.models.basic import LinearOscillator
from lostmotion_plugins.noises.drift import DriftingZero
from lostmotion_plugins.noises.flicker import Flicker
from lostmotion_plugins.noises.hum import Hum
from lostmotion_plugins.noises.jitter import Jitter

M, C, K, DT, OMEGA, COUNT = 1.0, 0.4, 25.0, 0.004, 12.0, 4000
SPREAD = 0.002
"""White noise (m); the amplitude of the motion is 0.17 m."""
T = DT * np.arange(COUNT)
PHASOR = 20.0 / complex(K - M * OMEGA**2, C * OMEGA)
X, V = ((factor * PHASOR * np.exp(1j * OMEGA * T)).real for factor in (1.0, 1j * OMEGA))

NOISES = {
    "jitter": (Jitter(), 1.5e-3), "drift": (DriftingZero(), 5e-3), "hum": (Hum(), 3e-3), "flicker": (Flicker(), 1e-3),
}  # fmt: skip
"""Each with its true size: 1.5 ms, 5 mm within a second (root), 3 mm, 1 mm in each decade."""


def add_noise(kind, size, rng):
    """Return noise (samples,) written without the blocks: moved stamps, a sum of steps, 1/f lines, a wandering sine."""
    if kind == "jitter":
        late = size * rng.standard_normal(COUNT)
        return (PHASOR * np.exp(1j * OMEGA * (T + late))).real - X
    if kind == "drift":
        return np.cumsum(size * math.sqrt(DT) * rng.standard_normal(COUNT))
    if kind == "flicker":
        lines = np.array([1.0, 1j]) @ rng.standard_normal((2, 8 * COUNT)) / np.sqrt(np.arange(1, 8 * COUNT + 1))
        return size / math.sqrt(math.log(10.0)) * np.fft.fft(lines, 16 * COUNT).real[:COUNT]
    steps = math.sqrt(DT / 100.0) * (rng.standard_normal(COUNT) + 1j * rng.standard_normal(COUNT))
    return size * ((1.0 + 1j + np.cumsum(steps)) * np.exp(2j * np.pi * 50.0 * T)).real


def posterior_of(z, noises):
    observation = Observation.of("run", z, 20.0 * np.cos(OMEGA * T)[:, None], DT, "position")
    observation = replace(observation, sensors=(Sensor("position", noises=noises),))
    scales = Scales(20.0, 0.17, 1.0 / OMEGA, usual=math.log((1e-3 * 20.0) ** 2 * DT), span=COUNT * DT)
    system = System(LinearOscillator())
    free = FreeParameter("c", "N s/m", math.log(C), math.log(0.05), math.log(4.0), log=True)
    levels = make_noise_levels((observation,), scales)
    return Posterior(
        ParameterSpace((free, *levels)), (observation,), Lanes(system, nsub=2), scales,
        system.vector({"m": M, "c": C, "k": K}),
    )  # fmt: skip


@pytest.mark.parametrize("kind", NOISES)
def test_a_noise_is_found_with_its_size(kind):
    """Over 10 seeds the largest error of the log size was 0.08 (jitter), 0.14 (drift) and 0.53 (hum: a single sine)."""
    noise, size = NOISES[kind]
    rng = np.random.default_rng(5)
    z = X + SPREAD * rng.standard_normal(COUNT) + add_noise(kind, size, rng)
    plain, fitted = (
        maximise(p, p.space.start) for p in (posterior_of(z, (White(),)), posterior_of(z, (White(), noise)))
    )
    (values,) = fitted.posterior.recordings[0].noise_values(fitted.theta[None])[1]
    assert math.log(values[0] / size) == pytest.approx(0.0, abs=0.8 if kind == "hum" else 0.2)
    assert fitted.log_likelihood > plain.log_likelihood + 50.0
    white = math.sqrt(fitted.posterior.recordings[0].noise(fitted.theta).white)
    assert white == pytest.approx(SPREAD, rel=0.15)


@pytest.mark.parametrize("kind", NOISES)
def test_white_noise_is_not_taken_for_another(kind):
    """One more parameter gains 0.5 on average in a log-likelihood, and 8 with one below 1e-4; of 30 the most was 1."""
    noise, _ = NOISES[kind]
    z = X + SPREAD * np.random.default_rng(6).standard_normal(COUNT)
    plain, fitted = (
        maximise(p, p.space.start) for p in (posterior_of(z, (White(),)), posterior_of(z, (White(), noise)))
    )
    assert -1.0 < fitted.log_likelihood - plain.log_likelihood < 8.0


def test_noises_of_a_sensor_add_up():
    """The filter with two noises is that with one whose block holds both."""
    z = X + SPREAD * np.random.default_rng(7).standard_normal(COUNT)
    posterior = posterior_of(z, (White(), AR1(), Hum(), Jitter()))
    block = posterior.recordings[0].noise(posterior.space.start)
    values = posterior.recordings[0].noise_values(posterior.space.start[None])
    noises = posterior.observations[0].sensors[0].noises
    parts = [n.covariance(tuple(v[0]), DT) for n, v in zip(noises, values, strict=True)]
    assert block.shown.tolist() == [1.0, 1.0, 0.0]
    assert block.white == parts[0].white
    assert block.clock == parts[3].clock > 0.0
    assert block.variance_after(700) == pytest.approx(sum(p.variance_after(700) for p in parts), rel=1e-12)
    assert np.isfinite(posterior.log_density(posterior.space.start))


OWN = '''
from dataclasses import dataclass
import numpy as np
from lostmotion.contracts import Noise, NoiseBlock, NoiseParameter

@dataclass(frozen=True)
class Echo(Noise):
    """The last reading stays by a half."""
    name = "echo"
    paper = "Own measurement, 2025"
    states = ("last",)
    def parameters(self, sensor):
        size = sensor.log_noise
        return (NoiseParameter("log_noise_echo", size, size - 7.0, size + 3.0),)
    def covariance(self, p, dt):
        whole = np.array([[p[0] ** 2]])
        return NoiseBlock(shown=np.ones(1), transition=np.array([[0.5]]), driving=0.75 * whole, first=whole)
    def words(self, p, share):
        return f"An echo of {100 * share:.0f} %."
'''
OWN_CASE = """
plugins = ["echo.py"]
[[recordings]]
file = "run.csv"
time = "t"
inputs = [{ input = "force", column = "F", unit = "N" }]
sensors = [{ channel = "position", column = "x", unit = "m", noise = "NAME" }]
[model]
name = "linear_oscillator"
[model.known]
m = 1.0
k = 25.0
[model.estimate]
c = { low = 0.05, high = 4.0, scale = "log" }
"""


def test_a_noise_of_a_third_party_file_is_fitted(tmp_path):
    """One file and its name in the case: no other line. The echo has three quarters of the variance."""
    rng = np.random.default_rng(9)
    fresh, echo = rng.standard_normal(COUNT), np.zeros(COUNT)
    for k in range(1, COUNT):
        echo[k] = 0.5 * echo[k - 1] + math.sqrt(0.75) * fresh[k]
    z = X + SPREAD * (0.5 * rng.standard_normal(COUNT) + math.sqrt(0.75) * echo)
    np.savetxt(tmp_path / "run.csv", np.c_[T, 20.0 * np.cos(OMEGA * T), z], delimiter=",", header="t,F,x", comments="")
    (tmp_path / "echo.py").write_text(OWN)
    (tmp_path / "case.toml").write_text(OWN_CASE.replace("NAME", "echo"))
    prepared = prepare(tmp_path / "case.toml", Registry.discover())
    posterior = make_posterior(System(prepared.model), prepared.case, prepared.observations)
    fit = maximise(posterior, posterior.space.start)
    block = fit.posterior.recordings[0].noise(fit.theta)
    assert math.sqrt(block.first[0, 0]) == pytest.approx(math.sqrt(0.75) * SPREAD, rel=0.1)
    assert math.sqrt(block.white) == pytest.approx(0.5 * SPREAD, rel=0.2)


def test_an_unknown_noise_is_refused_with_the_known_ones(tmp_path):
    np.savetxt(tmp_path / "run.csv", np.c_[T, np.cos(OMEGA * T), X], delimiter=",", header="t,F,x", comments="")
    (tmp_path / "echo.py").write_text(OWN)
    (tmp_path / "case.toml").write_text(OWN_CASE.replace("NAME", "pink"))
    with pytest.raises(LostMotionError, match=r"(?s)noise.*'pink'.*ar1.*echo.*jitter"):
        prepare(tmp_path / "case.toml", Registry.discover())


def test_a_sum_of_five_autoregressive_noises_has_the_spectrum_of_flicker():
    """Within 10 % of S = a / f, with a the variance in a decade over log(10), for f from 0.0002 to 0.05 of the rate."""
    block, f = Flicker().covariance((2.0,), 0.01), np.geomspace(2e-4, 0.05, 60)
    kept, variance = np.diag(block.transition), np.diag(block.first)
    rows = variance * (1.0 - kept**2) / (1.0 + kept**2 - 2.0 * kept * np.cos(2.0 * np.pi * f[:, None]))
    told = 2.0 * rows.sum(axis=1)
    assert told == pytest.approx(4.0 / math.log(10.0) / f, rel=0.1)


def test_variance_of_a_walk_grows_evenly():
    walk = DriftingZero().covariance((2.0,), 0.1)
    assert [walk.variance_after(n) for n in (0, 1, 7, 64)] == pytest.approx([0.0, 0.4, 2.8, 25.6])


def test_drawn_noise_has_the_covariance_of_its_block():
    """200,000 samples know the variance to 1 %: AR(1) noise of 12 samples, and stamps at a speed of 3."""
    block = NoiseBlock.join([AR1().covariance((0.5, 12.0), 1.0), Jitter().covariance((0.2,), 1.0)])
    drawn = block.draw(np.full(200_000, 3.0), np.random.default_rng(8))
    assert drawn.var() == pytest.approx(0.25 + 0.36, rel=0.03)
    assert np.mean(drawn[12:] * drawn[:-12]) == pytest.approx(0.25 / math.e, rel=0.06)


@pytest.mark.parametrize("noise", ["jitter", "white + jitter"])
def test_jitter_of_an_accelerometer_is_refused(tmp_path, noise):
    """The speed of an acceleration jumps with dry friction; a velocity may jitter."""
    np.savetxt(tmp_path / "run.csv", np.c_[T, np.cos(OMEGA * T), X], delimiter=",", header="t,F,x", comments="")
    text = OWN_CASE.replace('plugins = ["echo.py"]', "").replace("NAME", noise)
    (tmp_path / "case.toml").write_text(text.replace('"position"', '"acceleration"').replace('"m"', '"m/s^2"'))
    with pytest.raises(LostMotionError, match="'acceleration' measures an acceleration, and the noise 'jitter' needs"):
        prepare(tmp_path / "case.toml", Registry.discover())
    (tmp_path / "case.toml").write_text(text.replace('"position"', '"velocity"').replace('"m"', '"m/s"'))
    (sensor,) = prepare(tmp_path / "case.toml", Registry.discover()).observations[0].sensors
    assert [one.name for one in sensor.noises][-1] == "jitter"


def test_jitter_of_an_accelerometer_is_refused_in_a_notebook():
    recording = lm.Recording.from_arrays(
        T, inputs={"force": np.cos(OMEGA * T)}, sensors={"acceleration": X},
        units={"force": "N", "acceleration": "m/s^2"}, noise={"acceleration": "jitter"},
    )  # fmt: skip
    case = lm.Case(
        recording, "m*x'' + c*x' + k*x = force", known={"m": 1.0, "c": 0.2}, estimate={"k": lm.LogUniform(5, 99)}
    )
    with pytest.raises(LostMotionError, match="measures an acceleration, and the noise 'jitter' needs"):
        case.prepare(Registry.discover())
