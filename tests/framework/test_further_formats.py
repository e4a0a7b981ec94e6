"""Formats whose libraries are extras: there and back, what is missing is named, and a third party adds one."""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import escape

import numpy as np
import pytest

from lostmotion.errors import DataError
from lostmotion.offers import READER
from lostmotion.recording import read_table
from lostmotion.recording.folders import digest_recording
from lostmotion.recording.formats import ENDINGS, is_recording
from lostmotion.recording.offered import OfferedReader, offered_readers
from lostmotion.recording.outline import GivenRoles, outline_table
from lostmotion.registry import default

N = 200
TIME = np.arange(N) / 100.0
FORCE = 40.0 * np.sin(7.0 * TIME)
PLACE = 30.0 * np.cos(7.0 * TIME)
LIBRARIES = {
    "xlsx": "python_calamine", "tdms": "nptdms", "mf4": "asammdf", "parquet": "pyarrow",
    "mcap": "mcap", "bag": "rosbags", "uff": "pyuff",
}  # fmt: skip


def to_xlsx(path: Path) -> None:
    """Write a sheet as Excel does: a title, names, a row of units, numbers; and a second sheet with words only."""
    heads = [["Run 7"], ["Time", "Motor force", "Position"], ["s", "N", "mm"]]
    rows = [*heads, *np.column_stack([TIME, FORCE, PLACE]).tolist()]
    pack_sheets(path, {"Data": rows, "Notes": [["made by hand"]]})


def pack_sheets(path: Path, sheets: dict[str, list[list[object]]]) -> None:
    main, rel = "http://schemas.openxmlformats.org/spreadsheetml/2006/main", "http://schemas.openxmlformats.org"
    office = f"{rel}/officeDocument/2006/relationships"
    book = "".join(f'<sheet name="{n}" sheetId="{i}" r:id="r{i}"/>' for i, n in enumerate(sheets, 1))
    links = "".join(
        f'<Relationship Id="r{i}" Type="{office}/worksheet" Target="worksheets/s{i}.xml"/>'
        for i, _ in enumerate(sheets, 1)
    )
    kinds = "".join(
        f'<Override PartName="/xl/worksheets/s{i}.xml"'
        ' ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"/>'
        for i, _ in enumerate(sheets, 1)
    )
    with zipfile.ZipFile(path, "w") as file:
        file.writestr(
            "[Content_Types].xml",
            f'<Types xmlns="{rel}/package/2006/content-types"><Default Extension="rels"'
            ' ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Override'
            ' PartName="/xl/workbook.xml" ContentType="application/vnd.openxmlformats-officedocument.'
            f'spreadsheetml.sheet.main+xml"/>{kinds}</Types>',
        )
        file.writestr(
            "_rels/.rels",
            f'<Relationships xmlns="{rel}/package/2006/relationships"><Relationship Id="r1"'
            f' Type="{office}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
        )
        file.writestr(
            "xl/workbook.xml", f'<workbook xmlns="{main}" xmlns:r="{office}"><sheets>{book}</sheets></workbook>'
        )
        file.writestr(
            "xl/_rels/workbook.xml.rels",
            f'<Relationships xmlns="{rel}/package/2006/relationships">{links}</Relationships>',
        )
        for i, rows in enumerate(sheets.values(), 1):
            body = "".join(f"<row>{''.join(map(write_cell, row))}</row>" for row in rows)
            file.writestr(
                f"xl/worksheets/s{i}.xml", f'<worksheet xmlns="{main}"><sheetData>{body}</sheetData></worksheet>'
            )


def write_cell(cell: object) -> str:
    if isinstance(cell, str):
        return f'<c t="inlineStr"><is><t>{escape(cell)}</t></is></c>'
    return f"<c><v>{cell!r}</v></c>"


def to_tdms(path: Path) -> None:
    import nptdms

    told = {"wf_increment": 0.01, "wf_start_offset": 0.0}
    held = [("Motor force", FORCE, "N"), ("Position", PLACE, "mm")]
    with nptdms.TdmsWriter(str(path)) as file:
        file.write_segment([nptdms.ChannelObject("run", n, v, {**told, "unit_string": u}) for n, v, u in held])


def to_mf4(path: Path) -> None:
    import asammdf

    signals = [
        asammdf.Signal(FORCE, TIME, name="Motor force", unit="N"),
        asammdf.Signal(PLACE, TIME, name="Position", unit="mm"),
    ]
    with asammdf.MDF(version="4.10") as file:
        file.append(signals)
        file.save(str(path))


def to_parquet(path: Path) -> None:
    import pyarrow
    import pyarrow.parquet

    fields = [("time", "s"), ("Motor force", "N"), ("Position", "mm")]
    schema = pyarrow.schema([pyarrow.field(n, pyarrow.float64(), metadata={"unit": u}) for n, u in fields])
    pyarrow.parquet.write_table(pyarrow.table([TIME, FORCE, PLACE], schema=schema), path)


def to_mcap(path: Path) -> None:
    """Write messages of ROS 2 about both, and one topic of words."""
    from mcap_ros2.writer import Writer

    header = "std_msgs/Header header\nfloat64[] values\n" + "=" * 80
    header += "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + "=" * 80
    header += "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec"
    with path.open("wb") as stream:
        writer = Writer(stream)
        both = writer.register_msgdef("lab_msgs/Reading", header)
        words = writer.register_msgdef("std_msgs/String", "string data")
        for i in range(N):
            at = 1_700_000_000_000_000_000 + i * 10_000_000
            stamp = {"sec": at // 10**9, "nanosec": at % 10**9}
            content = {"header": {"stamp": stamp, "frame_id": "rig"}, "values": [FORCE[i], PLACE[i]]}
            writer.write_message("/rig", both, content, log_time=at + 3_000_000 * (i % 2), publish_time=at)
            writer.write_message("/say", words, {"data": "on"}, log_time=at, publish_time=at)
        writer.finish()


def to_bag(path: Path) -> None:
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    types = get_typestore(Stores.ROS1_NOETIC)
    pair = types.types["std_msgs/msg/Float64MultiArray"]
    layout = types.types["std_msgs/msg/MultiArrayLayout"](dim=[], data_offset=0)
    with Writer(path) as bag:
        topic = bag.add_connection("/rig", pair.__msgtype__, typestore=types)
        for i in range(N):
            raw = types.serialize_ros1(pair(layout=layout, data=np.array([FORCE[i], PLACE[i]])), pair.__msgtype__)
            bag.write(topic, 1_700_000_000_000_000_000 + i * 10_000_000, raw)


def to_bag2(path: Path) -> None:
    """Write a bag of ROS 2: a folder with its description and a database."""
    from rosbags.rosbag2 import Writer
    from rosbags.typesys import Stores, get_typestore

    types = get_typestore(Stores.ROS2_HUMBLE)
    pair = types.types["std_msgs/msg/Float64MultiArray"]
    layout = types.types["std_msgs/msg/MultiArrayLayout"](dim=[], data_offset=0)
    with Writer(path, version=9) as bag:
        topic = bag.add_connection("/rig", pair.__msgtype__, typestore=types)
        for i in range(N):
            raw = types.serialize_cdr(pair(layout=layout, data=np.array([FORCE[i], PLACE[i]])), pair.__msgtype__)
            bag.write(topic, 1_700_000_000_000_000_000 + i * 10_000_000, raw)


WRITERS: dict[str, Callable[[Path], None]] = {
    "xlsx": to_xlsx, "tdms": to_tdms, "mf4": to_mf4, "parquet": to_parquet,
}  # fmt: skip


def written(folder: Path, ending: str, write: Callable[[Path], None]) -> Path:
    """Return a file of this format; skip where its library is absent."""
    pytest.importorskip(LIBRARIES[ending], reason=f"the extra of {ending} is not installed")
    write(folder / f"run.{ending}")
    return folder / f"run.{ending}"


@pytest.mark.parametrize("ending", list(WRITERS))
def test_a_further_format_becomes_the_same_table(tmp_path: Path, ending: str) -> None:
    path = written(tmp_path, ending, WRITERS[ending])
    found = outline_table(path, GivenRoles())
    assert is_recording(path)
    assert found.dt == pytest.approx(0.01, rel=1e-6)
    columns = {one.name: one for one in found.columns}
    np.testing.assert_allclose(columns["Motor force"].values, FORCE, atol=1e-9)
    np.testing.assert_allclose(columns["Position"].values, PLACE, atol=1e-9)
    assert {name: one.unit for name, one in columns.items()} == {"Motor force": "N", "Position": "mm"}


@pytest.mark.parametrize(
    ("ending", "write", "names"),
    [("mcap", to_mcap, ("/rig.values[0]", "/rig.values[1]")), ("bag", to_bag, ("/rig.data[0]", "/rig.data[1]"))],
)
def test_messages_of_a_robot_become_columns(
    tmp_path: Path, ending: str, write: Callable[[Path], None], names: tuple[str, str]
) -> None:
    table = read_table(written(tmp_path, ending, write))
    np.testing.assert_array_equal(table.columns[names[0]], FORCE)
    np.testing.assert_array_equal(table.columns[names[1]], PLACE)
    late = 0.003 * (np.arange(N) % 2) if ending == "mcap" else 0.0
    np.testing.assert_allclose(table.columns["/rig.time"], TIME + late, atol=1e-12)
    if ending == "mcap":
        np.testing.assert_allclose(table.columns["/rig.header.stamp"], TIME, atol=1e-12)
    assert not any(name.startswith("/say.data") for name in table.columns)


@pytest.mark.parametrize("what", ["folder", "database"])
def test_a_bag_of_ros_2_is_read_as_a_folder_and_as_its_database(tmp_path: Path, what: str) -> None:
    pytest.importorskip("rosbags", reason="the extra rosbag is not installed")
    to_bag2(tmp_path / "run")
    (database,) = (tmp_path / "run").glob("*.db3")
    path = tmp_path / "run" if what == "folder" else database
    assert is_recording(path)
    table = read_table(path)
    np.testing.assert_array_equal(table.columns["/rig.data[0]"], FORCE)
    np.testing.assert_array_equal(table.columns["/rig.data[1]"], PLACE)
    np.testing.assert_allclose(table.columns["/rig.time"], TIME, atol=1e-12)
    if what == "folder":
        before = digest_recording(path)
        (path / "metadata.yaml").write_bytes((path / "metadata.yaml").read_bytes() + b"\n")
        assert digest_recording(path) != before


def test_a_database_without_its_description_is_read(tmp_path: Path) -> None:
    """A copy of the database alone, as people send it."""
    pytest.importorskip("rosbags", reason="the extra rosbag is not installed")
    to_bag2(tmp_path / "run")
    (database,) = (tmp_path / "run").glob("*.db3")
    alone = tmp_path / "alone.db3"
    alone.write_bytes(database.read_bytes())
    np.testing.assert_array_equal(read_table(alone).columns["/rig.data[0]"], FORCE)


def test_an_empty_bag_folder_is_told_so(tmp_path: Path) -> None:
    pytest.importorskip("rosbags", reason="the extra rosbag is not installed")
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "metadata.yaml").write_text("nothing: 1\n")
    with pytest.raises(DataError, match="run"):
        read_table(tmp_path / "run")


def test_lists_in_a_parquet_file_become_columns(tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow", reason="the extra parquet is not installed")
    parquet = importlib.import_module("pyarrow.parquet")
    lists = np.column_stack([FORCE, PLACE]).tolist()
    content = pyarrow.table({"timestamp": TIME, "observation.state": lists, "task": ["a"] * N})
    parquet.write_table(content, tmp_path / "run.parquet")
    table = read_table(tmp_path / "run.parquet")
    np.testing.assert_array_equal(table.columns["observation.state[1]"], PLACE)
    assert "task" in table.refused


def test_two_sheets_with_numbers_are_asked_about(tmp_path: Path) -> None:
    pytest.importorskip("python_calamine", reason="the extra xlsx is not installed")
    rows = [["time", "x"], *np.column_stack([TIME, PLACE]).tolist()]
    pack_sheets(tmp_path / "run.xlsx", {"A": rows, "B": rows})
    with pytest.raises(DataError, match=r"2 sheets with numbers \(A, B\)"):
        read_table(tmp_path / "run.xlsx")


@pytest.mark.parametrize("below", [[], [[], ["Mean", 1.0, 2.0]]])
def test_a_sheet_of_texts_with_decimal_commas_is_read(tmp_path: Path, below: list[list[object]]) -> None:
    pytest.importorskip("python_calamine", reason="the extra xlsx is not installed")
    texts = [[f"{value:.4f}".replace(".", ",") for value in row] for row in np.column_stack([TIME, FORCE, PLACE])]
    pack_sheets(tmp_path / "run.xlsx", {"A": [["Time [s]", "Force [N]", "Pos [mm]"], *texts, *below]})
    table = read_table(tmp_path / "run.xlsx")
    np.testing.assert_allclose(table.columns["Force"], FORCE, atol=1e-4)
    assert table.units["Pos"] == "mm"


@pytest.mark.parametrize("ending", [*WRITERS, "mcap", "bag"])
def test_a_damaged_file_is_told_so(tmp_path: Path, ending: str) -> None:
    writers = {**WRITERS, "mcap": to_mcap, "bag": to_bag}
    path = written(tmp_path, ending, writers[ending])
    raw = path.read_bytes()
    for content in (np.random.default_rng(1).bytes(5000), raw[: len(raw) // 20]):
        path.write_bytes(content)
        with pytest.raises(DataError, match=rf"run\.{ending}"):
            read_table(path)


@pytest.mark.parametrize("ending", sorted(LIBRARIES))
def test_a_format_without_its_library_names_the_extra(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str
) -> None:
    hidden = tmp_path / "hidden"
    hidden.mkdir()
    library = LIBRARIES[ending]
    (hidden / f"{library}.py").write_text(f"raise ModuleNotFoundError('none here', name={library!r})\n")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(hidden), os.environ.get("PYTHONPATH", "")]))
    (tmp_path / f"run.{ending}").write_bytes(b"anything")
    extra = {"bag": "rosbag"}.get(ending, ending)
    with pytest.raises(DataError, match=rf"\({library}\): pip install 'lostmotion\[{extra}\]'"):
        read_table(tmp_path / f"run.{ending}")


CORE = """
import sys
from pathlib import Path
import h5py, numpy as np, scipy.io, xarray as xr
from lostmotion.recording import read_table
folder, columns = Path(sys.argv[1]), {"time": np.arange(200) / 100.0, "x": np.cos(np.arange(200) / 9.0)}
rows = np.column_stack(list(columns.values()))
for ending, between in (("csv", ","), ("tsv", "\\t"), ("txt", " ")):
    np.savetxt(folder / f"run.{ending}", rows, delimiter=between, header=between.join(columns), comments="")
np.savez(folder / "run.npz", **columns)
scipy.io.savemat(folder / "run.mat", columns)
xr.Dataset({"x": ("time", columns["x"])}, {"time": columns["time"]}).to_netcdf(folder / "run.nc", engine="h5netcdf")
with h5py.File(folder / "run.h5", "w") as file:
    for name, column in columns.items():
        file[name] = column
head = "LabVIEW Measurement\\t\\nSeparator\\tTab\\nX_Columns\\tOne\\n***End_of_Header***\\t\\n\\nChannels\\t1\\t\\n"
head += "Samples\\t200\\t\\nDelta_X\\t0.01\\t\\n***End_of_Header***\\t\\t\\nX_Value\\tx\\tComment\\n"
(folder / "run.lvm").write_text(head + "".join(f"{t:.2f}\\t{x!r}\\t\\n" for t, x in rows.tolist()))
for ending in ("csv", "tsv", "txt", "npz", "mat", "nc", "h5", "lvm"):
    np.testing.assert_allclose(read_table(folder / f"run.{ending}").columns["x"], columns["x"], atol=1e-12)
print("read")
"""


def test_the_formats_of_the_core_need_no_extra(tmp_path: Path) -> None:
    """All libraries of the extras are hidden, in this process and in that of the reader."""
    hidden = tmp_path / "hidden"
    hidden.mkdir()
    for library in {*LIBRARIES.values(), "mcap_ros2"}:
        (hidden / f"{library}.py").write_text(f"raise ModuleNotFoundError('none here', name={library!r})\n")
    places = os.pathsep.join([str(hidden), os.environ.get("PYTHONPATH", "")])
    line = [sys.executable, "-c", CORE, str(tmp_path)]
    done = subprocess.run(line, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": places}, check=False)
    assert done.stdout == "read\n", done.stderr


def test_every_offered_reader_has_an_extra_and_can_be_imported() -> None:
    text = (Path(__file__).parents[2] / "pyproject.toml").read_text()
    for ending, (reader, *others) in offered_readers().items():
        assert not others, ending
        assert ending not in ENDINGS
        module, _, function = reader.target.partition(":")
        assert callable(getattr(importlib.import_module(module), function))
        extra = reader.requirement.removeprefix("lostmotion[").removesuffix("]")
        assert f"\n{extra} = [" in text, extra


def test_readers_are_listed_with_the_plugins() -> None:
    listed = {entry.name: entry for entry in default().entries() if entry.kind == READER}
    assert set(LIBRARIES) <= set(listed)
    assert listed["mf4"].about == "lostmotion[mf4]"


def test_an_unknown_ending_lists_those_that_are_read(tmp_path: Path) -> None:
    with pytest.raises(DataError, match=r"ends in 'zzz': expected one of csv, .*, xlsx; export"):
        read_table(tmp_path / "run.zzz")


def test_a_third_party_adds_a_format(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_package(tmp_path / "site", "two_bytes", "twb")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path / "site"), os.environ.get("PYTHONPATH", "")]))
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    offered_readers.cache_clear()
    try:
        assert offered_readers()["twb"] == (OfferedReader("two-bytes", "two_bytes:read", "two-bytes"),)
        (tmp_path / "run.twb").write_bytes(np.arange(6, dtype="<i2").tobytes())
        table = read_table(tmp_path / "run.twb")
        assert table.columns["count"].tolist() == [0, 1, 2, 3, 4, 5]
        assert table.units["count"] == "mm"
        write_package(tmp_path / "site", "other", "twb")
        importlib.invalidate_caches()
        offered_readers.cache_clear()
        with pytest.raises(DataError, match=r"'twb' are read by .* uninstall one of them"):
            read_table(tmp_path / "run.twb")
    finally:
        monkeypatch.undo()
        offered_readers.cache_clear()


def write_package(site: Path, name: str, ending: str) -> None:
    """Write an installed package that offers a reader."""
    told = site / f"{name}-1.0.dist-info"
    told.mkdir(parents=True)
    project = name.replace("_", "-")
    (told / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project}\nVersion: 1.0\n")
    (told / "entry_points.txt").write_text(f"[lostmotion.v1]\n{name} = {name}\n")
    (site / f"{name}.py").write_text(
        "from lostmotion.hookspecs import hookimpl\n\n\n"
        "@hookimpl\ndef lostmotion_readers():\n"
        f"    return {{{ending!r}: ('{name}:read', {project!r})}}\n\n\n"
        "def read(path):\n    import numpy as np\n    from lostmotion.recording import table_of_arrays\n\n"
        "    return table_of_arrays({'count': np.fromfile(path, dtype='<i2')}, {'count': 'mm'})\n"
    )
