"""Terms that are no force: what stands between the machine and the recording of its drive and of its response."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable

from lostmotion.contracts import Array, Term, Values

Input = Callable[[Array, int], Array]
"""A recorded input: its value (order 0) or its first derivative (order 1) at times (s) of any shape."""


class DriveTerm(Term):
    """Something between the recorded excitation and the one that acts: no force, but another input.

    `true` returns what acts at the times `t` (s from the start of the recording), or its time derivative (`order` 1,
    for a model that is driven by a base velocity), of the recorded input `u`; `p` is as for `Term.force`.
    """

    acts = "drive"

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return no force."""
        return 0.0

    @staticmethod
    @abstractmethod
    def true(u: Input, t: Array, p: Values, order: int) -> Array:
        """Return the input that acts at times `t`, as `t`, or its derivative."""


class SensorTerm(Term):
    """Something between the motion and its recording: no force.

    The sensor shows `gain(p)` times what is there, `delay(p)` seconds late, `rounded` at the end. One that leaves marks
    in the values themselves, as rounding does, says by `marks` what they tell; it is not fitted by likelihood.
    """

    acts = "sensor"

    @staticmethod
    def force(t: float, x: float, v: float, u: Array, p: Values, s: Values) -> float:
        """Return no force."""
        return 0.0

    @staticmethod
    def gain(p: Values) -> float:
        """Return what the sensor shows of one unit."""
        return 1.0

    @staticmethod
    def delay(p: Values) -> float:
        """Return how late it shows it, in s."""
        return 0.0

    @staticmethod
    def rounded(z: Array, p: Values) -> Array:
        """Return the shown values (samples,) as they are stored."""
        return z

    @staticmethod
    def marks(z: Array) -> tuple[Values, Values]:
        """Return the parameters that the stored values (samples,) betray, with their errors; or nothing."""
        return (), ()

    @staticmethod
    def scatter(p: Values) -> float:
        """Return the standard deviation of the error that such marks bring with them."""
        return 0.0

    @property
    def marked(self) -> bool:
        """Whether the values themselves tell of this term, so that it is not fitted."""
        return type(self).marks is not SensorTerm.marks
