"""A group of commands that imports a command only when it runs, and Tab completion of plugin names."""

from __future__ import annotations

import contextlib
import errno
import warnings
from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any, ClassVar

import click
from click.shell_completion import CompletionItem

from lostmotion.defaults import SOURCES
from lostmotion.errors import LostMotionError, PluginWarning, nearest
from lostmotion.offers import COMMAND
from lostmotion.registry import KINDS, Registry, default
from lostmotion.registry.classes import import_target

EXIT_INTERRUPTED = 130
MAX_MESSAGE_LENGTH = 1500
"""Largest number of characters of a message: names in it may come from a file."""


def examples(*lines: str) -> str:
    """Return command lines as the epilog of a help text, one line each."""
    return "\b\n" + "\n".join(("Examples:", *(f"  {line}" for line in lines)))


class SentenceError(click.ClickException):
    """A `LostMotionError` on the command line: one sentence, exit status 2, no traceback."""

    exit_code = 2

    def show(self, file: object = None) -> None:
        """Write the sentence to standard error."""
        click.echo(f"lostmotion: {flatten_text(self.message)}", err=True)


def flatten_text(text: str) -> str:
    """Return a text on one line of limited length, with control characters replaced by their codes."""
    shown = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in " ".join(text.split()))
    return shown if len(shown) <= MAX_MESSAGE_LENGTH else f"{shown[:MAX_MESSAGE_LENGTH]} ..."


@contextlib.contextmanager
def _show_plugin_warnings() -> Iterator[None]:
    """Show each warning about a plugin once, as a sentence on standard error; other warnings are unchanged."""
    with warnings.catch_warnings():
        usual, seen = warnings.showwarning, set[str]()

        def show(message: Warning | str, category: type[Warning], *rest: Any) -> None:
            if not issubclass(category, PluginWarning):
                usual(message, category, *rest)
            elif str(message) not in seen:
                seen.add(str(message))
                click.echo(f"lostmotion: warning: {flatten_text(str(message))}", err=True)

        warnings.simplefilter("always", PluginWarning)
        warnings.showwarning = show  # type: ignore[assignment]
        yield


class LazyGroup(click.Group):
    """A group whose `table` gives the import target and the one-line help of each command.

    Packages add commands by the hook `lostmotion_commands`; they cannot replace a command of the `table`.
    """

    table: ClassVar[Mapping[str, tuple[str, str]]] = {}

    def find_commands(self, ctx: click.Context) -> dict[str, tuple[str, str]]:
        """Return import target and one-line help of all commands by name, in alphabetical order."""
        added = {e.name: (e.target, e.about) for e in registry_of(ctx).offered(COMMAND).values()}
        return dict(sorted({**added, **self.table}.items()))

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the commands."""
        return list(self.find_commands(ctx))

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import and return the command, or return None when there is no such name."""
        if cmd_name in self.table:
            module, _, attribute = self.table[cmd_name][0].partition(":")
            own: click.Command = getattr(import_module(module), attribute)
            return own
        added = registry_of(ctx).offered(COMMAND)
        if cmd_name not in added:
            return None
        command: click.Command = import_target(added[cmd_name].target, added[cmd_name].whose, click.Command)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return name, command and remaining arguments; an unknown name is refused with the nearest known one."""
        if args[0] not in self.table and not args[0].startswith("-"):
            known = self.find_commands(ctx)
            if args[0] not in known:
                for entry in registry_of(ctx).entries():
                    if (entry.kind, entry.name) == (COMMAND, args[0]):
                        raise SentenceError(entry.why)
                if args[0] in SOURCES:
                    raise SentenceError(registry_of(ctx).explain_absence(COMMAND, args[0]))
                raise click.UsageError(f"there is no command {args[0]!r}{nearest(args[0], known)}", ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the one-line help texts without importing a command."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, text) for name, (_, text) in self.find_commands(ctx).items()])

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Return the commands that begin with the typed text, then the options, without importing a command."""
        known = self.find_commands(ctx).items()
        found = [CompletionItem(n, help=text) for n, (_, text) in known if n.startswith(incomplete)]
        return found + click.Command.shell_complete(self, ctx, incomplete)

    def invoke(self, ctx: click.Context) -> object:
        """Run the command; a `LostMotionError` becomes a sentence, Ctrl-C the exit status 130."""
        try:
            with _show_plugin_warnings() if ctx.parent is None else contextlib.nullcontext():
                return super().invoke(ctx)
        except LostMotionError as err:
            raise SentenceError(str(err)) from err
        except MemoryError as err:
            raise SentenceError("there is not enough memory: cut the recording, or use fewer --jobs") from err
        except OSError as err:
            if err.errno in (None, errno.EPIPE):
                raise
            raise SentenceError(
                f"{err.filename or 'a file'} cannot be used ({err.strerror}): check the file and its permissions"
            ) from err
        except (KeyboardInterrupt, click.Abort):
            click.echo("lostmotion: interrupted", err=True)
            ctx.exit(EXIT_INTERRUPTED)


class PluginName(click.types.StringParamType):
    """The name of a plugin of the given kinds, or of any kind; the command that uses the name loads the plugin."""

    name = "name"

    def __init__(self, *kinds: str) -> None:
        self._kinds = kinds or KINDS

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return the names that begin with the typed text, those of `--plugin` files included."""
        names = [(name, kind) for kind in self._kinds for name in registry_of(ctx).names(kind)]
        return [CompletionItem(name, help=kind) for name, kind in names if name.startswith(incomplete)]


def registry_of(ctx: click.Context) -> Registry:
    """Return the registry of this command line; during Tab completion it is filled here, since no command has run."""
    held = ctx.find_object(Registry)
    if held is not None:
        return held
    for path in ctx.find_root().params.get("plugin") or ():
        with contextlib.suppress(LostMotionError):
            default().add_file(path)
    return default()
