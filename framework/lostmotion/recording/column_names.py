"""What the name of a column says: time, a counter of rows, or a quantity; in English, German, Japanese and Russian."""

from __future__ import annotations

import re
from collections.abc import Mapping

KINDS = ("force", "position", "velocity", "acceleration")
"""The quantities of a column, in the order in which its unit is compared with them."""
NAMES: Mapping[str, re.Pattern[str]] = {
    "force": re.compile(
        r"force|load ?cell|(?<![^\W_])load(?![a-z]|[ _]?(?:pos|angle|vel|speed|acc|side|enc))|torque|effort|thrust"
        r"|^f([_ \d.,\[(/]|$)|^tau|moment(?!ary)|(?<!thermo)couple|^u\d*$|drive|excit|brake|kraft|fuerza|forza"
        r"|荷重|力|하중|힘|トルク|сила|усилие|момент",
        re.IGNORECASE,
    ),
    "acceleration": re.compile(r"acc|^a[xyz]?([_ \d.,\[(/]|$)|accel|beschl|加速度|ускорение|가속도", re.IGNORECASE),
    "velocity": re.compile(
        r"(?<!tra)(?<!le)vel|speed|^v[xyz]?([_ \d.,\[(/]|$)|^w([_ \d.,\[(/]|$)|^dq|omega|gyro|rpm|geschw"
        r"|drehzahl|vitesse|velocidad|速度|回転数|속도|скорость|обороты",
        re.IGNORECASE,
    ),
    "position": re.compile(
        r"pos|disp|dist(?!urb)|deflec|elong|exten[st]|lvdt|abstand|^hub|angle|enc|travel|gauge|laser"
        r"|^[xqy]([_ \d.,\[(/]|$)|theta|phi|stroke|^weg|winkel|d[ée]plac|desplaz"
        r"|変位|位置|角度|位移|변위|위치"
        r"|перемещение|положение|угол",
        re.IGNORECASE,
    ),
}
TIME = re.compile(
    r"(^|[_ .])(t|ts|time|file ?time|date ?time|date|datum|zeit|uhrzeit|zeitstempel|seconds?|timestamp|stamp|clock|"
    r"elapsed|x_value|temps|tiempo|tempo|horodatage|heure|hora|fecha|tijd)([_ \[(.,/]|$)"
    r"|時間|時刻|日時|日付|时间|시간|日期|время|дата",
    re.IGNORECASE,
)
OTHER = re.compile(r"temp(?!s)|volt|spannung|current|strom|press|druck|power|soc|setpoint|soll|温度", re.IGNORECASE)
"""Names of readings of which nothing is computed."""
COUNTER = re.compile(
    r"^(#|no\.?|nr\.?|n|k|i|index|idx|row|rows|zeile|sample ?(no\.?|number|index)?|samples|count(er)?|counts|pulses?|"
    r"ticks?|record|scan|point|frame|seq(uence)?|id|ordinal|番号|номер|№)([_ \[(.,/]|$)",
    re.IGNORECASE,
)
"""Names of columns that count rows, samples or pulses."""

_ASCII = re.compile(r"[\x00-\x7f]+")


def has_foreign_name(text: str) -> bool:
    """Return whether a text has a word for time or for a quantity in letters beyond those of English."""
    foreign = _ASCII.sub(" ", text)
    return TIME.search(foreign) is not None or kind_named(foreign) != ""


def names_time(name: str) -> bool:
    """Return whether the name of a column is one of time."""
    return TIME.search(name) is not None and COUNTER.match(name) is None


def names_other(name: str) -> bool:
    """Return whether the name of a column is that of a reading, which may grow as evenly as time does."""
    return kind_named(name) != "" or OTHER.search(name) is not None


def kind_named(name: str) -> str:
    """Return the quantity of `KINDS` that the name of a column says; "" where it says none."""
    return next((kind for kind, pattern in NAMES.items() if pattern.search(name)), "")
