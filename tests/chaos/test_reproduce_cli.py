"""The figures and tables of the paper from the command line."""

import csv
import json

import pytest
from click.testing import CliRunner
from PIL import Image

from lostmotion.cli import main
from lostmotion_chaos.paper.page import DRAWINGS
from lostmotion_chaos.paper.run import ITEMS, choose_names

VERDICTS = {"reproduced", "reproduced in part", "not reproduced", "beyond the paper"}


def run(*args):
    return CliRunner().invoke(main, ["reproduce", *map(str, args)], prog_name="lostmotion")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    out = tmp_path_factory.mktemp("paper")
    return run("table1", "fig3", "fig5", "fig18", "--out", out, "--quick", "--quiet"), out


def test_every_verdict_is_said_and_the_files_are_there(done):
    result, out = done
    assert result.exit_code == 0, result.output
    assert result.output.splitlines()[-1] == str(out / "index.html")
    names = {
        "table1.csv",
        "table1.md",
        "fig3.png",
        "fig3.pdf",
        "fig5.png",
        "fig5.pdf",
        "fig18.png",
        "fig18.pdf",
        "index.html",
    }
    assert names | {"reproduce.json"} == {path.name for path in out.iterdir()}


def test_figures_have_print_quality(done):
    picture = Image.open(done[1] / "fig3.png")
    assert picture.info["dpi"][0] == pytest.approx(300, abs=1)
    assert picture.size[0] >= 2400
    assert (done[1] / "fig3.pdf").read_bytes().startswith(b"%PDF")


def test_the_numbers_stand_in_the_json(done):
    content = json.loads((done[1] / "reproduce.json").read_text(encoding="utf-8"))
    assert list(content["items"]) == ["table1", "fig3", "fig5", "fig18"]
    for entry in content["items"].values():
        assert entry["verdict"] in VERDICTS
        assert entry["says"].endswith(".")
        assert entry["numbers"]
    assert content["provenance"]["settings"] == {"names": ["table1", "fig3", "fig5", "fig18"], "quick": True}


def test_the_page_shows_each_with_its_sentence(done):
    page = (done[1] / "index.html").read_text(encoding="utf-8")
    for text in ("Table 1", "Fig. 3", "Fig. 18", 'src="fig3.png"', "reproduced in part", "simulated joint"):
        assert text in page
    assert "http" not in page


def test_the_table_has_the_three_cases(done):
    with (done[1] / "table1.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["case"] for row in rows] == ["1", "2", "3"]
    assert rows[1]["k1 (N/m)"] == "1000"


@pytest.mark.slow
def test_the_same_seed_gives_the_same_files(done, tmp_path):
    assert run("table1", "fig3", "fig5", "fig18", "--out", tmp_path, "--quick", "--quiet", "--jobs", "1").exit_code == 0
    for path in done[1].iterdir():
        assert path.read_bytes() == (tmp_path / path.name).read_bytes(), path.name


def test_an_unknown_name_is_refused_with_its_neighbour(tmp_path):
    result = run("fig24", "--out", tmp_path)
    assert result.exit_code == 2
    assert "fig24" in result.output
    assert "fig23" in result.output
    assert not list(tmp_path.iterdir())


def test_all_figures_of_the_paper_can_be_asked_for():
    wanted = {f"fig{k}" for k in range(3, 24)} | {"table1", "table2"}
    assert wanted | {"bifurcation", "basins", "section", "map"} == set(ITEMS)
    assert choose_names(()) == choose_names(("all", "fig3")) == list(ITEMS)
    assert set(DRAWINGS) == {name for name in ITEMS if not name.startswith("table")}
