"""Files are written whole or not at all: a full disk, a kill or an error leaves what stood there before."""

from __future__ import annotations

import errno
import os
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lostmotion.errors import DataError, PlaceError
from lostmotion.storage import (
    StoredArray,
    folder_for,
    load_arrays,
    load_json,
    save_arrays,
    save_bytes,
    save_json,
    save_table,
    save_text,
    whole,
)

LONG = np.random.default_rng(0).normal(size=2_000)
UNITS = {"time": "s", "x": "m"}
DOORS: list[tuple[str, Callable[[Path, np.ndarray], object]]] = [
    ("page.html", lambda path, x: save_text(path, repr(x.tolist()))),
    ("picture.png", lambda path, x: save_bytes(path, x.tobytes())),
    ("facts.json", lambda path, x: save_json(path, {"x": x.tolist()})),
    ("table.csv", lambda path, x: save_table(path, {"time": x, "x": x}, UNITS, {})),
    ("table.nc", lambda path, x: save_table(path, {"time": x, "x": x}, UNITS, {})),
    ("arrays.nc", lambda path, x: save_arrays(path, {"x": StoredArray(("time",), x)}, {}, {})),
]
IDS = [f"{name}-{i}" for i, (name, _) in enumerate(DOORS)]


def fails(*_args: object) -> None:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


@pytest.mark.parametrize(("name", "save"), DOORS, ids=IDS)
def test_a_full_disk_leaves_the_previous_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, save: Callable[..., object]
) -> None:
    save(tmp_path / name, LONG[:10])
    before = (tmp_path / name).read_bytes()
    monkeypatch.setattr(os, "fsync", fails)
    with pytest.raises(PlaceError, match=r"no space left on its disk .* existing files are unchanged"):
        save(tmp_path / name, LONG)
    assert (tmp_path / name).read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("ending", [pytest.param("csv", marks=pytest.mark.slow), "nc"])
def test_a_file_that_may_not_grow_is_a_sentence_and_status_2(tmp_path: Path, ending: str) -> None:
    """RLIMIT_FSIZE stands in for a disk that is full: the system refuses the bytes as it writes them.

    It is larger than what numba keeps of a kernel that was not compiled before.
    """
    out = tmp_path / f"run.{ending}"
    line = ["simulate", "linear_oscillator", "--set", "m=1,c=2,k=400", "--drive", "harmonic:amplitude=1,omega=9"]
    line += ["--duration", "160", "--rate", "500", "--out", str(out)]
    out.write_bytes(b"what stood there before")
    code = (
        "import resource, sys; from lostmotion.cli import main; from lostmotion import storage\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, 2_000_000)); main(sys.argv[1:])"
    )
    done = subprocess.run([sys.executable, "-B", "-c", code, *line], capture_output=True, text=True, check=False)
    assert done.returncode == 2, done.stderr
    assert (done.stderr.count("\n"), "no space left on its disk" in done.stderr) == (1, True), done.stderr
    assert out.read_bytes() == b"what stood there before"
    assert [p.name for p in tmp_path.iterdir()] == [out.name]
    assert resource.getrlimit(resource.RLIMIT_FSIZE)[0] == resource.RLIM_INFINITY


def test_an_error_while_writing_leaves_the_previous_result(tmp_path: Path) -> None:
    save_text(tmp_path / "a.txt", "before")
    with pytest.raises(TypeError), whole(tmp_path / "a.txt") as spare:
        spare.write_text(b"not a text")  # type: ignore[arg-type]
    assert (tmp_path / "a.txt").read_text() == "before"
    assert len(list(tmp_path.iterdir())) == 1


def test_what_a_killed_process_left_is_cleared_and_what_a_living_one_writes_is_not(tmp_path: Path) -> None:
    child = subprocess.Popen([sys.executable, "-c", ""])
    child.wait()
    dead, alive, other = (tmp_path / f".a.{n}.txt" for n in (child.pid, os.getppid(), "notes"))
    for file in (dead, alive, other):
        file.write_text("half")
    save_text(tmp_path / "a.txt", "all")
    assert not dead.exists()
    assert alive.exists()
    assert other.exists()


def test_no_link_is_written_through(tmp_path: Path) -> None:
    (tmp_path / "precious").write_text("mine")
    (tmp_path / "out").mkdir()
    for name in ("page.html", f".page.{os.getpid()}.html"):
        (tmp_path / "out" / name).symlink_to(tmp_path / "precious")
    save_text(tmp_path / "out" / "page.html", "page")
    assert (tmp_path / "precious").read_text() == "mine"
    assert (tmp_path / "out" / "page.html").read_text() == "page"
    assert not (tmp_path / "out" / "page.html").is_symlink()


def test_a_place_that_is_a_file_is_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(PlaceError, match=r"cannot be written .*: choose another place"):
        folder_for(tmp_path / "out" / "below")


def test_a_damaged_result_is_a_sentence(tmp_path: Path) -> None:
    save_arrays(tmp_path / "arrays.nc", {"x": StoredArray(("time",), LONG)}, {}, {})
    raw = (tmp_path / "arrays.nc").read_bytes()
    (tmp_path / "arrays.nc").write_bytes(raw[: len(raw) // 2])
    with pytest.raises(DataError, match=r"arrays\.nc cannot be read, or is damaged .*: run it again"):
        load_arrays(tmp_path / "arrays.nc", "run it again")
    for text, words in (("{", "not JSON, or damaged"), ("[1]", "a list, not an object"), ("[" * 10**5, "not JSON")):
        (tmp_path / "a.json").write_text(text)
        with pytest.raises(DataError, match=words):
            load_json(tmp_path / "a.json", "run it again")
