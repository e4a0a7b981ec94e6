"""Lines at the end of a table that are no rows of it: statistics of its columns, and marks of its end."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator

from lostmotion.recording.header import Line, cells_of, is_value

LONGEST = 50
"""The most lines of a footer."""
FOOTER = re.compile(
    r"\W*(mean|average|avg|min(imum)?|max(imum)?|std\.?( ?dev\w*)?|stdev|standard deviation|variance|rms|sum|total|"
    r"median|n|count|number of \w+|peak( to peak)?|range|statistics?|summary|end( of .*)?|eof|done|stop|stopped|"
    r"mittel(wert)?|durchschnitt|summe|maxim\w+|minim\w+|standardabweichung|anzahl|statistik|ende|"
    r"moyenne|somme|平均値?|最大値?|最小値?|標準偏差|合計|среднее|максимум|минимум|сумма)\b.*",
    re.IGNORECASE,
)
"""The first cell of the first line of a footer."""


def drop_footer(rows: Iterator[Line], separator: str | None) -> Iterator[Line]:
    """Yield the rows of a table without its footer, which begins below a row that starts with a number or a stamp."""
    after_value = False
    for row in rows:
        first = next((cell for cell in cells_of(row[1], separator) if cell.strip()), "").strip()
        if after_value and FOOTER.fullmatch(first):
            rest = deque([row])
            for more in rows:
                rest.append(more)
                if len(rest) > LONGEST:
                    break
            else:
                return
            yield from rest
            yield from rows
            return
        after_value = is_value(first)
        yield row
