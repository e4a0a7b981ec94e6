"""A model without a recording as a Python function: `lostmotion.simulate(...)`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from lostmotion.arguments import checked, choice, list_texts, maybe, positive, share, text, words
from lostmotion.notebook.argument_rules import KNOWN, RUN
from lostmotion.registry import Registry, default
from lostmotion.simulation import simulated_machine as _simulate


@checked(
    **RUN,
    model=text,
    drives=words,
    motion=maybe(choice("translation", "rotation")),
    values=KNOWN,
    duration=positive,
    rate=positive,
    initial=maybe(KNOWN),
    noise=share,
)
def simulate(
    model: str,
    *,
    terms: str | Iterable[str] = (),
    drives: str | Iterable[str],
    motion: str | None = None,
    registry: Registry | None = None,
    out: str | Path | None = None,
    values: Mapping[str, float],
    duration: float,
    rate: float,
    initial: Mapping[str, float] | None = None,
    noise: float = 0.0,
    seed: int = 0,
) -> _simulate.SimulatedTable:
    """Return the table of a simulated machine, with columns (samples,) by name; `out` (.csv, .nc) is an optional file.

    `values` and `initial` are values of parameters and states by name, in SI units. `drives` are texts such as
    "harmonic:amplitude=1,frequency=2"; `duration` is in s and `rate` in Hz. `noise` is white, as a share of the
    standard deviation of each channel. `motion` ("translation", "rotation") selects one kind where a model allows both.
    """
    known = registry or default()
    assembly, own = _simulate.assembly_of(known, model, list_texts(terms), motion)
    used = [("model", model), *(("term", term.name) for term in assembly.terms)]
    every = {**own, **values}
    plan = _simulate.Plan(
        assembly, every, list_texts(drives), duration, rate, initial or {}, noise, seed, known.origins(*used)
    )
    table = _simulate.simulate(plan)
    if out is not None:
        table.save(Path(out))
    return table
