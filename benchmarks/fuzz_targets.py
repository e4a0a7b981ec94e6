"""What `fuzz.py` damages and whom it gives it to: one seed or more for each kind of input."""

from __future__ import annotations

import io
import json
import tomllib
import warnings
import zipfile
from contextlib import redirect_stdout
from dataclasses import make_dataclass
from functools import partial

import numpy as np

from fuzz_door import door
from fuzz_seeds import CASE, COLUMNS, READ, TABLES, N
from lostmotion.case import Channel, RecordingSpec, dump_case, load_case
from lostmotion.errors import LostMotionError
from lostmotion.identification import checkpoint
from lostmotion.inference.setup import make_known
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.recording import load, load_recording, outline
from lostmotion.recording.formats import table_of
from lostmotion.recording.outline import GivenRoles, outline_table
from lostmotion.registry import Registry, default
from lostmotion_chaos.analysis import source
from lostmotion_chaos.analysis.source import WantedChannel, load_source
from lostmotion_chaos.maps import store

STORED = ("diagnosis", "analysis", "chain", "map", "campaign")
KINDS = (*TABLES, "case", "values", "plugin", *STORED, "door")
SPEC = RecordingSpec("run", "time", None, (Channel("u", "force", "N"),), (Channel("x", "position", "m"),))
NASTY = [
    b"1e999", b"-1e308", b"nan", b"inf", b"0x1p-1080", b"9" * 400, b"0x" + b"f" * 5000, b"1" * 5000, b"", b"\x00",
    b"\xff\xfe", b"\xef\xbb\xbf", b"\n", b"\r", b",", b";", b"\t", b'"', b"'", b"#", b"[" * 3000, b"a." * 3000,
    b"{" * 500, b"../../../x", b"\x1b[2J", b"<script>", b"\xe2\x80\xa8", b"\x85", b"1_000", b"true", b"-0.0",
    b"1979-05-27", b"%s%n", b"    -1\n",
]  # fmt: skip
TREE = [
    None, True, "", "<script>alert(1)</script>", "\x1b[2J", -1, 0, 1e308, 10**400, [], {}, [[[]]], {"a": {}}, "NaN",
    float("nan"), float("inf"), "x" * 5000, ["a", 1], -0.0,
]  # fmt: skip


def tried(kind, seeds, rng, folder, *, write_only=False):
    """Write one damaged input into the folder and have it read; what it is refused with goes up."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if kind in TABLES:
            return table(kind, seeds, rng, folder, write_only)
        return TARGETS[kind](seeds, rng, folder, write_only)


def damaged(raw: bytes, rng) -> bytes:
    """Return bytes after some mutations: cuts, flips, repeats, swaps, nasty words, numbers of other sizes."""
    data = bytearray(raw)
    for _ in range(int(rng.geometric(0.6))):
        way, at = int(rng.integers(8)), int(rng.integers(max(1, len(data))))
        size = int(min(len(data) - at, 2 ** rng.integers(0, 9)))
        if way == 0:
            del data[at : len(data) if rng.random() < 0.3 else at + size]
        elif way == 1:
            for k in rng.integers(max(1, len(data)), size=int(rng.integers(1, 9))):
                if data:
                    data[k] ^= 1 << int(rng.integers(8))
        elif way == 2:
            data[at:at] = data[at : at + size] * int(rng.integers(1, 5))
        elif way == 3:
            data[at : at + size] = rng.bytes(size)
        elif way in (4, 5):
            data[at : at + (size if way == 4 else 0)] = NASTY[int(rng.integers(len(NASTY)))]
        elif way == 6:
            data[at : at + 4] = [b"\xff\xff\xff\x7f", b"\x00\x00\x00\x00", b"\xff\xff\xff\xff"][int(rng.integers(3))]
        else:
            other = int(rng.integers(max(1, len(data))))
            data[at : at + size] = data[other : other + size]
    return bytes(data)


def words(text: str, rng) -> str:
    """Return a text of which some tokens were exchanged for others of its own or nasty ones."""
    tokens = text.split(" ")
    for _ in range(int(rng.integers(1, 5))):
        at = int(rng.integers(len(tokens)))
        nasty = NASTY[int(rng.integers(len(NASTY)))].decode("latin-1")
        tokens[at] = nasty if rng.random() < 0.5 else tokens[int(rng.integers(len(tokens)))]
    return " ".join(tokens)


FuzzTrial = make_dataclass("FuzzTrial", [("number", int)], frozen=True)
"""The outcome of a trial of a small campaign: its number."""


def unguarded():
    """Have foreign formats read in this process, where a crash or a hang is seen for what it is."""
    load.read_table = source.read_table = outline.read_table = table_of
    checkpoint.walk_in_subprocess = store.walk_in_subprocess = lambda path: None


def table(kind, seeds, rng, folder, write_only):
    name, raw = next(iter(seeds.files[kind].items()))
    path = folder / name
    path.write_bytes(_zipped(raw, rng) if kind == "npz" and rng.random() < 0.7 else damaged(raw, rng))
    if write_only:
        return
    attempts = (
        lambda: load_recording(RecordingSpec(name, *_rest()), folder),
        lambda: load_source(path, WantedChannel(("x",)), default()),
    )
    if kind in READ:  # made by the tests, with columns of other names
        attempts = (lambda: outline_table(path, GivenRoles()),)
    refused = None
    for attempt in attempts:
        try:
            attempt()
        except LostMotionError as err:
            refused = err
    if refused:
        raise refused


def _zipped(raw: bytes, rng) -> bytes:
    """Return an archive whose members are damaged, and whose checksums are right."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(raw)) as old, zipfile.ZipFile(out, "w") as new:
        hit = old.namelist()[int(rng.integers(len(old.namelist())))]
        for name in old.namelist():
            new.writestr(name, damaged(old.read(name), rng) if name == hit else old.read(name))
    return out.getvalue()


def _rest():
    return SPEC.time, SPEC.rate, SPEC.inputs, SPEC.sensors


def values(seeds, rng, folder, write_only):
    """Give columns of strange numbers to the checks."""
    columns = {name: column.copy() for name, column in COLUMNS.items()}
    for _ in range(int(rng.integers(1, 4))):
        name = ("time", "u", "x")[int(rng.integers(3))]
        _twist(columns, name, rng)
    np.savez(folder / "run.npz", **columns)
    if not write_only:
        recording = load_recording(RecordingSpec("run.npz", *_rest()), folder)
        assert np.isfinite(recording.data.excitation).all()
        assert not np.isinf(recording.data.response).any()
        assert all("\n" not in note for note in recording.notes)


def _twist(columns, name, rng):
    column, at = columns[name], int(rng.integers(N))
    size = int(rng.integers(1, N))
    strange = rng.choice([np.nan, np.inf, -np.inf, 1e308, -1e308, 5e-324, 0.0, 1e30, -9999.0])
    way = int(rng.integers(9))
    if way == 0:
        column[at : at + size] = strange
    elif way == 1:
        column[rng.integers(max(1, len(column)), size=3) if len(column) else []] = strange
    elif way == 2:
        columns[name] = column * rng.choice([1e300, 1e-300, -1.0, 1e-3, 57.3])
    elif way == 3:
        columns[name] = column[::-1].copy()
    elif way == 4:
        columns[name] = column[:at]
    elif way == 5:
        columns[name] = np.round(column, int(rng.integers(0, 6)))
    elif way == 6:
        columns["u"], columns["x"] = columns["x"], columns["u"]
    elif way == 7:
        columns[name] = rng.permutation(column)
    else:
        columns[name] = np.full(N, strange)


def case(seeds, rng, folder, write_only):
    """Give a damaged case to the front door of the commands, recording and model included."""
    good = CASE if rng.random() < 0.8 else CASE.replace("[[levels]]", "[[recordings]]")
    way = rng.random()
    if way < 0.6:
        _dumped(_tree(tomllib.loads(CASE), rng, spare=0.01), folder / "case.toml")
    else:
        text = words(good, rng).encode("utf-8", "replace") if way < 0.8 else damaged(good.encode(), rng)
        (folder / "case.toml").write_bytes(text)
    (folder / "run.csv").write_bytes(seeds.files["csv"]["run.csv"])
    if write_only:
        return
    load_case(folder / "case.toml")
    ready = prepare(folder / "case.toml", default())
    make_known(System(ready.model, ready.terms), ready.case)
    load_source(folder / "case.toml", WantedChannel(), default())


def _dumped(tree, path):
    """Write a case; JSON's null, which TOML has not, gives way."""
    dump_case(json.loads(json.dumps(tree).replace("null", "0")), path)


def plugin(seeds, rng, folder, write_only):
    """Give a class with strange metadata to a registry, and ask it for what `plugins show` prints."""
    from lostmotion.cli.plugins import _print_sheet
    from lostmotion.cli.sheets import make_sheet
    from lostmotion.contracts import Param, Term
    from lostmotion.quantities import FORCE

    def odd():
        return TREE[int(rng.integers(len(TREE)))]

    def one():
        given = {"name": "size", "meaning": "a size", "dimension": FORCE, "null": 0.0}
        for key in ("name", "meaning", "null", "low", "high", "scale", "prior"):
            if rng.random() < 0.1:
                given[key] = odd()
        return Param(**given)

    body = {"name": "odd", "physics": "A force of {size} acts", "formula": "size", "paper": "none"}
    body |= {key: odd() for key in (*body, "needs", "states", "motions") if rng.random() < 0.15}
    body["force"] = staticmethod(lambda t, x, v, u, p, s: p[0])
    if not write_only:
        body["params"] = (one(),) if rng.random() < 0.8 else odd()
        made = make_dataclass("Odd", [("at", str, "ground")], bases=(Term,), frozen=True, namespace=body)
        registry = Registry().add(made)
        (entry,) = registry.entries()
        with redirect_stdout(io.StringIO()):
            _print_sheet(make_sheet(entry, registry.load("term", entry.name)))


def _tree(value, rng, depth=0, spare=0.02):
    """Return nested JSON of which a few places hold something else."""
    if depth and rng.random() < spare * depth:
        return _other(value, rng)
    if isinstance(value, dict):
        return {k: _tree(v, rng, depth + 1, spare) for k, v in value.items() if rng.random() > spare / 4}
    if isinstance(value, list):
        return [_tree(v, rng, depth + 1, spare) for v in value]
    return value


def _other(value, rng):
    """Return something in place of a value: another number for a number half of the time, else anything."""
    if isinstance(value, float) and rng.random() < 0.7:
        return value * float(rng.choice([0.0, -1.0, 1e-300, 1e300, 1e6, 1e-6, np.nan, np.inf]))
    return TREE[int(rng.integers(len(TREE)))]


def report(kind, facts, arrays, seeds, rng, folder, write_only):
    files = dict(seeds.files[kind])
    if rng.random() < 0.5:
        files[facts] = json.dumps(_tree(json.loads(files[facts]), rng)).encode()
    else:
        which = facts if rng.random() < 0.5 else arrays
        files[which] = damaged(files[which], rng)
    for name, raw in files.items():
        (folder / name).write_bytes(raw)
    if write_only:
        return
    if kind == "diagnosis":
        from lostmotion.diagnosis.report.diagnosis_page import write_report as write
    else:
        from lostmotion_chaos.analysis.report.page import write_analysis as write
    write(folder)


def chain(seeds, rng, folder, write_only):
    path = folder / "chain.h5"
    path.write_bytes(damaged(seeds.files["chain"]["chain.h5"], rng))
    if not write_only:
        checkpoint.load(path, "abc")


def stored_map(seeds, rng, folder, write_only):
    import shutil

    from lostmotion_chaos.maps.map import Map

    shutil.rmtree(folder / "map.zarr", ignore_errors=True)
    names = list(seeds.files["map"])
    hit = names[int(rng.integers(len(names)))]
    for name, raw in seeds.files["map"].items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(damaged(raw, rng) if name == hit else raw)
    if not write_only:
        Map.open(folder / ("map.nc" if hit == "map.nc" else "map.zarr"))


def campaign(seeds, rng, folder, write_only):
    import shutil

    from lostmotion.campaigns.campaign import Campaign

    place = folder / "campaign"
    shutil.rmtree(place, ignore_errors=True)
    work = Campaign(FuzzTrial, FuzzTrial, 3, {"kind": "toy", "settings": {"a": 1}})
    work.run(place, 1)
    files = sorted(p for p in place.rglob("*") if p.is_file())
    hit = files[int(rng.integers(len(files)))]
    hit.write_bytes(damaged(hit.read_bytes(), rng))
    if not write_only:
        work.run(place, 1)


TARGETS = {
    "case": case, "values": values, "plugin": plugin,
    "diagnosis": partial(report, "diagnosis", "diagnosis.json", "arrays.nc"),
    "analysis": partial(report, "analysis", "analysis.json", "analysis.nc"), "chain": chain,
    "map": stored_map, "campaign": campaign, "door": door,
}  # fmt: skip
