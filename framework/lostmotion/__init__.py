"""lostmotion finds the physics that a machine model leaves out.

The front doors of the chaos laboratory can be had from here: `from lostmotion import embed, quantify, denoise,
surrogate_test`. They are imported when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lostmotion.stages.denoise import denoise
    from lostmotion.stages.embed import embed
    from lostmotion.stages.quantify import quantify
    from lostmotion.stages.surrogates import surrogate_test

__version__ = "0.1.0"
__all__ = ["denoise", "embed", "quantify", "surrogate_test"]
_DOORS = {
    "denoise": "stages.denoise:denoise",
    "embed": "stages.embed:embed",
    "quantify": "stages.quantify:quantify",
    "surrogate_test": "stages.surrogates:surrogate_test",
}


def __getattr__(name: str) -> Any:
    """Return a front door, imported now."""
    if name not in _DOORS:
        raise AttributeError(f"module 'lostmotion' has no attribute {name!r}: it has {', '.join(__all__)}")
    module, _, attribute = _DOORS[name].partition(":")
    return getattr(import_module(f"lostmotion.{module}"), attribute)
