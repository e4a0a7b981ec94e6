"""A name stands for one thing: no two classes of the packages share one, and no two files of the framework."""

import ast
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = (
    "framework/lostmotion",
    "plugins/lostmotion_plugins",
    "plugins/lostmotion_chaos",
    "plugins/lostmotion_trials",
    "plugins/lostmotion_app",
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


def files_by_name():
    """Return the files of the framework by their name in the singular; `__init__` is not a name."""
    files = defaultdict(list)
    for path in sorted((ROOT / PACKAGES[0]).rglob("*.py")):
        if path.stem != "__init__":
            files[singular(path.stem.lstrip("_"))].append(path.relative_to(ROOT).as_posix())
    return files


def singular(name):
    """Return a name without the ending of a plural: boxes, matches, entries and words."""
    endings = {"ies": "y", "ses": "s", "xes": "x", "shes": "sh", "ches": "ch", "ss": "ss", "s": ""}
    plural = next((ending for ending in endings if name.endswith(ending)), "")
    return name.removesuffix(plural) + endings.get(plural, "")


def test_no_two_files_share_a_name_or_differ_by_a_plural_alone():
    files = files_by_name()
    assert len(files) > 200
    assert {name: where for name, where in files.items() if len(where) > 1} == {}


def test_plurals_are_known():
    pairs = (
        "page pages",
        "batch batches",
        "box boxes",
        "entry entries",
        "class classes",
        "drive drives",
        "loss losses",
    )
    assert [pair for pair in pairs if len({singular(word) for word in pair.split()}) > 1] == []
