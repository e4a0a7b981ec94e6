"""The arrays of a diagnosis, as they are stored in `arrays.nc` and drawn in the report."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lostmotion.contracts import Array
from lostmotion.diagnosis.compared_motions import take_section
from lostmotion.diagnosis.friction_level import list_levels
from lostmotion.diagnosis.outcome import Outcome
from lostmotion.diagnosis.stages import ForceLocation, SearchResult, list_physical_keys
from lostmotion.inference.fit import Fit
from lostmotion.quantities import unit_of
from lostmotion.storage import StoredArray

PORTRAIT = 3000
MOTION_NAMES = {
    "recorded": "smoothed motion of the recording",
    "before": "free run of the nominal model",
    "after": "free run of the augmented model",
}
PREDICTED = "free-running prediction of the"


def list_arrays(
    outcome: Outcome, motions: Mapping[str, Array]
) -> tuple[dict[str, StoredArray], dict[str, StoredArray]]:
    """Return the variables and the coordinates of `arrays.nc`; `motions` are those of `list_motions`."""
    d = outcome.diagnosis
    levels, level_time = list_levels(outcome, name_units(d)["force"])
    variables = {
        **_list_series(outcome),
        **_list_further_sensors(outcome),
        **_list_curves(d),
        **_list_portraits(d, motions),
        **_list_growth(outcome),
        **_list_draws(outcome),
        **levels,
    }
    coords = {
        **level_time,
        "time": StoredArray(("time",), d.shown.time, "s", "time from the start of the recording"),
        "covariate": StoredArray(("covariate",), list(d.located.curves)),
        "lead": StoredArray(("lead",), outcome.before.lead, "s", "time from the start of a free run"),
        "lag": StoredArray(("lag",), np.arange(1, len(outcome.before.acf) + 1), "1", "lag in samples"),
        "parameter": StoredArray(("parameter",), list_physical_keys(d.before)),
        "parameter_after": StoredArray(("parameter_after",), list_physical_keys(d.after)),
        "parameter_unit": StoredArray(("parameter",), _list_units(d.before)),
        "parameter_after_unit": StoredArray(("parameter_after",), _list_units(d.after)),
    }
    return variables, coords


def _list_units(fit: Fit) -> list[str]:
    """Return the SI unit of each physical parameter of a fit."""
    units = {free.key: free.unit for free in fit.posterior.space.free}
    return [units[key] for key in list_physical_keys(fit)]


def name_units(d: SearchResult) -> dict[str, str]:
    """Return the SI units of position, velocity, acceleration and force in the model of a diagnosis."""
    if d.after.posterior.system.model.motion == "rotation":
        return {"position": "rad", "velocity": "rad/s", "acceleration": "rad/s^2", "force": "N m"}
    return {"position": "m", "velocity": "m/s", "acceleration": "m/s^2", "force": "N"}


def _list_series(outcome: Outcome) -> dict[str, StoredArray]:
    d, units = outcome.diagnosis, name_units(outcome.diagnosis)
    shown, missing = d.shown, d.located.missing
    model = d.after.posterior.system.model
    seen = unit_of(shown.channel, model.motion)
    heldout = np.ones(shown.samples)
    if shown.samples > d.held[0].samples:
        heldout[: shown.samples - d.held[0].samples] = 0.0
    time = ("time",)
    table = {
        "response": StoredArray(time, shown.response, seen, f"recorded {shown.sensors[0].label}"),
        "heldout": StoredArray(time, heldout, "1", "1 where no fit has seen the data"),
        "record": StoredArray(time, np.zeros(shown.samples), "1", "number of the recording"),
        "position": StoredArray(time, missing.position, units["position"], "smoothed position"),
        "velocity": StoredArray(time, missing.velocity, units["velocity"], "smoothed velocity"),
        "missing_force": StoredArray(time, missing.force, units["force"], "missing force, found terms taken out"),
        "missing_force_sd": StoredArray(time, missing.sd, units["force"], "standard deviation of the missing force"),
        "forecast_before": StoredArray(time, outcome.before.forecasts[:, 0], seen, f"{PREDICTED} nominal model"),
        "restart": StoredArray(time, outcome.before.restarts, "1", "1 where a free run begins"),
    }
    if not shown.free:
        unit = unit_of(model.inputs[shown.lead], model.motion)
        table["excitation"] = StoredArray(time, shown.excitation, unit, "measured input")
    if d.left is not None:
        left = d.left.missing
        table["left_force"] = StoredArray(time, left.force, units["force"], "force left unexplained")
        table["left_force_sd"] = StoredArray(time, left.sd, units["force"], "standard deviation of the force left")
        table["law"] = StoredArray(time, d.law, units["force"], "force of the found terms")
        table["forecast_after"] = StoredArray(time, outcome.after.forecasts[:, 0], seen, f"{PREDICTED} augmented model")
    return table


def _list_further_sensors(outcome: Outcome) -> dict[str, StoredArray]:
    """Return readings and predictions of the second and further sensors: `response_2`, `forecast_before_2`, ..."""
    d, time, table = outcome.diagnosis, ("time",), {}
    motion = d.after.posterior.system.model.motion
    for i, sensor in enumerate(d.shown.sensors[1:], start=1):
        unit = unit_of(sensor.channel, motion)
        table[f"response_{i + 1}"] = StoredArray(time, d.shown.readings[:, i], unit, f"recorded {sensor.label}")
        before, after = outcome.before.forecasts[:, i], outcome.after.forecasts[:, i]
        table[f"forecast_before_{i + 1}"] = StoredArray(time, before, unit, f"{PREDICTED} nominal model")
        if d.found:
            table[f"forecast_after_{i + 1}"] = StoredArray(time, after, unit, f"{PREDICTED} augmented model")
    return table


def _list_curves(d: SearchResult) -> dict[str, StoredArray]:
    units = {**name_units(d), "phase": "cycles", "time": "s"}
    units |= {name: units[name.split()[0]] for name in d.located.curves}
    names = list(d.located.curves)
    width = max(len(c.mean) for c in d.located.curves.values())
    force = units["force"]

    def stacked(located: ForceLocation, part: str) -> Array:
        return np.array([_pad_values(getattr(located.curves[n], part), width) for n in names])

    dims = ("covariate", "bin")
    table = {"bin_center": StoredArray(dims, stacked(d.located, "center"), "see covariate_unit", "middle of each bin")}
    table["covariate_unit"] = StoredArray(("covariate",), [units[n] for n in names])
    for part in ("mean", "low", "high"):
        table[f"before_{part}"] = StoredArray(dims, stacked(d.located, part), force, f"missing force, {part}")
        if d.left is not None:
            table[f"after_{part}"] = StoredArray(dims, stacked(d.left, part), force, f"force left, {part}")
    if d.law_curves:
        means = np.array([_pad_values(d.law_curves[n].mean, width) for n in names])
        table["law_mean"] = StoredArray(dims, means, force, "force of the found terms")
    return table


def _pad_values(values: Array, width: int) -> Array:
    return np.concatenate([values[:width], np.full(max(width - len(values), 0), np.nan)])


def _list_growth(outcome: Outcome) -> dict[str, StoredArray]:
    lead, lag = ("lead",), ("lag",)
    said = "rms error over the standard deviation of the response"
    table = {
        "growth_before": StoredArray(lead, outcome.before.growth, "1", said),
        "acf_before": StoredArray(lag, outcome.before.acf, "1", "autocorrelation of standardised one-step errors"),
        "acf_limit": StoredArray(
            (), 1.96 / np.sqrt(outcome.diagnosis.held[0].samples), "1", "95 % bound of white errors"
        ),
    }
    if outcome.diagnosis.found:
        table["growth_after"] = StoredArray(lead, outcome.after.growth, "1", said)
        table["acf_after"] = StoredArray(lag, outcome.after.acf, "1", "autocorrelation of standardised one-step errors")
    return table


def _list_draws(outcome: Outcome) -> dict[str, StoredArray]:
    meaning = "draws of the parameters,"
    return {
        "posterior_before": StoredArray(
            ("draw", "parameter"), outcome.draws_before, "see parameter_unit", f"{meaning} nominal model"
        ),
        "posterior_after": StoredArray(
            ("draw", "parameter_after"),
            outcome.draws_after,
            "see parameter_after_unit",
            f"{meaning} with what was found",
        ),
    }


def _list_portraits(d: SearchResult, motions: Mapping[str, Array]) -> dict[str, StoredArray]:
    """Return phase portraits and stroboscopic sections of the recording and of free runs of both models."""
    units, period = name_units(d), d.shown.period
    table = {}
    for name, states in motions.items():
        tail = states[-PORTRAIT:] if period else states[:: max(1, len(states) // PORTRAIT)]
        points = take_section(states, period) if period else None
        for axis, column, unit in (("x", 0, units["position"]), ("v", 1, units["velocity"])):
            table[f"portrait_{name}_{axis}"] = StoredArray(("portrait",), tail[:, column], unit, MOTION_NAMES[name])
            if points is not None:
                meaning = f"{MOTION_NAMES[name]}, once each drive period"
                table[f"section_{name}_{axis}"] = StoredArray(("section",), points[:, column], unit, meaning)
    return table
