"""Each field of each result class says what it means, so that the page of the keys has no gaps."""

from __future__ import annotations

import dataclasses
import pkgutil
from importlib import import_module

import pytest

from lostmotion import results
from lostmotion.codec import schema
from lostmotion.results.diagnosis import Diagnosis

OURS = [f"lostmotion.results.{one.name}" for one in pkgutil.iter_modules(results.__path__)]
MODULES = [import_module(name) for name in (*OURS, "lostmotion_chaos.results")]
CLASSES = [
    kind
    for module in MODULES
    for kind in vars(module).values()
    if dataclasses.is_dataclass(kind) and kind.__module__ == module.__name__
]


@pytest.mark.parametrize("kind", [results.Interval, *CLASSES], ids=lambda kind: kind.__name__)
def test_each_field_has_a_meaning(kind):
    assert kind.__doc__
    assert [f.name for f in dataclasses.fields(kind) if not f.metadata.get("doc", "").strip()] == []


def test_each_name_is_that_of_one_class():
    names = [kind.__name__ for kind in CLASSES]
    assert len(names) == len(set(names))


def test_each_key_of_a_diagnosis_is_told_with_its_type():
    rows = list(schema(Diagnosis))
    assert [row.path for row in rows if not row.doc or row.type == "value"] == []
    assert len({row.path for row in rows}) == len(rows)
