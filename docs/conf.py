"""The site: `sphinx-build -W docs OUT`. Nothing is fetched: fonts, scripts and formulas are part of the pages."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "_ext"))

import lostmotion  # noqa: E402 - after the path to our extensions

project = "lostmotion"
author = "the lostmotion contributors"
project_copyright = author
release = version = lostmotion.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx_click",
    "captions",
    "mathml",
    "listings",
    "pictures",
    "schemas",
]
exclude_patterns = ["_ext", "_pictures"]
smartquotes = False
nitpicky = True
nitpick_ignore_regex = [
    (r"py:.*", r"(?!lostmotion).*"),
    (r"py:.*", r"lostmotion\..*\.(Array|Values|Drive|Hold|Data)"),
    (r"py:.*", r"lostmotion\..*\._.*"),
    (r"py:.*", r"lostmotion\.diagnosis\.report\.page_data\.Evidence"),
    (r"py:.*", r"lostmotion\.(identification\.report\.view\.IdentificationView|robots\.arm_page\.RobotEvidence)"),
    (r"py:.*", r"lostmotion\.results\.\w+\..*"),  # their keys have pages of their own
    (r"py:.*", r"lostmotion\.settings\.(?!Settings).*"),
]
default_role = "literal"
html_math_renderer = "mathml"

myst_enable_extensions = ["deflist", "dollarmath", "colon_fence"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_type_aliases = {"ArrayLike": "ArrayLike"}
autodoc_preserve_defaults = True
autodoc_class_signature = "separated"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 90
add_module_names = False

html_theme = "furo"
html_title = f"lostmotion {release}"
html_static_path = ["_static"]
html_css_files = ["house.css"]
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
pygments_style = "friendly"
pygments_dark_style = "github-dark"
