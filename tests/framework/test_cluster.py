"""Trials on the workers of a dask cluster: the bytes of processes, also when a worker is killed in the middle."""

import os
import signal
import threading
import time
from functools import partial
from pathlib import Path

import pytest
from click.testing import CliRunner
from toy_campaign import Fate, deadly, fall, toy

from lostmotion.campaigns import cluster as cluster_module
from lostmotion.campaigns.campaign import Campaign, _run_elsewhere
from lostmotion.cli import main
from lostmotion.errors import DataError
from lostmotion_trials.blind.commitment import Blind, conceal_case
from lostmotion_trials.coverage.results import MachineTrial
from lostmotion_trials.sealing import ConcealedCase
from lostmotion_trials.trial_steps import TrialSteps

distributed = pytest.importorskip("distributed", reason="distributed is not installed: pip install lostmotion[cluster]")


@pytest.fixture(scope="module")
def workers(tmp_path_factory):
    """Two workers on this machine, with another working directory than that of the tests."""
    before = Path.cwd()
    os.chdir(tmp_path_factory.mktemp("elsewhere"))
    try:
        with distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", silence_logs=50
        ) as running:
            os.chdir(before)
            yield running.scheduler_address
    finally:
        os.chdir(before)


def list_files(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def test_workers_that_are_killed_in_the_middle_of_a_trial_lose_nothing(workers, tmp_path):
    marks = tmp_path / "marks"
    marks.mkdir()
    told = []
    there = Campaign(partial(fall, marks), MachineTrial, 8, {"seed": 3}).run(
        tmp_path / "there", 1, lambda done, of: told.append(done), cluster=workers
    )
    here = Campaign(partial(toy, None), MachineTrial, 8, {"seed": 3}).run(tmp_path / "here", 1)
    assert sorted(p.name for p in marks.iterdir()) == ["1", "4"]
    assert there == here
    assert told == list(range(9))
    assert list_files(tmp_path / "there") == list_files(tmp_path / "here")


def conceal(out, cluster=""):
    blind = Blind(seed=4, most=600)
    steps = TrialSteps(out, 2, 1, lambda *_: {"seed": 4}, cluster=cluster)
    return steps.run("conceal", partial(conceal_case, blind, out), ConcealedCase, {})


def test_cases_that_workers_conceal_have_the_bytes_of_processes(workers, tmp_path):
    assert conceal(tmp_path / "there", workers) == conceal(tmp_path / "here")
    files = list_files(tmp_path / "there")
    assert {"cases/001/recording.csv", "sealed/001.json", "steps/conceal/trials/00001.json"} <= set(files)
    assert files == list_files(tmp_path / "here")


def test_a_command_that_ends_in_the_middle_is_continued_without_the_cluster(workers, tmp_path, monkeypatch):
    """The scheduler holds two pieces at a time, so that the others are not even begun."""
    monkeypatch.setattr(cluster_module, "AHEAD", 2)

    def stop(done, _of):
        if done == 3:
            raise KeyboardInterrupt

    work = Campaign(partial(toy, None), MachineTrial, 8, {"seed": 3})
    with pytest.raises(KeyboardInterrupt):
        work.run(tmp_path, 1, stop, cluster=workers)
    assert len(list((tmp_path / "trials").iterdir())) == 3
    told = []
    made = work.run(tmp_path, 1, lambda done, of: told.append(done))
    assert told == list(range(3, 9))
    assert [row.machine for row in made] == list(range(8))
    assert work.run(tmp_path, 1, cluster="tcp://127.0.0.1:1") == made  # nothing is missing: no cluster is asked


def test_a_trial_that_kills_each_of_its_workers_ends_the_campaign(workers, tmp_path):
    with pytest.raises(DataError, match="workers of the cluster cannot do this work"):
        Campaign(deadly, Fate, 3, {}).run(tmp_path, 1, cluster=workers)


def test_a_result_that_no_worker_is_left_to_compute_is_not_waited_for():
    """A worker that was killed is not always started again: the campaign waited for ever."""

    class Lost:
        status = "pending"

        def result(self, timeout):
            raise TimeoutError

    class Empty:
        def scheduler_info(self):
            return {"workers": {}}

    with pytest.raises(DataError, match=r"cannot do this work \(none is left\)"):
        cluster_module._get_result(Empty(), Lost())


def test_a_cluster_that_ends_in_the_middle_is_told(tmp_path):
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", silence_logs=50
    ) as running:

        def end(done, _of):
            if done == 2:
                running.close()

        with pytest.raises(DataError, match="the cluster was lost: start it and run the same command again"):
            Campaign(partial(toy, tmp_path / "gate"), MachineTrial, 8, {"seed": 3}).run(
                tmp_path / "out", 1, end, cluster=running.scheduler_address
            )
    assert 2 <= len(list((tmp_path / "out" / "trials").iterdir())) <= 4


def test_a_worker_that_does_not_see_the_folder_is_told(tmp_path):
    with pytest.raises(DataError, match=r"does not see .*absent: choose an --out in a folder that all workers share"):
        _run_elsewhere(partial(toy, None), tmp_path / "absent", 0)


def test_threads_of_one_worker_make_one_trial_at_a_time(tmp_path):
    (tmp_path / "campaign.json").write_text('{"schema": "lostmotion.campaign/1"}', encoding="utf-8")
    at_once, most = [], []

    def look(number):
        at_once.append(number)
        most.append(len(at_once))
        time.sleep(0.05)
        at_once.remove(number)
        return Fate(number)

    threads = [threading.Thread(target=_run_elsewhere, args=(look, tmp_path, k)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert most == [1, 1, 1, 1]


@pytest.mark.parametrize("world", ["perfect", "arms"])
def test_a_cluster_that_does_not_answer_is_told(tmp_path, world):
    line = ["prove", "--world", world, "--cases", "2", "--out", str(tmp_path / "x"), "--cluster", "nonsense://x"]
    outcome = CliRunner().invoke(main, line, prog_name="lostmotion")
    assert outcome.exit_code == 2
    assert "there is no cluster at nonsense://x" in outcome.output


def prove(out, *args):
    line = ["prove", "--cases", "2", "--only", "coulomb_friction", "--samples", "800", "--seed", "5", "--out", str(out)]
    return CliRunner().invoke(main, [*line, *args], prog_name="lostmotion")


@pytest.mark.slow
def test_a_trial_on_a_cluster_has_the_same_bytes_though_a_worker_is_killed(workers, tmp_path, monkeypatch):
    """The folder is given relative to the working directory of the command, which is not that of the workers."""
    monkeypatch.chdir(tmp_path)
    begun, over, killed = tmp_path / "there" / "steps" / "diagnose", threading.Event(), []

    def kill():
        """Kill a worker half a second after it has begun a diagnosis."""
        with distributed.Client(workers, set_as_default=False) as client:
            while not killed and not over.wait(0.05):
                busy = [address for address, tasks in client.processing().items() if tasks and begun.exists()]
                for process in client.run(os.getpid, workers=busy[:1]).values() if busy else ():
                    time.sleep(0.5)
                    os.kill(process, signal.SIGKILL)
                    killed.append(process)

    watcher = threading.Thread(target=kill)
    watcher.start()
    there = prove("there", "--cluster", workers)
    over.set()
    watcher.join()
    assert there.exit_code == 0, there.output
    assert len(killed) == 1
    assert prove("here").exit_code == 0
    assert list_files(tmp_path / "there") == list_files(tmp_path / "here")
    assert "cases/001/diagnosis/diagnosis.json" in list_files(tmp_path / "there")
