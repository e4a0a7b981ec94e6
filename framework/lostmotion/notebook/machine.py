"""A fitted model that can be simulated under another drive."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lostmotion.arguments import anything, checked, mapping, maybe, number, positive
from lostmotion.contracts import Array, Assembly, Machine, Model, Term
from lostmotion.diagnosis.outcome import Outcome
from lostmotion.errors import CaseError, DataError, nearest
from lostmotion.likelihood.sensors import Sensor
from lostmotion.quantities import unit_of
from lostmotion.recording import Recording
from lostmotion.recording.load import make_recording
from lostmotion.recording.made import RecordingLayout, collect_columns
from lostmotion.registry import Registry
from lostmotion.results.background import FittedMachine
from lostmotion.simulation.simulated_machine import FreeMotion, run_free_motion
from lostmotion.written import model_of

Signal = ArrayLike | Callable[[Array], Array]


@dataclass(frozen=True, eq=False)
class FittedModel:
    """A model with its terms, the values (SI) of all parameters, and the sensors of the case."""

    model: Machine
    terms: tuple[Term, ...]
    values: Mapping[str, float]
    sensors: tuple[Sensor, ...]
    learned: tuple[str, ...] = ()

    @property
    def assembly(self) -> Assembly:
        """The model plus its terms."""
        return Assembly(self.model, self.terms)

    @checked(
        duration=maybe(positive),
        rate=maybe(positive),
        initial=maybe(mapping(number, "{'position': 0.01}")),
    )
    def simulate(
        self,
        inputs: Mapping[str, Signal] | Recording,
        *,
        duration: float | None = None,
        rate: float | None = None,
        initial: Mapping[str, float] | None = None,
    ) -> Recording:
        """Return the readings of the sensors for a free motion under `inputs`, without noise, in SI units.

        `inputs` maps inputs of the model to arrays (n,) sampled at `rate` (Hz), or to functions of time (s); or it is a
        recording whose inputs are used. The motion begins at rest, except for the states in `initial`, and lasts
        `duration` (s). Raises `CaseError` where it cannot be simulated.
        """
        if self.learned:
            raise CaseError(
                f"{' and '.join(self.learned)} was learned and is not stored with the result: simulate the result of"
                " `diagnose` in the same session, or diagnose again"
            )
        signals, rate = _read_signals(inputs, rate)
        samples = _count_samples(signals, duration, rate)
        columns = _make_inputs(self.model, signals, rate)
        moved = run_free_motion(self.assembly, self.values, columns, samples, rate, initial or {})
        driven = {name: u for name, u in zip(self.model.inputs, moved.inputs.T, strict=True) if name in signals}
        names = {sensor.label: sensor.channel for sensor in self.sensors}
        units = {name: unit_of(name, self.model.motion) for name in (*driven, *names.values())}
        which = ({name: name for name in driven}, {channel: label for label, channel in names.items()})
        shown = {sensor.label: self._simulate_sensor(moved, sensor) for sensor in self.sensors}
        units |= {label: units[channel] for label, channel in names.items()}
        layout = RecordingLayout(which, units, rate=rate, name=f"simulated {self.assembly.label}")
        return make_recording(collect_columns({**driven, **shown}, layout))

    @staticmethod
    def _simulate_sensor(moved: FreeMotion, sensor: Sensor) -> Array:
        """Return the readings of a sensor (samples,), with the effect of its terms."""
        seen = moved.channels[sensor.channel]
        for term, p in moved.system.at_sensor(moved.full, moved.system.everything, sensor.place):
            seen = term.rounded(term.gain(p) * term.bent(seen, p) + term.offset(p), p)
        for change in moved.system.changes_at_sensor(moved.full, moved.system.everything, sensor.place):
            seen = change.apply(seen, moved.times)
        return seen

    def __repr__(self) -> str:
        values = ", ".join(f"{key} = {value:.4g}" for key, value in self.values.items() if not key.endswith(".since"))
        return f"<FittedModel {self.assembly.label}: {values}>"


def make_fitted_model(outcome: Outcome, machine: FittedMachine) -> FittedModel:
    """Return the model of a diagnosis made in this session, with learned forces if there are any."""
    posterior = outcome.diagnosis.after.posterior
    system = posterior.system
    terms = tuple(t for key, t in zip(system.keys, system.terms, strict=True) if key in posterior.active)
    return FittedModel(system.model, terms, machine.values, outcome.diagnosis.shown.sensors)


def restore_fitted_model(machine: FittedMachine, registry: Registry) -> FittedModel:
    """Return the model described by the `machine` of a result; learned forces are not among its terms."""
    if machine.equations:
        cls: Any = model_of(machine.equations, units=machine.units, params=[*machine.values])
        made: Model = cls()
    else:
        made = registry.make("dynamics" if machine.model in registry.names("dynamics") else "model", machine.model)
    kept = (term for term in machine.terms if term.key not in machine.learned)
    terms = tuple(registry.make("term", term.name, at=term.at) for term in kept)
    sensors = tuple(Sensor(sensor.channel, sensor.name) for sensor in machine.sensors)
    return FittedModel(made.turned(machine.motion), terms, machine.values, sensors, machine.learned)


def _read_signals(inputs: Mapping[str, Signal] | Recording, rate: float | None) -> tuple[dict[str, Signal], float]:
    """Return the signals by input, and the rate (Hz) at which arrays are sampled."""
    if isinstance(inputs, Recording):
        return {str(a.attrs["of"]): np.asarray(a) for a in inputs.inputs}, inputs.rate
    if rate is None:
        raise CaseError("the rate is missing: give rate=, the samples per second of the arrays and of the simulation")
    signals: dict[str, Signal] = mapping(anything, "{'force': array} or {'force': function of time}")(inputs, "inputs")
    for name, signal in signals.items():
        values = None if callable(signal) else np.asarray(signal)
        if values is not None and (values.dtype.kind not in "iufb" or values.ndim != 1):
            raise CaseError(f"the input {name!r} is neither an array (n,) of numbers nor a function of time (s)")
    return signals, rate


def _count_samples(signals: Mapping[str, Signal], duration: float | None, rate: float) -> int:
    lengths = {name: len(np.asarray(signal)) for name, signal in signals.items() if not callable(signal)}
    if duration is None and not lengths:
        raise CaseError("the duration is missing: give duration= in s, since no input is an array")
    samples = round(duration * rate) if duration is not None else min(lengths.values())
    if short := [name for name, length in lengths.items() if length < samples]:
        raise DataError(
            f"{short[0]} has {lengths[short[0]]} samples, and {samples} are requested: shorten the duration"
        )
    if samples < 2:
        raise CaseError(f"{samples} samples are requested: at least 2 are needed")
    return samples


def _make_inputs(model: Machine, signals: Mapping[str, Signal], rate: float) -> list[Callable[[Array], Array]]:
    """Return each input of a model as a function of time (s): zero for inputs that are not given."""
    if unknown := [name for name in signals if name not in model.inputs]:
        raise CaseError(
            f"{model.name} has no input {unknown[0]!r}{nearest(unknown[0], model.inputs)}:"
            f" it has {', '.join(model.inputs)}"
        )
    made: list[Callable[[Array], Array]] = []
    for name in model.inputs:
        if name in signals:
            made.append(_make_function(signals[name], rate))
        elif name == "base_velocity" and "base_position" in signals:
            made.append(_differentiate(_make_function(signals["base_position"], rate), rate))
        else:
            made.append(np.zeros_like)
    return made


def _make_function(signal: Signal, rate: float) -> Callable[[Array], Array]:
    if callable(signal):
        return lambda t: np.broadcast_to(np.asarray(signal(t), dtype=float), np.shape(t)).astype(float)
    from scipy.interpolate import CubicSpline

    values = np.asarray(signal, dtype=float)
    if not np.isfinite(values).all():
        raise DataError("an input has values that are not finite: fill the gaps first")
    return CubicSpline(np.arange(len(values)) / rate, values)  # type: ignore[no-any-return]


def _differentiate(position: Callable[[Array], Array], rate: float) -> Callable[[Array], Array]:
    """Return the time derivative of a position by central differences over a hundredth of a sample."""
    h = 0.01 / rate
    return lambda t: (position(t + h) - position(t - h)) / (2.0 * h)
