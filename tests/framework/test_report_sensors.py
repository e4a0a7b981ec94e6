"""All sensors on the page: a panel and a row for each, and nothing of it where there is one sensor."""

from __future__ import annotations

import numpy as np
import pytest
import report_fixture as made

from lostmotion.diagnosis.report import sensor_figure
from lostmotion.diagnosis.report.diagnosis_page import write_report
from lostmotion.diagnosis.report.page_data import read_evidence
from lostmotion.report import style

ROWS = [
    {"name": "motor <b>", "channel": "position", "unit": "m", "noise_sd": 4e-5, "kind": "white"},
    {"name": "load", "channel": "second_velocity", "unit": "m/s", "noise_sd": 2e-3, "kind": "ar1"},
]


def facts(base=made.mismatch):
    found = base() | {"sensors": ROWS}
    for when, errors in (("before", (0.19, 0.23)), ("after", (0.012, 0.013))):
        found["fit"][when]["heldout_nrmse_by_sensor"] = dict(zip(["motor <b>", "load"], errors, strict=True))
    return found


def two_sensors(data, every=1):
    """Return the arrays with a second sensor, read at every so many samples, that shows the velocity."""
    shown = np.where(np.arange(data.time.size) % every == 0, data.velocity.values, np.nan)
    further = {
        "response_2": ("time", shown, {"units": "m/s"}),
        "forecast_before_2": ("time", 40.0 * data.forecast_before.values, {"units": "m/s"}),
    }
    if "forecast_after" in data:
        further["forecast_after_2"] = ("time", 40.0 * data.forecast_after.values, {"units": "m/s"})
    return data.assign(further)


@pytest.fixture(scope="module")
def data():
    return made.arrays(periods=20)


@pytest.mark.usefixtures("unsaved")
def test_each_sensor_has_its_panels_and_its_row(data, tmp_path):
    home = made.write(tmp_path, facts(), two_sensors(data))
    evidence = read_evidence(home)
    with style.use_style():
        figure = sensor_figure.draw(evidence)
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["motor <b>", "", "load", ""]
    assert [axes.get_ylabel().rpartition(" (")[0] for axes in figure.axes] == [
        "position",
        "error",
        "second velocity",
        "error",
    ]
    units = [axes.get_ylabel().rpartition("(")[2] for axes in figure.axes]
    assert [unit.removesuffix(")").removeprefix("m") for unit in units[:2]] == ["m", "m"]
    assert all(unit.endswith("m/s)") for unit in units[2:])
    assert sensor_figure.make_table(evidence).rows == [
        ["motor <b>", "position", "40 µm", "white", "19 %", "1.2 %"],
        ["load", "second velocity", "2 mm/s", "autocorrelated", "23 %", "1.3 %"],
    ]
    page = write_report(home).read_text(encoding="utf-8")
    assert page.index("section-prediction") < page.index("section-sensors") < page.index("section-missing")
    assert "of the first sensor, motor &lt;b&gt;" in page


@pytest.mark.usefixtures("unsaved")
def test_one_model_has_one_column_of_errors(data, tmp_path):
    evidence = read_evidence(made.write(tmp_path, facts(made.adequate), two_sensors(made.alone(data))))
    table = sensor_figure.make_table(evidence)
    assert table.head[-1] == "Error"
    assert [row[-1] for row in table.rows] == ["19 %", "23 %"]


@pytest.mark.usefixtures("unsaved")
def test_a_sensor_that_is_read_more_rarely_is_drawn_as_a_line(data, tmp_path):
    evidence = read_evidence(made.write(tmp_path, facts(), two_sensors(data, every=4)))
    with style.use_style():
        figure = sensor_figure.draw(evidence)
    recorded = figure.axes[2].lines[0].get_ydata()
    assert recorded.size > 20
    assert np.isfinite(recorded).all()
    assert np.isfinite(figure.axes[3].lines[1].get_ydata()).sum() > 20


@pytest.mark.usefixtures("unsaved")
def test_one_sensor_has_no_section(data, tmp_path):
    home = made.write(tmp_path, made.mismatch() | {"sensors": ROWS[:1]}, data)
    assert sensor_figure.draw(read_evidence(home)) is None
    assert "section-sensors" not in write_report(home).read_text(encoding="utf-8")
