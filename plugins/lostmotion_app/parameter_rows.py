"""A row of the table of parameters: known, or to be estimated with a prior, and a value that is tried."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import panel as pn

from lostmotion.case import Prior
from lostmotion.contracts import Param
from lostmotion_app.parts import NumberField, make_html

KNOWN = "known"
FORMS: Mapping[str, tuple[str, ...]] = {
    KNOWN: ("value",),
    "log-uniform": ("low", "high"),
    "uniform": ("low", "high"),
    "normal": ("mean", "sd"),
}
"""What a parameter may be, with the numbers that belong to it."""
STEPS = 200
"""The number of steps of a slider."""


class ParameterRow:
    """One parameter of a model; `change` is called when a number of it has changed."""

    def __init__(self, param: Param, motion: str, model: Mapping[str, Any], change: Callable[[], None]) -> None:
        self.name, self.change = param.name, change
        unit = param.unit(motion)
        entry = model.get("known", {}).get(self.name, model.get("estimate", {}).get(self.name, 0.0))
        form, numbers = _read_entry(entry)
        shown = f"{self.name} ({unit})" if unit != "1" else self.name
        self.form = pn.widgets.Select(name=f"{shown}", options=list(FORMS), value=form, width=120)
        self.fields = [NumberField("", width=92) for _ in range(2)]
        self.slider = pn.widgets.DiscreteSlider(name=f"{self.name} tried", options=[0.0], width=160, formatter="%.4g")
        self.view = pn.FlexBox(
            self.form, *(field.widget for field in self.fields), self.slider,
            make_html(f"<span class='lm-quiet'>{param.meaning}</span>", sizing_mode=None, width=140, margin=(14, 10)),
            sizing_mode="stretch_width", align_items="flex-end",
        )  # fmt: skip
        self._arrange(numbers)
        self.form.param.watch(lambda _: self._convert(), "value")
        for field in self.fields:
            field.widget.param.watch(lambda _: self._retry(), "value")
        self.slider.param.watch(lambda _: self.change(), "value_throttled")

    @property
    def tried(self) -> float:
        """The value (SI) that is tried: the known one, or the one of the slider."""
        return float(self.fields[0].value or 0.0) if self.form.value == KNOWN else float(self.slider.value)

    def read(self) -> tuple[str, float | dict[str, Any]]:
        """Return the name, and the known value or the prior in the form of a case file; `CaseError` if it is none."""
        words = FORMS[self.form.value]
        numbers = {word: float(field.value or 0.0) for word, field in zip(words, self.fields, strict=False)}
        if self.form.value == KNOWN:
            return self.name, numbers["value"]
        prior: dict[str, Any] = {**numbers, **({"scale": "log"} if self.form.value == "log-uniform" else {})}
        Prior(**prior)  # which refuses what is no prior
        return self.name, prior

    def _arrange(self, numbers: tuple[float, ...]) -> None:
        """Set names and numbers of the fields, and the range of the slider."""
        words = FORMS[self.form.value]
        for number, field in enumerate(self.fields):
            field.widget.visible = number < len(words)
            field.widget.name = f"{self.name}: {words[number]}" if number < len(words) else ""
            if number < len(words):
                field.value = numbers[number]
        self.slider.visible = self.form.value != KNOWN
        self._set_slider()

    def _set_slider(self) -> None:
        """Set the values of the slider to the range of the prior; its middle is tried first."""
        if self.form.value == KNOWN:
            return
        one, other = (float(field.value or 0.0) for field in self.fields)
        low, high = (one - 2.0 * other, one + 2.0 * other) if self.form.value == "normal" else (one, other)
        if self.form.value == "log-uniform" and 0.0 < low < high:
            values = np.geomspace(low, high, STEPS + 1)
        else:
            values = np.linspace(low, high if high > low else low + 1.0, STEPS + 1)
        options = [float(value) for value in values]
        now = float(self.slider.value or 0.0)
        near = min(options, key=lambda value: abs(value - now)) if options[0] <= now <= options[-1] and now else None
        self.slider.param.update(options=options, value=options[STEPS // 2] if near is None else near)

    def _retry(self) -> None:
        self._set_slider()
        self.change()

    def _convert(self) -> None:
        """Keep the size of a parameter when it becomes known, or is to be estimated."""
        size = float(self.slider.value or self.fields[0].value or 1.0) or 1.0
        numbers = {
            KNOWN: (size,),
            "log-uniform": (abs(size) / 10.0, abs(size) * 10.0),
            "uniform": (size - abs(size), size + abs(size)),
            "normal": (size, abs(size) / 2.0),
        }
        self._arrange(numbers[self.form.value])
        self.change()


def _read_entry(entry: Any) -> tuple[str, tuple[float, ...]]:
    """Return the form of an entry of a case, and its numbers."""
    if not isinstance(entry, Mapping):
        return KNOWN, (float(entry),)
    if "mean" in entry:
        return "normal", (float(entry["mean"]), float(entry["sd"]))
    if "low" in entry:
        return "log-uniform" if entry.get("scale") == "log" else "uniform", (float(entry["low"]), float(entry["high"]))
    middle = float(entry.get("median", entry.get("half_sd", 1.0)))  # shown as the form that is nearest to it
    return "log-uniform", (middle / 10.0, middle * 10.0)
