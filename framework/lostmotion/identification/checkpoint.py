"""A chain on the disk in the layout of emcee's HDF5 backend, written completely or not at all, to be continued."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lostmotion.errors import DataError
from lostmotion.identification.normal_scores import Scores
from lostmotion.identification.t_mixture import TMixture
from lostmotion.recording.subprocess_reader import walk_in_subprocess
from lostmotion.recording.unpacked import RESULT, check_hdf5
from lostmotion.storage import save_bytes

EMCEE_GROUP = "mcmc"
"""The group that emcee reads."""
EXTRA_GROUP = "lostmotion"
"""The group with the additional data that a continued run needs."""
_MIXTURE_FIELDS = ("weights", "centres", "roots")
_SCALE_FIELDS = ("low", "high", "middle", "breadth")


@dataclass(frozen=True)
class StoredChain:
    """A chain in emcee's `backend`, with the proposal mixture and the start that its next step depends on.

    `evaluations` counts the evaluations of the likelihood until the chain was read or begun, and `fits` how often the
    mixture was fitted to an earlier chain.
    """

    backend: Any
    mixture: TMixture
    start: Any
    evaluations: int
    fits: int

    @property
    def state(self) -> Any:
        """The state of emcee from which the chain continues."""
        return self.backend.get_last_sample() if self.backend.iteration else self.start


def compute_digest(parts: Iterable[object]) -> str:
    """Return the SHA-256 of texts, numbers and arrays as 64 hexadecimal digits."""
    seen = hashlib.sha256()
    for part in parts:
        raw = np.ascontiguousarray(part).tobytes() if isinstance(part, np.ndarray) else repr(part).encode()
        seen.update(len(raw).to_bytes(8, "big") + raw)
    return seen.hexdigest()


def save(path: Path, digest: str, keys: tuple[str, ...], kept: StoredChain, evaluations: int) -> None:
    """Write a chain of the coordinates `keys` to a file, completely or not at all."""
    import h5py

    memory = io.BytesIO()
    with h5py.File(memory, "w") as file:
        _write_chain(file.create_group(EMCEE_GROUP), kept.backend, kept.state.random_state)
        ours = file.create_group(EXTRA_GROUP)
        ours.attrs.update(digest=digest, keys=list(keys), evaluations=evaluations, fits=kept.fits)
        for name in _MIXTURE_FIELDS:
            ours[f"mixture/{name}"] = getattr(kept.mixture, name)
        for name in _SCALE_FIELDS:
            ours[f"scale/{name}"] = getattr(kept.mixture.scale, name)
        ours["start/coords"], ours["start/log_prob"] = kept.start.coords, kept.start.log_prob
        _write_random(ours["start"], kept.start.random_state)
    save_bytes(path, memory.getvalue())


def _write_chain(group: Any, backend: Any, random_state: Any) -> None:
    import emcee

    walkers, size = backend.shape
    steps = backend.iteration
    group.attrs.update(version=emcee.__version__, nwalkers=walkers, ndim=size, has_blobs=False, iteration=steps)
    group["accepted"] = backend.accepted
    group.create_dataset("chain", data=backend.chain[:steps], maxshape=(None, walkers, size), chunks=True)
    group.create_dataset("log_prob", data=backend.log_prob[:steps], maxshape=(None, walkers), chunks=True)
    _write_random(group, random_state)


def _write_random(group: Any, random_state: Any) -> None:
    for i, part in enumerate(random_state):
        group.attrs[f"random_state_{i}"] = part


def load(path: Path, digest: str) -> StoredChain | None:
    """Return the stored chain, or None if its inputs differ from those of `digest`.

    Raises `DataError` when the file is not a chain of lostmotion, so that no other file is overwritten.
    """
    import h5py

    try:
        walk_in_subprocess(path)
        check_hdf5(path, RESULT)
        with h5py.File(path, "r") as file:
            ours = file[EXTRA_GROUP]
            if ours.attrs["digest"] != digest:
                return None
            scale = Scores(*(ours[f"scale/{name}"][...] for name in _SCALE_FIELDS))
            mixture = TMixture(**{name: ours[f"mixture/{name}"][...] for name in _MIXTURE_FIELDS}, scale=scale)
            backend = _read_chain(file[EMCEE_GROUP])
            counts = (int(ours.attrs[name]) for name in ("evaluations", "fits"))
            return StoredChain(backend, mixture, _read_start(ours["start"]), *counts)
    except Exception as err:  # h5py raises many types of exceptions
        raise DataError(f"{path} is not a readable chain of an identification: choose another place") from err


def _read_chain(group: Any) -> Any:
    from emcee.backends import Backend

    backend = Backend()
    backend.reset(int(group.attrs["nwalkers"]), int(group.attrs["ndim"]))
    backend.chain, backend.log_prob = group["chain"][...], group["log_prob"][...]
    backend.accepted, backend.iteration = group["accepted"][...], int(group.attrs["iteration"])
    backend.random_state = _read_random(group)
    return backend


def _read_start(group: Any) -> Any:
    import emcee

    return emcee.State(group["coords"][...], log_prob=group["log_prob"][...], random_state=_read_random(group))


def _read_random(group: Any) -> tuple[Any, ...]:
    return tuple(group.attrs[f"random_state_{i}"] for i in range(5))


def remove_temporary_files(path: Path) -> None:
    """Remove temporary files that interrupted runs have left beside the chain."""
    for spare in path.parent.glob(f".{path.stem}.*{path.suffix}"):
        spare.unlink(missing_ok=True)
