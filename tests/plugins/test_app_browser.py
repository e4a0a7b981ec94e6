"""The page in a real browser: from a CSV file to a named cause, reload, cancel, a killed server, a narrow page."""

import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from lostmotion.case.reading import parse_case

pytest.importorskip("panel", reason="no page: Panel is absent (the extra `app`)")
sys.path.insert(0, str(Path(__file__).parent))

from chromium import Chromium, find_browser

if find_browser() is None:
    pytest.skip("no browser: Chromium is absent", allow_module_level=True)

SERVE = "from lostmotion_app.command import command; command()"
LONG = 400.0


class Server:
    """The page of a folder in another process."""

    def __init__(self, folder):
        self.process = subprocess.Popen(
            [sys.executable, "-c", SERVE, str(folder), "--no-open"], stdout=subprocess.PIPE, text=True
        )
        self.address = self.process.stdout.readline().strip()

    def end(self, how=signal.SIGINT):
        self.process.send_signal(how)
        self.process.wait(60.0)


@pytest.fixture
def serve():
    servers = []

    def begin(folder):
        servers.append(Server(folder))
        return servers[-1]

    yield begin
    for server in servers:
        if server.process.poll() is None:
            server.end(signal.SIGKILL)


def write_recording(folder, friction=2.0):
    """Write the recording of an oscillator with dry friction, integrated in small steps."""
    m, c, k, dt, steps = 1.0, 8.0, 4000.0, 1.0 / 200.0, 40
    t, x, v, rows, rng = 0.0, 0.0, 0.0, [], np.random.default_rng(3)
    for _ in range(1400):
        drive = 20.0 * np.sin(37.0 * t) + 15.0 * np.sin(61.0 * t + 1.0)
        rows.append((t, drive, x + 2e-6 * rng.standard_normal()))
        for _ in range(steps):
            push = 20.0 * np.sin(37.0 * t) + 15.0 * np.sin(61.0 * t + 1.0)
            v += (push - c * v - k * x - friction * np.tanh(v / 1e-4)) / m * dt / steps
            x += v * dt / steps
            t += dt / steps
    folder.mkdir(exist_ok=True)
    head = "time [s],force [N],position [m]"
    np.savetxt(folder / "rig.csv", np.array(rows), delimiter=",", header=head, comments="", fmt="%.9g")
    return folder


def test_it_asks_no_other_address_and_escapes_what_files_say(tmp_path, serve):
    write_recording(tmp_path)
    rows = "\n".join(f"{i / 100},{np.sin(i / 7):.6f},{np.cos(i / 7):.6f}" for i in range(300))
    nasty = "<img src=q onerror=alert(1)>"
    (tmp_path / "nasty.csv").write_text(f'time,"{nasty} position",force\n{rows}\n', encoding="utf-8")
    (tmp_path / "empty.csv").write_text("", encoding="utf-8")
    server = serve(tmp_path)
    with Chromium(width=400, height=800, dark=True) as browser:
        browser.open(server.address)
        browser.wait_for("Recording")
        browser.wait("location.search.includes('theme=dark')")
        browser.choose("Recording or case file", "nasty.csv")
        browser.wait_for("What was read")
        browser.wait_for(nasty)
        assert browser.evaluate("all(document).filter((e) => e.tagName === 'IMG' && e.src.endsWith('/q')).length") == 0
        browser.choose("Recording or case file", "empty.csv")
        browser.wait_for("empty.csv")
        browser.wait("all(document).some((e) => seen(e) && e.classList.contains('lm-problem'))")
        browser.choose("Recording or case file", "rig.csv")
        browser.wait_for("rig.csv: 1400 rows at 200 Hz")
        assert browser.evaluate("document.documentElement.scrollWidth <= window.innerWidth + 1")
        asked = [one for one in browser.requests if not one.startswith(("data:", "blob:", "about:"))]
        port = re.search(r":(\d+)/", server.address)[1]
        assert asked
        assert [one for one in asked if not re.match(rf"(http|ws)://127\.0\.0\.1:{port}/", one)] == []
        assert [one for one in browser.problems if "favicon" not in one] == []


def open_recording(browser, server):
    """Open the page, and choose the recording that `write_recording` wrote."""
    browser.open(server.address)
    browser.choose("Recording or case file", "rig.csv")
    browser.wait_for("model: linear_oscillator")


@pytest.mark.slow
def test_the_whole_way_from_a_file_to_a_named_cause(tmp_path, serve):
    """The server is killed and the page reloaded in the middle."""
    write_recording(tmp_path)
    server = serve(tmp_path)
    with Chromium() as browser:
        open_recording(browser, server)
        browser.click("Model")
        browser.wait_for("Prediction error of free runs")
        browser.choose("m (kg)", "known")
        browser.type("m: value", "1.0")
        browser.click("Run")
        browser.wait_for("a process of its own")
        browser.click("Diagnose")
        browser.wait_for("diagnose-1: running", LONG)
        server.end(signal.SIGKILL)
        again = serve(tmp_path)
        browser.open(again.address + "?screen=Run&recording=rig.csv")
        browser.wait_for("diagnose-1: ", LONG)
        browser.wait_for("diagnose-1: done", LONG)
        browser.click("Results")
        browser.wait_for("Dry friction of", LONG)
        browser.wait_for("with ticked terms", LONG)
        with_term = browser.wait("(words().match(/free runs: [^0-9]*([0-9.e-]+) %/) || [])[1]", LONG)
        browser.evaluate("(all(document).find((e) => e.type === 'checkbox' && seen(e)).click(), true)")
        browser.wait(f"(words().match(/free runs: [^0-9]*([0-9.e-]+) %/) || [])[1] !== '{with_term}'", LONG)
        assert float(browser.evaluate("words().match(/free runs: [^0-9]*([0-9.e-]+) %/)[1]")) > 2.0 * float(with_term)
        assert browser.problems == []


@pytest.mark.slow
def test_a_run_is_cancelled_and_gives_the_answer_so_far(tmp_path, serve):
    write_recording(tmp_path)
    server = serve(tmp_path)
    with Chromium() as browser:
        open_recording(browser, server)
        browser.click("Run")
        browser.wait_for("a process of its own")
        browser.click("Diagnose")
        browser.wait_for("weighing", LONG)
        browser.wait_for("score tests", LONG)
        browser.click("Cancel")
        browser.wait_gone("diagnose-1: running", LONG)
        assert re.search(r"diagnose-1: (done|ended before there was an answer)", browser.read())


@pytest.mark.slow
def test_the_whole_way_by_keyboard_alone(tmp_path, serve):
    """From the list of files to a named cause, and to a term that is switched off; no event of a mouse is sent."""
    write_recording(tmp_path)
    server = serve(tmp_path)
    with Chromium() as browser:
        browser.open(server.address)
        browser.wait_for("Choose a recording of this folder.")
        browser.tab_to("Recording or case file")
        browser.write("r")
        browser.press("Tab", 9)
        browser.wait_for("model: linear_oscillator")
        browser.enter("Confirm")
        browser.wait_for("Changed in case.toml (Confirm)")
        browser.enter("Next: Model")
        browser.wait_for("Prediction error of free runs")
        browser.tab_to("m (kg)")
        browser.write("k")
        browser.tab_to("m: value")
        browser.press("a", 65, modifiers=2)
        browser.write("1.0")
        browser.enter("Next: Check")
        browser.wait_for("It takes seconds.")
        browser.enter("Next: Run")
        browser.wait_for("a process of its own")
        browser.enter("Diagnose")
        browser.wait_for("diagnose-1: done", LONG)
        browser.enter("Next: Results")
        browser.wait_for("Dry friction of", LONG)
        browser.wait_for("with ticked terms", LONG)
        with_term = browser.wait("(words().match(/free runs: [^0-9]*([0-9.e-]+) %/) || [])[1]", LONG)
        browser.tab_to("Coulomb friction")
        browser.press(" ", 32)
        browser.wait(f"(words().match(/free runs: [^0-9]*([0-9.e-]+) %/) || [])[1] !== '{with_term}'", LONG)
        assert browser.problems == []


def test_the_screens_come_before_their_fields_and_take_the_arrow_keys(tmp_path, serve):
    write_recording(tmp_path)
    server = serve(tmp_path)
    with Chromium() as browser:
        browser.open(server.address + "?recording=rig.csv")
        browser.wait_for("model: linear_oscillator")
        browser.press("Tab", 9)
        assert browser.evaluate("called(focused(document))") == "Data"
        browser.press("ArrowRight", 39)
        browser.wait_for("Prediction error of free runs")
        browser.enter("All models as pictures")
        browser.wait_for("gear_pair")
        browser.enter("robot_joint")
        browser.wait_gone("gear_pair")
        assert browser.evaluate("named('Model').value") == "robot_joint"


FIELDS = ("tab", "slider", "button", "combobox", "textbox", "checkbox", "figure", "tabpanel")


def read_fields(browser):
    """Return the names of tabs, sliders and other elements by role, and their properties by role and name."""
    browser.wait("all(document).filter((e) => seen(e) && e.matches('.noUi-handle')).every((e) => e.ariaLabel)")
    told = [one for one in browser.read_aloud() if one[0] in FIELDS]
    assert [(role, name) for role, name, _ in told if not name.strip() or name == "null"] == []
    return {role: [name for one, name, _ in told if one == role] for role in FIELDS}, {one[:2]: one[2] for one in told}


def test_programs_that_read_aloud_get_names_roles_and_values_and_a_gap_is_cut(tmp_path, serve):
    write_recording(tmp_path)
    rows = np.delete(np.loadtxt(tmp_path / "rig.csv", delimiter=",", skiprows=1), range(900, 1000), axis=0)
    np.savetxt(tmp_path / "rig.csv", rows, delimiter=",", header="time [s],force [N],position [m]", comments="")
    shutil.copy(tmp_path / "rig.csv", tmp_path / "other.csv")
    server = serve(tmp_path)
    with Chromium() as browser:
        browser.open(server.address + "?recording=rig.csv")
        browser.wait_for("1 gap in the time, up to 0.505 s: cut into 2 recordings")
        browser.wait_for("Further recordings with the same columns")
        browser.wait("all(document).some((e) => seen(e) && e.ariaValueText === '6.995')")
        names, values = read_fields(browser)
        assert names["tab"] == ["Data", "Model", "Check", "Run", "Results", "Take away", "Analyse"]
        assert values["tab", "Data"]["selected"]
        assert not values["tab", "Model"]["selected"]
        assert names["slider"] == ["Stretch to use (s), begin", "Stretch to use (s), end", "Held out: last share"]
        assert values["slider", "Stretch to use (s), end"]["valuetext"] == "6.995"
        assert "force [N] over time (s)" in names["figure"]
        assert "Further recordings with the same columns" in names["combobox"]
        assert len(set(names["textbox"])) == len(names["textbox"])
        browser.press("Tab", 9)
        browser.press("ArrowRight", 39)
        browser.wait_for("Prediction error of free runs")
        browser.wait_for("k tried")
        names, values = read_fields(browser)
        assert values["tab", "Model"]["selected"]
        assert [values["button", name]["pressed"] for name in ("Library", "Equations")] == ["true", "false"]
        assert names["slider"] == ["m tried", "c tried", "k tried"]
        before = float(values["slider", "k tried"]["valuetext"])
        browser.evaluate("(all(document).filter((e) => seen(e) && e.matches('.noUi-handle')).pop().focus(), true)")
        browser.press("ArrowRight", 39)
        handle = "all(document).filter((e) => seen(e) && e.matches('.noUi-handle')).pop().ariaValueText"
        assert float(browser.wait(f"{handle} !== '{before:g}' && {handle}")) == pytest.approx(1.0233 * before, rel=1e-3)
        browser.evaluate("(all(document).find((e) => e.matches('.bk-tab.bk-active')).focus(), true)")
        browser.press("End", 35)
        browser.wait_for("It needs no model.")
        browser.press("Home", 36)
        browser.wait_for("What was read")
        assert browser.problems == []
    recordings = parse_case(tmp_path / "lostmotion-app" / "rig.csv" / "case.toml")["recordings"]
    assert [(one.get("t_start"), one.get("t_end")) for one in recordings] == [(None, 4.495), (5.0, None)]


def test_a_known_value_removes_the_sentence_that_it_was_supposed(tmp_path, serve):
    t, rng = np.arange(1000) / 200.0, np.random.default_rng(0)
    rows = np.stack(
        [t, 1e-3 * np.sin(9.0 * t), 9e-4 * np.sin(9.0 * t - 0.4) + 1e-6 * rng.standard_normal(1000)], axis=1
    )
    np.savetxt(tmp_path / "moved.csv", rows, delimiter=",", header="time [s],base [m],position [m]", comments="")
    server = serve(tmp_path)
    with Chromium() as browser:
        browser.open(server.address + "?recording=moved.csv")
        browser.wait_for("Supposed: m is 1")
        browser.click("Model")
        browser.wait_for("Prediction error of free runs")
        browser.type("m: value", "2.5")
        browser.click("Data")
        browser.wait_for("What was read")
        browser.wait_gone("Supposed: m is 1")
        browser.wait_for("Please check")
    content = parse_case(tmp_path / "lostmotion-app" / "moved.csv" / "case.toml")
    assert content["model"]["known"]["m"] == 2.5
    assert not any(says.startswith("m is") for says in content["guessed"])


def test_a_remedy_changes_the_case_and_a_reload_shows_the_same_recording(tmp_path, serve):
    write_recording(tmp_path)
    rows = np.loadtxt(tmp_path / "rig.csv", delimiter=",", skiprows=1)
    rows[-200:, 2] = rows[-200, 2]
    np.savetxt(tmp_path / "stuck.csv", rows, delimiter=",", header="time [s],force [N],position [m]", comments="")
    server = serve(tmp_path)
    with Chromium() as browser:
        browser.open(server.address + "?recording=stuck.csv")
        browser.wait_for("may have been stuck")
        browser.click("Use it until 5.995 s")
        browser.wait_for("+t_end = 5.995")
        browser.wait_gone("may have been stuck")
        assert "t_end = 5.995" in (tmp_path / "lostmotion-app" / "stuck.csv" / "case.toml").read_text()
        browser.open(server.address + "?recording=stuck.csv")
        browser.wait_for("stuck.csv: 1400 rows at 200 Hz")
        browser.click("Check")
        browser.wait_for("It takes seconds.")
        browser.wait_for("Supposed: the model is linear_oscillator")
        assert browser.problems == []
