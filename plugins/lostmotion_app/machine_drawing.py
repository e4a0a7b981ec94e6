"""The picture of a machine as SVG: bodies in a row, springs, dampers and gaps between them, with their parameters.

Lines take the colour of the text around them, so that they are seen on a dark page.
"""

from __future__ import annotations

import html
from collections.abc import Callable, Iterator, Mapping

from lostmotion.report.words import sentence, to_words
from lostmotion_app.machine_parts import BASE, GROUND, DrawnElement, MachineParts

ROW, SPAN, BODY, EDGE = 30, 70, 46, 12
"""The height of a row of elements, the lengths of an element and of a body, and the width of a wall (units of SVG)."""
TOP, BOTTOM = 20, 16
"""The space above the machine, for arrows, and below it."""
LABEL = 34
"""The space right of the last body for the label of its input, where it has no element there."""
WEIGHT = 34
"""The space below a body for a load or a weight."""


def draw_machine(parts: MachineParts, *, width: int = 0) -> str:
    """Return a picture as the text of an SVG with a description for those who do not see it.

    `width` (px) is that of the picture; without it the picture has its own size at most, and shrinks with its place.
    """
    words, drawing = describe_machine(parts), _MachineDrawing(parts)
    lines = "".join(drawing.draw())
    size = f'width="{width}"' if width else f'style="width: 100%; max-width: {drawing.width}px"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {drawing.width} {drawing.height}" {size} role="img"'
        f' aria-label="{html.escape(words, quote=True)}" fill="none" stroke="currentColor" stroke-width="1.5"'
        f' stroke-linejoin="round" stroke-linecap="round">{lines}</svg>'
    )


def describe_machine(parts: MachineParts) -> str:
    """Return a picture in words."""
    names = [_name_body(parts, number) for number in range(len(parts.bodies))]
    told = [f"{'wheel' if parts.motion == 'rotation' else 'body'} {name}" for name in names]
    told += [_describe_element(parts, one) for one in parts.elements]
    told += [f"{name_input(parts, number)} on {names[number]}" for number, name in enumerate(parts.inputs) if name]
    if parts.moved:
        told.append("the base is moved")
    return sentence("; ".join(told)) + "."


def name_input(parts: MachineParts, number: int) -> str:
    """Return the input of a body in words, empty for none; the force of a rotation is a torque."""
    said = to_words(parts.inputs[number])
    return said.replace("force", "torque") if parts.motion == "rotation" else said


def _name_body(parts: MachineParts, number: int) -> str:
    return parts.bodies[number] or f"number {number + 1}"


def _describe_element(parts: MachineParts, one: DrawnElement) -> str:
    """Return an element in words: its kind, its parameters, and its ends."""
    body = _name_body(parts, one.body)
    if one.kind in ("load", "weight"):
        return f"{'constant force' if one.kind == 'load' else 'weight'} {one.name} on {body}"
    kinds = {"gap": "spring with a gap", "stop": "one-sided stop", "nonlinear": "nonlinear spring"}
    kind = kinds.get(one.shape, one.kind) if one.kind == "spring" else one.kind
    length = f", {one.length}" if one.length else ""
    ends = {GROUND: "the ground", BASE: "the moved base"}
    return f"{kind} {one.name}{length} from {body} to {ends.get(one.end) or _name_body(parts, one.end)}"


class _MachineDrawing:
    """The layout of one machine: which elements are left of, between, right of and below the bodies."""

    def __init__(self, parts: MachineParts) -> None:
        self.parts, count = parts, len(parts.bodies)
        self.between: list[list[DrawnElement]] = [[] for _ in range(count + 1)]
        self.below: list[list[DrawnElement]] = [[] for _ in range(count)]
        self.over: list[DrawnElement] = []
        for one in parts.elements:
            self._place(one)
        rows = max([1, *map(len, self.between)])
        self.floor = [number for number in range(count) if not self._is_held(number)]
        self.tall = max(ROW * rows, BODY)
        self.left = EDGE + SPAN if self.between[0] or parts.moved else EDGE
        self.right = SPAN + EDGE if self.between[-1] else LABEL
        self.width = self.left + count * BODY + (count - 1) * SPAN + self.right
        self.top = TOP + ROW * len(self.over)
        self.height = self.top + self.tall + (WEIGHT if any(self.below) else BOTTOM)

    def _place(self, one: DrawnElement) -> None:
        """Put an element into a column: between two bodies, or left, right or below one."""
        last = len(self.parts.bodies) - 1
        if one.kind in ("load", "weight"):
            self.below[one.body].append(one)
        elif one.end >= 0 and abs(one.end - one.body) == 1:
            self.between[max(one.end, one.body)].append(one)
        elif one.end >= 0:
            self.over.append(one)
        elif one.body == 0 and (one.end == BASE or not self.parts.moved):
            self.between[0].append(one)
        elif one.body == last:
            self.between[last + 1].append(one)
        else:
            self.below[one.body].append(one)

    def _is_held(self, number: int) -> bool:
        """Return whether a spring holds a body at its place; others stand on wheels."""
        return any(one.kind == "spring" and number in (one.body, one.end) for one in self.parts.elements)

    def find_body(self, number: int) -> int:
        """Return the left edge of a body."""
        return self.left + number * (BODY + SPAN)

    def draw(self) -> Iterator[str]:
        """Yield the elements of the picture."""
        for number, name in enumerate(self.parts.bodies):
            yield from self._draw_body(number, name)
        for column, elements in enumerate(self.between):
            start = EDGE if column == 0 else self.find_body(column - 1) + BODY
            for row, one in enumerate(elements):
                yield _draw_element(one, start, self._find_row(row, len(elements)), start + SPAN)
        for row, one in enumerate(self.over):
            yield from self._draw_over(one, TOP + row * ROW)
        for number, elements in enumerate(self.below):
            for place, one in enumerate(elements):
                at = self.find_body(number) + BODY * (place + 1) // (len(elements) + 1)
                yield _draw_hanging(one, at, self.top + self.tall)
        if self.between[0] or self.parts.moved:
            yield _draw_wall(EDGE, self.top, self.tall, -1)
        if self.between[-1]:
            yield _draw_wall(self.find_body(len(self.parts.bodies) - 1) + BODY + SPAN, self.top, self.tall, 1)
        if self.parts.moved:
            yield _draw_arrow(4, self.top - 10, 40, both=True) + _write(46, self.top - 6, "base", anchor="start")

    def _find_row(self, row: int, count: int) -> float:
        """Return the height of a row of elements beside the bodies."""
        return self.top + self.tall * (row + 0.5) / count

    def _draw_body(self, number: int, name: str) -> Iterator[str]:
        """Yield a body with its name, its input, and wheels where nothing holds it."""
        x, middle = self.find_body(number), self.top + self.tall / 2
        corner = BODY / 2 if self.parts.motion == "rotation" else 3
        yield f'<rect x="{x}" y="{self.top}" width="{BODY}" height="{self.tall}" rx="{corner:g}" stroke-width="2"/>'
        if self.parts.motion != "rotation" and number in self.floor and not self.below[number]:
            for at in (x + 11, x + BODY - 11):
                yield f'<circle cx="{at}" cy="{self.top + self.tall + 5}" r="4"/>'
        yield _write(x + BODY / 2, middle + 5, name, size=14)
        if said := name_input(self.parts, number).removeprefix("second "):
            draw = _draw_turn if self.parts.motion == "rotation" else _draw_arrow
            yield draw(x + BODY / 2 - 14, self.top - 8, x + BODY / 2 + 14)
            yield _write(x + BODY / 2 + 19, self.top - 6, said, anchor="start")

    def _draw_over(self, one: DrawnElement, y: int) -> Iterator[str]:
        """Yield an element above the bodies, between two that are no neighbours."""
        first, last = sorted((one.body, one.end))
        a, b = self.find_body(first) + BODY / 4, self.find_body(last) + 3 * BODY / 4
        middle = (a + b - SPAN) / 2
        yield _draw_line((a, self.top), (a, y), (middle, y)) + _draw_line((middle + SPAN, y), (b, y), (b, self.top))
        yield _draw_element(one, middle, y, middle + SPAN)


def _draw_line(*points: tuple[float, float]) -> str:
    return f'<polyline points="{" ".join(f"{x:g},{y:g}" for x, y in points)}"/>'


def _write(x: float, y: float, text: str, *, size: int = 11, anchor: str = "middle") -> str:
    """Return a text at a place."""
    return (
        f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" font-size="{size}" font-family="sans-serif"'
        f' fill="currentColor" stroke="none">{html.escape(text)}</text>'
    )


def _draw_arrow(start: float, y: float, end: float, *, both: bool = False) -> str:
    """Return an arrow to the right; with two heads where it moves to and fro."""
    back = _draw_line((start + 5, y - 4), (start, y), (start + 5, y + 4)) if both else ""
    return back + _draw_line((start, y), (end, y)) + _draw_line((end - 5, y - 4), (end, y), (end - 5, y + 4))


def _draw_turn(start: float, y: float, end: float) -> str:
    """Return a bent arrow to the right, of a torque."""
    head = _draw_line((end - 6, y), (end, y + 2), (end + 2, y - 5))
    return f'<path d="M{start:g} {y + 2:g} Q{(start + end) / 2:g} {y - 10:g} {end:g} {y + 2:g}"/>{head}'


def _draw_wall(x: float, top: float, tall: float, side: int) -> str:
    """Return a wall with its hatching on the left (-1) or on the right (1)."""
    strokes = range(int(top) + 6, int(top + tall) + 8, 8)
    return _draw_line((x, top - 2), (x, top + tall + 2)) + "".join(
        f'<path d="M{x:g} {y - 6} l{7 * side} 7" stroke-width="0.9"/>' for y in strokes
    )


def _draw_element(one: DrawnElement, start: float, y: float, end: float) -> str:
    """Return a spring or a damper between two heights, with the names of its parameters above it."""
    shape = "damper" if one.kind == "damper" else one.shape
    name = f"{one.name}, {one.length}" if one.length else one.name
    return _SYMBOLS[shape](start, y, end) + _write((start + end) / 2, y - 9, name)


def _draw_spring(start: float, y: float, end: float, turns: int = 5) -> str:
    a, b = start + 8, end - 8
    step = (b - a) / (2 * turns)
    peaks = [(a + (k + 0.5) * step, y + (5 if k % 2 else -5)) for k in range(2 * turns)]
    return _draw_line((start, y), (a, y), *peaks, (b, y), (end, y))


def _draw_nonlinear(start: float, y: float, end: float) -> str:
    a, b = start + 0.3 * (end - start), start + 0.7 * (end - start)
    slant = _draw_line((a, y + 10), (b, y - 7)) + _draw_line((b - 6, y - 8), (b, y - 7), (b - 2, y - 2))
    return _draw_spring(start, y, end) + slant


def _draw_damper(start: float, y: float, end: float) -> str:
    a, b = start + 0.35 * (end - start), start + 0.62 * (end - start)
    cup = _draw_line((b, y - 7), (a, y - 7), (a, y + 7), (b, y + 7))
    piston = (a + b) / 2 + 2
    return _draw_line((start, y), (a, y)) + cup + _draw_line((piston, y - 5), (piston, y + 5)) + _draw_line(
        (piston, y), (end, y)
    )  # fmt: skip


def _draw_gap(start: float, y: float, end: float) -> str:
    """Return a spring that ends in a fork, in which the end of a rod has play."""
    a, b = start + 0.55 * (end - start), end - 9
    fork = _draw_line((b, y - 3), (b, y - 7), (a, y - 7), (a, y + 7), (b, y + 7), (b, y + 3))
    knob = f'<circle cx="{(a + b) / 2:g}" cy="{y:g}" r="3" fill="currentColor"/>'
    return _draw_spring(start, y, a, 3) + fork + knob + _draw_line(((a + b) / 2, y), (end, y))


def _draw_stop(start: float, y: float, end: float) -> str:
    """Return a spring whose plate the body meets on one side."""
    a = start + 0.6 * (end - start)
    return _draw_spring(start, y, a, 3) + _draw_line((a, y - 8), (a, y + 8)) + _draw_line(
        (end - 10, y - 8), (end - 10, y + 8)
    ) + _draw_line((end - 10, y), (end, y))  # fmt: skip


_SYMBOLS: Mapping[str, Callable[[float, float, float], str]] = {
    "linear": _draw_spring,
    "nonlinear": _draw_nonlinear,
    "gap": _draw_gap,
    "stop": _draw_stop,
    "damper": _draw_damper,
}


def _draw_hanging(one: DrawnElement, x: float, y: float) -> str:
    """Return a load or a weight as an arrow below a body, and another element as a short one to the floor."""
    if one.kind in ("load", "weight"):
        end = y + 18
        arrow = _draw_line((x, y + 2), (x, end)) + _draw_line((x - 4, end - 5), (x, end), (x + 4, end - 5))
        return arrow + _write(x + 8, y + 15, one.name, anchor="start")
    symbol = _SYMBOLS["damper" if one.kind == "damper" else one.shape](0, 0, 24)
    floor = _draw_line((x - 8, y + 24), (x + 8, y + 24))
    name = _write(x + 9, y + 15, f"{one.name}, {one.length}" if one.length else one.name, anchor="start")
    return f'<g transform="translate({x:g} {y:g}) rotate(90)">{symbol}</g>{floor}{name}'
