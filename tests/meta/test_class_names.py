"""A name of a class stands for one thing: no two classes of the packages share one, private ones included."""

import ast
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = (
    "framework/lostmotion",
    "plugins/lostmotion_plugins",
    "plugins/lostmotion_chaos",
    "plugins/lostmotion_trials",
)


def places_by_name():
    """Return where classes are defined, by the name of the class."""
    places = defaultdict(list)
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ClassDef):
                    places[node.name].append(f"{path.relative_to(ROOT).as_posix()}:{node.lineno}")
    return places


def test_no_two_classes_share_a_name():
    places = places_by_name()
    assert {package for package in PACKAGES if not any(package in where[0] for where in places.values())} == set()
    assert {name: where for name, where in places.items() if len(where) > 1} == {}
