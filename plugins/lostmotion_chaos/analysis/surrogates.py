"""Surrogate data test: whether a series differs from its null hypothesis, by its rank among surrogates."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lostmotion.arguments import checked, error, instance, positive, random, text, whole
from lostmotion.contracts import Quantifier, Series, Surrogate
from lostmotion.errors import ContractError, DataError
from lostmotion.kernels.threads import spread
from lostmotion.settings import DEFAULT
from lostmotion_chaos.results import Sided

Array = NDArray[np.float64]
Statistic = Quantifier[Series] | Callable[[Array], float]


@dataclass(frozen=True, eq=False)
class SurrogateTest:
    """The rank of a recording's statistic among surrogates: `values` (draws,), NaN where it was refused.

    `p_low` is the probability under the null hypothesis of a value as low as `original`, `p_high` of one as high; `p`
    is that of the requested side, or min(1, 2 min(p_low, p_high)). `refused` counts the surrogates without a value:
    they count against rejection, as ties do. `piece` is the part of the series that was compared.
    """

    method: str
    null: str
    statistic: str
    original: float
    values: Array
    p_low: float
    p_high: float
    sided: Sided
    refused: int
    piece: slice
    says: str

    @property
    def p(self) -> float:
        """The p-value; NaN where the statistic was refused for the recording."""
        two = min(1.0, 2.0 * min(self.p_low, self.p_high)) if self.p_low == self.p_low else self.p_low
        return {"low": self.p_low, "high": self.p_high, "two": two}[self.sided]

    def rejects(self, level: float = DEFAULT.motion.level) -> bool:
        """Return whether the null hypothesis is rejected at `level`; never where the statistic was refused."""
        return self.p <= level


@checked(
    series=instance(Series, "a Series, as lm.embed returns it"),
    surrogate=instance(Surrogate, "a surrogate, such as lm.registry.default().make('surrogate', NAME)"),
    draws=whole(0, 1_000_000),
    rng=random,
    sided=text,
    jobs=whole(0),
    level=positive,
)
def surrogate_test(
    series: Series,
    surrogate: Surrogate,
    statistic: Statistic,
    *,
    draws: int = 99,
    rng: np.random.Generator,
    sided: Sided = "two",
    jobs: int = 0,
    level: float = DEFAULT.motion.level,
) -> SurrogateTest:
    """Return how the statistic of `series` ranks among those of `draws` surrogates.

    `statistic` is a quantifier, or a function of x (m,) that may run in several threads; it sees the same piece of the
    recording as the surrogates. Each draw has a random stream of its own, so the result does not depend on `jobs`.
    Raises `DataError` for a number of draws with which `level` cannot be reached.
    """
    if not callable(statistic) and not isinstance(statistic, Quantifier):
        raise error(statistic, "statistic", "a quantifier, or a function of the samples (m,)")
    _require_enough(draws, sided, level)
    for_draws, for_original, *streams = rng.spawn(draws + 2)
    drawn = np.asarray(surrogate.draw(series, draws=draws, rng=for_draws), dtype=float)
    part = _check_piece(series, surrogate, drawn, draws)
    original, why = _compute_statistic(statistic, replace(series, x=series.x[part]), for_original)
    values = np.full(draws, np.nan)

    def work(begin: int, end: int) -> None:
        for k in range(begin, end):
            values[k] = _compute_statistic(statistic, replace(series, x=drawn[k]), streams[k])[0]

    if np.isfinite(original):
        spread(work, draws, jobs=jobs, slices=draws)
    return _rank_statistic(surrogate, _name_statistic(statistic), original, values, (sided, level), part, why)


def _require_enough(draws: int, sided: Sided, level: float) -> None:
    """Raise `DataError` for an unknown side, or for a number of draws with which `level` cannot be reached."""
    least = math.ceil((2.0 if sided == "two" else 1.0) / level - 1e-9) - 1
    if sided not in ("two", "low", "high"):
        raise DataError(f"the test is {sided!r} sided: give two, low (the recording lies lower) or high")
    if draws < least:
        raise DataError(f"{draws} surrogates cannot reject at {100.0 * level:g} %: at least {least} are needed")


def _check_piece(series: Series, surrogate: Surrogate, drawn: Array, draws: int) -> slice:
    """Return the part of the series that the surrogates replace; raise `ContractError` for wrong surrogates."""
    if drawn.ndim != 2 or len(drawn) != draws or not np.isfinite(drawn).all() or drawn.shape[1] > series.n:
        raise ContractError(
            f"{surrogate.name} returned an array {drawn.shape}, and {draws} finite rows of at most {series.n} samples "
            "were expected: write to its author"
        )
    part = surrogate.piece(series)
    if part.stop - part.start != drawn.shape[1]:
        raise ContractError(f"{surrogate.name} says {part} and drew {drawn.shape[1]} samples: write to its author")
    return slice(part.start, part.stop)


def _compute_statistic(statistic: Statistic, series: Series, rng: np.random.Generator) -> tuple[float, str]:
    """Return the statistic, NaN where it is refused, and the reason."""
    if not isinstance(statistic, Quantifier):
        try:
            return float(statistic(series.x)), ""
        except (TypeError, ValueError) as err:
            said = " ".join(str(err).split())
            raise DataError(
                f"the statistic {_name_statistic(statistic)} returns no number ({said}): give a function of the"
                " samples (m,) that returns one"
            ) from err
    estimate = statistic.estimate(series, rng=rng)
    return float(estimate.value), estimate.says


def _name_statistic(statistic: Statistic) -> str:
    name = getattr(statistic, "name", None) or getattr(statistic, "__name__", None) or type(statistic).__name__
    return str(name).replace("_", " ")


def _rank_statistic(
    surrogate: Surrogate, name: str, original: float, values: Array, how: tuple[Sided, float], part: slice, why: str
) -> SurrogateTest:
    """Return the test at a side and a level (`how`); ties and refusals count against rejection."""
    sided, level = how
    n, method = len(values), surrogate.name
    refused = int((~np.isfinite(values)).sum())
    if not np.isfinite(original):
        nothing, reason = float("nan"), why.rstrip(".") or "it is not finite"
        says = f"No test: the {name} of the recording was refused ({reason})."
        return SurrogateTest(method, surrogate.null, name, original, values, nothing, nothing, sided, n, part, says)
    lower = int((values <= original).sum()) + refused
    higher = int((values >= original).sum()) + refused
    p_low, p_high = (1 + lower) / (1 + n), (1 + higher) / (1 + n)
    bare = SurrogateTest(method, surrogate.null, name, original, values, p_low, p_high, sided, refused, part, "")
    return replace(bare, says=_write_sentence(bare, level))


def _write_sentence(test: SurrogateTest, level: float) -> str:
    """Return the outcome of the test at a level in words."""
    n, side = len(test.values), test.sided
    if side == "two":
        side = "low" if test.p_low <= test.p_high else "high"
    worse = round((test.p_low if side == "low" else test.p_high) * (1 + n)) - 1 - test.refused
    count = "None" if worse == 0 else str(worse)
    tails = ", two-sided" if test.sided == "two" else ""
    verb = "has" if worse < 2 else "have"
    name = " ".join(test.statistic.split("_"))
    says = (
        f"{count} of {n} surrogates ({test.method}) {verb} a {name} as {side} as the recording's "
        f"(p = {test.p:.2g}{tails})"
    )
    verdict = "it is not" if test.rejects(level) else "it may be"
    lost = ""
    if test.refused:
        lost = f" For {test.refused} surrogates it was refused: they count against a rejection."
    return f"{says}: {verdict} {test.null}.{lost}"
