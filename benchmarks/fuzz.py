"""Damaged and malicious inputs by the thousand: `python benchmarks/fuzz.py [--inputs 20000] [--only KIND]`.

Each input is a good file, damaged by a seeded chain of mutations, and given to the function that a command would give
it to. It must be taken, or refused with one sentence (a `LostMotionError`), within 10 s of a processor and 2 GiB. The
inputs of one worker run in a process of their own, so that one that dies there is named too: foreign formats are read
without the guard there, and count as found only if the guard does not hold either. Exit status 1 when anything was
found; `--keep FOLDER` keeps what did it.
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

from fuzz_door import compile_kernels
from fuzz_seeds import READ, Seeds
from fuzz_targets import KINDS, tried, unguarded
from lostmotion.errors import LostMotionError

SECONDS, MEMORY, SENTENCE = 10, 2 * 2**30, 20_000
HANGS, DIED = "hangs outside of Python", "killed its process"
FOREIGN = ("mat5", "mat73", "nc", "nc3", "h5", "uff", "chain", "map", *READ)
HUNG = 180
"""Seconds of silence after which a process hangs outside of Python: longer than on a busy computer."""
CHUNK = 250
"""Inputs that one process takes before its memory is read."""


@dataclass
class Tally:
    """What became of the inputs of one kind."""

    done: int = 0
    refused: int = 0
    apart: int = 0
    slowest: float = 0.0
    memory: int = 0
    found: Counter[str] = field(default_factory=Counter)


class TooSlowError(BaseException):
    """An input that took longer than it may; no `except Exception` of a reader swallows it."""


def alarm(_signal, _frame):
    raise TooSlowError


def one(kind, seeds, number, folder):
    """Return what went wrong with an input, an empty string if nothing, and whether it was refused."""
    rng = np.random.default_rng([KINDS.index(kind), number])
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        tried(kind, seeds, rng, folder)
    except LostMotionError as err:
        return ("" if sentence(str(err)) else f"no sentence: {str(err)[:80]!r}"), True
    except TooSlowError:
        return f"longer than {SECONDS} s {place(sys.exc_info()[2])}", False
    except BaseException as err:
        return f"{type(err).__name__} {place(err.__traceback__)} {str(err)[:80]}", False
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    return "", False


def sentence(text):
    return bool(text.strip()) and "\n" not in text and len(text) < SENTENCE and "Traceback" not in text


def place(trace):
    """Return the innermost line of ours."""
    ours = [f for f in traceback.extract_tb(trace) if "lostmotion" in f.filename] or traceback.extract_tb(trace)
    return f"[{Path(ours[-1].filename).name}:{ours[-1].lineno}]" if ours else ""


def worker(kind, seeds, numbers, mouth):
    """Tell of each input before and after it was tried, and the peak of memory at the end."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGPROF, alarm)
    unguarded()
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            mouth.send(("begun", number, 0.0))
            begun = time.perf_counter()
            wrong, refused = one(kind, seeds, number, Path(folder))
            mouth.send((wrong, refused, time.perf_counter() - begun))
    mouth.send(("memory", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024, 0.0))


def chunk(kind, seeds, numbers, tally, keep):
    """Try some inputs in a process of their own; one that dies or hangs there is noted and the rest goes on."""
    numbers = list(numbers)
    while numbers:
        ear, mouth = multiprocessing.Pipe(duplex=False)
        process = multiprocessing.get_context("fork").Process(target=worker, args=(kind, seeds, numbers, mouth))
        process.start()
        mouth.close()
        died = listened(ear, tally, kind, keep, seeds)
        if died is not None and process.is_alive():
            process.kill()
        process.join()
        numbers = numbers[numbers.index(died) + 1 :] if died is not None else []


def listened(ear, tally, kind, keep, seeds):
    """Return the input over which the process died or hung, or None when it went through all."""
    current = None
    while True:
        try:
            if not ear.poll(HUNG):
                return noted(tally, kind, current, HANGS, keep, seeds)
            word, second, seconds = ear.recv()
        except EOFError:
            return noted(tally, kind, current, DIED, keep, seeds)
        if word == "memory":
            tally.memory = max(tally.memory, second)
            return None
        if word == "begun":
            current = second
            continue
        tally.done += 1
        tally.refused += bool(second)
        tally.slowest = max(tally.slowest, seconds)
        if word:
            noted(tally, kind, current, word, keep, seeds)


def guarded(kind, seeds, number):
    """Return whether the front door refuses a table over which a reader died: it reads such formats apart."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            tried(kind, seeds, np.random.default_rng([KINDS.index(kind), number]), Path(folder))
        except LostMotionError as err:
            return sentence(str(err))
    return False


def noted(tally, kind, number, wrong, keep, seeds):
    if kind in FOREIGN and wrong in (HANGS, DIED) and guarded(kind, seeds, number):
        tally.done, tally.refused, tally.apart = tally.done + 1, tally.refused + 1, tally.apart + 1
        return number
    tally.found[cause := wrong.partition("]")[0]] += 1
    if tally.found[cause] == 1:
        print(f"  {kind} {number}: {wrong}", flush=True)
        if keep:
            held = keep / f"{kind}-{number}"
            held.mkdir(parents=True, exist_ok=True)
            tried(kind, seeds, np.random.default_rng([KINDS.index(kind), number]), held, write_only=True)
    return number


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=20000)
    parser.add_argument("--first", type=int, default=0, help="the number of the first input: go on with other ones")
    parser.add_argument("--only", choices=KINDS, action="append")
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    kinds = options.only or KINDS
    folder = Path(tempfile.mkdtemp())
    try:
        seeds = Seeds.made(folder)
        tallies = {kind: campaign(kind, seeds, options, len(kinds)) for kind in kinds}
    finally:
        shutil.rmtree(folder)
    total = sum(t.done for t in tallies.values())
    found = sum(sum(t.found.values()) for t in tallies.values())
    memory = max((t.memory for kind, t in tallies.items() if kind not in FOREIGN), default=0)  # those have a guard
    print(f"{total} inputs, {found} findings; the largest process took {memory / 2**20:.0f} MiB")
    return int(found > 0 or memory > MEMORY)


def campaign(kind, seeds, options, kinds):
    """Return what became of the inputs of one kind; a costly kind takes a smaller share."""
    tally = Tally()
    if kind == "door":
        compile_kernels()
    count = max(1, round(options.inputs / kinds * seeds.share(kind)))
    numbers = range(options.first, options.first + count)
    for start in range(0, count, CHUNK):
        chunk(kind, seeds, numbers[start : start + CHUNK], tally, options.keep)
    taken = f"slowest {tally.slowest:5.2f} s  {tally.memory / 2**20:5.0f} MiB"
    died = f"({tally.apart} readers died)"
    print(
        f"{kind:<10} {tally.done:>6} inputs  {tally.refused:>6} refused {died}  {taken}  "
        f"{sum(tally.found.values())} findings",
        flush=True,
    )
    return tally


if __name__ == "__main__":
    sys.exit(main())
