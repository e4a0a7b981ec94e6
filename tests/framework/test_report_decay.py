"""The figure of a decay: dots of the recording, lines of the models, units on all axes, outliers left out."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
import report_fixture as made

from lostmotion.codec import to_plain
from lostmotion.diagnosis.report import decay_figure
from lostmotion.diagnosis.report.diagnosis_page import write_report
from lostmotion.report import style
from lostmotion.results.behaviour import DecayCycles


def curve(bend=0.0, scatter=0.0):
    amplitude = np.geomspace(3.2e-3, 1e-4, 60)
    noise = scatter * np.random.default_rng(1).normal(size=60)
    frequency, decrement = 24.0 + bend * amplitude + noise, 0.03 + 0.1 * noise
    return DecayCycles(*map(tuple, (amplitude, amplitude, frequency, decrement, decrement / 6.28)))


def test_recording_and_models_are_drawn_with_units():
    with style.use_style():
        figure = decay_figure.draw_cycles(
            [curve(-50.0, 0.01)], [curve()], [curve(-50.0)], quantity="position amplitude", unit="m"
        )
        left, right = figure.axes
    assert [axes.get_xlabel() for axes in (left, right)] == ["position amplitude (mm)"] * 2
    assert left.get_ylabel() == "logarithmic decrement"
    assert right.get_ylabel() == "frequency (Hz)"
    assert [line.get_label() for line in right.lines] == ["recording", "model before", "model after"]
    assert right.get_xscale() == "log"
    assert np.allclose(right.lines[0].get_xdata(), 1e3 * np.array(curve().amplitude))
    assert right.lines[0].get_marker() == "."


def test_one_model_is_no_model_before():
    with style.use_style():
        figure = decay_figure.draw_cycles([curve(), curve(1.0)], [curve()], unit="m/s^2")
    assert [line.get_label() for line in figure.axes[0].lines if not line.get_label().startswith("_")] == [
        "recording",
        "model",
    ]


def test_wild_cycles_and_models_do_not_set_the_scale():
    tame = curve(-50.0, 0.01)
    wild = replace(tame, frequency=(*tame.frequency[:-1], 100.0))
    with style.use_style():
        figure = decay_figure.draw_cycles([wild], [curve(1e5)], unit="m")
    assert figure.axes[1].get_ylim()[1] < 25.0


def test_without_a_decay_there_is_no_figure():
    assert decay_figure.draw_cycles([], unit="m") is None
    assert "3 decays, one after each hit" in decay_figure.caption_cycles(3)
    assert "after the hit" in decay_figure.caption_cycles()
    assert "hit" not in decay_figure.caption_cycles(struck=False)


DECAY = {
    "says": "The frequency stays at 24 Hz <i>; the model follows within 4 %.",
    "unit": "m",
    "measured": [to_plain(curve(-50.0, 0.01)), to_plain(curve(-50.0, 0.01))],
    "before": [to_plain(curve())],
    "after": [to_plain(curve(-50.0))],
}


def page_of(folder, facts):
    made.write(folder, facts, made.arrays(periods=20))
    return write_report(folder).read_text(encoding="utf-8")


@pytest.mark.usefixtures("unsaved")
def test_the_page_shows_decays_after_the_prediction(tmp_path):
    page = page_of(tmp_path, made.mismatch() | {"decay": DECAY})
    assert page.index("section-prediction") < page.index("section-decay") < page.index("section-missing")
    assert "The frequency stays at 24 Hz &lt;i&gt;; the model follows within 4\N{NO-BREAK SPACE}%." in page
    assert "Each dot is a cycle of 2 decays, one after each hit" in page


@pytest.mark.usefixtures("unsaved")
def test_a_decay_that_could_not_be_measured_is_said_without_a_figure(tmp_path):
    page = page_of(tmp_path, made.mismatch() | {"decay": {"says": "No free decay could be measured."}})
    section = page.partition('id="section-decay"')[2].partition("</section>")[0]
    assert "No free decay could be measured." in section
    assert "<figure>" not in section


@pytest.mark.usefixtures("unsaved")
def test_a_recording_without_decays_has_no_section(tmp_path):
    assert "section-decay" not in page_of(tmp_path, made.mismatch())


def test_lists_of_different_lengths_are_not_drawn():
    broken = {**to_plain(curve()), "frequency": [24.0]}
    evidence = made.evidence(made.mismatch() | {"decay": DECAY | {"measured": [broken]}})
    assert decay_figure.draw(evidence) is None


@pytest.mark.usefixtures("unsaved")
def test_where_nothing_drives_the_page_speaks_of_no_drive(tmp_path):
    facts = made.mismatch() | {"decay": DECAY}
    facts["drive"] = {"amplitude": 3.0, "unit": "N", "of": "the inertial force", "frequency": None, "free": True}
    data = made.arrays(periods=20)
    data = data.drop_vars([name for name in data.variables if name.startswith("section_")] + ["excitation"])
    made.write(tmp_path, facts, data)
    page = write_report(tmp_path).read_text(encoding="utf-8")
    words = re.sub(r"<figure>.*?<figcaption>|<details>.*", "", page, flags=re.DOTALL)
    assert "<h2>Phase portrait</h2>" in page
    assert "Its share of the inertial force" in page
    assert "Poincar" not in words
    assert "follows the same spiral" in words
    assert "hit" not in words.partition("Free decay")[2].partition("</section>")[0].replace("white", "")
