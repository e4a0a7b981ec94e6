"""Bad input, whatever it is, is refused with one sentence: no traceback, no hang, no memory that runs away."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
import warnings
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from lostmotion.case import load_case
from lostmotion.cli import main
from lostmotion.errors import LostMotionError
from lostmotion.quantities import si_factor
from lostmotion.recording import ENDINGS, Channel, RecordingSpec, load_recording, read_columns
from lostmotion.recording.formats import table_of

SOME = settings(max_examples=30, deadline=10_000, suppress_health_check=list(HealthCheck), derandomize=True)
CELLS = st.sampled_from(
    ["", "1", "-2.5", "1,5", "nan", "inf", "1e999", "x", '"', "#", "\t", ";", "\ufeff", "0x1", "1_0"]
)
GOOD = """
[[recordings]]
file = "run.csv"
time = "t"
excitation = { column = "u", quantity = "force", unit = "N" }
response = { column = "x", quantity = "position", unit = "m" }
[model]
name = "lin_backlash"
[model.estimate]
c = { low = 0.8, high = 80.0, scale = "log" }
"""


def refused(action: Callable[[], object]) -> str:
    """Return the sentence an action is refused with, or an empty one when it is not; anything else fails the test."""
    said = ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            action()
    except LostMotionError as err:
        said = str(err) or "?\n"
    assert "\n" not in said
    return said


@SOME
@given(raw=st.binary(max_size=400), ending=st.sampled_from(sorted(ENDINGS)))
@example(raw=b"PK\x03\x04", ending="npz")
@example(raw=b"\x89HDF\r\n\x1a\n", ending="h5")
@example(raw=b"MATLAB 5.0".ljust(124) + b"\x00\x01IM" + b"\xff" * 64, ending="mat")
def test_any_bytes_are_a_recording_or_refused(
    tmp_path_factory: pytest.TempPathFactory, raw: bytes, ending: str
) -> None:
    path = tmp_path_factory.mktemp("raw") / f"run.{ending}"
    path.write_bytes(raw)
    refused(lambda: table_of(path))


@SOME
@given(rows=st.lists(st.lists(CELLS, min_size=1, max_size=4), max_size=8), separator=st.sampled_from(",;\t "))
def test_any_table_is_a_recording_or_refused(
    tmp_path_factory: pytest.TempPathFactory, rows: list[list[str]], separator: str
) -> None:
    path = tmp_path_factory.mktemp("table") / "run.csv"
    path.write_text("\n".join(separator.join(row) for row in rows), encoding="utf-8")
    refused(lambda: table_of(path))


@SOME
@given(text=st.text(max_size=60), at=st.integers(0, len(GOOD)))
def test_any_case_is_meant_or_refused(tmp_path_factory: pytest.TempPathFactory, text: str, at: int) -> None:
    path = tmp_path_factory.mktemp("case") / "case.toml"
    path.write_bytes((GOOD[:at] + text + GOOD[at:]).encode("utf-8", "replace"))
    refused(lambda: load_case(path))


@SOME
@given(unit=st.text(alphabet="Nms kgdeg*^/()-.0123456789µ°²", max_size=30))
@example(unit="N*9**9**9")
@example(unit="N**(2**(3**(20)))")
@example(unit="N/0")
@example(unit="m*" * 3000 + "m")
def test_any_unit_is_known_or_refused(unit: str) -> None:
    refused(lambda: si_factor(unit, "force"))


@SOME
@given(values=st.lists(st.floats(allow_nan=True, width=64), min_size=100, max_size=120), which=st.sampled_from("tux"))
def test_any_numbers_are_a_recording_or_refused(
    tmp_path_factory: pytest.TempPathFactory, values: list[float], which: str
) -> None:
    folder, n = tmp_path_factory.mktemp("numbers"), len(values)
    columns = {"t": np.arange(n) / 100.0, "u": np.sin(np.arange(n)), "x": np.cos(np.arange(n)), which: np.array(values)}
    np.savez(folder / "run.npz", **columns)
    spec = RecordingSpec("run.npz", "t", None, (Channel("u", "force", "N"),), (Channel("x", "position", "m"),))
    refused(lambda: load_recording(spec, folder))


def deep(folder: Path) -> None:
    (folder / "case.toml").write_text("a = " + "[" * 5000)


def digits(folder: Path) -> None:
    (folder / "case.toml").write_text(GOOD + "[model.known]\nm = " + "9" * 5000)


def huge(folder: Path) -> None:
    (folder / "case.toml").write_text(GOOD + "[model.known]\nm = 0x" + "f" * 400)


def dotted(folder: Path) -> None:
    (folder / "case.toml").write_text("a" + ".a" * 100_000 + " = 1")


def control(folder: Path) -> None:
    (folder / "case.toml").write_text('title = "a\\u0000b"' + GOOD)


def elsewhere(folder: Path) -> None:
    (folder / "case.toml").write_text(GOOD.replace('time = "t"', 'time = "t"\nname = "../../x"'))


def device(folder: Path) -> None:
    (folder / "case.toml").write_text(GOOD.replace("run.csv", "run.csv/../../../../../../dev/zero"))


@pytest.mark.parametrize("write", [deep, digits, huge, dotted, control, elsewhere, device], ids=lambda w: w.__name__)
def test_a_case_that_was_made_to_harm_is_one_sentence_and_status_2(
    tmp_path: Path, write: Callable[[Path], None]
) -> None:
    write(tmp_path)
    done = CliRunner().invoke(
        main, ["diagnose", str(tmp_path / "case.toml"), "--out", str(tmp_path / "out"), "--quiet"]
    )
    assert (done.exit_code, done.stderr.count("\n")) == (2, 1), done.output
    assert done.stderr.startswith("lostmotion: ")
    assert done.stderr.rstrip("\n").isprintable()


def million(path: Path) -> None:
    path.write_text(",".join(f"c{i}" for i in range(1_000_000)) + "\n" + "0," * 999_999 + "0\n")


def long_line(path: Path) -> None:
    path.write_text("time,x\n" + "1," * 1_000_000)


def zip_bomb(path: Path) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file, file.open("x.npy", "w") as member:
        for _ in range(250):
            member.write(bytes(2**20))


def lying_npy(path: Path) -> None:
    """A header that claims 10 ** 11 numbers before nothing at all."""
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (100000000000,), }".ljust(117) + b"\n"
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("x.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header)


def mat_bomb(path: Path) -> None:
    body = zlib.compress(struct.pack("<II", 14, 2**28) + bytes(2**28), 9)
    path.write_bytes(b"MATLAB 5.0".ljust(124) + b"\x00\x01IM" + struct.pack("<II", 15, len(body)) + body)


def empty_terabytes(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file.create_dataset("x", shape=(10**11,), dtype="f8", chunks=(10**6,))


def of_another_file(path: Path) -> None:
    path.with_suffix(".raw").write_bytes(np.ones(200).tobytes())
    with h5py.File(path, "w") as file:
        file.create_dataset("x", (200,), "f8", external=[(path.with_suffix(".raw").name, 0, 1600)])


BOMBS = [
    ("csv", million, "columns exchanged"), ("csv", long_line, "columns exchanged"), ("npz", zip_bomb, "at most 244"),
    ("npz", lying_npy, "cannot be read"), pytest.param("mat", mat_bomb, "at most 244", marks=pytest.mark.slow),
    ("h5", empty_terabytes, "at most 244"),
    ("nc", empty_terabytes, "at most 244"), ("h5", of_another_file, "other files"),
]  # fmt: skip


@pytest.mark.parametrize(("ending", "write", "words"), BOMBS, ids=lambda v: getattr(v, "__name__", str(v)))
def test_a_file_that_unpacks_to_more_than_fits_is_refused(
    tmp_path: Path, ending: str, write: Callable[[Path], None], words: str
) -> None:
    path = tmp_path / f"run.{ending}"
    write(path)
    assert words in refused(lambda: read_columns(path))


def test_the_largest_table_that_is_read_fits_into_2_gib(tmp_path: Path) -> None:
    """A table at a quarter of the limit takes a quarter of the memory, whether cells are looked at or not."""
    code = (
        "import resource, sys; from pathlib import Path; from lostmotion.recording import read_columns\n"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "read_columns(Path(sys.argv[1]))\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)"
    )
    path, rows = tmp_path / "run.csv", 200_000
    for end in ("1", ""):  # an empty cell has each cell looked at
        path.write_text("a,b,c,d,e\n" + "1,1,1,1,1\n" * rows + f"1,1,1,1,{end}\n")
        done = subprocess.run([sys.executable, "-c", code, path], capture_output=True, text=True, check=True)
        for_one = 1024 * int(done.stdout) / (5 * rows)
        assert for_one * 32e6 < 1.7 * 2**30


def test_pipes_and_devices_are_no_recordings(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "run.csv")
    os.mkfifo(tmp_path / "case.toml")
    assert "not a regular file" in refused(lambda: read_columns(tmp_path / "run.csv"))
    assert "not a regular file" in refused(lambda: load_case(tmp_path / "case.toml"))


def test_what_a_terminal_would_obey_is_shown_as_its_code(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text("time,\x1b[2Jx,y\n" + "".join(f"{k},1,{k % 7}\n" for k in range(200)))
    assert "control character b'\\x1b'" in refused(lambda: read_columns(tmp_path / "run.csv"))
    (tmp_path / "run.csv").write_bytes(b"time,\xc2\x9b2Jx,y\n" + b"".join(b"%d.5,1,2\n" % k for k in range(200)))
    done = CliRunner().invoke(main, ["analyse", str(tmp_path / "run.csv"), "--out", str(tmp_path / "out")])
    assert done.exit_code == 2
    assert "\\x9b2Jx" in done.stderr
    assert "\x9b" not in done.stderr


@pytest.mark.slow
def test_the_fuzz_campaign_finds_nothing() -> None:
    line = [
        sys.executable,
        str(Path(__file__).parents[2] / "benchmarks" / "fuzz.py"),
        "--inputs",
        "600",
        "--first",
        "7",
    ]
    kinds = ("csv", "mat5", "h5", "case", "values", "plugin", "chain", "campaign", "door")
    done = subprocess.run(
        [*line, *(word for kind in kinds for word in ("--only", kind))], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
    assert " 0 findings" in done.stdout.splitlines()[-1]
