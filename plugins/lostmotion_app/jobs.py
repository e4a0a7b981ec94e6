"""Jobs: commands that run in processes of their own, so that the page may be closed, and are found again by folder."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from lostmotion.errors import DataError
from lostmotion.storage import folder_for, held, save_json
from lostmotion_app.worker import JOB, PROGRESS, STATUS

OUTPUT, LOG = "output.txt", "log.txt"
OUT = "{out}"
"""The folder of a job in the words of its command."""
STARTING = 60.0
"""Seconds within which a process has taken its job."""
LINES = 2000
"""The most lines of a progress that are read."""


class Progress(NamedTuple):
    """What a job has told of its progress.

    `steps` are words with the time (s) since its beginning, `weighed` the scores (log posterior weights) of sets of
    terms, `used` the share of its budget, None where none is told.
    """

    steps: list[tuple[float, str]]
    weighed: dict[tuple[str, ...], float]
    used: float | None


@dataclass(frozen=True)
class Job:
    """A command in a folder, which also holds its progress, its output and its results."""

    folder: Path

    @property
    def words(self) -> list[str]:
        """The words of the command."""
        return [str(word) for word in self._read(JOB).get("words", ())]

    @property
    def command(self) -> str:
        """The name of the command, such as "diagnose"."""
        return str(self._read(JOB).get("command", ""))

    @property
    def name(self) -> str:
        """The name of the job, that of its folder."""
        return self.folder.name

    @property
    def state(self) -> str:
        """What became of the job: running, done, cancelled, failed, or killed."""
        status = self._read(STATUS)
        if "status" in status:
            return {0: "done", 130: "cancelled"}.get(int(status["status"]), "failed")
        if self._is_locked():
            return "running"
        begun = float(self._read(JOB).get("begin", 0.0))
        return "running" if not status and time.time() - begun < STARTING else "killed"

    @property
    def seconds(self) -> float:
        """The time since its beginning, or until its end (s)."""
        status, job = self._read(STATUS), self._read(JOB)
        return float(status.get("end", time.time())) - float(job.get("begin", time.time()))

    @property
    def processor(self) -> float | None:
        """The processor time that it used (s), None before its end."""
        return self._read(STATUS).get("processor")

    @property
    def progress(self) -> Progress:
        """What it has told of its progress, the last lines alone if many."""
        steps, weighed, used = [], dict[tuple[str, ...], float](), None
        for line in self._text(PROGRESS).splitlines()[-LINES:]:
            with contextlib.suppress(ValueError, KeyError, TypeError, AttributeError):
                step = json.loads(line)
                if "score" in step:
                    weighed[tuple(map(str, step["terms"]))], used = float(step["score"]), float(step["used"])
                else:
                    steps.append((float(step["seconds"]), str(step["step"])))
        return Progress(steps, weighed, used)

    @property
    def output(self) -> list[str]:
        """What the command printed, and its messages if it failed."""
        texts = [self._text(OUTPUT)] + ([self._text(LOG)] if self.state in ("failed", "cancelled") else [])
        return [line for text in texts for line in text.splitlines()]

    def cancel(self) -> None:
        """End the job as Ctrl+C does: a search gives the best answer so far."""
        if self.state == "running" and (number := self._read(STATUS).get("process")) and self._is_locked():
            with contextlib.suppress(ProcessLookupError):
                os.kill(int(number), signal.SIGINT)

    def _is_locked(self) -> bool:
        try:
            with held(self.folder / JOB):
                return False
        except DataError:
            return True
        except OSError:
            return False

    def _text(self, name: str) -> str:
        try:
            return (self.folder / name).read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""

    def _read(self, name: str) -> Mapping[str, Any]:
        try:
            content = json.loads((self.folder / name).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return content if isinstance(content, dict) else {}


def begin_job(place: Path, command: str, words: Sequence[str], prepare: Callable[[Path], None]) -> Job:
    """Return a job that begins in a new folder of `place`, which `OUT` in the words stands for; `prepare` fills it."""
    numbers = [int(end) for path in place.glob(f"{command}-*") if (end := path.name.rpartition("-")[2]).isdecimal()]
    folder = folder_for(place / f"{command}-{max(numbers, default=0) + 1}")
    filled = [word.replace(OUT, str(folder)) for word in words]
    prepare(folder)
    save_json(folder / JOB, {"command": command, "words": filled, "begin": time.time()})
    with (folder / OUTPUT).open("wb") as output, (folder / LOG).open("wb") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "lostmotion_app.worker", str(folder)],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=log,
            start_new_session=True,
        )
    _OURS.append(process)
    return Job(folder)


_OURS: list[subprocess.Popen[bytes]] = []
"""The processes that this server began: they are waited for, so that none stays behind as a zombie."""


def list_jobs(place: Path, command: str) -> list[Job]:
    """Return the jobs of a command in a folder, the newest first."""
    _OURS[:] = [process for process in _OURS if process.poll() is None]
    jobs = [Job(path.parent) for path in place.glob(f"{command}-*/{JOB}")]
    return sorted(jobs, key=lambda job: -int(job.name.rpartition("-")[2]))
