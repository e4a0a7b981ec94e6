from __future__ import annotations

from pathlib import Path

import pytest

SHARED = Path(__file__).resolve().parents[1].parent / "shared"


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of real recordings, which lies beside the project and is no part of it."""
    if not (SHARED / "data").is_dir():
        pytest.skip(f"no real recordings: {SHARED / 'data'} is absent")
    return SHARED
