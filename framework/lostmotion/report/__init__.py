"""The report: reads what a diagnosis wrote, computes nothing, and writes one self-contained page."""

from lostmotion.report.hero import figure_hero
from lostmotion.report.page import write_report

__all__ = ["figure_hero", "write_report"]
