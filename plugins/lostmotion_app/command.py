"""`lostmotion app`: a local web page for a folder of recordings and cases."""

from __future__ import annotations

from pathlib import Path

import click

from lostmotion.cli import examples, registry_of
from lostmotion.errors import AbsentError


@click.command(
    epilog=examples(
        "lostmotion app",
        "lostmotion app measurements     the page for another folder",
        "lostmotion app --no-open --port 5010     print the address, and open no browser",
        "lostmotion --plugin my_terms.py app     with terms of your own",
    )
)
@click.argument("folder", default=Path(), type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--port", default=0, show_default="a free one", type=click.IntRange(0, 65535), help="Port of the page.")
@click.option("--no-open", is_flag=True, help="Print the address, and open no browser.")
@click.pass_context
def command(ctx: click.Context, folder: Path, port: int, no_open: bool) -> None:
    """Open a local web page to look at recordings, choose a model, check, diagnose, and see the results.

    The page is served to this machine only, at an address with a random part: a request without it is refused. It asks
    for no address outside of this machine. It reads recordings and cases of FOLDER, and writes into
    FOLDER/lostmotion-app. Jobs are processes of their own: they go on when the page is closed. Ctrl+C ends the page.
    """
    try:
        from lostmotion_app.server import PageServer
    except ModuleNotFoundError as err:
        if (err.name or "").partition(".")[0] not in ("panel", "bokeh", "tornado", "param"):
            raise
        raise AbsentError(
            f"the page needs Panel, which is absent ({err.name}): run `pip install 'lostmotion[app]'`"
        ) from err
    plugins = tuple(str(Path(file).absolute()) for file in ctx.find_root().params.get("plugin") or ())
    server = PageServer(folder.resolve(), registry_of(ctx), plugins, port)
    click.echo(server.address)
    if not no_open:
        click.launch(server.address)
    server.run()
