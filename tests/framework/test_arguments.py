"""Wrong arguments of the Python interface: one sentence each, no `TypeError` and no warning of NumPy."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import lostmotion as lm
from lostmotion.arguments import checked, describe, list_texts, maybe, positive, to_number, whole, words
from lostmotion.errors import CaseError, LostMotionError

T = np.arange(400) / 100.0
FORCE, PLACE = np.sin(7.0 * T), 1e-3 * np.cos(7.0 * T)
EQUATION = "m*x'' + c*x' + k*x = force"


def recorded(**changes: Any) -> lm.Recording:
    given: dict[str, Any] = {
        "time": T,
        "inputs": {"force": FORCE},
        "sensors": {"position": PLACE},
        "units": {"force": "N", "position": "m"},
    }
    return lm.Recording.from_arrays(**(given | changes))


def simulated(**changes: Any) -> Any:
    given: dict[str, Any] = {
        "values": {"m": 1.0, "c": 0.2, "k": 50.0},
        "drives": "harmonic:amplitude=1,frequency=2",
        "duration": 1.0,
        "rate": 50.0,
    }
    return lm.simulate("linear_oscillator", **(given | changes))


CALLS: dict[str, tuple[Callable[[], Any], str]] = {
    "NaN as a known value": (
        lambda: lm.Case(recorded(), EQUATION, known={"m": float("nan")}),
        r"known\['m'\] is nan: expected a finite number",
    ),
    "complex known value": (
        lambda: lm.diagnose(recorded(), EQUATION, known={"m": 1j}),
        r"known\['m'\] is 1j: expected a finite number",
    ),
    "known values as a list": (
        lambda: lm.diagnose(recorded(), EQUATION, known=["m"]),  # type: ignore[arg-type]
        r"known is a list: expected a dictionary, such as {'m': 1.0}",
    ),
    "a text as a prior": (
        lambda: lm.identify(recorded(), EQUATION, estimate={"c": "0.1 to 1"}),  # type: ignore[dict-item]
        r"estimate\['c'\] is '0.1 to 1': expected lm.LogUniform",
    ),
    "a frame as a recording": (
        lambda: lm.diagnose(pd.DataFrame({"x": PLACE}), EQUATION),  # type: ignore[arg-type]
        r"case is a DataFrame of pandas: .*lm.Recording.from_pandas makes one",
    ),
    "a dictionary as a recording": (
        lambda: lm.analyse({"x": PLACE}),  # type: ignore[arg-type]
        "recording is a dict: expected a Recording",
    ),
    "a list of texts as readings": (
        lambda: recorded(sensors={"position": ["a"] * 400}),
        "'position' holds the word 'a' instead of numbers",
    ),
    "complex readings": (lambda: recorded(sensors={"position": 1j * PLACE}), "holds complex128 instead of numbers"),
    "a negative rate": (lambda: recorded(time=None, rate=-100.0), "rate is -100.0: expected a number above 0"),
    "a rate as a text": (lambda: recorded(time=None, rate="100 Hz"), "rate is '100 Hz': expected a number above 0"),
    "an unknown hold": (lambda: recorded(hold="stpe"), r"hold is 'stpe' \(did you mean 'step'\?\): expected one of"),
    "sensors as an array": (lambda: recorded(sensors=PLACE), r"sensors is an array \(400,\) of float64"),
    "a unit as a number": (lambda: recorded(units={"force": 1, "position": "m"}), r"units\['force'\] is 1"),
    "an array as a frame": (
        lambda: lm.Recording.from_pandas(PLACE, sensors={"position": "x"}),
        "expected a data frame of pandas or polars",
    ),
    "a frame as a dataset": (
        lambda: lm.Recording.from_xarray(pd.DataFrame(), sensors={"position": "x"}),  # type: ignore[arg-type]
        "dataset is a DataFrame of pandas: expected a Dataset of xarray",
    ),
    "a number as a path": (
        lambda: lm.Recording.read(3, sensors={"position": "x"}),  # type: ignore[arg-type]
        "path is 3: expected the path of a file",
    ),
    "a long path": (lambda: lm.load("x" * 999), "expected the path of a file or folder"),
    "a number as a model": (
        lambda: lm.Case(recorded(), 7),  # type: ignore[arg-type]
        "model is 7: expected a model, its name, or equations as text",
    ),
    "no recordings": (lambda: lm.Case({}, EQUATION), "a case needs a Recording"),  # type: ignore[arg-type]
    "a seed with a fraction": (
        lambda: lm.diagnose(recorded(), EQUATION, seed=0.5),  # type: ignore[arg-type]
        "seed is 0.5: expected a whole number from 0",
    ),
    "a term as a number": (
        lambda: lm.diagnose(recorded(), EQUATION, terms=[3]),  # type: ignore[list-item]
        "an entry of terms is 3: expected a text",
    ),
    "an unknown setting": (lambda: lm.Settings().changed({"select.decisiv": 1}), "did you mean 'select.decisive'"),
    "a setting as an array": (
        lambda: lm.Settings().changed({"select.decisive": T}),  # type: ignore[dict-item]
        r"the setting select.decisive is an array \(400,\) of float64",
    ),
    "a prior with NaN": (lambda: lm.Normal(float("nan"), 1.0), "the mean of a prior is nan"),
    "a prior with texts": (lambda: lm.LogUniform("a", "b"), "the low of a prior is 'a'"),  # type: ignore[arg-type]
    "a negative duration": (lambda: simulated(duration=-1.0), "duration is -1.0: expected a number above 0"),
    "an initial state of NaN": (lambda: simulated(initial={"position": np.nan}), r"initial\['position'\] is nan"),
    "drives as a dictionary": (lambda: simulated(drives={"a": 1}), "drives is a dict: expected a text, or a list"),
    "huge initial state": (lambda: simulated(initial={"position": 1e308}), "diverged|stiff"),
    "a period as a text": (
        lambda: lm.embed(PLACE, None, dt=0.01),  # type: ignore[arg-type]
        "embedder is None: expected an embedder",
    ),
    "a number as the name of an input": (
        lambda: lm.Recording.from_arrays(rate=1.0, sensors={3: PLACE}, units={}),  # type: ignore[dict-item]
        "a key of sensors is 3: expected a text",
    ),
    "a period longer than the recording": (
        lambda: lm.analyse(recorded(), period=10.0, progress=False),
        "the period of 10 s does not fit 4 s at 100 Hz",
    ),
    "no pairs of samples": (
        lambda: lm.analyse(recorded(), every=0),
        "every is 0: expected a whole number from 1",
    ),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("call", "says"), CALLS.values(), ids=CALLS)
def test_a_wrong_argument_is_refused_with_one_sentence(call: Callable[[], Any], says: str) -> None:
    with pytest.raises(LostMotionError, match=says) as caught:
        call()
    assert "\n" not in str(caught.value)


@pytest.mark.filterwarnings("error")
def test_a_frame_of_polars_is_refused_where_a_recording_is_wanted() -> None:
    polars = pytest.importorskip("polars", reason="polars is not installed")
    with pytest.raises(CaseError, match=r"case is a DataFrame of polars: .*from_pandas"):
        lm.diagnose(polars.DataFrame({"x": PLACE}), EQUATION)
    with pytest.raises(LostMotionError, match=r"frame is a LazyFrame of polars: .*not a lazy one"):
        lm.Recording.from_pandas(polars.LazyFrame({"x": PLACE}), sensors={"position": "x"})


@pytest.mark.parametrize(
    ("equation", "says"),
    [
        ("m*x'' + c*x' + k*x/0 = force", "divides by zero, at character 20"),
        ("m*x'' + c*x'/(2*0) + k*x = force", "divides by zero, at character 15"),
        ("m*x'' + c*x' + k*x/(c - c) = force", "divides by zero"),
        ("m*x'' + c*x' + k*x = force/0", "divides by zero, at character 28"),
        ("m*x'' + c*x' + k*x*log(0) = force", "has a part that is no finite number, at character 20"),
        ("m*x'' + c*x' + k*x*sqrt(-1) = force", "no finite number"),
        ("m*x'' + c*x' + k*x*(0 - 1)^0.5 = force", "no finite number"),
        ("m*x'' + c*x' + k*x*0^(-1) = force", "no finite number"),
        ("m*x'' + c*x' + k*x*(1e300*1e300) = force", "no finite number"),
        ("m*x'' + c*x' + k*x*asin(2) = force", "no finite number"),
    ],
)
def test_numbers_in_an_equation_are_finite(equation: str, says: str) -> None:
    with pytest.raises(CaseError, match=says):
        lm.model(equation)


@pytest.mark.parametrize("factor", ["2/3", "sqrt(2)", "(1 - 1)", "sin(pi/3)", "max(0, 1)", "2^(-1)", "gap(2, 3, 1)"])
def test_numbers_that_are_finite_are_accepted(factor: str) -> None:
    assert "k" in {param.name for param in lm.model(f"m*x'' + c*x' + k*x*{factor} = force").params}


def test_numbers_of_any_kind_are_numbers() -> None:
    for value in (3, 3.0, np.float32(3), np.int8(3), np.array(3.0), Decimal(3), Fraction(6, 2)):
        assert to_number(value) == 3.0
    for other in (None, True, "3", 3j, np.array([3.0]), np.nan, np.inf, 10**400, Decimal("NaN"), T):
        assert to_number(other) is None


def test_what_is_wrong_is_described_in_one_line() -> None:
    for value in (pd.DataFrame({"x": T}), xr.Dataset(), "x\ny", b"\xff", object(), T, "x" * 5000, 10**5000, int):
        said = describe(value)
        assert said.isprintable()
        assert len(said) < 100
    assert describe([datetime(2025, 1, 1)]) == "a list"


def test_a_rule_changes_an_argument_and_leaves_the_others() -> None:
    @checked(rate=maybe(positive), names=words, seed=whole(1, 5))
    def call(rate: Any, names: Any = (), *, seed: int = 3, other: Any = None) -> tuple[Any, ...]:
        return rate, list_texts(names), seed, other

    assert call(np.float32(2), (name for name in "ab"), other="?") == (2.0, ("a", "b"), 3, "?")
    assert call(None, "ab") == (None, ("ab",), 3, None)
    with pytest.raises(CaseError, match="seed is 6: expected a whole number from 1 to 5"):
        call(1, seed=6)
    with pytest.raises(TypeError):
        call()  # type: ignore[call-arg]


def test_a_path_may_be_a_text_or_a_path(tmp_path: Path) -> None:
    for place in (tmp_path, str(tmp_path)):
        with pytest.raises(LostMotionError, match="contains no result"):
            lm.load(place)


def test_a_path_of_blanks_is_named_in_one_line() -> None:
    with pytest.raises(CaseError, match=r"^'\\n' cannot be read") as caught:
        lm.diagnose("\n")
    assert "\n" not in str(caught.value)


def test_the_name_of_a_file_is_one_line() -> None:
    with pytest.raises(LostMotionError, match=r"^'\\n' ends in ''") as caught:
        lm.analyse("\n", channel="x")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("power", ["1e308", "(-1e300)", "101"])
def test_a_power_that_overflows_is_refused(power: str) -> None:
    with pytest.raises(CaseError, match="has a power above 100, with which numbers overflow"):
        lm.model(f"m*x''^{power} = force")
