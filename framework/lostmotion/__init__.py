"""lostmotion finds the physics that a machine model leaves out.

A recording and a model make a case, and a case can be diagnosed:

    import lostmotion as lm

    recording = lm.Recording.from_arrays(t, inputs={"force": u}, sensors={"position": x}, units={"force": "N", ...})
    case = lm.Case(recording, lm.model("lin_backlash"), known={"m": 1.0}, estimate={"c": lm.LogUniform(0.8, 80.0)})
    found = lm.diagnose(case)

Each name is imported when it is first used. Packages offer further functions by the hook `lostmotion_functions`, such
as `analyse` and `map`. The plugins that all of them know are in `lostmotion.registry.default()`.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lostmotion.errors import LostMotionError
    from lostmotion.errors import LostMotionError as LostmotionError
    from lostmotion.notebook.case import Case
    from lostmotion.notebook.distributions import HalfNormal, LogNormal, LogUniform, Normal, Uniform
    from lostmotion.notebook.doors import check, diagnose, identify, load
    from lostmotion.notebook.models import model, simulate
    from lostmotion.recording import Recording
    from lostmotion.settings import Settings

__version__ = "0.1.0"
__all__ = [
    "Case", "HalfNormal", "LogNormal", "LogUniform", "LostMotionError", "LostmotionError", "Normal", "Recording",
    "Settings", "Uniform", "analyse", "check", "denoise", "diagnose", "embed", "identify", "load", "map", "model",
    "quantify", "simulate", "surrogate_test",
]  # fmt: skip
_TARGETS = {
    **{name: f"notebook.doors:{name}" for name in ("check", "diagnose", "identify", "load")},
    "Case": "notebook.case:Case",
    **{
        name: f"notebook.distributions:{name}"
        for name in ("HalfNormal", "LogNormal", "LogUniform", "Normal", "Uniform")
    },
    "LostMotionError": "errors:LostMotionError",
    "LostmotionError": "errors:LostMotionError",
    "Recording": "recording:Recording",
    "Settings": "settings:Settings",
    **{name: f"notebook.models:{name}" for name in ("model", "simulate")},
}
_OFFERED = ("analyse", "denoise", "embed", "map", "quantify", "surrogate_test")
"""Names in `__all__` that a package offers by a hook: functions of the analysis of chaos."""


_MODULES = ("registry", "settings", "testing")


def __dir__() -> list[str]:
    """Return all public names, imported or not, for completion in a shell."""
    return sorted({*globals(), *__all__, *_MODULES})


def __getattr__(name: str) -> Any:
    """Return a public object or module, which is imported at this moment."""
    if name in _MODULES:
        return import_module(f"lostmotion.{name}")
    if name not in _TARGETS:
        if name.startswith("_") or find_spec(f"lostmotion.{name}"):  # Python imports a module of this name by itself
            raise AttributeError(f"module 'lostmotion' has no attribute {name!r}")
        return _find_offered(name)
    module, _, attribute = _TARGETS[name].partition(":")
    return getattr(import_module(f"lostmotion.{module}"), attribute)


def _find_offered(name: str) -> Any:
    """Return a function that a package offers by its hook; raise `AbsentError` or `AttributeError` where none does."""
    from lostmotion.errors import AbsentError
    from lostmotion.offers import FUNCTION
    from lostmotion.registry import default

    if name in default().offered(FUNCTION):
        return default().function(FUNCTION, name)
    if name in _OFFERED:
        raise AbsentError(default().explain_absence(FUNCTION, name))
    raise AttributeError(f"module 'lostmotion' has no attribute {name!r}: it has {', '.join(__all__)}")
