"""Pictures that are drawn by the build: `{picture} NAME` runs `_pictures/NAME.py` and shows its figure in the page.

`{picture} NAME PART` shows one of several figures of a script. Files that a script lists as `SOURCES` belong to it.
The printed output of a script is appended to the caption, so that the numbers are those of the run.
"""

from __future__ import annotations

import base64
import contextlib
import html
import io
import runpy
import sys
from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar

import matplotlib as mpl
from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

mpl.use("agg")
FOLDER = Path(__file__).resolve().parents[1] / "_pictures"
sys.path.insert(0, str(FOLDER))


def setup(app: Sphinx) -> dict[str, bool]:
    """Offer `picture`."""
    app.add_directive("picture", Picture)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


class Picture(SphinxDirective):
    """The figure that `draw()` or `draw(PART)` of a script returns, with the body of the directive as its caption."""

    required_arguments = 1
    optional_arguments = 1
    has_content = True
    option_spec: ClassVar[Any] = {"alt": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        """Return a figure as HTML, the picture within it."""
        name = self.arguments[0]
        data, said, sources = draw_picture(*self.arguments)
        for path in (FOLDER / f"{name}.py", *sources):
            self.env.note_dependency(str(path))
        caption = " ".join([*self.content, *said.split("\n")]).strip()
        alt = html.escape(self.options.get("alt", caption), quote=True)
        image = f'<img alt="{alt}" src="data:image/png;base64,{data}">'
        text = f'<figure class="drawn">{image}<figcaption>{html.escape(caption)}</figcaption></figure>'
        return [nodes.raw("", text, format="html")]


@lru_cache
def draw_picture(name: str, *part: str) -> tuple[str, str, tuple[Path, ...]]:
    """Return a picture (PNG, base64), what its script printed, and the files that it depends on."""
    told = io.StringIO()
    with contextlib.redirect_stdout(told), mpl.rc_context({"font.size": 9, "axes.spines.top": False,
                                                          "axes.spines.right": False, "figure.dpi": 100}):  # fmt: skip
        script = runpy.run_path(str(FOLDER / f"{name}.py"))
        figure = script["draw"](*part)
        figure.tight_layout()
        image = io.BytesIO()
        figure.savefig(image, format="png", dpi=160, metadata={"Software": None})
    return base64.b64encode(image.getvalue()).decode(), told.getvalue().strip(), tuple(script.get("SOURCES", ()))
