"""A map on the command line: what is said, what is written, what is refused, and what `--help` shows."""

import json
import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from click.testing import CliRunner

from lostmotion.cli import main

X, Y = ("--x", "alpha=0.2:0.6:5:inverse"), ("--y", "zeta=0.01:0.04:4")
SHORT = ("--periods", 60, "--transient", 20, "--starts", 2, "--quiet")


def run(*args):
    return CliRunner().invoke(main, ["map", *map(str, args)], prog_name="lostmotion")


def test_a_map_is_made_drawn_and_told(tmp_path):
    out = tmp_path / "map.zarr"
    result = run("--model", "lin_backlash", *X, *Y, *SHORT, "--unit", "bit", "--figure", "--out", out)
    assert result.exit_code == 0, result.output
    lines = result.output.splitlines()
    assert "5 alpha x 4 zeta, 2 starts" in lines[0]
    assert "% chaotic" in lines[0]
    assert lines[1].startswith("20 cells computed in ")
    assert lines[2] == str(tmp_path / "map.png")
    assert (tmp_path / "map.png").stat().st_size > 10_000
    with xr.open_zarr(out) as stored:
        assert dict(stored.sizes) == {"alpha": 5, "zeta": 4, "start": 2}
        assert stored["lyapunov_max"].attrs["units"] == "bit/t_bar"
        assert np.isfinite(stored["lyapunov_max"]).all()
    again = run("--model", "lin_backlash", *X, *Y, *SHORT, "--unit", "bit", "--out", out)
    assert "computed" not in again.output
    other = run("--model", "lin_backlash", *X, *Y, *SHORT, "--out", out)
    assert other.exit_code == 2
    assert "with other settings (settings unit bit/t_bar, now 1/t_bar)" in other.output
    assert "--fresh" in other.output


def test_a_machine_in_si_units_with_a_term_is_mapped(tmp_path):
    out = tmp_path / "map.nc"
    result = run(
        "--model", "lin_backlash", "--set", "m=1,c=8,k0=4e4", "--set", "x0=0.005",
        "--term", "viscous_damping", "--drive", "harmonic:omega=40", "--x", "viscous_damping.coefficient=0:10:2",
        "--y", "drive.amplitude=90:110:2", *SHORT, "--out", out,
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    with xr.open_dataset(out) as stored:
        assert stored["lyapunov_max"].attrs["units"] == "1/s"
        assert stored["drive.amplitude"].attrs["units"] == "N"
        settings = json.loads(stored.attrs["provenance"])["settings"]
    assert settings["terms"] == ["viscous_damping"]
    assert settings["fixed"] == {"c": 8.0, "drive.omega": 40.0, "k0": 40000.0, "m": 1.0, "x0": 0.005}


def test_three_axes_and_a_refined_map(tmp_path):
    three = ("--axis", "frequency_ratio=0.15:0.25:2", "--out", tmp_path / "three.nc")
    result = run("--model", "lin_backlash", *X, *Y, *SHORT, *three)
    assert result.exit_code == 0, result.output
    assert "5 alpha x 4 zeta x 2 frequency_ratio" in result.output
    refined = run("--model", "lin_backlash", *X, *Y, *SHORT, "--refine", 1, "--out", tmp_path / "fine.zarr")
    assert refined.exit_code == 0, refined.output
    assert "9 alpha x 7 zeta" in refined.output


@pytest.mark.parametrize(
    ("args", "says"),
    [
        (("--model", "lin_backlash", *X), "zeta is not given: add --set zeta=..."),
        (("--model", "lin_backlsh", *X, *Y), "did you mean 'lin_backlash'"),
        (("--model", "lin_backlash", "--x", "alpha=0.1:0.5", *Y), "NAME=LOW:HIGH:N"),
        (("--model", "lin_backlash", *X, *Y, "--set", "zeta"), "write key=value"),
        (("--model", "lin_backlash", *X, *Y, "--periods", "10"), "periods"),
        (("--model", "lin_backlash", *X, *Y, "--cluster", "nonsense://x"), "there is no cluster at nonsense://x"),
    ],
)
def test_what_cannot_be_meant_is_one_sentence(tmp_path, args, says):
    result = run(*args, "--quiet", "--out", tmp_path / "a.zarr")
    assert result.exit_code == 2
    assert says in result.output
    assert "Traceback" not in result.output


def test_a_place_that_cannot_be_is_refused(tmp_path):
    (tmp_path / "file").write_text("x")
    result = run("--model", "lin_backlash", *X, *Y, *SHORT, "--out", tmp_path / "file" / "a.zarr")
    assert result.exit_code == 2
    assert "cannot be written" in result.output


def test_help_has_examples_and_loads_nothing_heavy():
    result = run("--help")
    assert "Examples:" in result.output
    assert "--refine" in result.output
    code = (
        "import sys; import lostmotion_chaos.commands.map;"
        " print(sorted({'numpy', 'xarray', 'zarr', 'numba'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
