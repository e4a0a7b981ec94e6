"""A local web page for the commands of lostmotion: data, model, check, run, results.

It contains screens alone. What a screen shows and does is done by functions of the framework, and a command does the
same; the page shows it.

It is made with Panel and Bokeh: figures that ask the server for the samples of the range they show, widgets, and all
files served from this machine. They install 170 MB. NiceGUI installs 105 MB, and has no such figures: it needs plotly
or its own drawing beside it.
"""

from lostmotion.hookspecs import hookimpl

_HERE = "lostmotion_app"


@hookimpl
def lostmotion_commands() -> dict[str, tuple[str, str]]:
    """Return the command that opens the page."""
    return {"app": (f"{_HERE}.command:command", "Open a local web page: data, model, check, run, results.")}
