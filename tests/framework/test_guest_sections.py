"""A package adds a section to the page of a diagnosis by the hook `lostmotion_sections`, in one file."""

import importlib
from pathlib import Path

import pytest
import report_fixture as made

from lostmotion.diagnosis.guest_sections import find_sections
from lostmotion.diagnosis.report.diagnosis_page import write_report
from lostmotion.registry import Registry

SOURCE = Path(__file__).parents[2] / "plugins" / "template" / "src"
GUEST = """
from lostmotion.hookspecs import hookimpl
from lostmotion.report.pages import PageSection
@hookimpl
def lostmotion_sections():
    return {{"{name}": ("{module}:make", "A section.")}}
def make():
    {body}
"""


@pytest.fixture(scope="module")
def data():
    return made.arrays(periods=20)


def page_of(folder, registry, data):
    folder = made.write(folder / "result", made.mismatch(), data)
    return write_report(folder, find_sections(registry)).read_text(encoding="utf-8")


@pytest.mark.usefixtures("unsaved")
def test_the_section_of_the_template_is_on_the_page_where_its_arrays_are(tmp_path, monkeypatch, data):
    monkeypatch.syspath_prepend(SOURCE)
    registry = Registry().add(importlib.import_module("lostmotion_template"))
    assert find_sections(Registry()) == {}
    page = page_of(tmp_path / "with", registry, data)
    assert '<section id="section-power">' in page
    assert page.index("section-whiteness") < page.index("section-power")
    assert "On average, the missing force takes energy from the machine." in page
    assert "section-power" not in page_of(tmp_path / "without", registry, data.drop_vars("missing_force"))


@pytest.mark.parametrize(
    ("name", "body", "said"),
    [
        ("power", "raise ValueError('no')", "This section cannot be drawn (ValueError: no): inform its author."),
        ("power", "return PageSection('x', 'X', words=lambda shown: 1 / 0)", "ZeroDivisionError"),
        ("power", "return 'text'", "is of the type str: return a PageSection"),
        (
            "ranking",
            "return PageSection('x', 'X', words=lambda shown: 'words')",
            "has a section &#39;ranking&#39;",
        ),
    ],
)
@pytest.mark.usefixtures("unsaved")
def test_a_section_that_fails_says_so_and_the_page_is_complete(tmp_path, data, name, body, said):
    module = f"guest_{abs(hash((name, body)))}"
    file = tmp_path / f"{module}.py"
    file.write_text(GUEST.format(name=name, module=module, body=body))
    page = page_of(tmp_path, Registry().add_file(file), data)
    assert said in page
    assert "section-whiteness" in page
