"""The hooks a plugin may answer: each returns names, not objects, so that listing plugins imports none of them."""

from __future__ import annotations

from collections.abc import Mapping

import pluggy

PROJECT = "lostmotion"
GROUP = "lostmotion.v1"

hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)


@hookspec
def lostmotion_models() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Model`."""
    raise NotImplementedError


@hookspec
def lostmotion_terms() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Term`."""
    raise NotImplementedError


@hookspec
def lostmotion_embedders() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Embedder`."""
    raise NotImplementedError


@hookspec
def lostmotion_quantifiers() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Quantifier`."""
    raise NotImplementedError


@hookspec
def lostmotion_surrogates() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Surrogate`."""
    raise NotImplementedError


@hookspec
def lostmotion_denoisers() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Denoiser`."""
    raise NotImplementedError


@hookspec
def lostmotion_engines() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Engine`."""
    raise NotImplementedError


@hookspec
def lostmotion_commands() -> Mapping[str, tuple[str, str]]:
    """Return `{"name": ("package.module:command", "One line of help.")}` for each `click.Command`."""
    raise NotImplementedError
