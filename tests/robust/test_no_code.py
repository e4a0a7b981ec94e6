"""Nothing that comes from a file is run, written elsewhere, or shown as markup."""

from __future__ import annotations

import ast
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion.cli import main
from lostmotion.errors import DataError
from lostmotion.recording import read_columns
from lostmotion.report.pages import load_template
from lostmotion_chaos.maps.map import Map

ROOT = Path(__file__).parents[2]
FOLDERS = ("framework", "plugins/lostmotion_plugins", "plugins/lostmotion_chaos")
SOURCES = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py"))
PAGES = sorted(p for top in ("framework", "plugins") for p in (ROOT / top).rglob("*.html.j2"))
KNOWN = {
    "framework/lostmotion/likelihood/adopted.py": {
        "exec"
    },  # our own text, filled with numbers and with functions of loaded plugins
    "framework/lostmotion/likelihood/place_frame.py": {"exec"},  # our own text: assignments by numbers of rows
    "framework/lostmotion/campaigns/cluster.py": {
        "pickle.loads"
    },  # what the client of a dask cluster sent, over the cluster's own pickles
    "framework/lostmotion/written.py": {
        "exec"
    },  # our own text: arithmetic on indices and numbers, made of a tree that was parsed
    "plugins/lostmotion_plugins/simulators/callback.py": {
        "exec"
    },  # our own text: numbers, quoted names of joints and the sources of laws of loaded plugins
    "framework/lostmotion/testing/rules.py": {"pickle.loads"},  # bytes that were made a moment ago
}


class Bomb:
    """Leaves a file behind when it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> tuple[object, ...]:
        return (Path.touch, (self.path,))


def called(tree: ast.AST) -> set[str]:
    """Return the calls in a module that may run what they are given."""
    names = [ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)]
    risky = {"eval", "exec", "os.system", "os.popen", "pickle.load", "pickle.loads", "marshal.loads", "yaml.load"}
    return {name for name in names if name in risky or name.endswith(("read_pickle", "Unpickler"))}


def test_no_source_runs_what_it_reads() -> None:
    found = {p.relative_to(ROOT).as_posix(): called(ast.parse(p.read_text(encoding="utf-8"))) for p in SOURCES}
    assert {name: calls for name, calls in found.items() if calls} == KNOWN
    assert not [p for p in SOURCES if "allow_pickle=True" in p.read_text(encoding="utf-8")]


def test_a_pickle_in_an_archive_is_not_opened(tmp_path: Path) -> None:
    np.savez(tmp_path / "run.npz", x=np.array([Bomb(tmp_path / "run")], dtype=object), y=np.zeros(200))
    with pytest.raises(DataError, match="could run code"):
        read_columns(tmp_path / "run.npz")
    (tmp_path / "raw.npz").write_bytes(np.array([Bomb(tmp_path / "run")], dtype=object).dumps())
    with pytest.raises(DataError, match="cannot be read as npz"):
        read_columns(tmp_path / "raw.npz")
    assert not (tmp_path / "run").exists()


def test_a_pickle_in_a_map_is_not_opened(tmp_path: Path) -> None:
    """A zarr store of version 2 names its codecs, and one of them unpickles."""
    store, chunk = tmp_path / "map.zarr", np.array([Bomb(tmp_path / "run")], dtype=object)
    (store / "a").mkdir(parents=True)
    (store / ".zgroup").write_text('{"zarr_format": 2}')
    (store / ".zattrs").write_text('{"schema": "lostmotion.map/1"}')
    (store / "a" / ".zattrs").write_text('{"_ARRAY_DIMENSIONS": ["t"]}')
    (store / "a" / ".zarray").write_text(
        '{"zarr_format": 2, "shape": [1], "chunks": [1], "dtype": "|O", "order": "C", "fill_value": null, '
        '"compressor": null, "filters": [{"id": "pickle", "protocol": 5}]}'
    )
    (store / "a" / "0").write_bytes(chunk.dumps())
    with pytest.raises(DataError, match="not a map of lostmotion"):
        Map.open(store)
    assert not (tmp_path / "run").exists()


def test_a_module_beside_a_recording_is_not_taken_for_one_of_pythons(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "scipy.py").write_text(f"open({str(tmp_path / 'run')!r}, 'w')")
    (tmp_path / "run.mat").write_bytes(b"MATLAB 5.0".ljust(200))
    monkeypatch.chdir(tmp_path)
    with pytest.raises(DataError):
        read_columns(Path("run.mat"))
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.parent.parent.name)
def test_every_page_escapes_what_it_is_given(path: Path) -> None:
    top = "framework" if path.is_relative_to(ROOT / "framework") else "plugins"
    page = load_template(path.name, ".".join(path.parent.relative_to(ROOT / top).parts))
    assert page.environment.autoescape is True
    text = path.read_text(encoding="utf-8")
    assert "|safe" not in text.replace(" ", "")
    assert "{%autoescape" not in text.replace(" ", "")


def test_out_that_is_a_file_is_refused_and_stays(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine")
    (tmp_path / "case.toml").write_text('[model]\nname = "lin_backlash"')
    done = CliRunner().invoke(main, ["diagnose", str(tmp_path / "case.toml"), "--out", str(tmp_path / "out")])
    assert done.exit_code == 2
    assert "is a file" in done.stderr
    assert (tmp_path / "out").read_text() == "mine"
