"""A group of commands that imports a command only when it runs, and names of plugins that the Tab key completes."""

from __future__ import annotations

import contextlib
import errno
import warnings
from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any, ClassVar

import click
from click.shell_completion import CompletionItem

from lostmotion.errors import LostMotionError, PluginWarning, nearest
from lostmotion.registry import KINDS, Registry, default
from lostmotion.registry.classes import import_target
from lostmotion.registry.hooks import COMMAND

INTERRUPTED = 130
LONGEST = 1500
"""Characters of a sentence that are shown: names in it may come from a file."""


def examples(*lines: str) -> str:
    """Return command lines as the epilog of a help text, kept on lines of their own."""
    return "\b\n" + "\n".join(("Examples:", *(f"  {line}" for line in lines)))


class SentenceError(click.ClickException):
    """An error of ours as the command line shows it: one sentence, exit status 2, no traceback."""

    exit_code = 2

    def show(self, file: object = None) -> None:
        """Write the sentence to standard error."""
        click.echo(f"lostmotion: {plain(self.message)}", err=True)


def plain(text: str) -> str:
    """Return a text on one line and not endless; what a terminal would obey stands there as its code."""
    shown = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in " ".join(text.split()))
    return shown if len(shown) <= LONGEST else f"{shown[:LONGEST]} ..."


@contextlib.contextmanager
def _warnings_shown() -> Iterator[None]:
    """Show each warning about a plugin once, as a sentence on standard error; all others as they are."""
    with warnings.catch_warnings():
        shown, told = warnings.showwarning, set[str]()

        def show(message: Warning | str, category: type[Warning], *rest: Any) -> None:
            if not issubclass(category, PluginWarning):
                shown(message, category, *rest)
            elif str(message) not in told:
                told.add(str(message))
                click.echo(f"lostmotion: warning: {plain(str(message))}", err=True)

        warnings.simplefilter("always", PluginWarning)
        warnings.showwarning = show  # type: ignore[assignment]
        yield


class LazyGroup(click.Group):
    """A group whose `table` says for each command where it stands and what its one line of help is.

    Packages add commands of their own by the hook `lostmotion_commands`; a name of the `table` stays what it is.
    """

    table: ClassVar[Mapping[str, tuple[str, str]]] = {}

    def commands_of(self, ctx: click.Context) -> dict[str, tuple[str, str]]:
        """Return target and line of help of all commands by name, in the order of the alphabet."""
        added = {e.name: (e.target, e.about) for e in registry_of(ctx).commands().values()}
        return dict(sorted({**added, **self.table}.items()))

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the commands."""
        return list(self.commands_of(ctx))

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Return the command, imported now, or None when there is no such name."""
        if cmd_name in self.table:
            module, _, attribute = self.table[cmd_name][0].partition(":")
            own: click.Command = getattr(import_module(module), attribute)
            return own
        added = registry_of(ctx).commands()
        if cmd_name not in added:
            return None
        command: click.Command = import_target(added[cmd_name].target, added[cmd_name].whose, click.Command)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return name, command and the arguments left; an unknown name is told with the nearest known one."""
        if args[0] not in self.table and not args[0].startswith("-"):
            known = self.commands_of(ctx)
            if args[0] not in known:
                for entry in registry_of(ctx).entries():
                    if (entry.kind, entry.name) == (COMMAND, args[0]):
                        raise SentenceError(entry.why)
                raise click.UsageError(f"there is no command {args[0]!r}{nearest(args[0], known)}", ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the one-line helps; no command is imported for that."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, text) for name, (_, text) in self.commands_of(ctx).items()])

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Return the commands that begin with what is typed, then the options; no command is imported for that."""
        known = self.commands_of(ctx).items()
        found = [CompletionItem(n, help=text) for n, (_, text) in known if n.startswith(incomplete)]
        return found + click.Command.shell_complete(self, ctx, incomplete)

    def invoke(self, ctx: click.Context) -> object:
        """Run the command; an error of ours becomes a sentence, Ctrl-C the exit status 130."""
        try:
            with _warnings_shown() if ctx.parent is None else contextlib.nullcontext():
                return super().invoke(ctx)
        except LostMotionError as err:
            raise SentenceError(str(err)) from err
        except MemoryError as err:
            raise SentenceError("there is not enough memory: cut the recording, or use fewer --jobs") from err
        except OSError as err:
            if err.errno in (None, errno.EPIPE):
                raise
            raise SentenceError(f"{err.filename or 'a file'} cannot be used ({err.strerror}): see to it") from err
        except (KeyboardInterrupt, click.Abort):
            click.echo("lostmotion: interrupted", err=True)
            ctx.exit(INTERRUPTED)


class PluginName(click.types.StringParamType):
    """The name of a plugin of the given kinds, or of any kind; it is looked up by whoever loads it."""

    name = "name"

    def __init__(self, *kinds: str) -> None:
        self._kinds = kinds or KINDS

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return the names that begin with what is typed, those of `--plugin` files included."""
        names = [(name, kind) for kind in self._kinds for name in registry_of(ctx).names(kind)]
        return [CompletionItem(name, help=kind) for name, kind in names if name.startswith(incomplete)]


def registry_of(ctx: click.Context) -> Registry:
    """Return the registry of this command line; while the Tab key completes, no command has run and filled it."""
    held = ctx.find_object(Registry)
    if held is not None:
        return held
    for path in ctx.find_root().params.get("plugin") or ():
        with contextlib.suppress(LostMotionError):
            default().add_file(path)
    return default()
