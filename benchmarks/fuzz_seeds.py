"""Good files of every kind that `fuzz.py` damages, made anew by each run."""

from __future__ import annotations

import shutil
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import h5py
import numpy as np
import pyuff
import scipy.io
import xarray as xr

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests" / "framework"), str(ROOT / "tests" / "chaos")]
EXTRAS = {"xlsx": "python_calamine", "tdms": "nptdms", "mcap": "mcap_ros2", "bag": "rosbags", "db3": "rosbags",
          "parquet": "pyarrow", "mf4": "asammdf"}  # fmt: skip
"""Formats whose libraries are extras: they are tried where the library is installed."""
READ = tuple(name for name, library in EXTRAS.items() if find_spec(library))
TABLES = ("csv", "txt", "lvm", "logger", "npz", "mat5", "mat73", "nc", "nc3", "h5", "uff", *READ)
N = 240
TIME = np.arange(N) / 100.0
COLUMNS = {"time": TIME, "u": np.sin(9.0 * TIME), "x": 1e-3 * np.cos(9.0 * TIME) + 1e-5 * np.sin(31.0 * TIME**2)}
CASE = """title = "A slider"
[[recordings]]
file = "run.csv"
time = "time"
excitation = { column = "u", quantity = "force", unit = "N", factor = 2.0 }
response = { column = "x", quantity = "position", unit = "mm" }
hold = "step"
t_start = 0.1
t_end = 2.2
name = "first"

[[levels]]
amplitude = 2.07
unit = "deg"
frequency = 1.54
motion = "chaotic"
lyapunov = { value = 1.42, sd = 0.2, unit = "bit/s" }
d2 = { value = 2.1, low = 2.0, high = 2.2 }

[sensor]
noise = "each"
offset = { mean = 0.0, sd = 1e-4 }

[experiment]
max_level = 3.0

[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 4e4
[model.estimate]
c = { low = 0.8, high = 80.0, scale = "log" }
x0 = { median = 5e-3, sd_log = 0.5, each = true }
k1 = { half_sd = 2.0 }
"""


@dataclass(frozen=True)
class Seeds:
    """Good files by kind, as bytes by name."""

    files: dict[str, dict[str, bytes]]

    @classmethod
    def made(cls, folder: Path) -> Seeds:
        """Return the seeds, made in an empty folder."""
        made = {}
        for kind in (*TABLES, "diagnosis", "analysis", "chain", "map"):
            place = folder / kind
            place.mkdir()
            MAKERS[kind](place)
            made[kind] = {
                p.relative_to(place).as_posix(): p.read_bytes() for p in sorted(place.rglob("*")) if p.is_file()
            }
        return cls(made)

    @staticmethod
    def share(kind: str) -> float:
        """Return how many inputs of a kind are made for one of the others: drawing a report takes seconds."""
        return {
            "diagnosis": 0.02,
            "analysis": 0.02,
            "map": 0.2,
            "chain": 0.5,
            "campaign": 0.3,
            "csv": 2.0,
            "case": 3.0,
        }.get(kind, 1.0)


def _npz(folder):
    np.savez(folder / "run.npz", **COLUMNS)


def _csv(folder, name="run.csv", separator=","):
    np.savetxt(folder / name, np.column_stack(list(COLUMNS.values())), fmt="%.9g", delimiter=separator,
               header=separator.join(COLUMNS), comments="")  # fmt: skip


def _mat5(folder):
    scipy.io.savemat(folder / "run.mat", {**COLUMNS, "log": {"a": TIME, "note": "words"}})


def _mat73(folder):
    path = folder / "run.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, column in COLUMNS.items():
            file.create_dataset(name, data=column[None, :]).attrs["MATLAB_class"] = np.bytes_("double")
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: test".ljust(124) + b"\x00\x02IM")


def _nc(folder, engine="h5netcdf"):
    names = {k: ("time", v) for k, v in COLUMNS.items() if k != "time"}
    xr.Dataset(names, {"time": ("time", TIME, {"units": "seconds"})}).to_netcdf(folder / "run.nc", engine=engine)


def _h5(folder):
    with h5py.File(folder / "run.h5", "w") as file:
        for name, column in COLUMNS.items():
            file.create_dataset(name, data=column, compression="gzip")


def _uff(folder):
    for name in ("u", "x"):
        head = pyuff.prepare_58(
            binary=0, id1=name, func_type=1, rsp_node=1, rsp_dir=1, ref_node=1, ref_dir=1, data=COLUMNS[name], x=TIME,
            abscissa_spacing=1, abscissa_min=0.0, abscissa_inc=0.01, num_pts=N, ord_data_type=4,
        )  # fmt: skip
        sets = {"orddenom_spec_data_type": 0, "z_axis_spec_data_type": 0} | head
        pyuff.UFF(str(folder / "run.uff")).write_sets([sets], "add")


def _lvm(folder):
    head = (
        "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nMulti_Headings\tNo\nX_Columns\tOne\n"
        "Date\t2025/03/04\nTime\t09:58:50.123\n***End_of_Header***\t\n\t\nChannels\t2\t\t\n"
        f"Samples\t{N}\t{N}\t\nY_Unit_Label\tN\tmm\t\nX0\t0.0\t0.0\t\nDelta_X\t0.01\t0.01\t\n"
        "***End_of_Header***\t\t\t\nX_Value\tu\tx\tComment\n"
    )
    rows = np.column_stack(list(COLUMNS.values()))
    (folder / "run.lvm").write_text(head + "".join(f"{t:.4f}\t{u:.6g}\t{x:.6g}\t\n" for t, u, x in rows))


def _logger(folder):
    """Comments, units, stamps, decimal commas, rows without their last cell, statistics: all that text tables have."""
    head = "# rig 3\n;Kraft;Weg\ntime;u;x\n;[N];[mm]\n"
    stamps = np.datetime64("2025-03-04T09:58:50.000") + np.arange(N) * np.timedelta64(10, "ms")
    rows = [f"{str(s).replace('T', ' ')};{u:.6f};{x:.6f}".replace(".", ",") for s, u, x in
            zip(stamps, COLUMNS["u"], COLUMNS["x"], strict=True)]  # fmt: skip
    rows[7] = rows[7].rpartition(";")[0]
    (folder / "run.csv").write_text(head + "\n".join(rows) + "\nMittelwert;0,1;0,2\n", encoding="utf-8")


def _further(ending):
    def make(folder):
        import test_further_formats as formats

        if ending == "db3":
            formats.to_bag2(folder / "bag")
            (database,) = (folder / "bag").glob("*.db3")
            database.rename(folder / "run.db3")
            shutil.rmtree(folder / "bag")
        else:
            getattr(formats, f"to_{ending}")(folder / f"run.{ending}")

    return make


def _diagnosis(folder):
    import report_fixture

    report_fixture.write(folder, report_fixture.mismatch(), report_fixture.arrays(periods=20))


def _analysis(folder):
    import analysis_fixture

    analysis_fixture.write(folder, *analysis_fixture.chaotic())


def _chain(folder):
    import emcee
    from emcee.backends import Backend

    from lostmotion.identification import checkpoint as _keep
    from lostmotion.identification.normal_scores import Scores
    from lostmotion.identification.t_mixture import TMixture

    rng = np.random.default_rng(0)
    start = emcee.State(
        rng.normal(size=(8, 2)), log_prob=rng.normal(size=8), random_state=np.random.RandomState(0).get_state()
    )
    backend = Backend()
    backend.reset(8, 2)
    backend.grow(3, None)
    for _ in range(3):
        backend.save_step(start, np.ones(8, dtype=bool))
    scale = Scores(*(np.full(2, v) for v in (-1.0, 1.0, 0.0, 1.0)))
    cloud = TMixture(weights=np.ones(1), centres=np.zeros((1, 2)), roots=np.eye(2)[None], scale=scale)
    _keep.save(folder / "chain.h5", "abc", ("a", "b"), _keep.StoredChain(backend, cloud, start, 3, 1), 3)


def _map(folder):
    from click.testing import CliRunner

    from lostmotion.cli import main

    for out in ("map.zarr", "map.nc"):
        line = "map --model lin_backlash --x alpha=0.1:0.6:2:inverse --y zeta=0.01:0.06:2 --periods 40 --transient 5"
        done = CliRunner().invoke(main, [*line.split(), "--starts", "1", "--out", str(folder / out)])
        assert done.exit_code == 0, done.output


MAKERS = {
    "csv": _csv, "txt": lambda folder: _csv(folder, "run.txt", " "), "npz": _npz, "mat5": _mat5, "mat73": _mat73,
    "nc": _nc, "nc3": lambda folder: _nc(folder, "scipy"), "h5": _h5, "uff": _uff, "diagnosis": _diagnosis,
    "analysis": _analysis, "chain": _chain, "map": _map, "lvm": _lvm, "logger": _logger,
    **{ending: _further(ending) for ending in READ},
}  # fmt: skip
