"""The descriptions of plugins that `lostmotion plugins show` prints; this module loads NumPy, the listing does not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass
from typing import Any

from lostmotion.codec import described
from lostmotion.contracts import Dynamics, Param, Term
from lostmotion.registry import Entry

TEXT_FIELDS = ("physics", "formula", "null", "paper", "motion", "reads", "unit")
LIST_FIELDS = ("states", "inputs", "channels", "needs", "motions")
SET_FIELDS = ("preserves",)


@dataclass(frozen=True)
class PlaceSheet:
    """The description of a place of a model at which a force can act."""

    name: str = described("its name")
    row: int | None = described("the row of the equations of motion on which the force acts; null without equations")
    inertia: str | None = described("the parameter that is the inertia there; null without equations")
    holds: tuple[str, ...] = described("parameters that live at the place")


@dataclass(frozen=True)
class ParameterSheet:
    """The description of a parameter of a plugin."""

    name: str = described("its name")
    meaning: str = described("what it is, in words")
    units: Mapping[str, str] = described("its unit in each kind of motion")
    low: float = described("lower bound; null where there is none")
    high: float = described("upper bound; null where there is none")
    scale: str = described("log where it is known by order of magnitude, else linear")
    null: float | None = described("where the plugin does nothing; null where there is no such value")
    typical: float = described("width of the default prior, in natural scales of the recording")
    aliases: tuple[str, ...] = described("further names")
    prior: str | None = described("its prior in a diagnosis, in words", default=None)


@dataclass(frozen=True)
class PluginSheet:
    """The description of a plugin; fields that do not apply are absent."""

    kind: str = described("model, term, quantifier, ...")
    name: str = described("its name")
    owner: str = described("its package and version")
    about: str = described("what it is, in a paragraph")
    physics: str | None = described("the sentence that reports a finding", default=None)
    formula: str | None = described("its formula", default=None)
    null: str | None = described("the null hypothesis of a surrogate", default=None)
    paper: str | None = described("the paper it follows", default=None)
    motion: str | None = described("translation or rotation", default=None)
    reads: str | None = described("what a method reads", default=None)
    unit: str | None = described("unit of what a method returns", default=None)
    preserves: tuple[str, ...] | None = described("what a surrogate preserves", default=None)
    states: tuple[str, ...] | None = described("states of a model or term", default=None)
    inputs: tuple[str, ...] | None = described("inputs of a model", default=None)
    channels: tuple[str, ...] | None = described("what sensors of a model can see", default=None)
    needs: tuple[str, ...] | None = described("parameters that a place must have for it", default=None)
    motions: tuple[str, ...] | None = described("kinds of motion it can be used in", default=None)
    interfaces: tuple[PlaceSheet, ...] | None = described("places at which a force can act on a model", default=None)
    parameters: tuple[ParameterSheet, ...] | None = described("its parameters", default=None)
    options: Mapping[str, object] | None = described("its options with their defaults", default=None)
    known_failures: Mapping[str, str] | None = described("rules that it breaks, with the reason", default=None)


def make_sheet(entry: Entry, cls: type[Any]) -> PluginSheet:
    """Return the description of a plugin class."""
    motions = _list_motions(cls)
    aliases = getattr(cls, "aliases", None) or {}
    options = [f for f in fields(cls) if f.init and f.name != "at"] if is_dataclass(cls) else []
    found = getattr(cls, "places", ()) if issubclass(cls, Dynamics) else getattr(cls, "interfaces", None) or ()
    places = [PlaceSheet(i.name, getattr(i, "row", None), getattr(i, "inertia", None), tuple(i.holds)) for i in found]
    return PluginSheet(
        kind=entry.kind,
        name=entry.name,
        owner=f"{entry.owner} {entry.version}".strip(),
        about=" ".join((cls.__doc__ or "").split()),
        physics=_get_text(cls, "physics"),
        formula=_get_text(cls, "formula"),
        null=_get_text(cls, "null"),
        paper=_get_text(cls, "paper"),
        motion=_get_text(cls, "motion"),
        reads=_get_text(cls, "reads"),
        unit=_get_text(cls, "unit"),
        preserves=tuple(sorted(_get_names(cls, "preserves") or ())) or None,
        states=_get_names(cls, "states"),
        inputs=_get_names(cls, "inputs"),
        channels=_get_names(cls, "channels"),
        needs=_get_names(cls, "needs"),
        motions=motions or None,
        interfaces=tuple(places) or None,
        parameters=tuple(
            _make_parameter_sheet(q, motions or (getattr(cls, "motion", ""),), entry.kind, aliases)
            for q in getattr(cls, "params", None) or ()
        )
        or None,
        options={f.name: None if f.default is MISSING else f.default for f in options} or None,
        known_failures=dict(getattr(cls, "known_failures", None) or {}) or None,
    )


def _get_text(cls: type[Any], key: str) -> str | None:
    word = getattr(cls, key, None)
    return word if isinstance(word, str) else None


def _get_names(cls: type[Any], key: str) -> tuple[str, ...] | None:
    return tuple(getattr(cls, key, None) or ()) or None


def _list_motions(cls: type[Any]) -> tuple[str, ...]:
    """Return the kinds of motion between which a model can be switched, or in which a term can be used."""
    if issubclass(cls, Term):
        return ("rotation",) if "angle" in (_get_names(cls, "needs") or ()) else ("translation", "rotation")
    return _get_names(cls, "motions") or ()


def _make_parameter_sheet(q: Param, motions: tuple[str, ...], kind: str, aliases: Mapping[str, str]) -> ParameterSheet:
    """Return the description of a parameter, with its unit in each kind of motion."""
    return ParameterSheet(
        name=q.name,
        meaning=q.meaning,
        units={m: q.unit(m) for m in motions},
        low=q.low,
        high=q.high,
        scale=q.scale,
        null=q.null,
        typical=q.prior.typical,
        aliases=tuple(alias for alias, name in aliases.items() if name == q.name),
        prior=_describe_prior(q) if kind == "term" else None,
    )


def _describe_prior(q: Param) -> str:
    """Return the prior of a term's parameter in a diagnosis, in natural scales of the recording."""
    if q.prior.choices:
        return f"one of {', '.join(f'{c:g}' for c in q.prior.choices)}"
    sizes = ("drive force", "rms position", "length of the recording" if q.prior.lasting else "time of the motion")
    powers = zip(sizes, (q.dimension.force, q.dimension.length, q.dimension.time), strict=True)
    natural = "".join(
        f" {'*' if n > 0 else '/'} {size}" + (f"^{abs(n)}" if abs(n) > 1 else "") for size, n in powers if n
    )
    form = "log-normal about" if q.scale == "log" else "half-normal of width" if q.low == 0.0 else "normal about 0, sd"
    return f"{form} {q.prior.typical:g}{natural}"
