"""The figure of a decay: dots of the recording, lines of the models, units on all axes, outliers left out."""

from __future__ import annotations

import numpy as np

from lostmotion.report import decay, style


def curve(bend=0.0, scatter=0.0):
    amplitude = np.geomspace(3.2e-3, 1e-4, 60)
    noise = scatter * np.random.default_rng(1).normal(size=60)
    return decay.Curve(amplitude, 24.0 + bend * amplitude + noise, 0.03 + 0.1 * noise)


def test_recording_and_models_are_drawn_with_units():
    with style.applied():
        figure = decay.draw([curve(-50.0, 0.01)], [curve()], [curve(-50.0)], quantity="position amplitude", unit="m")
        left, right = figure.axes
    assert [axes.get_xlabel() for axes in (left, right)] == ["position amplitude (mm)"] * 2
    assert left.get_ylabel() == "logarithmic decrement"
    assert right.get_ylabel() == "frequency (Hz)"
    assert [line.get_label() for line in right.lines] == ["recording", "model before", "model after"]
    assert right.get_xscale() == "log"
    assert np.allclose(right.lines[0].get_xdata(), 1e3 * curve().amplitude)
    assert right.lines[0].get_marker() == "."


def test_one_model_is_no_model_before():
    with style.applied():
        figure = decay.draw([curve(), curve(1.0)], [curve()], unit="m/s^2")
    assert [line.get_label() for line in figure.axes[0].lines if not line.get_label().startswith("_")] == [
        "recording",
        "model",
    ]


def test_wild_cycles_and_models_do_not_set_the_scale():
    wild = curve(-50.0, 0.01)
    wild.frequency[-1] = 100.0
    with style.applied():
        figure = decay.draw([wild], [curve(1e5)], unit="m")
    assert figure.axes[1].get_ylim()[1] < 25.0


def test_without_a_decay_there_is_no_figure():
    assert decay.draw([], unit="m") is None
    assert "3 hits" in decay.caption(3)
    assert "hits" not in decay.caption()
