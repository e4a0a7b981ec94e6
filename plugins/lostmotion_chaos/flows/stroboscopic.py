"""The stroboscopic map of a model with its terms, with tangent vectors: one point after the other, for long orbits."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from importlib import resources
from typing import Any

import numba
import numpy as np

from lostmotion.kernels.vector import BARE
from lostmotion.likelihood.adopted import adopt_function, compute_fingerprint, define_module, explain_errors, store_text
from lostmotion.likelihood.plan import Blueprint
from lostmotion_chaos.kernels.views import slow_view, view


def _list_parts(plan: Blueprint) -> dict[str, Callable[..., Any]]:
    """Return the functions of the plugins under the names they have in the composed text."""
    parts = {"model_rhs": plan.rhs, "model_observe": plan.observe}
    parts |= {f"motion_{i}": place.motion for i, place in enumerate(plan.places)}
    for i, law in enumerate(plan.laws):
        parts |= {f"force_{i}": law.force}
        parts |= {f"rate_{i}": law.rate} if law.states else {}
    return parts


def _list_fields(plan: Blueprint) -> dict[str, Any]:
    """Return the numbers of the terms whose functions are methods, under the names they have in a composed text."""
    return {f"fields_{i}": law.fields for i, law in enumerate(plan.laws) if law.fields}


def _write_law(index: int, plan: Blueprint, start: int) -> list[str]:
    """Return the lines that add one law to `dydt`, under its switch."""
    law, i = plan.laws[index], index
    place = plan.places[law.place]
    if law.channel is not None:  # a sensor is no part of the flow
        return []
    numbers = (f"dydt[{place.row}]" if a in law.felt else f"w[{start + a}]" for a in range(law.width))
    own = "(" + "".join(f"{number}, " for number in numbers) + ")"
    if law.prepared:
        own = f"view(w, {start}, {law.width})"
    states = "".join(f"y[at[{i}] + {a}], " for a in range(law.states))
    lever = "" if place.lever is None else f"p[{place.lever}]"
    handed = f"{f'fields_{i}, ' if law.fields else ''}t, x, v, u, {own}, ({states})"
    lines = [
        f"    if on[{i}]:",
        f"        x, v = motion_{law.place}(y, u{lever and ', ' + lever})",
        f"        push = force_{i}({handed})",
        f"        dydt[{place.row}] += push / p[{place.inertia}]",
    ]
    if place.against:
        pull = f"{lever} * push" if lever else "push"
        lines.append(f"        dydt[{place.against[0]}] -= {pull} / p[{place.against[1]}]")
    if law.states:
        lines.append(f"        rate_{i}({handed}, view(dydt, at[{i}], {law.states}))")
    return lines


def _write_text(plan: Blueprint, states: int) -> str:
    """Return the source of the map for a number of states."""
    starts = [sum(law.width for law in plan.laws[:i]) for i in range(len(plan.laws))]
    laws = "\n".join(line for i, start in enumerate(starts) for line in _write_law(i, plan, start))
    text = resources.files("lostmotion_chaos.kernels").joinpath("tangent.txt").read_text()
    return text.replace("@N@", str(states)).replace("@LAWS@", laws)


@lru_cache(maxsize=64)
def build_map(plan: Blueprint, states: int, compiled: bool = True) -> Callable[..., int]:
    """Return the map of a plan with a number of active states, compiled or as plain Python."""
    text, parts, fields = _write_text(plan, states), _list_parts(plan), _list_fields(plan)
    if compiled:
        also = "".join(f"{name}{compute_fingerprint(part)}" for name, part in sorted(parts.items())) + repr(fields)
        path = store_text(text, also)
        given = {name: adopt_function(part, path.stem) for name, part in parts.items()}
        whole = numba.njit(**BARE, cache=True)
        space = define_module(text, str(path), {**given, **fields, "jit": whole, "view": view})
    else:
        space = define_module(text, "<slow twin>", {**parts, **fields, "jit": lambda f: f, "view": slow_view})

    def mapped(*args: Any) -> int:
        return int(space["follow_orbit"](*args, np.zeros((10, states)), np.zeros((3, states, states))))

    return explain_errors(mapped)
