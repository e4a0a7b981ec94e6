"""The embedders: how the delay is chosen, and how the dimension."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from lostmotion.contracts import Array, Embedder
from lostmotion.errors import ContractError
from lostmotion.kernels.neighbours import Norm
from lostmotion.results import Embedding
from lostmotion_plugins.embedders.delay import (
    Delay,
    by_autocorrelation,
    by_information,
    by_neighbours,
    tamed,
    theiler_window,
)
from lostmotion_plugins.embedders.dimension import (
    EmbeddingDimension,
    Unfolding,
    by_cao,
    by_false_neighbours,
    room,
    unfold,
)

_CAO = "Cao, Physica D 110 (1997) 43-50"
_FRASER = "Fraser, Swinney, Physical Review A 33 (1986) 1134-1140"


@dataclass(frozen=True)
class AmiCao(Embedder):
    """First minimum of the average mutual information in bins, and Cao's E1 and E2.

    `longest` is the last lag looked at and `bins` the number of bins a side (0: chosen from the series);
    `equal_counts` makes bins of equal counts, for series with outliers; a minimum must stand out by `prominence`
    standard errors. `dims` is the last dimension looked at; E1 has levelled off above `level` where it rises by less
    than `change`.
    """

    longest: int = 0
    bins: int = 0
    equal_counts: bool = False
    prominence: float = 3.0
    dims: int = 8
    norm: Norm = "max"
    change: float = 0.05
    level: float = 0.9
    name: ClassVar[str] = "ami_cao"
    paper: ClassVar[str] = f"{_FRASER}; {_CAO}"

    def choose(self, x: Array, *, dt: float) -> Embedding:
        delay = by_information(
            tamed(x), self.longest, bins=self.bins, equal_counts=self.equal_counts, prominence=self.prominence
        )
        return _with_cao(x, delay, dt, self)


@dataclass(frozen=True)
class AmiFnn(Embedder):
    """First minimum of the average mutual information in bins, and false nearest neighbours.

    `ratio` and `loneliness` are Kennel's R_tol and A_tol; `share` of the neighbours may be false. For the other
    options see `ami_cao`.
    """

    longest: int = 0
    bins: int = 0
    equal_counts: bool = False
    prominence: float = 3.0
    dims: int = 8
    norm: Norm = "euclidean"
    ratio: float = 10.0
    loneliness: float = 2.0
    share: float = 0.01
    name: ClassVar[str] = "ami_fnn"
    paper: ClassVar[str] = f"{_FRASER}; Kennel, Brown, Abarbanel, Physical Review A 45 (1992) 3403-3411"

    def choose(self, x: Array, *, dt: float) -> Embedding:
        delay = by_information(
            tamed(x), self.longest, bins=self.bins, equal_counts=self.equal_counts, prominence=self.prominence
        )
        return _embedded(
            x, delay, dt, _Search(self.dims, self.norm, self.ratio, self.loneliness), lambda found: self._choice(found)
        )

    def _choice(self, found: Unfolding) -> EmbeddingDimension:
        return by_false_neighbours(found, share=self.share)


@dataclass(frozen=True)
class AmiKnnCao(Embedder):
    """First minimum of the mutual information by nearest neighbours, which needs no bins, and Cao's E1 and E2.

    The mutual information is averaged over `most` samples with their `neighbours` nearest neighbours; `seed` is that
    of the dither which breaks the ties of quantised series. For the other options see `ami_cao`.
    """

    longest: int = 0
    neighbours: int = 4
    most: int = 2000
    seed: int = 0
    prominence: float = 3.0
    dims: int = 8
    norm: Norm = "max"
    change: float = 0.05
    level: float = 0.9
    name: ClassVar[str] = "ami_knn_cao"
    paper: ClassVar[str] = f"Kraskov, Stoegbauer, Grassberger, Physical Review E 69 (2004) 066138; {_CAO}"

    def choose(self, x: Array, *, dt: float) -> Embedding:
        rng = np.random.default_rng(self.seed)
        delay = by_neighbours(
            tamed(x), self.longest, rng=rng, k=self.neighbours, most=self.most, prominence=self.prominence
        )
        return _with_cao(x, delay, dt, self)


@dataclass(frozen=True)
class AutocorrelationCao(Embedder):
    """Where the autocorrelation falls to 1/e, or crosses zero first, and Cao's E1 and E2: for linear motions.

    For the other options see `ami_cao`.
    """

    crossing: Literal["1/e", "zero"] = "1/e"
    longest: int = 0
    dims: int = 8
    norm: Norm = "max"
    change: float = 0.05
    level: float = 0.9
    name: ClassVar[str] = "autocorrelation_cao"
    paper: ClassVar[str] = f"Kantz, Schreiber, Nonlinear Time Series Analysis, Cambridge (2004), sect. 9.2; {_CAO}"

    def choose(self, x: Array, *, dt: float) -> Embedding:
        level = 0.0 if self.crossing == "zero" else float(np.exp(-1.0))
        return _with_cao(x, by_autocorrelation(tamed(x), self.longest, level=level), dt, self)


@dataclass(frozen=True)
class Fixed(Embedder):
    """Lag, dimension and Theiler window as they are given; `theiler` -1 has the window chosen from the series."""

    lag: int = 1
    dim: int = 3
    theiler: int = -1
    name: ClassVar[str] = "fixed"
    paper: ClassVar[str] = "Takens, Lecture Notes in Mathematics 898 (1981) 366-381; Theiler, Phys. Rev. A 34 (1986)"

    def choose(self, x: Array, *, dt: float) -> Embedding:
        if self.lag < 1 or self.dim < 1:
            raise ContractError(f"fixed: lag {self.lag} and dim {self.dim} are given, at least 1 and 1 are wanted")
        if self.theiler >= 0:
            return Embedding(self.lag, self.dim, self.theiler)
        window, says = theiler_window(tamed(x))
        return Embedding(self.lag, self.dim, window, status="uncertain" if says else "ok", says=says)


@dataclass(frozen=True)
class _Search:
    """What a search for neighbours in growing dimension is told."""

    dims: int
    norm: Norm
    ratio: float = 10.0
    loneliness: float = 2.0


def _with_cao(x: Array, delay: Delay, dt: float, of: AmiCao | AmiKnnCao | AutocorrelationCao) -> Embedding:
    """Return the embedding with that delay and the dimension by Cao's method."""
    return _embedded(
        x, delay, dt, _Search(of.dims, of.norm), lambda found: by_cao(found, change=of.change, level=of.level)
    )


def _embedded(
    x: Array, delay: Delay, dt: float, search: _Search, choice: Callable[[Unfolding], EmbeddingDimension]
) -> Embedding:
    """Return the embedding with that delay and the dimension that `choice` reads from the search."""
    theiler, short = theiler_window(tamed(x))
    curves = {**delay.curves, "lag": delay.curves["lag"] * dt}
    dims = room(len(x), delay.lag, search.dims, theiler)
    if dims < min(3, search.dims):
        says = (
            f"{len(x)} samples are too few to look for a dimension at lag {delay.lag} with a Theiler window of "
            f"{theiler}: dimension 2 is taken for want of a better one"
        )
        dimension = EmbeddingDimension(2, "given", "too_short", says)
    else:
        found = unfold(
            x,
            delay.lag,
            dims=dims,
            theiler=theiler,
            norm=search.norm,
            ratio=search.ratio,
            loneliness=search.loneliness,
        )
        dimension = choice(found)
        curves |= {name: getattr(found, name) for name in ("dim", "e1", "e2", "fnn", "fnn_distance", "fnn_loneliness")}
        curves["dim_fnn"] = found.dim
    worst = next((s for s in (dimension.status, delay.status) if s != "ok"), "uncertain" if short else "ok")
    says = "; ".join(part for part in (delay.says, dimension.says, short) if part)
    return Embedding(delay.lag, dimension.dim, theiler, curves, (delay.method, dimension.method), worst, says)
