"""lostmotion finds the physics that a machine model leaves out.

The front doors can be had from here, and are imported when they are first used: the commands as functions, `simulate`,
`diagnose`, `identify`, `analyse` and `map`, and the steps of the chaos laboratory, `embed`, `quantify`, `denoise` and
`surrogate_test`. What plugins they know is in `lostmotion.registry.default()`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lostmotion.stages.denoise import denoise
    from lostmotion.stages.embed import embed
    from lostmotion.stages.quantify import quantify
    from lostmotion.stages.surrogates import surrogate_test
    from lostmotion.workflow.doors import analyse, diagnose, identify, map, simulate

__version__ = "0.1.0"
__all__ = ["analyse", "denoise", "diagnose", "embed", "identify", "map", "quantify", "simulate", "surrogate_test"]
_DOORS = {
    **{name: f"workflow.doors:{name}" for name in ("analyse", "diagnose", "identify", "map", "simulate")},
    "denoise": "stages.denoise:denoise",
    "embed": "stages.embed:embed",
    "quantify": "stages.quantify:quantify",
    "surrogate_test": "stages.surrogates:surrogate_test",
}


_ROOMS = ("registry", "testing")


def __dir__() -> list[str]:
    """Return the front doors and the rooms beside what has been imported, for completion in a shell."""
    return sorted({*globals(), *__all__, *_ROOMS})


def __getattr__(name: str) -> Any:
    """Return a front door, or the module that holds plugins or the one that checks them, imported now."""
    if name in _ROOMS:
        return import_module(f"lostmotion.{name}")
    if name not in _DOORS:
        raise AttributeError(f"module 'lostmotion' has no attribute {name!r}: it has {', '.join(__all__)}")
    module, _, attribute = _DOORS[name].partition(":")
    return getattr(import_module(f"lostmotion.{module}"), attribute)
