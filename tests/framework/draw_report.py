"""Draws the page of the fixture, to look at it: `python tests/framework/draw_report.py FOLDER`."""

import sys
from pathlib import Path

from report_fixture import arrays, mismatch, write

from lostmotion.diagnosis.report.diagnosis_page import write_report
from lostmotion.diagnosis.report.hero import save_hero

home = write(Path(sys.argv[1]), mismatch(), arrays())
print(write_report(home), save_hero(home))  # noqa: T201
