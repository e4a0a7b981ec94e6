"""The page for contributors: what it names exists, and it is read in an afternoon."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "framework" / "ARCHITECTURE.md").read_text(encoding="utf-8")
FRAMEWORK = ROOT / "framework" / "lostmotion"
PLACES = (ROOT, FRAMEWORK, ROOT / "plugins", ROOT / "plugins" / "lostmotion_chaos")
MOST_WORDS = 4000
TABLE = PAGE.partition("## Rooms")[2].partition("\n## ")[0]


def words_in_code():
    """Return what the page sets in code, outside of blocks."""
    return set(re.findall(r"`([^`\n]+)`", PAGE))


def test_it_is_no_longer_than_an_afternoon():
    assert len(PAGE.split()) <= MOST_WORDS


def test_files_that_it_names_exist():
    named = {word for word in words_in_code() if re.fullmatch(r"(?:[\w.]+/)*\w+\.(?:py|md|toml)", word)}
    paths = {word for word in named if "/" in word}
    assert len(paths) > 40
    assert [path for path in sorted(paths) if not any((place / path).exists() for place in PLACES)] == []


@pytest.mark.parametrize("folder", sorted(p.name for p in FRAMEWORK.iterdir() if (p / "__init__.py").exists()))
def test_every_package_is_in_the_table(folder):
    assert f"`{folder}`" in TABLE


def test_every_module_without_a_package_is_in_the_table():
    modules = {p.stem for p in FRAMEWORK.glob("*.py")} - {"__init__", "__main__"}
    assert [name for name in sorted(modules) if f"`{name}`" not in TABLE] == []
