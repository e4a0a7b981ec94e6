"""The codec of all results: frozen dataclasses to plain JSON values and back, and the meaning of each key of a file.

A field is written under its name, or under that of `described(key=...)`. A field whose default is None is left out of
the file where it is None; a field with `described(spare=True)` where it has its default. Numbers that are not finite
are written as null, and null is read as NaN where a number is expected. Unknown keys are ignored when a file is read,
so that older programs can read newer files.
"""

from __future__ import annotations

import dataclasses
import math
import operator
from collections.abc import Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeVar, get_args, get_origin, get_type_hints

from lostmotion.errors import DataError

if TYPE_CHECKING:
    from cattrs import Converter

T = TypeVar("T")
Cells = float | tuple[float, ...]
"""A number, or a list of numbers."""
ABSENT = ", or absent"
WORDS: Mapping[Any, str] = {
    float: "number",
    Cells: "number or list of numbers",
    int: "whole number",
    str: "text",
    bool: "true or false",
}


def described(
    doc: str,
    *,
    unit: str = "",
    key: str = "",
    flat: bool = False,
    spare: bool = False,
    default: Any = dataclasses.MISSING,
) -> Any:
    """Return a dataclass field with its meaning (`doc`), its unit, and its `key` in a file where that differs.

    A `flat` field holds a result whose keys are written among those of the enclosing result; it may be None if none of
    its keys is in the file. A `spare` field is left out of a file where it has its `default`. A mapping as `default`
    means a new empty mapping in each result.
    """
    metadata = {"doc": doc, "unit": unit, "key": key, "flat": flat, "spare": spare}
    if isinstance(default, dict):
        return dataclasses.field(default_factory=dict, metadata=metadata)
    return dataclasses.field(default=default, metadata=metadata)


def to_plain(result: Any) -> Any:
    """Return a result as plain JSON values: mappings, lists, strings, numbers, booleans, None."""
    return _make_converter().unstructure(result)


def from_plain(kind: type[T], plain: Any, what: str = "the file") -> T:
    """Return a result of type `kind` from plain JSON values; `DataError` names the key of `what` that is wrong."""
    from cattrs import BaseValidationError, transform_error  # imported late: declaring results does not need it

    try:
        return _make_converter().structure(plain, kind)
    except (BaseValidationError, TypeError, ValueError, KeyError) as err:
        first = transform_error(err, path="", format_exception=_format_error)[0]
        raise DataError(f"{what} is not what this program writes: {first}") from err


class SchemaEntry(NamedTuple):
    """A key of a result file: `path` such as `found[].probability`, its type in words, unit and meaning."""

    path: str
    type: str
    unit: str
    doc: str


def schema(kind: type) -> Iterator[SchemaEntry]:
    """Yield an entry for each key in the files of a type of result, in the order of writing."""
    yield from _list_entries(kind, "")


def _list_entries(kind: Any, before: str) -> Iterator[SchemaEntry]:
    hints = get_type_hints(kind)
    for f in dataclasses.fields(kind):
        path = before + _key_of(f)
        core, ending, words = _read_hint(hints[f.name])
        if f.metadata.get("flat"):
            yield from _list_entries(core, before)
            continue
        words += ABSENT if f.metadata.get("spare") else ""
        yield SchemaEntry(path + ending, words, f.metadata.get("unit", ""), f.metadata.get("doc", ""))
        if dataclasses.is_dataclass(core):
            yield from _list_entries(core, f"{path}{ending}.")


def _read_hint(hint: Any) -> tuple[Any, str, str]:
    """Return the innermost type of a hint, the ending of a path into it, and the type in words."""
    if _is_literal(hint):
        return hint, "", _format_choices(hint)
    options = [one for one in get_args(hint) if one is not type(None)]
    if type(None) in get_args(hint):
        core, ending, words = _read_hint(options[0])
        return core, ending, words + ABSENT
    origin = getattr(hint, "__origin__", None)
    if origin is tuple:
        core, ending, words = _read_hint(options[0])
        return core, f"[]{ending}", f"list of {words}"
    if isinstance(origin, type) and issubclass(origin, Mapping):
        core, ending, words = _read_hint(options[1])
        return core, f".NAME{ending}", f"mapping of names to {words}"
    return hint, "", "object" if dataclasses.is_dataclass(hint) else WORDS.get(hint, "value")


@cache
def _make_converter() -> Converter:
    import numpy as np
    from cattrs import Converter

    made = Converter()
    made.register_unstructure_hook(float, lambda x: float(x) if math.isfinite(x) else None)
    made.register_unstructure_hook(int, operator.index)
    made.register_unstructure_hook(bool, bool)
    made.register_structure_hook(float, lambda x, _: _read_number(x))
    made.register_structure_hook(int, lambda x, _: _read_whole(x))
    made.register_structure_hook(bool, lambda x, _: _check_type(x, bool, "true or false"))
    made.register_structure_hook_func(lambda kind: kind is object, lambda x, _: x)
    made.register_structure_hook(
        Cells, lambda x, _: tuple(map(_read_number, x)) if isinstance(x, list | tuple) else _read_number(x)
    )
    made.register_structure_hook(str, lambda x, _: _check_type(x, str, "a text"))
    made.register_unstructure_hook_func(lambda kind: kind is np.ndarray, lambda x: made.unstructure(x.tolist()))
    made.register_structure_hook_func(_is_literal, _check_choice)
    made.register_unstructure_hook_func(
        lambda kind: isinstance(kind, type) and issubclass(kind, np.generic), lambda x: made.unstructure(x.item())
    )
    made.register_unstructure_hook_factory(dataclasses.is_dataclass, lambda kind: _make_writer(kind, made))
    made.register_structure_hook_factory(dataclasses.is_dataclass, lambda kind: _make_reader(kind, made))
    return made


def _is_literal(kind: Any) -> bool:
    return get_origin(kind) is Literal


def _format_choices(kind: Any) -> str:
    """Return the words that a field may hold as text: `"a", "b" or "c"`."""
    *first, last = (f'"{word}"' for word in get_args(kind))
    return f"{', '.join(first)} or {last}" if first else last


def _check_choice(x: Any, kind: Any) -> Any:
    if x not in get_args(kind):
        raise TypeError(f"expected {_format_choices(kind)}, found {x!r}")
    return x


def _make_writer(kind: type, converter: Converter) -> Any:
    from cattrs.gen import make_dict_unstructure_fn, override

    spare = {f.name for f in _fields_of(kind) if f.default is None or f.metadata.get("spare")}
    how = {
        f.name: override(rename=f.metadata.get("key") or None, omit_if_default=f.name in spare)
        for f in _fields_of(kind)
    }
    write: Any = make_dict_unstructure_fn(kind, converter, _cattrs_use_linecache=False, **how)  # type: ignore[arg-type]
    fields = [(_key_of(f), bool(f.metadata.get("flat"))) for f in _fields_of(kind)]

    def in_order(result: Any) -> dict[str, Any]:
        found = write(result)  # cattrs writes fields with omitted defaults last
        plain: dict[str, Any] = {}
        for key, flat in fields:
            if key in found:
                plain.update(found[key] if flat else {key: found[key]})
        return plain

    return in_order if spare or _flat_fields(kind) else write


def _make_reader(kind: type, converter: Converter) -> Any:
    from cattrs.gen import make_dict_structure_fn, override

    how = {f.name: override(rename=f.metadata.get("key") or None) for f in _fields_of(kind)}
    read: Any = make_dict_structure_fn(kind, converter, _cattrs_use_linecache=False, **how)  # type: ignore[arg-type]
    hints = get_type_hints(kind)
    flat = {_key_of(f): (f.default is None, _keys_of(_read_hint(hints[f.name])[0])) for f in _flat_fields(kind)}

    def structured(plain: Any, wanted: Any) -> Any:
        inner = {key: None if optional and not keys & set(plain) else plain for key, (optional, keys) in flat.items()}
        return read({**plain, **inner}, wanted)

    return structured if flat else read


def _flat_fields(kind: Any) -> list[dataclasses.Field[Any]]:
    return [f for f in _fields_of(kind) if f.metadata.get("flat")]


def _keys_of(kind: Any) -> set[str]:
    return {_key_of(f) for f in _fields_of(kind)}


def _key_of(f: dataclasses.Field[Any]) -> str:
    return str(f.metadata.get("key") or f.name)


def _fields_of(kind: Any) -> tuple[dataclasses.Field[Any], ...]:
    return dataclasses.fields(kind)


def _read_number(x: Any) -> float:
    if x is None:
        return math.nan
    if isinstance(x, bool) or not isinstance(x, int | float):
        raise TypeError(f"expected a number, found {x!r}")
    return float(x)


def _read_whole(x: Any) -> int:
    if isinstance(x, bool) or not isinstance(x, int):
        raise TypeError(f"expected a whole number, found {x!r}")
    return x


def _check_type(x: Any, kind: type[T], words: str) -> T:
    if not isinstance(x, kind):
        raise TypeError(f"expected {words}, found {x!r}")
    return x


def _format_error(err: BaseException, _: Any) -> str:
    return f"{err.args[0]!r} is absent" if isinstance(err, KeyError) else str(err)
