"""Times of the page: to the first screen, to the plot of a million rows, of a zoom, a parameter, a term, a check.

    python benchmarks/app.py                    all of them, wall time and processor time of the server
    python benchmarks/app.py --pictures DIR     pictures of five screens; docs/howto has all but that of Check

It needs the extra `app` and Chromium. Wall times include the browser; on a machine with other work, the processor time
of the server tells more.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "plugins"))

from chromium import Chromium

SERVE = "from lostmotion_app.command import command; command()"
ROWS = 1_000_000
SAMPLES = 24_000
SIMULATED = (
    "simulate", "lin_backlash", "--set", "m=1,c=8,k0=4e4,x0=0.005", "--term", "coulomb_friction:force=3", "--drive",
    "harmonic:amplitude=100,omega=40", "--rate", "640", "--noise", "0.01",
)  # fmt: skip
ERROR = "(words().match(/free runs: [^0-9]*([0-9.e-]+) %/) || [])[1]"
DIAGNOSED = "diagnose-1: done, [0-9]+ s, ([0-9]+) s of processor time"
PANEL = "Bokeh.documents[0].get_model_by_name('panel 0')"
KNOWN = {"m": "1", "k0": "40000", "k1": "0"}
UNITS = {"m": "kg", "k0": "N/m", "k1": "N/m"}
PATIENCE = 900.0
IDLE = 0.03
"""The processor time (s) in a second up to which a server does nothing."""
SETTLED = 4.0
"""Seconds after which a screen has drawn all its figures."""


class Server:
    """The page of a folder in another process."""

    def __init__(self, folder: Path) -> None:
        self.begin = time.perf_counter()
        words = [sys.executable, "-c", SERVE, str(folder), "--no-open"]
        self.process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout is not None
        self.address = self.process.stdout.readline().strip()

    @property
    def processor(self) -> float:
        """The processor time that the server has used (s)."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def wait_idle(self) -> None:
        """Wait until the server does nothing for a second: what it does delays the answer that is measured next."""
        before = -1.0
        while self.processor - before > IDLE:
            before = self.processor
            time.sleep(1.0)


def lostmotion(*words: str) -> None:
    """Run a command."""
    subprocess.run([sys.executable, "-m", "lostmotion", *words], check=True, stdout=subprocess.DEVNULL)


def write_recordings(folder: Path) -> None:
    """Write a million rows of four columns, and a simulated machine with 24 000 samples."""
    t = np.arange(ROWS) / 2000.0
    noise = np.random.default_rng(0).standard_normal(ROWS)
    rows = np.stack([t, 100.0 * np.sin(40.0 * t), 5e-3 * np.sin(40.0 * t - 1.0) + 1e-5 * noise, noise], axis=1)
    head = "time [s],force [N],position [m],velocity [m/s]"
    np.savetxt(folder / "million.csv", rows, delimiter=",", header=head, comments="", fmt="%.7g")
    lostmotion(*SIMULATED, "--duration", f"{SAMPLES / 640.0:g}", "--out", str(folder / "long.csv"))


@contextmanager
def timed(what: str, server: Server, wanted: str) -> Iterator[None]:
    """Print how long something took."""
    wall, own = time.perf_counter(), server.processor
    yield
    wall, own = time.perf_counter() - wall, server.processor - own
    print(f"| {what} | {wanted} | {wall:.2f} s | {own:.2f} s |", flush=True)


def change_tried(browser: Chromium, key: str) -> None:
    """Move the first slider of a parameter by one step, and wait for the new prediction."""
    before = browser.evaluate(ERROR)
    browser.evaluate("(all(document).find((e) => seen(e) && e.classList.contains('noUi-handle')).focus(), true)")
    browser.press(key, {"ArrowRight": 39, "ArrowLeft": 37}[key])
    browser.wait(f"{ERROR} !== {before!r}", PATIENCE)


def measure(folder: Path) -> None:
    """Print the table."""
    print("| | wanted | wall | processor time of the server |\n|---|---|---|---|", flush=True)
    server = Server(folder)
    with Chromium() as browser:
        begun = time.perf_counter()
        browser.open(server.address)
        browser.wait_for("Recording", PATIENCE)
        wall = time.perf_counter() - server.begin
        print(f"| command to the first screen | 2 s | {wall:.2f} s, of which browser"
              f" {time.perf_counter() - begun:.2f} s | {server.processor:.2f} s |", flush=True)  # fmt: skip
        with timed(f"a file of {ROWS} rows x 4 to the first plot", server, "3 s"):
            browser.choose("Recording or case file", "million.csv")
            browser.wait(
                "Bokeh.documents[0].get_model_by_name('panel 0')?.renderers[0].data_source.data.x.length > 1000"
            )
        with timed("from the plot to what was read: roles, drive, warnings", server, "-"):
            browser.wait_for("What was read", PATIENCE)
        server.wait_idle()
        with timed("zoom into it", server, "0.1 s"):
            zoom(browser)
        browser.choose("Recording or case file", "long.csv")
        browser.wait_for("long.csv:", PATIENCE)
        browser.click("Model")
        browser.wait_for("Prediction error of free runs", PATIENCE)
        browser.choose("Model", "lin_backlash")
        browser.click("Use this model")
        browser.wait_for("half gap", PATIENCE)
        browser.wait(ERROR, PATIENCE)
        change_tried(browser, "ArrowRight")
        server.wait_idle()
        with timed(f"a parameter to the new prediction, {SAMPLES} samples", server, "0.5 s"):
            change_tried(browser, "ArrowLeft")
        enter_known(browser)
        browser.click("Next: Check")
        browser.wait_for("It takes seconds.", PATIENCE)
        with timed("check, whole library, with the start of its process", server, "5 s"):
            press(browser, "Check")
            browser.wait_for("check-1: done", PATIENCE)
        told = browser.evaluate("words().match(/check-1: done, ([0-9]+ s), ([0-9]+ s) of processor time/).slice(1)")
        print(f"| the process of this check, its imports included | | {told[0]} | {told[1]} (its own) |", flush=True)
        browser.click("Run")
        browser.wait_for("a process of its own", PATIENCE)
        browser.type("Budget in s of processor time (--budget)", "20")
        before_run = server.processor
        press(browser, "Diagnose")
        browser.wait_for("diagnose-1: done", PATIENCE)
        own, job = server.processor - before_run, float(browser.evaluate(f"words().match(/{DIAGNOSED}/)[1]"))
        print(f"| the page open during a diagnosis of {job:.0f} s of processor time | 3 % | | {own:.2f} s,"
              f" {own / job:.1%} |", flush=True)  # fmt: skip
        browser.click("Results")
        browser.wait_for("with ticked terms ", PATIENCE)
        browser.wait(ERROR, PATIENCE)
        server.wait_idle()
        before = browser.evaluate(ERROR)
        with timed(f"a term switched off, {SAMPLES} samples", server, "0.5 s"):
            browser.evaluate("(all(document).find((e) => e.type === 'checkbox' && seen(e)).click(), true)")
            browser.wait(f"{ERROR} !== {before!r}", PATIENCE)
    server.process.kill()


def press(browser: Chromium, text: str) -> None:
    """Press a button, where a tab has the same name."""
    browser.evaluate(
        f"(all(document).filter((e) => e.tagName === 'BUTTON' && seen(e) && said(e) === {text!r}).pop().click(), true)"
    )


def zoom(browser: Chromium) -> None:
    """Mark a part of the first panel with the mouse, and wait for its samples."""
    place = browser.evaluate(
        "(() => { const e = all(document).find((e) => seen(e) && e.classList.contains('bk-canvas-events')"
        " || seen(e) && e.classList.contains('bk-events')); const r = e.getBoundingClientRect();"
        " return [r.x, r.y, r.width, r.height]; })()"
    )
    left, top, width, height = place
    for kind, share in (("mouseMoved", 0.5), ("mousePressed", 0.5), ("mouseMoved", 0.52), ("mouseMoved", 0.55),
                        ("mouseReleased", 0.55)):  # fmt: skip
        browser.send("Input.dispatchMouseEvent", type=kind, x=left + share * width, y=top + 0.5 * height,
                     button="left", buttons=0 if kind == "mouseReleased" else 1, clickCount=1)  # fmt: skip
    browser.wait(f"{PANEL}.renderers[0].data_source.data.x[0] > 100", PATIENCE)


def draw_pictures(folder: Path, out: Path) -> None:
    """Write pictures of the screens: an oscillator without its friction, diagnosed in the page."""
    from PIL import Image

    out.mkdir(parents=True, exist_ok=True)
    server = Server(folder)
    with Chromium(width=1100, height=760) as browser:
        browser.open(server.address)
        browser.choose("Recording or case file", "short.csv")
        browser.wait_for("model: linear_oscillator", PATIENCE)
        take(browser, out / "app_data.png")
        browser.click("Model")
        browser.wait_for("Prediction error of", PATIENCE)
        browser.click("All models as pictures")
        browser.wait_for("robot_joint", PATIENCE)
        take(browser, out / "app_model.png")
        browser.click("All models as pictures")
        browser.choose("Model", "lin_backlash")
        browser.wait("!pressed('rigid_drive')", PATIENCE)
        browser.click("Use this model")
        browser.wait_for("half gap", PATIENCE)
        enter_known(browser)
        browser.click("Next: Check")
        browser.wait_for("It takes seconds.", PATIENCE)
        press(browser, "Check")
        browser.wait_for("check-1: done", PATIENCE)
        take(browser, out / "app_check.png")
        browser.click("Run")
        browser.wait_for("a process of its own", PATIENCE)
        press(browser, "Diagnose")
        browser.wait_for("Explanations so far", PATIENCE)
        take(browser, out / "app_run.png")
        browser.wait_for("diagnose-1: done", PATIENCE)
        browser.click("Results")
        browser.wait_for("Missing force over", PATIENCE)
        take(browser, out / "app_results.png")
    server.process.kill()
    for path in out.glob("app_*.png"):
        Image.open(path).convert("P", palette=Image.Palette.ADAPTIVE, colors=160).save(path, optimize=True)


def enter_known(browser: Chromium) -> None:
    """Enter the known values of the simulated machine."""
    for name, value in KNOWN.items():
        browser.choose(f"{name} ({UNITS[name]})", "known")
        browser.type(f"{name}: value", value)
    time.sleep(SETTLED)


def take(browser: Chromium, path: Path) -> None:
    """Write a picture once the page is drawn."""
    time.sleep(3.0)
    browser.evaluate("(window.scrollTo(0, 0), true)")
    browser.picture(path)


def main() -> None:
    """Measure, or draw the pictures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pictures", type=Path, metavar="DIR", help="write pictures, and measure nothing")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as spare:
        folder = Path(spare) / "measurements"
        folder.mkdir()
        if given.pictures:
            lostmotion(*SIMULATED, "--duration", "5", "--out", str(folder / "short.csv"))
            draw_pictures(folder, given.pictures)
        else:
            write_recordings(folder)
            measure(folder)


if __name__ == "__main__":
    main()
