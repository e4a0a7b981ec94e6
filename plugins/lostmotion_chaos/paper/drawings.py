"""The data of each figure of the paper: arrays and labels. Figures of the same form share a class."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion_chaos.paper.chain import Slopes


@dataclass(frozen=True, eq=False)
class Drawing:
    """The data of a figure."""


@dataclass(frozen=True, eq=False)
class PhaseDrawing(Drawing):
    """Phase plots: states (samples, 2) in m and m/s, and a title for each."""

    states: Sequence[Array]
    titles: Sequence[str]


@dataclass(frozen=True, eq=False)
class UnfoldedDrawing(Drawing):
    """States (samples, 2) in m and m/s, and the delay in samples of the delay plot of the displacement."""

    states: Array
    lag: int


@dataclass(frozen=True, eq=False)
class ForceDrawing(Drawing):
    """The normalised `force` of the backlash over the normalised displacement `p`, (places,)."""

    p: Array
    force: Array


@dataclass(frozen=True, eq=False)
class SectionsDrawing(Drawing):
    """Poincare maps: points (periods, 2) in m with a title for each map, and the points of a transient."""

    points: Sequence[Array]
    titles: Sequence[str]
    transient: Array


@dataclass(frozen=True, eq=False)
class LineDrawing(Drawing):
    """Exponents (cells, starts) in bit per normalised time over 1/alpha, the share of starts in chaos (cells,).

    `known` are the windows of 1/alpha in which careful integration found chaos.
    """

    inverse: Array
    exponents: Array
    share: Array
    known: Sequence[tuple[float, float]]


@dataclass(frozen=True, eq=False)
class DiagramsDrawing(Drawing):
    """Stroboscopic positions (cells, starts, kept) in x0 over 1/alpha and the share of chaos, for each damping."""

    inverse: Array
    places: Sequence[Array]
    dampings: Sequence[float]
    shares: Array


@dataclass(frozen=True, eq=False)
class BranchesDrawing(Drawing):
    """Stroboscopic positions (cells, starts, kept) in x0 and exponents (cells, starts) over 1/alpha."""

    inverse: Array
    places: Array
    exponents: Array


@dataclass(frozen=True, eq=False)
class PlaneDrawing(Drawing):
    """The largest exponent (zeta, inverse) in bit per normalised time over 1/alpha and the damping ratio."""

    inverse: Array
    zeta: Array
    exponent: Array


@dataclass(frozen=True, eq=False)
class SharedPlaneDrawing(PlaneDrawing):
    """A plane with the share of starts (zeta, inverse) that end in chaos as well."""

    share: Array


@dataclass(frozen=True, eq=False)
class Basin:
    """The attractor on which each start (up, across) ends, as an index into the labels."""

    across: Array
    up: Array
    index: NDArray[np.int64]
    labels: Sequence[str]


@dataclass(frozen=True, eq=False)
class BasinsDrawing(Drawing):
    """The basins of Cases 2 and 3."""

    cases: tuple[Basin, ...]


@dataclass(frozen=True, eq=False)
class Visits:
    """The number of visits of each cell (x, v) of a section in `periods` drive periods; edges in x0 and x0 omega_0."""

    counts: Array
    x: Array
    v: Array
    periods: int


@dataclass(frozen=True, eq=False)
class VisitsDrawing(Drawing):
    """The sections of Cases 1 and 3."""

    cases: tuple[Visits, ...]


@dataclass(frozen=True, eq=False)
class JointDrawing(Drawing):
    """A recording of the joint over time (s), the output without harmonics (`left`), and the spectra of both.

    Angles are in degrees, frequencies in Hz, spectral densities in degrees squared per Hz.
    """

    time: Array
    base: Array
    link: Array
    left: Array
    frequency: Array
    density: Array
    rest: Array


@dataclass(frozen=True, eq=False)
class InformationDrawing(Drawing):
    """Mutual information (bit) over the lag (s), and the lag (s) of its first minimum."""

    lag: Array
    ami: Array
    first: float


@dataclass(frozen=True, eq=False)
class CaoDrawing(Drawing):
    """Cao's numbers over the dimension."""

    dim: Array
    e1: Array
    e2: Array


@dataclass(frozen=True, eq=False)
class CleanedCaoDrawing(Drawing):
    """Cao's E1 over the dimension before and after noise reduction."""

    dim: Array
    before: Array
    dim_after: Array
    after: Array


@dataclass(frozen=True, eq=False)
class DelayDrawing(Drawing):
    """Delay plots: recordings (samples,) in degrees, delays in samples and in s, and titles."""

    links: Sequence[Array]
    lags: Sequence[int]
    seconds: Sequence[float]
    titles: Sequence[str]


@dataclass(frozen=True, eq=False)
class SlopesDrawing(Drawing):
    """Slopes of the correlation sum of recordings and their surrogates, and titles."""

    slopes: Sequence[Slopes]
    titles: Sequence[str]


@dataclass(frozen=True, eq=False)
class NoisyInformationDrawing(Drawing):
    """A motion (m) over time (s), and its mutual information (bit) over lags (s) at several noise levels."""

    time: Array
    x: Array
    names: Sequence[str]
    lags: Sequence[Array]
    amis: Sequence[Array]


@dataclass(frozen=True, eq=False)
class NoisyCaoDrawing(Drawing):
    """Cao's E1 over the dimension at several noise levels."""

    names: Sequence[str]
    dims: Sequence[Array]
    e1: Sequence[Array]


@dataclass(frozen=True, eq=False)
class NoisyMapsDrawing(Drawing):
    """Poincare maps (periods, 2) in m at several noise levels."""

    names: Sequence[str]
    noisy: Sequence[Array]


@dataclass(frozen=True, eq=False)
class CleanedMapsDrawing(NoisyMapsDrawing):
    """Poincare maps before and after noise reduction; `window` are the axis limits (2, 2) in m of an enlarged part."""

    cleaned: Sequence[Array]
    window: Array | None = None
