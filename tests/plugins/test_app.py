"""The page without a browser: its folder, its curves, its jobs, and what its server refuses."""

import http.client
import importlib
import json
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

import click
import numpy as np
import pytest
from click.testing import CliRunner

from lostmotion.case.reading import parse_case
from lostmotion.cli import main
from lostmotion.errors import CaseError, DataError
from lostmotion.evidence.bare import Budget, make_weighed
from lostmotion.likelihood.observation import Observation
from lostmotion.progress import show_progress
from lostmotion.recording.outline import GivenRoles
from lostmotion.registry import Registry, default

pytest.importorskip("panel", reason="no page: Panel is absent (the extra `app`)")

from lostmotion_app import command, jobs
from lostmotion_app.case_content import list_recordings
from lostmotion_app.curves import CurvePanels, thin
from lostmotion_app.desk import Desk
from lostmotion_app.folder import WorkFolder
from lostmotion_app.found_figures import find_recording
from lostmotion_app.job_view import write_weighed
from lostmotion_app.parts import write_table
from lostmotion_app.screens.guest import GuestScreen, list_guests
from lostmotion_app.screens.take_away import make_notebook
from lostmotion_app.used_stretch import UsedStretch

SERVE = "from lostmotion_app.command import command; command()"
PATIENCE = 120.0
UPGRADE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
    "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Protocol": "bokeh, token",
}


@pytest.fixture
def folder(tmp_path):
    t = np.arange(400) / 100.0
    rows = np.stack([t, 5.0 * np.sin(9.0 * t), 1e-3 * np.sin(9.0 * t - 0.4)], axis=1)
    place = tmp_path / "measured"
    place.mkdir()
    np.savetxt(place / "run1.csv", rows, delimiter=",", header="time [s],force [N],position [m]", comments="")
    return WorkFolder(place.resolve())


@pytest.mark.parametrize("name", ["../secret.csv", "/etc/hostname", "a/../../secret.csv", "link.csv", "\0"])
def test_no_path_leads_out_of_the_folder(folder, name):
    (folder.root.parent / "secret.csv").write_text("t,x\n0,1\n")
    (folder.root / "link.csv").symlink_to(folder.root.parent / "secret.csv")
    with pytest.raises(DataError):
        folder.find(name)
    assert folder.list_recordings() == ["run1.csv"]


def test_an_uploaded_file_stays_in_the_folder_and_replaces_none(folder, monkeypatch):
    assert folder.upload("../../other.csv", b"t,x\n0,1\n") == "other.csv"
    assert (folder.root / "other.csv").read_bytes() == b"t,x\n0,1\n"
    with pytest.raises(CaseError, match="exists already"):
        folder.upload("other.csv", b"t,x\n0,2\n")
    with pytest.raises(CaseError, match="no ending of a recording"):
        folder.upload("run.sh", b"")
    monkeypatch.setattr("lostmotion_app.folder.MOST_UPLOADED", 4)
    with pytest.raises(CaseError, match="is the most"):
        folder.upload("large.csv", b"12345")


def test_thin_curves_keep_every_extreme_and_single_samples_when_enlarged():
    x = np.arange(1_000_000.0)
    y = np.sin(x / 3e4)
    y[123_456], y[777_777] = 5.0, -7.0
    at, values = thin(x, y, x[0], x[-1])
    assert len(at) < 4000
    assert (values.max(), values.min()) == (5.0, -7.0)
    at, values = thin(x, y, 123_400.0, 123_500.0)
    assert np.array_equal(values, y[123_399:123_501])
    assert np.all(np.diff(at) == 1.0)


def test_a_new_range_that_each_panel_tells_is_drawn_once(monkeypatch):
    curves, x = CurvePanels("time (s)"), np.arange(1000.0)
    for name in ("one", "two"):
        curves.add_curve(curves.add_panel(name), x, x, colour="#000000")
    curves.fit_range(0.0, 999.0)
    drawn = []
    monkeypatch.setattr(curves, "_draw", lambda *given: drawn.append(given))
    curves._redraw(10.0, 20.0)
    curves._redraw(10.0, 20.0)
    assert len(drawn) == 2
    curves._redraw(10.0, 30.0)
    assert len(drawn) == 4


def test_a_case_keeps_the_stretch_and_the_values_of_a_user(folder):
    desk = Desk(folder, default(), recording="run1.csv")
    told = desk.draft(GivenRoles(), {})
    assert told.found[0].startswith("run1.csv: 400 rows at 100 Hz")
    content = desk.content
    content["recordings"][0]["t_end"] = 3.0
    content["model"]["known"] = {"m": 2.0}
    del content["model"]["estimate"]["m"]
    desk.save(content)
    desk.draft(GivenRoles(), {}, "linear_oscillator")
    assert desk.content["recordings"][0]["t_end"] == 3.0
    assert desk.content["model"]["known"] == {"m": 2.0}
    desk.redraft("m*x'' + c*x' = force")
    assert desk.content["model"]["equations"] == ["m*x'' + c*x' = force"]
    assert desk.content["recordings"][0]["t_end"] == 3.0
    assert (desk.place / desk.content["recordings"][0]["file"]).resolve() == folder.root / "run1.csv"


GUEST = """
from lostmotion.hookspecs import hookimpl
@hookimpl
def lostmotion_screens():
    return {"my_screen": ("guest_screen:draw", "What it shows.")}
def draw(desk):
    return 1 / 0
"""


def test_a_package_adds_a_screen_which_is_drawn_and_one_that_fails_says_so(folder, monkeypatch):
    monkeypatch.syspath_prepend(Path(__file__).parents[2] / "plugins" / "template" / "src")
    (folder.root / "guest_screen.py").write_text(GUEST, encoding="utf-8")
    registry = Registry().add(importlib.import_module("lostmotion_plugins"))
    registry.add(importlib.import_module("lostmotion_template"))
    registry.add_file(folder.root / "guest_screen.py")
    desk = Desk(folder, registry, recording="run1.csv")
    assert list_guests(desk) == {"Readings": "readings", "My screen": "my_screen"}
    screen = GuestScreen(desk, "readings")
    assert "How often each sensor reads which value." in screen.make_view()[0].object
    screen.show()
    assert "Choose a recording" in screen.problem.pane.object
    desk.draft(GivenRoles(), {})
    screen.show()
    assert not screen.problem.pane.visible
    (line,) = screen.shown[0].object.renderers
    assert np.sum(line.data_source.data["y"]) > 0.0
    failing = GuestScreen(desk, "my_screen")
    failing.show()
    assert "cannot be drawn (ZeroDivisionError: division by zero)" in failing.problem.pane.object


GIVEN = """
title = "mine"
plugins = ["terms.py"]
[[recordings]]
file = "../measured/run1.csv"
time = "time [s]"
inputs = [{ input = "force", column = "force [N]" }]
sensors = [{ channel = "position", column = "position [m]", unit = "m" }]
[model]
inverse = "../arm.py:inverse"
"""


def test_a_case_of_the_user_is_copied_with_its_paths_and_runs_code_after_consent(folder):
    (folder.root / "cases").mkdir()
    (folder.root / "cases" / "mine.toml").write_text(GIVEN, encoding="utf-8")
    (folder.root / "settings.toml").write_text("a = 1\n", encoding="utf-8")
    assert folder.list_cases() == ["cases/mine.toml"]
    desk = Desk(folder, default(), recording="cases/mine.toml")
    assert desk.is_given
    assert desk.is_robot
    with pytest.raises(CaseError, match=r"runs terms.py, ../arm.py: agree"):
        desk.require_agreed()
    desk.agreed.add("cases/mine.toml")
    desk.require_agreed()
    copied = folder.root / "lostmotion-app" / "copy"
    copied.mkdir(parents=True)
    desk.copy_case(copied)
    copy = parse_case(copied / "case.toml")
    assert (copied / copy["plugins"][0]).resolve() == folder.root / "cases" / "terms.py"
    assert (copied / copy["model"]["inverse"].partition(":")[0]).resolve() == folder.root / "arm.py"
    assert copy["model"]["inverse"].endswith(":inverse")
    assert next(list_recordings(copy))[1:] == ["force [N]", "position [m] (m)"]


def test_further_recordings_have_the_columns_of_the_first_and_stay_in_the_case(folder):
    for name in ("run2.csv", "run3.csv"):
        shutil.copy(folder.root / "run1.csv", folder.root / name)
    desk = Desk(folder, default(), recording="run1.csv")
    desk.draft(GivenRoles(), {})
    desk.add_recordings(["run3.csv", "run2.csv"])
    desk.draft(GivenRoles(), {}, "linear_oscillator")
    assert desk.list_further() == ["run3.csv", "run2.csv"]
    assert len(desk.read_case().recordings) == 3
    desk.add_recordings([])
    assert desk.list_further() == []


def test_a_log_and_an_mjcf_file_become_the_case_of_a_robot(folder):
    pytest.importorskip("mujoco", reason="MJCF needs the extra mujoco")
    from lostmotion_plugins.simulators.mujoco import EXAMPLE

    t = np.arange(400) / 100.0
    rows = np.stack([t, *(np.sin(t + k) for k in range(4))], axis=1)
    head = "t,tau_shoulder,tau_elbow,q_shoulder,q_elbow"
    np.savetxt(folder.root / "log.csv", rows, delimiter=",", header=head, comments="")
    (folder.root / "arm.xml").write_text(EXAMPLE, encoding="utf-8")
    desk = Desk(folder, default(), recording="log.csv")
    assert folder.list_robots() == ["arm.xml"]
    told = desk.draft_robot("arm.xml", "link")
    assert "elbow: torque 'tau_elbow', position 'q_elbow'" in told
    assert desk.is_robot
    assert desk.content["model"]["torque"] == "link"
    assert (desk.place / desk.content["model"]["mujoco"]).resolve() == folder.root / "arm.xml"
    desk.redraft("linear_oscillator")
    assert not desk.is_robot


def test_sets_of_terms_are_told_with_their_scores_while_a_search_runs(tmp_path, monkeypatch):
    file = tmp_path / "progress.jsonl"
    monkeypatch.setenv("LOSTMOTION_PROGRESS", str(file))
    with show_progress("search", quiet=True) as say:
        say("reading")
        for terms, score in ((frozenset(), 10.0), (frozenset({"coulomb_friction@joint"}), 33.5)):
            say(make_weighed(terms, score, Budget(seconds=1e6)))
    found = jobs.Job(tmp_path).progress
    assert [step for _, step in found.steps] == ["reading"]
    assert found.weighed == {(): 10.0, ("coulomb_friction@joint",): 33.5}
    assert 0.0 <= found.used < 0.01
    told = write_weighed(found.weighed)
    assert "Coulomb friction (joint)</td><td>+23.5" in told
    assert told.index("Coulomb") < told.index("Nothing")


def test_the_recording_of_held_out_readings_is_found():
    ripple = 0.1 * np.sin(np.arange(9.0))
    made = [Observation.of("seen", k + ripple, np.zeros((9, 1)), 1.0, "position") for k in (1.0, 2.0, 3.0)]
    assert find_recording(made, np.arange(4.0, 8.0), np.full(4, 2.0)) == 1


def finish(job):
    end = time.monotonic() + PATIENCE
    while job.state == "running" and time.monotonic() < end:
        time.sleep(0.05)
    return job.state


def test_a_job_runs_by_itself_and_is_found_again(tmp_path):
    job = jobs.begin_job(tmp_path, "settings", ["settings", "--json"], lambda _: None)
    assert finish(job) == "done"
    (found,) = jobs.list_jobs(tmp_path, "settings")
    assert found == job
    assert json.loads("\n".join(found.output))
    assert found.processor > 0.0


def test_a_job_that_fails_tells_why(tmp_path):
    job = jobs.begin_job(tmp_path, "check", ["check", "absent.toml", "--out", jobs.OUT], lambda _: None)
    assert finish(job) == "failed"
    assert "absent.toml cannot be read" in job.output[-1]


def test_a_job_is_cancelled_as_with_ctrl_c_and_a_killed_one_is_seen(tmp_path):
    code = "import time\nfrom lostmotion.hookspecs import hookimpl\ntime.sleep(100)\n"
    (tmp_path / "slow.py").write_text(code, encoding="utf-8")
    words = ["--plugin", str(tmp_path / "slow.py"), "plugins"]
    begun = [jobs.begin_job(tmp_path, "plugins", words, lambda _: None) for _ in range(2)]
    for job in begun:
        end = time.monotonic() + PATIENCE
        while not job._is_locked() and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(1.0)
    begun[0].cancel()
    assert finish(begun[0]) in ("cancelled", "failed")
    assert begun[1].state == "running"
    jobs.os.kill(json.loads((begun[1].folder / "status.json").read_text())["process"], signal.SIGKILL)
    assert finish(begun[1]) == "killed"


def test_texts_are_escaped_and_a_notebook_is_one():
    assert "<script>" not in write_table(["<script>"], [["<script>alert(1)</script>"]])
    cells = json.loads(make_notebook(["import lostmotion as lm", "", "print(1)"]))["cells"]
    assert [cell["source"] for cell in cells] == ["import lostmotion as lm", "print(1)"]


def test_without_panel_the_command_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "panel", None)
    monkeypatch.delitem(sys.modules, "lostmotion_app.server", raising=False)
    for name in [
        name for name in sys.modules if name.startswith("lostmotion_app.") and name != "lostmotion_app.command"
    ]:
        monkeypatch.delitem(sys.modules, name)
    done = CliRunner().invoke(command.command, [str(tmp_path), "--no-open"], obj=default())
    assert "lostmotion[app]" in str(done.exception)


def test_the_first_screen_waits_for_no_part_of_scipy_that_is_slow_to_import():
    first = "import lostmotion_app.server, lostmotion_app.page, lostmotion_app.screens.data, sys; print(*sys.modules)"
    told = subprocess.run([sys.executable, "-c", first], capture_output=True, text=True, check=True).stdout.split()
    assert {"scipy.signal", "scipy.stats", "numba", "xarray", "matplotlib"} & set(told) == set()


def test_help_has_examples():
    done = CliRunner().invoke(command.command, ["--help"])
    assert done.exit_code == 0
    assert "lostmotion app measurements" in done.output
    assert isinstance(main, click.Group)


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    place = tmp_path_factory.mktemp("served")
    process = subprocess.Popen(
        [sys.executable, "-c", SERVE, str(place), "--no-open"], stdout=subprocess.PIPE, text=True
    )
    yield process.stdout.readline().strip()
    process.kill()
    process.wait(PATIENCE)


def ask(url, **headers):
    try:
        request = urllib.request.Request(url, headers=headers)  # noqa: S310 - the address of the server below
        with urllib.request.urlopen(request, timeout=PATIENCE) as answer:  # noqa: S310
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as err:
        return err.code, err.read().decode()


def test_a_request_without_the_token_is_refused(address):
    base, token, *_ = re.fullmatch(r"(http://127\.0\.0\.1:\d+)/([\w-]{30,})(/page/open)", address).groups()
    for path in (
        "/",
        "/page/open",
        "/static/js/bokeh.min.js",
        f"/{token[:-1]}x/page/open",
        f"/{token}x/page/open",
        "/ws",
    ):
        assert ask(base + path)[0] == 403, path
    assert ask(f"{base}/{token}/../page/open")[0] == 403


def test_the_page_loads_nothing_from_elsewhere(address):
    status, text = ask(address)
    assert status == 200
    assert "Content-Security-Policy" in text
    sources = re.findall(r'(?:src|href)="([^"]+)"', text)
    assert sources
    assert [one for one in sources if re.match(r"(https?:)?//", one)] == []


def test_the_page_is_bound_to_this_machine_alone(address):
    port = int(re.search(r":(\d+)/", address)[1])
    with socket.socket() as other:
        other.settimeout(2.0)
        assert other.connect_ex(("127.0.0.2", port)) != 0


@pytest.mark.parametrize(("host", "refused"), [("http://example.org", True), (None, False)])
def test_another_site_may_not_open_the_connection(address, host, refused):
    """The same request from the page's own address is not refused for where it comes from (403)."""
    place, path = re.fullmatch(r"http://([\d.:]+)(/.*)", address).groups()
    keys = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13"}
    keys |= {"Sec-WebSocket-Key": "x" * 22 + "==", "Origin": host or f"http://{place}"}
    connection = http.client.HTTPConnection(place, timeout=PATIENCE)
    connection.request("GET", path + "/ws", headers=keys)
    assert (connection.getresponse().status == 403) is refused
    connection.close()


def test_the_stretch_is_set_by_numbers_or_by_the_slider():
    told = []
    stretch = UsedStretch(0.3, lambda: told.append(stretch.read()))
    stretch.offer((0.0, 8.0), 1.0, 8.0)
    assert told == []
    stretch.ends[1].widget.value = "6.5"
    assert told == [(1.0, 6.5)]
    assert stretch.slider.value == (1.0, 6.5)
    stretch._slide(2.0, 7.0)
    assert told[-1] == (2.0, 7.0)
    assert [end.widget.value for end in stretch.ends] == ["2", "7"]
    with pytest.raises(CaseError, match="runs from 0 s to 8 s"):
        stretch.ends[0].widget.value = "9"
    stretch.ends[0].widget.value = ""
    assert told[-1] == (0.0, 7.0)
