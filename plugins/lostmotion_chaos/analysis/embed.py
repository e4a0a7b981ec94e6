"""Delay embedding of a recorded channel: the first stage of the analysis."""

from __future__ import annotations

from numpy.typing import ArrayLike

from lostmotion import arguments
from lostmotion.contracts import Embedder, Series
from lostmotion.errors import ContractError, DataError
from lostmotion.results import STATUSES, Embedding
from lostmotion_chaos.signals.series import checked

MIN_DELAY_VECTORS = 100
"""Smallest number of delay vectors that is accepted."""


@arguments.checked(
    embedder=arguments.instance(Embedder, "an embedder, such as lm.registry.default().make('embedder', NAME)"),
    dt=arguments.positive,
    period=arguments.maybe(arguments.positive),
)
def embed(values: ArrayLike, embedder: Embedder, *, dt: float, period: float | None = None) -> Series:
    """Return the centred series of `values` (n,), sampled every `dt` s, with the embedding that `embedder` chooses.

    `period` (s) is that of the drive, if there is one. Raises `DataError` for values that cannot be analysed.
    """
    x = checked(values)
    chosen = embedder.choose(x.copy(), dt=dt)
    _require_sound(chosen, embedder.name)
    _require_room(len(x), chosen)
    return Series(x, dt, chosen, period)


def _require_sound(chosen: Embedding, name: str) -> None:
    whole = all(isinstance(v, int) for v in (chosen.lag, chosen.dim, chosen.theiler))
    if not whole or chosen.lag < 1 or chosen.dim < 1 or chosen.theiler < 0 or chosen.status not in STATUSES:
        raise ContractError(
            f"{name} chose lag {chosen.lag!r}, dim {chosen.dim!r}, theiler {chosen.theiler!r}, status "
            f"{chosen.status!r}: whole numbers of at least 1, 1 and 0 and a known status are needed"
        )


def _require_room(n: int, chosen: Embedding) -> None:
    rows = n - chosen.window + 1
    if rows < MIN_DELAY_VECTORS:
        raise DataError(
            f"a series of {n} samples is too short for dim {chosen.dim} and lag {chosen.lag} ({max(rows, 0)} delay "
            f"vectors, {MIN_DELAY_VECTORS} needed): record longer, or lower the dimension"
        )
