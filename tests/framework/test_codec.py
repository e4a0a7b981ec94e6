"""Results are written and read by one codec: nothing is lost, and a file that is wrong is told at its key."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
import pytest

from lostmotion.codec import described, from_plain, schema, to_plain
from lostmotion.errors import DataError
from lostmotion.results import Interval


@dataclass(frozen=True)
class Part:
    name: str = described("what it is called")
    size: float = described("how large it is", unit="m")
    numbers: Mapping[str, Interval] = described("its numbers", default={})
    late: Interval | None = described("since when", default=None)
    rest: float = described("what is left", default=0.0)
    at: str = described("where it is", default="", spare=True)


@dataclass(frozen=True, kw_only=True)
class Choice:
    name: str = described("what it is called")
    price: float | None = described("what it costs", default=None)
    good: bool = described("whether it is good")


@dataclass(frozen=True)
class Whole:
    parts: tuple[Part, ...] = described("what it is made of")
    curve: tuple[tuple[float, ...], ...] = described("a table", key="in", default=())
    many: int = described("how many", default=3)
    good: bool = described("whether it is good", default=True)
    kind: Literal["near", "far"] = described("where it is", default="near")


WHOLE = Whole((Part("a", np.float64(0.5), {"k": Interval(1.0, 0.5, 2.0, "N")}), Part("b", 1.0)), ((1.0, 2.0),))


def test_what_is_written_is_read():
    plain = json.loads(json.dumps(to_plain(WHOLE)))
    assert from_plain(Whole, plain) == WHOLE
    assert list(plain) == ["parts", "in", "many", "good", "kind"]


def test_none_is_left_out_and_what_is_not_finite_is_null():
    plain = to_plain(Part("a", math.inf, {"k": Interval(1.0, math.nan, 2.0, "N")}))
    assert plain["size"] is None
    assert plain["numbers"]["k"] == {"median": 1.0, "low": None, "high": 2.0, "unit": "N"}
    assert not {"late", "at"} & set(plain)
    assert math.isnan(from_plain(Part, plain).size)


def test_keys_stand_in_the_order_of_the_fields():
    late = Interval(1.0, 0.5, 2.0, "s")
    assert list(to_plain(Part("a", 1.0, late=late))) == ["name", "size", "numbers", "late", "rest"]
    assert list(to_plain(Choice(name="a", price=1.0, good=np.True_))) == ["name", "price", "good"]
    assert list(to_plain(Choice(name="a", good=True))) == ["name", "good"]


def test_arrays_are_lists_and_numbers_of_numpy_are_numbers():
    assert json.dumps(to_plain((np.True_, np.int64(3), np.float32(0.5)))) == "[true, 3, 0.5]"
    assert to_plain(Choice(name="a", good=np.True_))["good"] is True
    assert to_plain(Whole((), np.eye(2), np.int64(4)))["in"] == [[1.0, 0.0], [0.0, 1.0]]


def test_a_key_that_nobody_knows_is_ignored():
    assert from_plain(Whole, {"parts": [], "newer": 1}) == Whole(())


@pytest.mark.parametrize(
    ("plain", "said"),
    [
        ({"parts": [{"name": 3, "size": 1.0}]}, r"expected a text, found 3 @ \.parts\[0\]\.name"),
        ({"parts": [{"name": "a"}]}, r"'size' is absent"),
        ({"parts": [{"name": "a", "size": "x"}]}, r"expected a number, found 'x'"),
        ({"parts": [], "many": 1.5}, "expected a whole number, found 1.5"),
        ({"parts": [], "good": 1}, "expected true or false, found 1"),
        ({"parts": [], "kind": "odd"}, 'expected "near" or "far", found \'odd\' @ .kind'),
        ({"parts": [], "kind": [1]}, 'expected "near" or "far"'),
        ([1], "not what this program writes"),
        (None, "not what this program writes"),
    ],
)
def test_a_wrong_file_is_told_at_its_key(plain, said):
    with pytest.raises(DataError, match=said):
        from_plain(Whole, plain)


def test_the_schema_has_each_key_with_unit_and_meaning():
    rows = {row.path: row for row in schema(Whole)}
    assert rows["parts[].size"][1:] == ("number", "m", "how large it is")
    assert rows["parts[].numbers.NAME.low"].type == "number"
    assert rows["parts[].late"].type == "object, or absent"
    assert rows["kind"].type == '"near" or "far"'
    assert rows["parts[].at"].type == "text, or absent"
    assert rows["in[][]"].type == "list of list of number"


@dataclass(frozen=True)
class Share:
    hits: int = described("how many were right")
    of: int = described("of how many")


@dataclass(frozen=True)
class Counted:
    name: str = described("what was counted")
    share: Share = described("how often it was right", flat=True)
    late: float = described("what comes behind", default=0.0)
    where: Interval | None = described("where it was", flat=True, default=None)


def test_keys_of_a_flat_field_stand_among_those_of_its_owner():
    some, all_of_it = Counted("a", Share(1, 2)), Counted("b", Share(1, 2), 3.0, Interval(1.0, 0.5, 2.0, "N"))
    assert to_plain(some) == {"name": "a", "hits": 1, "of": 2, "late": 0.0}
    assert list(to_plain(all_of_it)) == ["name", "hits", "of", "late", "median", "low", "high", "unit"]
    assert [from_plain(Counted, to_plain(one)) for one in (some, all_of_it)] == [some, all_of_it]
    assert [row.path for row in schema(Counted)][:4] == ["name", "hits", "of", "late"]


@pytest.mark.parametrize(("plain", "said"), [({"name": "a", "hits": 1}, "'of' is absent"), ([1], "is not what this")])
def test_a_wrong_flat_field_is_told_at_its_key(plain, said):
    with pytest.raises(DataError, match=said):
        from_plain(Counted, plain)
