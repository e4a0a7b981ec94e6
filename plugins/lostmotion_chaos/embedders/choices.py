"""The embedders: each combines a method for the delay with a method for the dimension."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import ClassVar, Literal

import numpy as np

from lostmotion.contracts import Array, Embedder
from lostmotion.errors import ContractError
from lostmotion.results import Embedding
from lostmotion_chaos.embedders.delay import (
    Delay,
    choose_by_autocorrelation,
    choose_by_information,
    choose_by_neighbours,
    choose_theiler_window,
    clip_outliers,
)
from lostmotion_chaos.embedders.dimension import (
    EmbeddingDimension,
    Unfolding,
    choose_by_cao,
    choose_by_false_neighbours,
    limit_dimension,
    unfold,
)
from lostmotion_chaos.kernels.neighbours import Norm

_CAO = "Cao, Physica D 110 (1997) 43-50"
_FRASER = "Fraser, Swinney, Physical Review A 33 (1986) 1134-1140"


@dataclass(frozen=True)
class AmiCao(Embedder):
    """First minimum of the average mutual information in bins, and Cao's E1 and E2.

    `longest` is the last lag that is examined and `bins` the number of bins on each side (0: chosen from the series);
    `equal_counts` makes bins of equal counts, for series with outliers; a minimum must stand out by `prominence`
    standard errors. `dims` is the last dimension that is examined; E1 has levelled off above `level` where it rises by
    less than `change`.
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
        return _choose_with_cao(x, _choose_binned_delay(x, self), dt, self)


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
        delay, search = _choose_binned_delay(x, self), _Search(self.dims, self.norm, self.ratio, self.loneliness)
        return _choose_embedding(x, delay, dt, search, partial(choose_by_false_neighbours, share=self.share))


@dataclass(frozen=True)
class AmiKnnCao(Embedder):
    """First minimum of the mutual information by nearest neighbours, which needs no bins, and Cao's E1 and E2.

    The mutual information is averaged over `most` samples with their `neighbours` nearest neighbours; `seed` is the
    seed of the dither that breaks the ties of quantised series. For the other options see `ami_cao`.
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
        delay = choose_by_neighbours(
            clip_outliers(x), self.longest, rng=rng, k=self.neighbours, most=self.most, prominence=self.prominence
        )
        return _choose_with_cao(x, delay, dt, self)


@dataclass(frozen=True)
class AutocorrelationCao(Embedder):
    """First lag at which the autocorrelation falls to 1/e, or to zero, and Cao's E1 and E2: for linear motions.

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
        return _choose_with_cao(x, choose_by_autocorrelation(clip_outliers(x), self.longest, level=level), dt, self)


@dataclass(frozen=True)
class Fixed(Embedder):
    """Lag, dimension and Theiler window as given; with `theiler` = -1 the window is chosen from the series."""

    lag: int = 1
    dim: int = 3
    theiler: int = -1
    name: ClassVar[str] = "fixed"
    paper: ClassVar[str] = "Takens, Lecture Notes in Mathematics 898 (1981) 366-381; Theiler, Phys. Rev. A 34 (1986)"

    def choose(self, x: Array, *, dt: float) -> Embedding:
        if self.lag < 1 or self.dim < 1:
            raise ContractError(f"fixed: lag {self.lag} and dim {self.dim} are given; both must be at least 1")
        if self.theiler >= 0:
            return Embedding(self.lag, self.dim, self.theiler)
        window, says = choose_theiler_window(clip_outliers(x))
        return Embedding(self.lag, self.dim, window, status="uncertain" if says else "ok", says=says)


@dataclass(frozen=True)
class _Search:
    """Options of the search for neighbours in growing dimension."""

    dims: int
    norm: Norm
    ratio: float = 10.0
    loneliness: float = 2.0


def _choose_binned_delay(x: Array, of: AmiCao | AmiFnn) -> Delay:
    """Return the delay by the mutual information in bins, with the options of an embedder."""
    return choose_by_information(
        clip_outliers(x), of.longest, bins=of.bins, equal_counts=of.equal_counts, prominence=of.prominence
    )


def _choose_with_cao(x: Array, delay: Delay, dt: float, of: AmiCao | AmiKnnCao | AutocorrelationCao) -> Embedding:
    """Return the embedding with that delay and the dimension by Cao's method."""
    choose = partial(choose_by_cao, change=of.change, level=of.level)
    return _choose_embedding(x, delay, dt, _Search(of.dims, of.norm), choose)


def _choose_embedding(
    x: Array, delay: Delay, dt: float, search: _Search, choose: Callable[[Unfolding], EmbeddingDimension]
) -> Embedding:
    """Return the embedding with that delay and the dimension that `choose` reads from the search."""
    theiler, short = choose_theiler_window(clip_outliers(x))
    curves = {**delay.curves, "lag": delay.curves["lag"] * dt}
    dims = limit_dimension(len(x), delay.lag, search.dims, theiler)
    if dims < min(3, search.dims):
        says = (
            f"{len(x)} samples are too few to determine a dimension at lag {delay.lag} with a Theiler window of "
            f"{theiler}: dimension 2 is assumed"
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
        dimension = choose(found)
        curves |= {name: getattr(found, name) for name in ("dim", "e1", "e2", "fnn", "fnn_distance", "fnn_loneliness")}
        curves["dim_fnn"] = found.dim
    worst = next((s for s in (dimension.status, delay.status) if s != "ok"), "uncertain" if short else "ok")
    says = "; ".join(part for part in (delay.says, dimension.says, short) if part)
    return Embedding(delay.lag, dimension.dim, theiler, curves, (delay.method, dimension.method), worst, says)
