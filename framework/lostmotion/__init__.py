"""lostmotion finds the physics that a machine model leaves out.

A recording and a model make a case, and a case can be diagnosed:

    import lostmotion as lm

    recording = lm.Recording.from_arrays(t, inputs={"force": u}, sensors={"position": x}, units={"force": "N", ...})
    case = lm.Case(recording, lm.model("lin_backlash"), known={"m": 1.0}, estimate={"c": lm.LogUniform(0.8, 80.0)})
    found = lm.diagnose(case)

Each name is imported when it is first used: objects, the commands as functions, and the steps of the analysis. The
plugins that they know are in `lostmotion.registry.default()`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lostmotion.analysis.denoise import denoise
    from lostmotion.analysis.embed import embed
    from lostmotion.analysis.quantify import quantify
    from lostmotion.analysis.surrogates import surrogate_test
    from lostmotion.errors import LostMotionError
    from lostmotion.errors import LostMotionError as LostmotionError
    from lostmotion.notebook.case import Case, model
    from lostmotion.notebook.doors import analyse, diagnose, identify, load
    from lostmotion.notebook.models import map, simulate
    from lostmotion.notebook.priors import HalfNormal, LogNormal, LogUniform, Normal, Uniform
    from lostmotion.recording import Recording
    from lostmotion.settings import Settings

__version__ = "0.1.0"
__all__ = [
    "Case", "HalfNormal", "LogNormal", "LogUniform", "LostMotionError", "LostmotionError", "Normal", "Recording",
    "Settings", "Uniform", "analyse", "denoise", "diagnose", "embed", "identify", "load", "map", "model", "quantify",
    "simulate", "surrogate_test",
]  # fmt: skip
_TARGETS = {
    **{name: f"notebook.doors:{name}" for name in ("analyse", "diagnose", "identify", "load")},
    **{name: f"notebook.models:{name}" for name in ("map", "simulate")},
    **{name: f"notebook.case:{name}" for name in ("Case", "model")},
    **{name: f"notebook.priors:{name}" for name in ("HalfNormal", "LogNormal", "LogUniform", "Normal", "Uniform")},
    "LostMotionError": "errors:LostMotionError",
    "LostmotionError": "errors:LostMotionError",
    "Recording": "recording:Recording",
    "Settings": "settings:Settings",
    "denoise": "analysis.denoise:denoise",
    "embed": "analysis.embed:embed",
    "quantify": "analysis.quantify:quantify",
    "surrogate_test": "analysis.surrogates:surrogate_test",
}


_MODULES = ("registry", "settings", "testing")


def __dir__() -> list[str]:
    """Return all public names, imported or not, for completion in a shell."""
    return sorted({*globals(), *__all__, *_MODULES})


def __getattr__(name: str) -> Any:
    """Return a public object or module, which is imported at this moment."""
    if name in _MODULES:
        return import_module(f"lostmotion.{name}")
    if name not in _TARGETS:
        raise AttributeError(f"module 'lostmotion' has no attribute {name!r}: it has {', '.join(__all__)}")
    module, _, attribute = _TARGETS[name].partition(":")
    return getattr(import_module(f"lostmotion.{module}"), attribute)
