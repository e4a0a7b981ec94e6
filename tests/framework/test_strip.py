"""The strip of a report: when the models disagree with the recording, at which hit and in which recording."""

import numpy as np
import pytest
import report_fixture as made

from lostmotion.diagnosis.report import strip
from lostmotion.report import style

WORST = {"window": 1, "begin": 1.0, "end": 2.0, "ratio": 4.3, "p": 0.001, "beyond_chance": True}
TOLD = {
    "edges": [0.0, 1.0, 2.0, 3.0],
    "unit": "s",
    "windows": "even",
    "before": [1.0, 4.3, None],
    "after": [1.0, 1.2, 0.9],
    "expected": 1.0,
    "worst": WORST,
    "worst_before": WORST,
    "says": "The model disagrees most between 1 and 2 s (4.3 times the variance expected, p = 0.001 over 3 windows).",
}
ROWS = [
    {"name": "low", "level": 1.0, "unit": "N", "fitted": True, "before": 1.1, "after": 1.0, "p_after": 0.6},
    {"name": "<b>high", "level": 8.0, "unit": "N", "fitted": False, "before": 3.0, "after": 2.0},
]


RECORDINGS = {
    "rows": ROWS,
    "level_of": "drive",
    "expected": 1.0,
    "trend": {"after": None, "before": None},
    "says": "",
}


def evidence(facts=None, **where):
    return made.evidence((facts or made.mismatch()) | {"where": made.place("everywhere") | where})


@pytest.mark.parametrize("facts", [made.mismatch(), made.adequate()], ids=["mismatch", "adequate"])
def test_there_is_a_row_of_colours_for_each_model_over_one_step_plot(facts):
    with style.use_style():
        figure = strip.draw(evidence(facts, over_time=TOLD))
    models = 2 if facts["found"] else 1
    assert len(figure.axes) == models + 2
    below = figure.axes[models]
    assert below.get_xlabel() == "time (s)"
    assert "over expected" in below.get_ylabel()
    assert np.allclose(below.get_xlim(), (0.0, 3.0))


def test_the_caption_says_what_stands_out_and_what_chance_is():
    told = strip.caption(evidence(over_time=TOLD, by_recording=RECORDINGS | {"says": "Of 2 recordings one disagrees."}))
    assert told.startswith(TOLD["says"] + " It is shaded.")
    assert "For each window: " in told
    assert told.endswith("Of 2 recordings one disagrees.")
    quiet = TOLD | {"says": "", "windows": "hits", "worst": WORST | {"beyond_chance": False}}
    told = strip.caption(evidence(over_time=quiet))
    assert told.startswith("No section has a significant disagreement. For each hit, up to the next one: ")


def test_nothing_is_drawn_without_windows_and_a_table_has_a_row_for_each_recording():
    assert strip.draw(evidence()) is None
    assert strip.make_table(evidence()) is None
    table = strip.make_table(evidence(by_recording=RECORDINGS))
    assert table.head[1] == "Drive level (rms)"
    assert table.rows[0] == ["low", "1 N", "fitted", "1.1", "1", "0.6"]
    assert table.rows[1][2:] == ["held out", "3", "2", "–"]
