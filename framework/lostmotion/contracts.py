"""The seven kinds of plugin, in one file: subclass one once, as a frozen dataclass.

`rhs`, `observe`, `force` and `rate` are plain scalar Python on NumPy arrays. The host compiles them with numba into one
kernel: they may use `math`, arithmetic, branches and such only. What is *estimated* is an entry of `p`, no field.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Literal, Self

import numpy as np

from lostmotion.errors import ContractError, nearest
from lostmotion.parts import Array, Group, Interface, Param
from lostmotion.quantities import Dimension
from lostmotion.results import Embedding, Estimate
from lostmotion.subjects import Data, Flow, Orbit, Series

if TYPE_CHECKING:
    from lostmotion.likelihood.engine import Dynamics, Innovations, Points, Smoothed
    from lostmotion.likelihood.observation import Observation

__all__ = [
    "KINDS", "PSEUDO_NEEDS", "Array", "Assembly", "Data", "Denoiser", "Drive", "DriveTerm", "Embedder", "Engine",
    "Flow", "Group", "Input", "Interface", "Model", "Motion", "Orbit", "Param", "Quantifier", "SensorTerm", "Series",
    "Surrogate", "Term", "Values", "place_of"]  # fmt: skip

Input = Callable[[Array, int], Array]
"""A recorded input: its value (order 0) or its first derivative (order 1) at times (s) of any shape."""
Values = tuple[float, ...]
"""What a term is handed for its parameters and states: numbers to be indexed, nothing to be written."""
Drive = tuple[float, float, float]
Motion = Literal["translation", "rotation"]
PSEUDO_NEEDS = (
    "step", "finest", "mobility", "inertia", "omega", "amplitude", "stiffness", "play", "contact", "acceleration",
    "force_input", "shake_input",
)  # fmt: skip
"""What a term may need that is no parameter of that name: the integration `step` (s), which may be shorter or longer
from one to the next, the `finest` of these, and `mobility`, step / inertia:
the velocity that a unit force gives the body in a step. A law that jumps at zero velocity is as wide as `force *
mobility`, so that it sticks without turning the integration stiff. `omega` is the angular frequency of the drive
(rad/s), `amplitude` sqrt(2) of its rms; `stiffness` and `play` those of the spring at the place. `contact` is the
stiffness of a contact with play at the place, 0 where there is none. `inertia` is what a force at the place moves,
`acceleration` what all other forces give the body there; `force_input` and `shake_input` say which entry of `u` is the
force on that body and the acceleration of the base: -1 where none is."""


class Model(ABC):
    """A machine as a system of first-order equations, driven by what was *measured* going in.

    `states` names the entries of `y`; `inputs` those of `u`, zero where nothing drives them: "force", "second_force",
    "base_position" with "base_velocity", "base_acceleration" (motion is then relative, but for what accelerometers
    show). `channels` names by quantity what `observe` writes. `motion` is "translation" (N, m) or "rotation"
    (N m, rad); where it is a field, `motions` lists what it can be.
    """

    name: ClassVar[str]
    paper: ClassVar[str]
    motion: Motion
    motions: ClassVar[tuple[str, ...]] = ()
    states: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[str, ...]]
    channels: ClassVar[tuple[str, ...]]
    params: ClassVar[tuple[Param, ...]]
    interfaces: ClassVar[tuple[Interface, ...]]
    groups: ClassVar[tuple[Group, ...]] = ()

    @staticmethod
    @abstractmethod
    def rhs(t: float, y: Array, u: Array, p: Array, dydt: Array) -> None:
        """Write the time derivative of the states `y` (len(states),) into `dydt`."""

    @staticmethod
    @abstractmethod
    def observe(t: float, y: Array, dydt: Array, u: Array, p: Array, seen: Array) -> None:
        """Write what the sensors see into `seen` (len(channels),); `dydt` already holds the forces of the terms."""

    @classmethod
    def exact(cls, values: Mapping[str, float], drive: Drive, start: Array | None) -> Flow | None:
        """Return the flow under a drive (amplitude, omega, phase) where it is known in closed form, or None."""
        return None

    @property
    def driven(self) -> tuple[str, ...]:
        """The inputs that a single drive moves: the first one, and with a base position its velocity."""
        return self.inputs[: 2 if self.inputs[:1] == ("base_position",) else 1]

    def turned(self, motion: str) -> Self:
        """Return the model in that motion, or raise a `ContractError` where it cannot be in it."""
        if motion not in (known := self.motions or (self.motion,)):
            words = " or ".join(known)
            raise ContractError(f"{self.name} is of {words}, not of {motion}: ask for {words}, or another model")
        return self if motion == self.motion else replace(self, motion=motion)  # type: ignore[type-var]

    def __add__(self, term: Term) -> Assembly:
        return Assembly(self) + term


class Term(ABC):
    """One piece of physics that a model may lack: a force at an interface, with states of its own if it needs them.

    `force` returns the generalised force on the body in positive direction (friction is negative for v > 0), with
    `x`, `v` the relative motion at the interface `at`, `p` the own `params` followed by `needs`, `s` the own states.
    `physics` is a sentence with the parameters in braces; `formula` the law in plain text. `resembles` names terms that
    tell a similar story, `equals` those that no recording of a machine that does not age can tell from it. `begins` are
    the dimensions of those states that may be anything of natural size at first; all others begin at zero. One that
    does the same `anywhere` is tried at the ground alone. `force` and `rate` are static, or methods that read numbers
    among the fields of the term. `unlikely` is the log odds by which an engineer looks for other causes first.
    """

    at: str
    acts: ClassVar[Literal["motion", "drive", "sensor"]] = "motion"
    name: ClassVar[str]
    physics: ClassVar[str]
    formula: ClassVar[str]
    paper: ClassVar[str]
    params: ClassVar[tuple[Param, ...]]
    states: ClassVar[tuple[str, ...]] = ()
    begins: ClassVar[tuple[Dimension, ...]] = ()
    needs: ClassVar[tuple[str, ...]] = ()
    motions: ClassVar[tuple[str, ...]] = ("translation", "rotation")
    further: ClassVar[tuple[Param, ...]] = ()
    resembles: ClassVar[tuple[str, ...]] = ()
    equals: ClassVar[tuple[str, ...]] = ()
    anywhere: ClassVar[bool] = False
    unlikely: ClassVar[float] = 0.0

    @staticmethod
    @abstractmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return the force (N or N m) on the body in positive direction."""

    @staticmethod  # noqa: B027 - most terms have no states of their own
    def rate(t: float, x: float, v: float, u: Array, p: Values, s: Values, dsdt: Array) -> None:
        """Write the time derivative of the own states into `dsdt`; a term without states leaves this alone."""

    def prepared(self, p: Array) -> Array:
        """Return what a law is handed for `params` and `needs` (points, count): once for each point, not each step."""
        return p

    @staticmethod
    def derived(p: Values) -> Values:
        """Return the numbers that `further` names: what a reader asks for beside the parameters, such as a phase."""
        return ()

    def commoner(self, values: Mapping[str, float]) -> Mapping[str, Mapping[str, float]]:
        """Return commoner terms that are the same force together at these values, by name, with their values; or none.

        A set of terms is told with these: a part of friction that has one direction is, where it is small, an offset.
        """
        return {}

    @property
    def marked(self) -> bool:
        """Whether the stored values themselves tell of this term, so that it is not fitted."""
        return False

    def null(self) -> dict[str, float]:
        """Return the parameters, with their values, at which the term does nothing."""
        return {q.name: q.null for q in self.params if q.null is not None}

    def fits(self, model: Model) -> bool:
        """Return whether the term can act in `model`: the place, the kind of motion and the needs exist there."""
        try:
            return bool(place_of(model, self))
        except ContractError:
            return False


class _Beside(Term):
    """A term that acts beside the machine, and is no force."""

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return no force."""
        return 0.0


class DriveTerm(_Beside):
    """Something between the recorded excitation and the one that acts: no force, but another input.

    `true` returns what acts of the recorded input `u` at times `t` (s from the start of the recording), or its time
    derivative (`order` 1, for a base velocity); `p` is as for `Term.force`.
    """

    acts = "drive"

    @staticmethod
    @abstractmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        """Return the input that acts at times `t`, as `t`, or its derivative."""


class SensorTerm(_Beside):
    """Something between the motion and its recording: no force.

    It shows `gain(p)` times what is there and `offset(p)` more, `delay(p)` s late, `bent` and `rounded`. One with
    states shows the first of them: `rate` is told what the `channel`, a field of its own, shows in place of `x`. What
    shows in the stored values (`quantisation`) is not fitted. One that is `relative` is tried where there are several
    sensors.
    """

    acts = "sensor"
    channel: str = "position"
    relative: ClassVar[bool] = False

    @staticmethod
    def gain(p: Values) -> float:
        """Return what the sensor shows of one unit."""
        return 1.0

    @staticmethod
    def offset(p: Values) -> float:
        """Return what the sensor shows where nothing is."""
        return 0.0

    @staticmethod
    def delay(p: Values) -> float:
        """Return how late it shows it, in s."""
        return 0.0

    @staticmethod
    def bent(x: Array, p: Values) -> Array:
        """Return what the sensor shows where it should show `x`, of any shape; it grows with x."""
        return x

    @staticmethod
    def rounded(z: Array, p: Values) -> Array:
        """Return the shown values (samples,) as they are stored."""
        return z

    @staticmethod
    def quantisation(z: Array) -> tuple[Values, Values]:
        """Return the parameters that the stored values (samples,) betray, with their errors; or nothing."""
        return (), ()

    @staticmethod
    def scatter(p: Values) -> float:
        """Return the standard deviation of the error that such marks bring with them."""
        return 0.0

    @property
    def marked(self) -> bool:
        """Whether the values themselves tell of this term, so that it is not fitted."""
        return type(self).quantisation is not SensorTerm.quantisation


@dataclass(frozen=True)
class Assembly:
    """A model plus named terms: the one description that is simulated, fitted, diagnosed and drawn."""

    model: Model
    terms: tuple[Term, ...] = ()

    def __add__(self, term: Term) -> Assembly:
        place_of(self.model, term)
        if any((t.name, t.at) == (term.name, term.at) for t in self.terms):
            raise ContractError(f"{term.name} at {term.at} is in the model already: add it once, or at another place")
        return replace(self, terms=(*self.terms, term))

    @property
    def label(self) -> str:
        """The sum as people write it, for instance `lin_backlash + coulomb_friction`."""
        return " + ".join([self.model.name, *(t.name for t in self.terms)])


def place_of(model: Model, term: Term) -> Interface:
    """Return the interface of `model` at which `term` acts, or raise a `ContractError` that says what is wanting."""
    beside = (term.acts, *(model.inputs if term.acts == "drive" else (term.at,)))
    named = {name: replace(_BESIDE, name=name) for name in beside}
    places = {i.name: i for i in model.interfaces} if term.acts == "motion" else named
    if term.at not in places:
        raise ContractError(
            f"{term.name} acts at {term.at!r}, but {model.name} has {', '.join(places)}{nearest(term.at, places)}"
        )
    place = places[term.at]
    known = {*place.holds, *PSEUDO_NEEDS} - (set() if place.stiffness else {"stiffness", "play"})
    if lacking := [n for n in term.needs if n not in known]:
        raise ContractError(f"{term.name} needs {', '.join(lacking)}, which {model.name} does not have at {term.at}")
    if model.motion not in term.motions:
        raise ContractError(f"{term.name} is a law of {' or '.join(term.motions)}; {model.name} is {model.motion}")
    return place


_BESIDE = Interface("", -1, "", lambda y, u: (0.0, 0.0))


class Embedder(ABC):
    """Chooses the delay and the dimension in which a series unfolds."""

    name: ClassVar[str]
    paper: ClassVar[str]

    @abstractmethod
    def choose(self, x: Array, *, dt: float) -> Embedding:
        """Return lag, dim and Theiler window for `x` (n,) sampled every `dt` s, with the curves behind them."""


class Quantifier(ABC, Generic[Data]):
    """Measures one number, in `unit`: `Quantifier[Series]` of a recording, `Quantifier[Flow]` with `reads = "flow"`."""

    name: ClassVar[str]
    paper: ClassVar[str]
    unit: ClassVar[str]
    reads: ClassVar[Literal["series", "flow"]] = "series"

    @abstractmethod
    def estimate(self, data: Data, *, rng: np.random.Generator) -> Estimate:
        """Return value, low, high, status and curve; a refusal is a status with a sentence, not an exception."""


class Surrogate(ABC):
    """Draws series that share what `preserves` names with the recording and are random otherwise.

    `null` is the hypothesis, in words, under which the recording is one more such draw. `preserves` names some of
    "mean", "variance", "amplitudes" (the sorted values), "spectrum", "cycles" (the shape of single periods).
    """

    name: ClassVar[str]
    paper: ClassVar[str]
    null: ClassVar[str]
    preserves: ClassVar[frozenset[str]]

    @abstractmethod
    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        """Return surrogates (draws, m) of the series, m = n unless `piece` cuts its ends off."""

    def piece(self, series: Series) -> slice:
        """Return the part of the series that surrogates are made of: the recording is compared on the same part."""
        return slice(0, series.n)


class Denoiser(ABC):
    """Removes measurement noise from a series without a model of it."""

    name: ClassVar[str]
    paper: ClassVar[str]

    @abstractmethod
    def clean(self, series: Series, *, noise: float, rng: np.random.Generator) -> Array:
        """Return the cleaned series (n,); `noise` is the estimated standard deviation of the noise in it, as x."""


class Engine(ABC):
    """Filters, smooths and simulates a model with its terms at many parameter points at once; threads may call it.

    A point depends on neither the others nor their order. One that leaves all numbers is told by `reached`, no error.
    """

    name: ClassVar[str]
    paper: ClassVar[str]

    @abstractmethod
    def filter(self, dynamics: Dynamics, observation: Observation, points: Points) -> Innovations:
        """Return one-step errors and their variances, (points, samples, sensors)."""

    @abstractmethod
    def smooth(self, dynamics: Dynamics, observation: Observation, points: Points) -> Smoothed:
        """Return filtered and smoothed states of one point, and their covariances."""

    @abstractmethod
    def simulate(
        self, dynamics: Dynamics, points: Points, start: Array, steps: int, kicks: Array | None = None
    ) -> Array:
        """Return the states (points, steps, n) of free runs from `start` (points, n), NaN behind the last finite one.

        They begin at the samples `points.first` of their drives; `kicks` (points, steps, n) are added after the first.
        """


KINDS: Mapping[str, type[Any]] = {
    kind.__name__.lower(): kind for kind in (Model, Term, Embedder, Quantifier, Surrogate, Denoiser, Engine)
}
