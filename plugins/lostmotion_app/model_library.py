"""The library of models as pictures, each of which chooses its model."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import panel as pn

from lostmotion.case import WRITTEN
from lostmotion.contracts import Model
from lostmotion.registry import Registry
from lostmotion_app.machine_drawing import draw_machine
from lostmotion_app.machine_parts import find_parts
from lostmotion_app.parts import make_html

WIDTH, HEIGHT = 172, 128
"""The size of a picture with its name (px): two are beside each other on a phone."""
_OVER = {"position": "absolute", "inset": "0", "width": "100%", "height": "100%", "margin": "0"}
_BUTTON = """
.bk-btn-group { width: 100%; height: 100%; }
.bk-btn.bk-btn-default { width: 100%; height: 100%; background: transparent !important; display: flex;
  align-items: flex-end; justify-content: center; padding: 4px;
  border: 1px solid color-mix(in srgb, currentColor 25%, transparent); }
.bk-btn.bk-btn-default:hover, .bk-btn.bk-btn-default:focus-visible { outline: 2px solid currentColor; }
"""
"""The button lies over its picture."""


class ModelLibrary:
    """A switch that shows the pictures of all models; `choose` is called with the name of the chosen one."""

    def __init__(self, registry: Registry, choose: Callable[[str], None]) -> None:
        self.registry, self.choose = registry, choose
        self.switch = pn.widgets.Toggle(name="All models as pictures")
        self.pictures = pn.FlexBox(visible=False, sizing_mode="stretch_width", gap="8px")
        self.switch.param.watch(lambda event: self._open(shown=event.new), "value")

    def _open(self, *, shown: bool) -> None:
        """Show or hide the pictures, which are drawn once."""
        if shown and not self.pictures.objects:
            self.pictures[:] = [self._make_card(name) for name in list_models(self.registry)]
        self.pictures.visible = shown

    def _make_card(self, name: str) -> Any:
        """Return the picture of a model under a button with its name."""
        drawn = make_html(f'<div class="lm-card">{draw_model(self.registry.make("model", name))}</div>', margin=0)
        button = pn.widgets.Button(name=name, stylesheets=[_BUTTON], styles=_OVER)
        button.on_click(lambda _: self._take(name))
        return pn.Column(drawn, button, width=WIDTH, height=HEIGHT, margin=0, styles={"position": "relative"})

    def _take(self, name: str) -> None:
        self.choose(name)
        self.switch.value = False


def list_models(registry: Registry) -> list[str]:
    """Return the names of the models of the library; equations that were used are none of them."""
    return sorted({*registry.names("model")} - {WRITTEN})


def draw_model(model: Model) -> str:
    """Return the picture of a model as SVG."""
    return draw_machine(find_parts(model))
