"""Lines at the end of a table that are no rows of it: statistics of its columns, and marks of its end."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lostmotion.recording.cells import Line, cells_of, is_filled, is_value

LONGEST = 50
"""The most lines of a footer."""
FOOTER = re.compile(
    r"\W*(\d+ (rows?|samples?|records?|points?)|"
    r"mean|average|avg|min(imum)?|max(imum)?|std\.?( ?dev\w*)?|stdev|standard deviation|variance|rms|sum|total|"
    r"median|n|count|number of \w+|peak( to peak)?|range|statistics?|summary|end( of .*)?|eof|done|stop|stopped|"
    r"mittel(wert)?|durchschnitt|summe|maxim\w+|minim\w+|standardabweichung|anzahl|statistik|ende|"
    r"moyenne|somme|平均値?|最大値?|最小値?|標準偏差|合計|среднее|максимум|минимум|сумма)\b.*",
    re.IGNORECASE,
)
"""The first cell of the first line of a footer."""


def drop_footer(rows: Iterator[Line], separator: str | None) -> Iterator[Line]:
    """Yield the rows of a table without its footer, which begins below a row that starts with a number or a stamp.

    Rows of separators only are left out at the end of the table.
    """
    after_value, blank = False, list[Line]()
    for row in rows:
        cells = [cell.strip() for cell in cells_of(row[1], separator) if cell.strip()]
        if not cells:
            blank.append(row)
            continue
        alone = len(cells) == 1 and separator is not None and re.match(r"[^\d.+-]", cells[0])
        if after_value and (FOOTER.fullmatch(cells[0]) or alone):
            rest = [row, *islice(rows, LONGEST)]
            if len(rest) <= LONGEST and not any(_is_row(line, separator) for _, line in rest[1:]):
                return
            yield from (*blank, *rest, *rows)
            return
        after_value = is_value(cells[0])
        yield from (*blank, row)
        blank = []


def _is_row(line: str, separator: str | None) -> bool:
    """Return whether a line holds several values and nothing else, as a row of the table does."""
    cells = cells_of(line, separator)
    return len(cells) > 1 and all(map(is_value, cells)) and is_filled(cells[0])
