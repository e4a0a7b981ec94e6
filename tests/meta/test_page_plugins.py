"""The model and the quantifier that a page of the docs writes are used by the commands beside them."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion import registry
from lostmotion.cli import main
from lostmotion_chaos.maps.store import load

PAGE = (Path(__file__).parents[2] / "docs" / "howto" / "plugins-in-a-file.md").read_text(encoding="utf-8")


def blocks(language, holds):
    """Return the code blocks of the page in a language that hold a text."""
    found = re.findall(rf"^```{language}\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)
    return [block for block in found if holds in block]


@pytest.fixture
def lines(tmp_path, monkeypatch):
    """Return the commands on `my_machine.py`, by the word behind it, in a folder where the file is."""
    (code,), (commands,) = blocks("python", "(Model)"), blocks("sh", "my_machine.py")
    (tmp_path / "my_machine.py").write_text(code, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    registry.default.cache_clear()
    yield {line.split()[3]: line.split()[1:] for line in commands.strip().splitlines()}
    registry.default.cache_clear()
    sys.modules.pop("my_machine", None)


def run(words):
    done = CliRunner().invoke(main, words, prog_name="lostmotion")
    assert done.exit_code == 0, done.output
    return done.output


def test_they_keep_every_rule_and_are_simulated(lines):
    assert run(lines["plugins"]).rstrip().endswith("0 broken")
    assert "2400 samples of swing at 40 Hz" in run(lines["simulate"])


@pytest.mark.slow
def test_they_are_analysed_and_mapped(lines):
    run(lines["simulate"])
    run([*lines["analyse"], "--quiet"])
    assert '"crest"' in Path("swing/analysis.json").read_text(encoding="utf-8")
    run([*lines["map"], "--periods", "40", "--transient", "20", "--starts", "1", "--quiet"])
    assert np.isfinite(load(Path("swing.nc"))["crest"]).all()
