"""The result of an analysis: numbers and sentences, and the arrays behind them."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from lostmotion.contracts import Array, Series
from lostmotion.results import Embedding, Estimate
from lostmotion.results.background import Origin
from lostmotion.settings import DEFAULT, MotionSettings
from lostmotion.signals import spectrum, without_harmonics
from lostmotion.storage import StoredArray
from lostmotion_chaos.analysis.channel import AnalysedChannel
from lostmotion_chaos.analysis.motion_options import OPTIONS
from lostmotion_chaos.analysis.surrogates import SurrogateTest
from lostmotion_chaos.results import (
    Analysis,
    ChosenDelay,
    ChosenDimension,
    DrivePeriod,
    Measure,
    RecordedNoise,
    SurrogateOutcome,
)
from lostmotion_chaos.signals.sections import poincare, stroboscopic

NOISE_UNIT = "share of the signal's standard deviation"
CORRELATION_METHOD = "grassberger_procaccia"
Columns = dict[str, StoredArray]
CURVE_UNITS = {"lag": "s", "time": "s", "ami": "nat", "ami_floor": "nat", "slope": "1"}
"""The units of curves; other curves have unit 1."""


def make_result(found: AnalysedChannel, origin: Origin, limits: MotionSettings = DEFAULT.motion) -> Analysis:
    """Return the result of the analysis of a channel."""
    clean, denoised, embedding = found.clean, found.denoised, found.clean.embedding
    delay, dimension = embedding.methods
    return Analysis(
        title=found.source.title,
        verdict=found.verdict.motion,
        strength=found.verdict.strength,
        says=found.verdict.says,
        signs=found.verdict.signs,
        because=found.verdict.because,
        delay=ChosenDelay(samples=int(embedding.lag), seconds=embedding.lag * clean.dt, method=delay),
        dimension=ChosenDimension(value=int(embedding.dim), method=dimension, theiler=int(embedding.theiler)),
        noise=RecordedNoise(
            before=denoised.before.value,
            after=denoised.after.value,
            unit=NOISE_UNIT,
            before_interval=(denoised.before.low, denoised.before.high),
            method=found.denoiser,
        ),
        lyapunov=make_measure(found.exponent, found.exponent_method),
        d2=make_measure(found.dimension, CORRELATION_METHOD),
        k2=make_measure(found.entropy, CORRELATION_METHOD),
        others=tuple(make_measure(one, name, name) for name, one in found.others.items()),
        surrogates=tuple(map(make_outcome, found.tests)),
        drive=_make_drive(found),
        notes=write_notes(found, limits),
        provenance=origin,
    )


def make_measure(found: Estimate, method: str, name: str | None = None) -> Measure:
    """Return an estimate without its curves."""
    return Measure(
        name=name,
        value=found.value,
        low=found.low,
        high=found.high,
        unit=found.unit,
        method=method,
        status=found.status,
        says=found.says,
        details=found.details,
    )


def make_outcome(test: SurrogateTest) -> SurrogateOutcome:
    """Return a surrogate test without its draws."""
    return SurrogateOutcome(
        null=test.null,
        method=test.method,
        statistic=test.statistic,
        draws=len(test.values),
        p=test.p,
        sided=test.sided,
        original=test.original,
        says=test.says,
    )


def _make_drive(found: AnalysedChannel) -> DrivePeriod:
    period = math.nan if found.base.period is None else found.base.period
    return DrivePeriod(period=period, samples_per_period=period / found.source.dt, source=found.base.source)


def write_notes(found: AnalysedChannel, limits: MotionSettings = DEFAULT.motion) -> tuple[str, ...]:
    """Return the notes on limitations of the result."""
    source, embedding = found.source, found.clean.embedding
    notes = [*source.notes, *found.base.notes, *found.aside]
    if embedding.status != "ok":
        notes.append(embedding.says)
    for what, one in (("exponent", found.exponent), ("correlation dimension", found.dimension)):
        if one.status == "uncertain" or (one.ok and one.says):
            notes.append(f"On the {what}: {one.says}")
    periods = math.nan if found.base.period is None else len(source.x) * source.dt / found.base.period
    if periods < OPTIONS.note_periods:
        notes.append(
            f"The recording has {periods:.0f} periods: exponents and dimensions need some hundreds, so record longer."
        )
    return tuple(dict.fromkeys(notes))


def collect_arrays(found: AnalysedChannel) -> tuple[Columns, Columns]:
    """Return the variables and the coordinates of `analysis.nc`."""
    variables = {
        **_collect_series(found),
        **_collect_spectra(found),
        **_collect_sections(found),
        **_collect_embedding("embedding_", found.clean.embedding),
        **_collect_exponent(found.exponent),
        **_collect_dimension(found.dimension),
        **_collect_tests(found),
    }
    if found.clean is not found.raw:
        variables |= _collect_embedding("embedding_raw_", found.raw.embedding)
    time = np.arange(found.raw.n) * found.raw.dt
    return variables, {"time": StoredArray(("time",), time, "s", "time from the start")}


def _collect_series(found: AnalysedChannel) -> Columns:
    source, raw, clean = found.source, found.raw, found.clean
    table = {"x": StoredArray(("time",), raw.x, source.unit, f"{source.label}, mean removed")}
    if clean is not raw:
        table["cleaned"] = StoredArray(("time",), clean.x, source.unit, f"{source.label}, noise reduced")
    if source.excitation is not None:
        table["excitation"] = StoredArray(("time",), source.excitation, "", "measured excitation")
    return table


def _collect_spectra(found: AnalysedChannel) -> Columns:
    raw, unit = found.raw, found.source.unit
    density = f"({unit})^2/Hz" if unit else "1/Hz"
    frequency, power = spectrum(raw.x, raw.dt)
    table = {
        "frequency": StoredArray(("frequency",), frequency, "Hz", "frequency"),
        "density": StoredArray(("frequency",), power, density, "power spectral density"),
    }
    if found.base.period is not None:
        rest, _ = without_harmonics(raw.x, raw.dt, found.base.period)
        table["density_rest"] = StoredArray(
            ("frequency",), spectrum(rest, raw.dt)[1], density, "power spectral density without harmonics"
        )
    return table


def _collect_sections(found: AnalysedChannel) -> Columns:
    unit = found.source.unit
    table = {"section": StoredArray(("hit", "axis"), _compute_section(found.raw), unit, "section as recorded")}
    if found.clean is not found.raw:
        table["section_cleaned"] = StoredArray(
            ("hit_cleaned", "axis"), _compute_section(found.clean), unit, "section, cleaned"
        )
    return table


def _compute_section(series: Series) -> Array:
    """Return the section (points, 2) at drive phase 0; without a drive, where the series crosses its mean upwards."""
    lag = series.embedding.lag
    if series.period is None:
        return np.asarray(poincare(series.x, dt=series.dt, lag=lag).points)
    return np.asarray(stroboscopic(series.x, series.dt, series.period, lag=lag).points)


def _collect_embedding(prefix: str, chosen: Embedding) -> Columns:
    """Return the curves of an embedding over the lag and over the dimension, and those of false neighbours."""
    axes = {"lag": ("lag", "ami", "ami_floor", "autocorrelation"), "dim": ("dim", "e1", "e2")}
    axes["dim_fnn"] = ("dim_fnn", "fnn", "fnn_distance", "fnn_loneliness")
    table = {}
    for axis, names in axes.items():
        for name in (n for n in names if n in chosen.curves):
            table[prefix + name] = StoredArray((prefix + axis,), chosen.curves[name], CURVE_UNITS.get(name, "1"), name)
    return table


def _collect_exponent(found: Estimate) -> Columns:
    """Return the divergence with its variants and its local slopes (1/s)."""
    dims = {"members": ("lyapunov_variant", "lyapunov_time")}
    table = {}
    for name in ("time", "divergence", "members", "slope"):
        if name in found.curve:
            unit = CURVE_UNITS.get(name, "1") if name != "slope" else "1/s"
            table[f"lyapunov_{name}"] = StoredArray(dims.get(name, ("lyapunov_time",)), found.curve[name], unit, name)
    return table


def _collect_dimension(found: Estimate) -> Columns:
    plane, line = ("d2_dim", "d2_radius"), ("d2_dim",)
    dims: Mapping[str, tuple[str, ...]] = {
        "radius": ("d2_radius",),
        "log_correlation": plane,
        "slope": plane,
        "dim": line,
        "dimension_by_dim": line,
        "low_by_dim": line,
        "high_by_dim": line,
    }
    return {
        f"d2_{name}": StoredArray(d, found.curve[name], "1", name) for name, d in dims.items() if name in found.curve
    }


def _collect_tests(found: AnalysedChannel) -> Columns:
    if not found.tests:
        return {}
    width = max(len(t.values) for t in found.tests)
    values = np.full((len(found.tests), width), np.nan)
    for row, test in zip(values, found.tests, strict=True):
        row[: len(test.values)] = test.values
    originals = np.array([t.original for t in found.tests])
    table = {
        "surrogate_values": StoredArray(("test", "draw"), values, "1", "statistic of the surrogates"),
        "surrogate_original": StoredArray(("test",), originals, "1", "statistic of the recording"),
    }
    if found.surrogate_dims is not None:
        table["surrogate_d2_by_dim"] = StoredArray(
            ("d2_draw", "d2_dim"), found.surrogate_dims, "1", "dimension of surrogates"
        )
    return table
