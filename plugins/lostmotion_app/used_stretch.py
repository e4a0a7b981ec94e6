"""The stretch of a recording that is used, by a slider or by numbers, and the share of it that is held out."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import panel as pn

from lostmotion.errors import CaseError
from lostmotion_app.parts import NumberField

STEPS, ROUNDED = 1000, 1e-8
"""The number of steps of the slider, and the share of the recording within which an end is that of the recording."""


class UsedStretch:
    """Widgets of the stretch; `changed` is called after the user has changed it, or the share."""

    def __init__(self, hold: float, changed: Callable[[], None]) -> None:
        self.changed, self.span, self.setting = changed, (0.0, 1.0), False
        self.slider = pn.widgets.RangeSlider(
            name="Stretch to use (s)", start=0.0, end=1.0, value=(0.0, 1.0), step=0.01, format="0[.]000",
            sizing_mode="stretch_width",
        )  # fmt: skip
        self.ends = NumberField("From (s)", width=140), NumberField("Until (s)", width=140)
        self.hold = pn.widgets.FloatSlider(
            name="Held out: last share", start=0.05, end=0.7, step=0.05, value=hold, sizing_mode="stretch_width"
        )
        self.slider.param.watch(lambda event: self._slide(*event.new), "value_throttled")
        for end in self.ends:
            end.widget.param.watch(lambda _: self._enter(), "value")
        self.hold.param.watch(lambda _: changed(), "value_throttled")

    @property
    def widgets(self) -> list[Any]:
        """The widgets in their order."""
        return [self.slider, pn.Row(*(end.widget for end in self.ends)), self.hold]

    def offer(self, span: tuple[float, float], start: float, end: float) -> None:
        """Show a stretch of a recording that has a `span` of time (s)."""
        self.span = span
        self._set(start, end)

    def read(self) -> tuple[float, float]:
        """Return begin and end (s), within the recording; `CaseError` where no stretch is between the numbers."""
        low, high = self.span
        near = ROUNDED * (high - low)
        start, end = (limit if one.value is None or abs(one.value - limit) < near else one.value
                      for one, limit in zip(self.ends, self.span, strict=True))  # fmt: skip
        start, end = max(start, low), min(end, high)
        if not start < end:
            raise CaseError(
                f"no part of the recording is between these times: it runs from {low:.6g} s to {high:.6g} s"
            )
        return start, end

    def _set(self, start: float, end: float) -> None:
        """Show a stretch in all widgets, which tell nobody."""
        self.setting = True
        try:
            low, high = self.span
            step = float(f"{(high - low) / STEPS:.1g}")
            self.slider.param.update(start=low, end=high, step=step, value=(max(start, low), min(end, high)))
            for field, value in zip(self.ends, (start, end), strict=True):
                field.value = value
        finally:
            self.setting = False

    def _slide(self, start: float, end: float) -> None:
        if not self.setting:
            self._set(start, end)
            self.changed()

    def _enter(self) -> None:
        if not self.setting:
            self.changed()
            with suppress(CaseError):  # which `changed` has told
                self._set(*self.read())
