"""A formula for a learned curve: a sparse regression that makes a proposal and does not change any finding."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from lostmotion.contracts import Array
from lostmotion.quantities import Dimension
from lostmotion.settings import DEFAULT, UnknownSettings

RIDGE = 0.02
"""A curve is smooth, so its covariance is close to singular: this share of its mean variance is added."""
TURNS = np.arange(1.0, 20.01, 0.1)
"""Spatial frequencies that are tried, in periods over the range of the curve."""
MIDDLES = np.linspace(-0.9, 0.9, 73)
WIDTHS = (0.06, 0.08, 0.1, 0.15, 0.25, 0.4)


class Axis(NamedTuple):
    """The symbol of the variable of a curve, its dimension, that of the curve, and "translation" or "rotation"."""

    symbol: str
    dimension: Dimension
    of: Dimension
    motion: str


@dataclass(frozen=True)
class FormulaTerm:
    """One piece of a formula: its columns (points, 1 or 2), the price of the choice of its shape, and its text."""

    columns: Array
    price: float
    text: Callable[[Array], str]


@dataclass(frozen=True)
class Formula:
    """A proposed formula, and its share of the variance of the curve, weighted by the precision."""

    text: str
    share: float


def propose_formula(
    at: Array, mean: Array, covariance: Array, over: Axis, limits: UnknownSettings = DEFAULT.unknown
) -> Formula | None:
    """Return a formula of a few pieces for a curve (points,) with its covariance, or None.

    Pieces are added one by one, by Akaike's criterion. None when they explain less than `limits.formula` of the curve.
    """
    jitter = RIDGE * float(np.mean(np.diag(covariance))) + 1e-12 * float(np.mean(mean**2)) + 1e-300
    root = np.linalg.cholesky(covariance + jitter * np.eye(len(at)))
    aim = np.linalg.solve(root, mean)
    chosen: list[FormulaTerm] = []
    best = float(aim @ aim)
    pieces = list(_list_pieces(at, over))
    widest = np.stack([np.hstack([p.columns, p.columns])[:, :2] for p in pieces])
    whitened = np.linalg.solve(root, widest.transpose(1, 0, 2).reshape(len(at), -1)).reshape(len(at), -1, 2)
    prices = np.array([_sum_prices([p]) for p in pieces])
    white: list[Array] = []
    for _ in range(int(limits.formula_pieces)):
        scores = _compute_residuals(aim, white, whitened) + prices + _sum_prices(chosen)
        first = int(np.argmin(scores))
        if scores[first] >= best - limits.formula_gain:
            break
        best = scores[first]
        chosen.append(pieces[first])
        white.append(whitened[:, first, : pieces[first].columns.shape[1]])
        if _fit_columns(aim, white)[0] < (1.0 - limits.formula_full) * float(aim @ aim):
            break
    if not chosen:
        return None
    left, weights = _fit_columns(aim, white)
    share = 1.0 - left / float(aim @ aim)
    if share < limits.formula:
        return None
    cuts = np.cumsum([0, *(p.columns.shape[1] for p in chosen)])
    parts = [p.text(weights[a:b]) for p, a, b in zip(chosen, cuts[:-1], cuts[1:], strict=True)]
    return Formula(" + ".join(parts).replace("+ -", "- "), share)


def _sum_prices(pieces: list[FormulaTerm]) -> float:
    return math.fsum(2.0 * p.columns.shape[1] + p.price for p in pieces)


def _compute_residuals(aim: Array, white: list[Array], pieces: Array) -> Array:
    """Return the squared residual of a fit with some columns and one piece more, for each piece (count,).

    `pieces` (points, count, 2) have one column twice where they have only one.
    """
    rest, more = aim, pieces
    if white:
        q = np.linalg.qr(np.hstack(white))[0]
        rest, more = aim - q @ (q.T @ aim), pieces - np.einsum("ij,jkl->ikl", q, np.einsum("ij,ikl->jkl", q, pieces))
    gram = np.einsum("ikl,ikm->klm", more, more)
    told = np.einsum("ikl,i->kl", more, rest)
    weights = np.einsum("klm,km->kl", np.linalg.pinv(gram, rcond=1e-10, hermitian=True), told)
    return np.asarray(rest @ rest - np.sum(weights * told, axis=1))


def _fit_columns(aim: Array, columns: list[Array]) -> tuple[float, Array]:
    basis = np.hstack(columns)
    weights = np.linalg.lstsq(basis, aim, rcond=1e-10)[0]
    return float(np.sum((aim - basis @ weights) ** 2)), np.asarray(weights, dtype=float)


def _list_pieces(at: Array, over: Axis) -> Iterator[FormulaTerm]:
    """Yield the possible pieces of a formula: powers, the sign, a wave, a bump."""
    x, middle, half = over.symbol, 0.5 * float(at[0] + at[-1]), 0.5 * float(at[-1] - at[0])
    yield FormulaTerm(np.ones((len(at), 1)), 0.0, lambda w: _format_number(w[0], _find_unit(over, 0)))
    powers = {x: at, f"{x}|{x}|": at * np.abs(at), f"{x}^2": at**2, f"{x}^3": at**3}
    for (name, values), power in zip(powers.items(), (1, 2, 2, 3), strict=True):
        yield FormulaTerm(values[:, None], 0.0, _write_power(name, _find_unit(over, power)))
    if at[0] < 0.0 < at[-1]:
        yield FormulaTerm(np.sign(at)[:, None], 0.0, lambda w: f"{_format_number(w[0], _find_unit(over, 0))} sign({x})")
    for turns in TURNS:
        angles = math.pi * turns * at / half
        waves = np.stack([np.sin(angles), np.cos(angles)], axis=1)
        yield FormulaTerm(waves, 2.0 * math.log(len(TURNS)), _write_wave(2.0 * half / turns, over))
    for place, width in itertools.product(MIDDLES, WIDTHS):
        bump = np.exp(-(((at - middle - place * half) / (width * half)) ** 2))
        yield FormulaTerm(
            bump[:, None],
            2.0 * math.log(len(MIDDLES) * len(WIDTHS)),
            _write_bump(middle + place * half, width * half, over),
        )


def _find_unit(over: Axis, power: int) -> str:
    own, of = over.dimension, over.of
    return Dimension(of.force, of.length - power * own.length, of.time - power * own.time).unit(over.motion)


def _format_number(value: float, unit: str) -> str:
    return f"{value:.3g} {unit}"


def _write_power(name: str, unit: str) -> Callable[[Array], str]:
    return lambda w: f"{_format_number(w[0], unit)} {name}"


def _write_wave(period: float, over: Axis) -> Callable[[Array], str]:
    length = over.dimension.unit(over.motion)

    def text(w: Array) -> str:
        phase = math.atan2(w[1], w[0])
        size = _format_number(math.hypot(*w), _find_unit(over, 0))
        return f"{size} sin(2 pi {over.symbol} / {period:.3g} {length} {phase:+.2f})"

    return text


def _write_bump(middle: float, width: float, over: Axis) -> Callable[[Array], str]:
    length = over.dimension.unit(over.motion)
    shape = f"exp(-(({over.symbol} {-middle:+.3g} {length}) / {width:.3g} {length})^2)"
    return lambda w: f"{_format_number(w[0], _find_unit(over, 0))} {shape}"
