"""What the docs say is true: every code block of every page runs, and no key, command or link is behind."""

import os
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from lostmotion.case import channels, drive_levels, reading

sys.path.insert(0, str(Path(__file__).parent))

from pages import MARK, Page, run

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = [Page(path) for path in sorted(DOCS.rglob("*.md"))]
INDEX = re.compile(r"pypi|pythonhosted|index-url|anaconda\.org|/simple\b|badge", re.IGNORECASE)
MACHINE = re.compile(r"(?<![\w.!])/(home|root|work|tmp|Users|opt|usr)/")
AT_ONCE = 2


def name_of(page):
    return str(page.path.relative_to(DOCS))


def cases():
    for page in PAGES:
        marks = [pytest.mark.slow] * page.slow + [pytest.mark.real] * bool(page.needs)
        yield pytest.param(page, id=name_of(page), marks=marks)


@pytest.fixture(scope="module")
def crew(request):
    """Pages that run beside the one that is waited for; without xdist, which shares out the tests itself."""
    with ThreadPoolExecutor(1 if "PYTEST_XDIST_WORKER" in os.environ else AT_ONCE) as pool:
        yield pool
        pool.shutdown(cancel_futures=True)


@pytest.fixture(scope="module")
def running(request, crew, tmp_path_factory):
    """What gives the run of a page, begun before it is asked for where the tests run one by one."""
    begun = {}

    def begin(page):
        if page.path not in begun:
            folder = tmp_path_factory.mktemp(page.path.stem)
            for data in page.needs:
                for file in (request.getfixturevalue("shared") / "data" / data).iterdir():
                    (folder / file.name).symlink_to(file.resolve())
            begun[page.path] = crew.submit(run, page, folder)
        return begun[page.path]

    if "PYTEST_XDIST_WORKER" not in os.environ:
        chosen = [item for item in request.session.items if item.path == Path(__file__)]
        for page in dict.fromkeys(item.callspec.params["page"] for item in chosen if hasattr(item, "callspec")):
            if absent(page) is None:
                begin(page)
    return begin


def absent(page):
    """Return the first folder of recordings that a page needs and that is not there, or None."""
    shared = ROOT.parent / "shared" / "data"
    return next((shared / name for name in page.needs if not (shared / name).is_dir()), None)


@pytest.mark.parametrize("page", list(cases()))
def test_every_block_runs(page, running):
    if folder := absent(page):
        pytest.skip(f"no recordings: {folder} is absent")
    running(page).result()


def test_no_address_of_an_index_and_no_path_of_a_machine():
    files = {p: p.read_text(encoding="utf-8") for p in DOCS.rglob("*") if p.suffix in (".md", ".py", ".css")}
    assert [p for p, text in files.items() if INDEX.search(text) or MACHINE.search(text)] == []


def test_links_between_pages_lead_somewhere():
    links = [(page, link) for page in PAGES for link in re.findall(r"\]\((?![a-z]+:)([^)#\s]+)", page.text)]
    assert [(name_of(page), link) for page, link in links if not (page.path.parent / link).exists()] == []


def test_every_key_of_a_case_is_told():
    keys = {*reading.TOP, *reading.RECORDING, *reading.TIME, *reading.MODEL, *reading.SENSOR}
    keys |= {*reading.EXPERIMENT, *reading.PRIOR}
    keys |= {*channels.CHANNEL, *channels.INPUT, *channels.SENSOR, *drive_levels.LEVEL, *drive_levels.MEASURED}
    page = (DOCS / "reference" / "case.md").read_text(encoding="utf-8")
    assert sorted(key for key in keys if not re.search(rf"`{key}`|`\[+{key}", page)) == []


def test_comments_of_the_docs_are_known():
    comments = [(name_of(p), c) for p in PAGES for c in re.findall(r"<!--.*?-->", p.text)]
    assert [c for c in comments if not MARK.fullmatch(c[1])] == []
