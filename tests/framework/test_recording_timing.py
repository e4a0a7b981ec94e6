"""Time columns: what rounding explains is accepted, what it does not is refused."""

from __future__ import annotations

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.recording.timing import check_time

N = 20000
EVEN = np.arange(N)


def printed(time: np.ndarray, form: str) -> np.ndarray:
    return np.array([float(form % t) for t in time])


@pytest.mark.parametrize(
    ("time", "dt"),
    [
        (EVEN / 1000, 1e-3),
        (EVEN / 1000 + 1.7e9, 1e-3),
        (EVEN / 1024 - 3, 1 / 1024),
        (printed(EVEN / 1000, "%.6f"), 1e-3),
        (printed(EVEN / 4096, "%.6f"), 1 / 4096),
        (printed(EVEN / 1024, "%.3f"), 1 / 1024),
        (printed(EVEN / 1024 + 100, "%.6g"), 1 / 1024),
        (printed(EVEN / 44100, "%.5f"), 1 / 44100),
        ((EVEN / 1000).astype(np.float32).astype(float), 1e-3),
        ((EVEN / 1000 + 900).astype(np.float32).astype(float), 1e-3),
        (EVEN / 1000 + 4e-6 * np.sin(EVEN), 1e-3),
    ],
)
def test_an_even_grid_is_seen_through_rounding(time: np.ndarray, dt: float) -> None:
    assert check_time(time, "a.csv")[0] == pytest.approx(dt, rel=2e-5)


def test_rounding_that_matters_is_noted() -> None:
    assert "rounded to 0.001 s" in check_time(printed(EVEN / 1024, "%.3f"), "a.csv")[1][0]
    assert check_time(EVEN / 1000, "a.csv")[1] == ()


def jittered(scale: float) -> np.ndarray:
    return np.cumsum(1e-3 * (1 + scale * np.random.default_rng(1).uniform(-1, 1, N)))


@pytest.mark.parametrize(
    ("time", "words"),
    [
        (jittered(0.3), ["time steps run from", "resample", "rate = "]),
        (np.round(jittered(0.9), 3), ["resample"]),
        (np.cumsum(np.random.default_rng(1).choice([0.010, 0.011], N)).round(3), ["strays", "resample"]),
        (np.delete(EVEN / 1000, 7), ["gap of 0.002 s", "0.006 s", "0.008 s"]),
        (np.delete(EVEN / 1000, slice(500, 900)), ["gap of 0.401 s", "t_end = 0.499", "t_start = 0.9"]),
        (np.delete(EVEN / 1024, [7, 500]), ["gap", "1 more"]),
        (np.delete(printed(EVEN / 1024, "%.3f"), slice(7, 9)), ["gap"]),
        (np.delete((EVEN / 1000).astype(np.float32).astype(float), 7), ["gap"]),
        (np.insert(EVEN / 1000, 7, 0.007), ["only 0 s", "sample 8", "repeated"]),
        (np.concatenate([EVEN, EVEN]) / 1000, ["backwards", "sample 20000"]),
        (np.zeros(N), ["stays at 0 s"]),
        (np.where(EVEN == 5, np.nan, EVEN), ["sample 5", "nan"]),
        (np.floor(EVEN / 1000), ["rounded to 1 s", "more digits", "rate"]),
    ],
)  # fmt: skip
def test_uneven_time_is_refused(time: np.ndarray, words: list[str]) -> None:
    with pytest.raises(DataError) as caught:
        check_time(time, "a.csv")
    message = str(caught.value)
    assert [w for w in ["a.csv", *words] if w not in message] == [], message


@pytest.mark.parametrize("step", [1e-300, 1e-15, 1e9, 1e300])
def test_a_step_that_no_recorder_has_is_refused(step: float) -> None:
    with pytest.raises(DataError, match="sampling step comes to"):
        check_time(step * np.arange(200.0), "run.csv")
