"""The hooks that a plugin may implement. Each returns names and not objects, so that listing plugins imports none.

A plugin with one term::

    from lostmotion.hookspecs import hookimpl

    @hookimpl
    def lostmotion_terms():
        return {"maxwell_element": "my_package.terms:MaxwellElement"}

A package names the module that holds these functions in the entry-point group `lostmotion.v1`. `lostmotion plugins`
lists a name that two packages offer as a clash, and a package that fails with the reason; neither can be used.
"""

from __future__ import annotations

from collections.abc import Mapping

import pluggy

PROJECT = "lostmotion"
GROUP = "lostmotion.v1"

hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)


@hookspec
def lostmotion_models() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Model`: a model, a machine as equations of motion."""
    raise NotImplementedError


@hookspec
def lostmotion_dynamics() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Dynamics`: a machine that is stepped."""
    raise NotImplementedError


@hookspec
def lostmotion_terms() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Term`: a force or another effect."""
    raise NotImplementedError


@hookspec
def lostmotion_embedders() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Embedder`: a method that chooses lag and dimension."""
    raise NotImplementedError


@hookspec
def lostmotion_quantifiers() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Quantifier`: a method that estimates a number."""
    raise NotImplementedError


@hookspec
def lostmotion_surrogates() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Surrogate`: a method that draws surrogate series."""
    raise NotImplementedError


@hookspec
def lostmotion_denoisers() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Denoiser`: a method that removes measurement noise."""
    raise NotImplementedError


@hookspec
def lostmotion_noises() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Noise`: noise of a sensor, a state-space block."""
    raise NotImplementedError


@hookspec
def lostmotion_simulators() -> Mapping[str, str]:
    """Return `{"name": "package.module:Class"}` for each `Simulator`: a machine with joints, by others."""
    raise NotImplementedError


@hookspec
def lostmotion_commands() -> Mapping[str, tuple[str, str]]:
    """Return `{"name": ("package.module:command", "One line of help.")}` for each `click.Command`.

    A name that the framework's own command line uses is refused.
    """
    raise NotImplementedError


@hookspec
def lostmotion_functions() -> Mapping[str, tuple[str, str]]:
    """Return `{"name": ("package.module:function", "One line of help.")}` for each function of the Python interface.

    It becomes `lostmotion.name`, unless the framework itself has this name.
    """
    raise NotImplementedError


@hookspec
def lostmotion_results() -> Mapping[str, tuple[str, str]]:
    """Return `{"file.json": ("package.module:function", "One line of help.")}` for each kind of stored result.

    The function takes the `Path` of a folder that contains this file; `lostmotion.load` returns its result.
    """
    raise NotImplementedError


@hookspec
def lostmotion_routes() -> Mapping[str, tuple[str, str]]:
    """Return `{"name": ("package.module:function", "One line of help.")}` for each route of an identification.

    The function takes case, folder, registry, order, generator and progress, and returns a
    `lostmotion.identification.routes.Route`.
    """
    raise NotImplementedError


@hookspec
def lostmotion_measures() -> Mapping[str, tuple[str, str]]:
    """Return `{"attractors": ("package.module:function", "One line of help.")}`: what a diagnosis measures of motions.

    The function takes `Motions` (`contracts`), a `Registry` and a random generator, and returns `Attractors`
    (`contracts`).
    """
    raise NotImplementedError


@hookspec
def lostmotion_sections() -> Mapping[str, tuple[str, str]]:
    """Return `{"name": ("package.module:function", "One line of help.")}` for each section of the page of a diagnosis.

    The function takes nothing and returns a `lostmotion.report.pages.PageSection`, whose functions take an `Evidence`
    (`lostmotion.diagnosis.report.page_data`): the result and its arrays.
    """
    raise NotImplementedError


@hookspec
def lostmotion_screens() -> Mapping[str, tuple[str, str]]:
    """Return `{"name": ("package.module:function", "One line of help.")}` for each screen of the page of `app`.

    The function takes a `lostmotion_app.desk.Desk`, with the recording, the case and the results that the page works
    on, and returns what Panel shows: a figure of Bokeh or matplotlib, a table of pandas, an object of Panel. It is
    called whenever the screen is opened. The line of help stands above it.
    """
    raise NotImplementedError


@hookspec
def lostmotion_readers() -> Mapping[str, tuple[str, str]]:
    """Return `{"xyz": ("package.module:function", "requirement")}` for each ending of a file name, without its dot.

    The function takes the `Path` of a recording and returns a `Table` (`recording`). It runs in a process of its own,
    with limits of time and memory. If it raises `ImportError`, users are told to install the requirement with pip. An
    ending that the framework reads itself is refused.
    """
    raise NotImplementedError
