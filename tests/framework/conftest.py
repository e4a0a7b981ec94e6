"""Lets the tests of this folder, and the processes they start, `import toy_campaign`."""

import sys
from pathlib import Path

import pytest
from markupsafe import Markup

sys.path.insert(0, str(Path(__file__).parent))


def _framed(_figure, name):
    return Markup('<svg aria-label="{}"/>').format(name)


@pytest.fixture
def unsaved(monkeypatch):
    """Figures of pages are made and not saved: seconds for each page, where a test reads the words only."""
    monkeypatch.setattr("lostmotion.report.style.embed_figure", _framed)
