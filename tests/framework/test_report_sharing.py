"""The table and the words of what recordings share."""

import report_fixture as made

from lostmotion.diagnosis.report import sharing_table
from lostmotion.diagnosis.report.diagnosis_page import write_report


def values(*medians, unit):
    rows = zip(("low", "<b>high"), (4.0, 16.0), medians, strict=True)
    return [
        {"recording": n, "level": s, "median": m, "low": 0.9 * m, "high": 1.1 * m, "unit": unit} for n, s, m in rows
    ]


def shared(p, **more):
    return {"holds": p > 0.01, "p": p, "says": "", "power_of_level": None, "differs_in": None} | more


TOLD = {
    "recordings": ["low", "<b>high"],
    "levels": [4.0, 16.0],
    "level_of": "drive",
    "level_unit": "N",
    "says": ["c differs."],
    "parameters": {
        "k": {"by_recording": values(800.0, 801.0, unit="N/m"), "shared": shared(0.4)},
        "c": {
            "by_recording": values(1.0, 4.0, unit="N s/m"),
            "shared": shared(1e-9, power_of_level={"exponent": 1.0, "error": 0.1, "p": 0.5}),
        },
        "coulomb_friction.force": {
            "by_recording": values(0.001, 0.002, unit="N"),
            "shared": shared(1e-9, differs_in="<b>high"),
        },
        "x0": {"by_recording": values(0.001, 0.002, unit="m"), "shared": shared(1e-9)},
    },
}


def evidence(**facts):
    return made.evidence(made.mismatch() | facts)


def test_there_is_a_row_for_each_parameter_and_a_column_for_each_recording():
    table = sharing_table.make_table(evidence(sharing=TOLD))
    assert table.head == ["Parameter", "low (4 N)", "<b>high (16 N)", "One value?"]
    assert table.rows[0] == ["k (N/m)", "800 [720, 880]", "801 [721, 881]", "yes (p = 0.4)"]
    assert table.rows[1][-1] == "proportional to level to the power 1"
    assert table.rows[2][0] == "Coulomb friction: force (mN)"
    assert table.rows[2][1:] == ["1.00 [0.90, 1.10]", "2.0 [1.8, 2.2]", "no, differs in <b>high"]
    assert table.rows[3][-1] == "no (p = 1·10⁻⁹)"


def test_words_say_how_the_table_is_to_be_read():
    assert sharing_table.write_words(evidence(sharing=TOLD)).startswith("c differs. Medians with 95 % intervals")
    assert sharing_table.write_words(evidence(sharing={"parameters": {}, "says": ["Nothing."]})) == "Nothing."
    assert sharing_table.write_words(evidence()) == ""
    assert sharing_table.make_table(evidence()) is None


def test_the_page_has_the_section_and_escapes_names(tmp_path):
    page = write_report(made.write(tmp_path, made.mismatch() | {"sharing": TOLD})).read_text(encoding="utf-8")
    assert '<section id="section-sharing">' in page
    assert "&lt;b&gt;high (16 N)" in page
    assert "<b>high" not in page
