"""The contracts of methods for a series without a model: embedders, quantifiers, surrogates and denoisers."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar, Generic, Literal

import numpy as np

from lostmotion.parts import Array
from lostmotion.results import Embedding, Estimate
from lostmotion.subjects import Data, Series


class Embedder(ABC):
    """Chooses lag and dimension of the delay vectors of a series."""

    name: ClassVar[str]
    paper: ClassVar[str]

    @abstractmethod
    def choose(self, x: Array, *, dt: float) -> Embedding:
        """Return lag (samples), dimension and Theiler window (samples) for `x` (n,) sampled every `dt` s.

        Example: `results.Embedding(lag=6, dim=3, theiler=20)`. For an unsuitable series raise no error: set `status` to
        one of `results.STATUSES`, and explain it in `says`.
        """


class Quantifier(ABC, Generic[Data]):
    """Estimates one number in `unit`, from a `Series`, or from the `Flow` of a model where `reads = "flow"`."""

    name: ClassVar[str]
    paper: ClassVar[str]
    unit: ClassVar[str]
    reads: ClassVar[Literal["series", "flow"]] = "series"

    @abstractmethod
    def estimate(self, data: Data, *, rng: np.random.Generator) -> Estimate:
        """Return value with its 95 % interval (low <= value <= high), status and curve; draw only from `rng`.

        Example: `Estimate(value, low, high, "ok", unit=self.unit)` from `lostmotion.results`. For unsuitable data raise
        no error: return `Estimate.refused(status, says, unit=self.unit)` with a sentence that explains it.
        """


class Surrogate(ABC):
    """Draws random series that share the properties named in `preserves` with the recording.

    `null` says under which hypothesis the recording is one more such draw. `preserves` names some of "mean",
    "variance", "amplitudes" (sorted values), "spectrum", "cycles". A shuffle: `rng.permuted(x, axis=1)`.
    """

    name: ClassVar[str]
    paper: ClassVar[str]
    null: ClassVar[str]
    preserves: ClassVar[frozenset[str]]

    @abstractmethod
    def draw(self, series: Series, *, draws: int, rng: np.random.Generator) -> Array:
        """Return finite surrogates (draws, m) in the unit of `series.x`, m = n unless `piece` cuts off the ends."""

    def piece(self, series: Series) -> slice:
        """Return the part of the series from which surrogates are made; the recording is tested on the same part."""
        return slice(0, series.n)


class Denoiser(ABC):
    """Removes measurement noise from a series without a model of the machine."""

    name: ClassVar[str]
    paper: ClassVar[str]

    @abstractmethod
    def clean(self, series: Series, *, noise: float, rng: np.random.Generator) -> Array:
        """Return the cleaned series (n,), finite, in the unit of `series.x`; `noise` is the noise level (sd) in it.

        Do not change `series.x`. A moving average: `return np.convolve(series.x, np.ones(3) / 3.0, mode="same")`.
        """
