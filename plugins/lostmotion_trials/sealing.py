"""The seal of a trial: digests of cases and truths, which are published before the first diagnosis.

Each case has a folder `cases/NNN`, which the diagnosis reads, and a file `sealed/NNN.json` with the truth and a random
salt, so that a truth cannot be guessed from its digest.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from lostmotion.codec import described, from_plain, to_plain
from lostmotion.errors import DataError
from lostmotion.provenance import digest
from lostmotion.storage import load_json, save_json

AGAIN = "conceal into another folder, or begin with --fresh"


@dataclass(frozen=True)
class ConcealedCase:
    """A case that was written, with its truth."""

    case: str = described("name of the case")
    digests: Mapping[str, str] = described("SHA-256 of its files, and of the truth")


@dataclass(frozen=True)
class Seal:
    """The digests that are published before the first diagnosis: `seal.json`."""

    schema: str = described("`lostmotion.seal/1`")
    digest: str = described("name of the digest")
    digests: Mapping[str, Mapping[str, str]] = described("for each case the digests of its files, and of the truth")


def format_case_name(number: int) -> str:
    """Return the name of a case."""
    return f"{number:03d}"


def seal_case(out: Path, number: int, files: Sequence[str]) -> ConcealedCase:
    """Return the digests of the named files of a case and of its truth, which lie in the folder `out`."""
    case = format_case_name(number)
    return ConcealedCase(case, _compute_digests(out, case, files))


def publish(out: Path, cases: Sequence[ConcealedCase]) -> Seal:
    """Return the content of `seal.json` after writing it; an earlier one must say the same of the same cases."""
    path, new = out / "seal.json", {one.case: one.digests for one in cases}
    old = _load_seal(out).digests if path.exists() else {}
    for case in sorted(set(old) & set(new)):
        if old[case] != new[case]:
            raise DataError(f"case {case} is not the one of {path}: {AGAIN}")
    seal = Seal("lostmotion.seal/1", "SHA-256", {**old, **new})
    save_json(path, to_plain(seal))
    return seal


def open_seal(out: Path, number: int) -> object:
    """Return the truth of a case in plain JSON values, after checking that neither it nor the case has changed."""
    case = format_case_name(number)
    sealed = _load_seal(out).digests[case]
    for name, value in _compute_digests(out, case, [name for name in sealed if name != "truth"]).items():
        if sealed[name] != value:
            raise DataError(f"{name} of case {case} does not match its digest in seal.json: nothing is scored")
    return load_json(out / "sealed" / f"{case}.json", AGAIN)


def _load_seal(out: Path) -> Seal:
    return from_plain(Seal, load_json(out / "seal.json", AGAIN), str(out / "seal.json"))


def _compute_digests(out: Path, case: str, names: Sequence[str]) -> dict[str, str]:
    files = {"truth": out / "sealed" / f"{case}.json", **{name: out / "cases" / case / name for name in names}}
    return {name: digest(path) for name, path in files.items()}
