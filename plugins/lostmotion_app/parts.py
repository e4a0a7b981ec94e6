"""Small parts of the screens: text that is escaped, tables, problems, commands."""

from __future__ import annotations

import html
import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import panel as pn

from lostmotion.errors import CaseError, LostMotionError
from lostmotion.report.words import to_words

STYLE = (Path(__file__).parent / "page.css").read_text(encoding="utf-8")
GAP = 8
SIDE = 330
"""Width (px) of the controls beside a figure."""


def make_html(text: str = "", **options: Any) -> pn.pane.HTML:
    """Return a pane of HTML in the style of the page; texts in it have to be escaped already."""
    given = {"sizing_mode": "stretch_width", "margin": (2, 10), **options}
    return pn.pane.HTML(text, stylesheets=[STYLE], css_classes=["lm-dark"] if is_dark() else [], **given)


def is_dark() -> bool:
    """Return whether this page is shown in dark colours."""
    return bool(pn.config.theme == "dark")


def name_key(key: str) -> str:
    """Return the key of a term in words, with its place where the key has one: "coulomb_friction@joint"."""
    name, _, at = key.partition("@")
    return to_words(name) + (f" ({at})" if at else "")


def write_heading(text: str) -> str:
    """Return a heading as HTML."""
    return f"<h2>{html.escape(text)}</h2>"


def write_note(text: str) -> str:
    """Return a remark as HTML."""
    return f'<p class="lm-quiet">{html.escape(text)}</p>'


def write_lines(lines: Sequence[str]) -> str:
    """Return lines of text, such as those of a command, as HTML."""
    return f'<pre class="lm-lines">{html.escape(chr(10).join(lines))}</pre>'


def write_list(lines: Sequence[str]) -> str:
    """Return sentences as a list of HTML."""
    return f"<ul>{''.join(f'<li>{html.escape(line)}</li>' for line in lines)}</ul>"


def write_answer(sentences: Sequence[str]) -> str:
    """Return the sentences of an answer as HTML, the first in bold."""
    return f'<div class="lm-answer">{"".join(f"<p>{html.escape(one)}</p>" for one in sentences)}</div>'


def write_table(head: Sequence[str], rows: Sequence[Sequence[str]], bars: Sequence[float] = (), title: str = "") -> str:
    """Return a table as HTML; `bars` are shares (0 to 1) of a bar in a further column of each row, below its title."""
    top = "".join(f"<th>{html.escape(cell)}</th>" for cell in [*head, *([title] if bars else [])])
    body = []
    for number, row in enumerate(rows):
        cells = "".join(f"<td>{html.escape(cell)}</td>" for cell in row)
        if bars:
            width = 100.0 * min(max(bars[number], 0.0), 1.0)
            bar = f'<span class="lm-bar" style="width: {width:.1f}%"></span>' if width else ""
            cells += f'<td class="lm-bars">{bar}</td>'
        body.append(f"<tr>{cells}</tr>")
    return f'<div class="lm-wide"><table><tr>{top}</tr>{"".join(body)}</table></div>'


def write_errors(errors: Mapping[str, float]) -> str:
    """Return the errors of free runs, each over the standard deviation of its sensor, as HTML."""
    told = ", ".join(f"{name} {100.0 * error:.3g} %" for name, error in errors.items())
    return write_note(f"Prediction error of free runs: {told} (rms over the standard deviation of the recording)")


def write_folded(title: str, content: str) -> str:
    """Return HTML that a click on its title shows."""
    return f"<details><summary>{html.escape(title)}</summary>{content}</details>"


def write_command(*words: str) -> str:
    """Return the command that does the same as a screen, as HTML."""
    return write_note("The same as a command:") + write_lines([" ".join(map(shlex.quote, words))])


class NumberField:
    """A field for a number, which may be empty."""

    def __init__(self, name: str, hint: str = "", **options: Any) -> None:
        self.widget = pn.widgets.TextInput(name=name, placeholder=hint, **options)

    @property
    def value(self) -> float | None:
        """The number, None where the field is empty; raises `CaseError` for a text that is no number."""
        text = self.widget.value.strip()
        if not text:
            return None
        try:
            return float(text)
        except ValueError as err:
            raise CaseError(f"{self.widget.name} is {text[:40]!r}: expected a number, such as 0.5 or 1e-3") from err

    @value.setter
    def value(self, number: float | None) -> None:
        self.widget.value = "" if number is None else f"{number:.10g}"


class ProblemBox:
    """The place of a screen where a message stands if something cannot be used."""

    def __init__(self) -> None:
        self.pane = make_html(visible=False)

    def tell(self, says: str) -> None:
        """Show a message; an empty one hides the place."""
        self.pane.object = f'<div class="lm-problem" role="alert">{html.escape(says)}</div>' if says else ""
        self.pane.visible = bool(says)

    @contextmanager
    def watch(self) -> Iterator[None]:
        """Show the message of an error of the framework, or that of the system for a file, instead of raising it."""
        self.tell("")
        try:
            yield
        except LostMotionError as err:
            self.tell(str(err))
        except OSError as err:
            self.tell(f"{Path(str(err.filename or 'a file')).name} cannot be used ({err.strerror or err})")


def run_next(work: Callable[[], None]) -> None:
    """Run a function as soon as the page has shown what was changed before."""
    pn.state.curdoc.add_next_tick_callback(work)


def beside(controls: Sequence[Any], shown: Sequence[Any]) -> pn.FlexBox:
    """Return controls beside what they change; below each other on a narrow page."""
    left = pn.Column(*controls, width=SIDE, styles={"flex": f"0 1 {SIDE}px", "min-width": "260px"})
    right = pn.Column(*shown, sizing_mode="stretch_width", styles={"flex": "1 1 420px", "min-width": "280px"})
    return pn.FlexBox(left, right, sizing_mode="stretch_width", gap=f"{GAP}px", align_items="flex-start")
