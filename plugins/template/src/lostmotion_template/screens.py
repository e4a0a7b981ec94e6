"""A screen of your own in `lostmotion app`: it shows the recording or the results that the page works on."""

from __future__ import annotations

from typing import Any

import numpy as np

BINS = 60


def draw_readings(desk: Any) -> Any:
    """Return a figure of Bokeh with the distribution of the readings of each sensor, over their rms."""
    from bokeh.palettes import Colorblind
    from bokeh.plotting import figure

    drawn = figure(
        height=340, sizing_mode="stretch_width", x_axis_label="reading over its rms", y_axis_label="probability density"
    )
    for sensor, colour in zip(desk.read_case().recordings[0].sensors, Colorblind[8], strict=False):
        swing = (sensor - sensor.mean()).values
        density, edges = np.histogram(swing / np.sqrt(np.mean(swing**2)), BINS, density=True)
        drawn.step(edges[:-1], density, mode="after", color=colour, legend_label=sensor.attrs["long_name"])
    return drawn
