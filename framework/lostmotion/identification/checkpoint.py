"""A chain on the disk, in the layout of emcee's HDF5 backend: whole or not there, and to be continued."""

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

EMCEE = "mcmc"
"""The group that emcee reads."""
OURS = "lostmotion"
"""The group with what else is needed to go on."""
_MIXTURE = ("weights", "centres", "roots")
_SCALE = ("low", "high", "middle", "breadth")


@dataclass(frozen=True)
class Kept:
    """A chain as emcee's `backend` holds it, and what else its next step depends on: the mixture, and where it began.

    `evaluations` counts the runs of the likelihood up to when it was read or begun, `fits` how often the mixture was
    fitted to an earlier chain.
    """

    backend: Any
    mixture: TMixture
    start: Any
    evaluations: int
    fits: int

    @property
    def state(self) -> Any:
        """Return emcee's state to go on from."""
        return self.backend.get_last_sample() if self.backend.iteration else self.start


def fingerprint(parts: Iterable[object]) -> str:
    """Return the SHA-256 of texts, numbers and arrays as 64 hexadecimal digits."""
    seen = hashlib.sha256()
    for part in parts:
        raw = np.ascontiguousarray(part).tobytes() if isinstance(part, np.ndarray) else repr(part).encode()
        seen.update(len(raw).to_bytes(8, "big") + raw)
    return seen.hexdigest()


def save(path: Path, digest: str, keys: tuple[str, ...], kept: Kept, evaluations: int) -> None:
    """Write a chain of coordinates `keys` to a file that appears whole or not at all."""
    import h5py

    memory = io.BytesIO()
    with h5py.File(memory, "w") as file:
        _write_chain(file.create_group(EMCEE), kept.backend, kept.state.random_state)
        ours = file.create_group(OURS)
        ours.attrs.update(digest=digest, keys=list(keys), evaluations=evaluations, fits=kept.fits)
        for name in _MIXTURE:
            ours[f"mixture/{name}"] = getattr(kept.mixture, name)
        for name in _SCALE:
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


def load(path: Path, digest: str) -> Kept | None:
    """Return the chain that was kept, or None if it was made from something else than `digest` tells.

    Raises `DataError` when the file is none of ours, so that nothing else is written over.
    """
    import h5py

    try:
        walk_in_subprocess(path)
        check_hdf5(path, RESULT)
        with h5py.File(path, "r") as file:
            ours = file[OURS]
            if ours.attrs["digest"] != digest:
                return None
            scale = Scores(*(ours[f"scale/{name}"][...] for name in _SCALE))
            mixture = TMixture(**{name: ours[f"mixture/{name}"][...] for name in _MIXTURE}, scale=scale)
            backend = _read_chain(file[EMCEE])
            counts = (int(ours.attrs[name]) for name in ("evaluations", "fits"))
            return Kept(backend, mixture, _read_start(ours["start"]), *counts)
    except Exception as err:  # HDF5 fails in every way there is
        raise DataError(f"{path} is no chain of an identification that can be read: give another place") from err


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


def cleared(path: Path) -> None:
    """Remove what runs that were killed left beside the chain."""
    for spare in path.parent.glob(f".{path.stem}.*{path.suffix}"):
        spare.unlink(missing_ok=True)
