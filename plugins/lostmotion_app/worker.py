"""The process of a job: it runs a command of lostmotion, and leaves its exit status in the folder of the job.

    python -m lostmotion_app.worker FOLDER

`job.json` in the folder holds the words of the command. It is locked while the process runs, however it ends.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from pathlib import Path

from lostmotion.storage import held, save_json

JOB, STATUS, PROGRESS = "job.json", "status.json", "progress.jsonl"


def run(folder: Path) -> int:
    """Return the exit status of the command of a job, after writing it into the folder."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a server in the background hands down that it is ignored
    job = json.loads((folder / JOB).read_text(encoding="utf-8"))
    os.environ["LOSTMOTION_PROGRESS"] = str(folder / PROGRESS)
    begin, status = time.time(), 1
    with held(folder / JOB):
        save_json(folder / STATUS, {"process": os.getpid(), "begin": begin})
        try:
            from lostmotion.cli import main

            main(job["words"], prog_name="lostmotion")
        except SystemExit as err:
            status = err.code if isinstance(err.code, int) else int(err.code is not None)
        except KeyboardInterrupt:
            status = 130
        finally:
            done = {"end": time.time(), "processor": sum(os.times()[:4]), "status": status}
            save_json(folder / STATUS, {"process": os.getpid(), "begin": begin, **done})
    return status


if __name__ == "__main__":
    sys.exit(run(Path(sys.argv[1])))
