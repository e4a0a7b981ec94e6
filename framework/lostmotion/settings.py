"""The thresholds that decide: what is significant, what is named, what held-out data may say, what a chain must reach.

Each has a reason and, where there is one, a source. They are handed in, stand in the provenance of each result, and can
be changed: `lostmotion diagnose CASE.toml --set select.decisive=4`, or
`lostmotion.diagnose(case, settings={"select.decisive": 4.0})`. `lostmotion settings` lists them. Numbers that only say
how a thing is computed (steps of differences, starts of a search) stand where they are used.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, NamedTuple

from lostmotion.errors import CaseError, nearest


def _number(value: float, why: str, source: str = "", least: float = 0.0, most: float = math.inf) -> Any:
    """Return a field with its default, the reason for it, where it comes from and the range it may have."""
    told = {"default": value, "why": why, "source": source, "least": least, "most": most}
    return field(default=value, metadata=told)


@dataclass(frozen=True)
class LocateSettings:
    """Where a missing force lives."""

    significant: float = _number(
        8.0, "A random force beyond the usual noise of the drive counts from this gain in log-likelihood on."
    )
    structured: float = _number(
        0.1, "A covariate counts as structure when the missing force goes with it by more than this share.", most=1.0
    )
    level: float = _number(
        0.05,
        "The chance of calling a covariate beyond chance that is not, over all covariates together.",
        "Vovk, Wang, Annals of Statistics 49 (2021) 1736-1754",
        most=1.0,
    )
    told: float = _number(0.05, "A covariate that explains less than this share of the variance is not told.", most=1.0)
    tied: float = _number(
        3.0, "Covariates whose log likelihood ratios differ by less than this are not told apart: a factor of twenty."
    )
    signed: float = _number(
        0.97,
        (
            "The sign of the velocity is told in place of the velocity when it explains this share of what "
            "that explains."
        ),
        most=1.0,
    )
    quantisation: float = _number(
        0.05,
        "Marks in the stored values, such as steps of a converter, count from this share of the noise variance on.",
        most=1.0,
    )


@dataclass(frozen=True)
class SelectSettings:
    """Which terms are taken."""

    decisive: float = _number(
        math.log(20.0),
        "A term is taken when its log odds exceed this: odds of twenty.",
        "Kass, Raftery, J. Am. Stat. Assoc. 90 (1995) 773-795",
    )
    promising: float = _number(3.0, "A term is fitted when its score test promises this gain in log-likelihood.")
    most_terms: float = _number(5.0, "No more terms than this are taken.", least=1.0)
    further: float = _number(1.5, "The log price of each further parameter of a term.")
    onset: float = _number(
        math.log(100.0), "The log price of a term that was not there from the beginning: one in a hundred."
    )
    certain: float = _number(
        3.0,
        "An amplitude counts when it is this many robust standard deviations from nothing.",
        "White, Econometrica 50 (1982) 1-25",
    )
    memory: float = _number(
        2.0, "From this ratio of robust to usual standard deviations on, what is left over has a memory.", least=1.0
    )
    share: float = _number(
        0.2, "Beside leftovers with a memory a term has to take this share off the random force.", most=1.0
    )
    outshone: float = _number(
        0.1,
        "Terms that win less than this share, each, of what one learned curve promises only stand in for it.",
        most=1.0,
    )
    commoner: float = _number(
        6.0, "A commoner law is told in place of a found one that wins no more log evidence than this over it."
    )
    noise_memory: float = _number(
        8.0,
        (
            "Noise of a sensor has a memory when this raises the log-likelihood by so much: where the noise "
            "is white its two parameters are flat."
        ),
    )


@dataclass(frozen=True)
class RivalSettings:
    """What is usual on real machines, against which every name has to stand."""

    known: float = _number(
        0.01,
        "The standard deviation of a known value, relative: drawings and data sheets are not more exact.",
        most=1.0,
    )
    scale: float = _number(0.01, "The standard deviation of the scale of a sensor and of a drive, relative.", most=1.0)
    bent: float = _number(
        0.005, "The standard deviation of the square and of the cube that bend a sensor, in its range.", most=1.0
    )
    late: float = _number(
        0.5,
        "The standard deviation of the time between channels, in samples: acquisition systems filter and multiplex.",
    )
    much: float = _number(
        20.0,
        (
            "A smooth force that promises so much log evidence is fitted before a name is given, and no more "
            "than that is believed of a promise."
        ),
    )
    absurd: float = _number(
        100.0, "A promise beyond this of which nothing comes true tells that slopes about the fit mean nothing."
    )
    lasting: float = _number(
        4.0, "From this excess of the scatter of scores on their memory is long, and only promises count.", least=1.0
    )


@dataclass(frozen=True)
class UnknownSettings:
    """When a force without a name is learned as a curve, and what is said of it."""

    hope: float = _number(0.3, "Curves are tried that promise this share of what the best set of terms wins.", most=1.0)
    kept: float = _number(
        0.2, "A curve that changes the size of a named law by more than this share is the shape of that law.", most=1.0
    )
    alike: float = _number(0.8, "A curve looks like a law that explains this share of its variance.", most=1.0)
    alike_two: float = _number(
        0.9, "A curve looks like two laws that explain this share of its variance together.", most=1.0
    )
    formula: float = _number(0.8, "A formula is proposed that tells this share of a curve.", most=1.0)


@dataclass(frozen=True)
class HeldOutSettings:
    """What data that no fit has seen may decide."""

    share: float = _number(
        0.3, "The share of a recording, or of the recordings, that is held out.", least=0.05, most=0.7
    )
    rise: float = _number(0.01, "An error of free runs that rises by a smaller share than this has not changed.")
    missing: float = _number(
        1.02, "A missing force that rises by more than this factor is not explained by what was found.", least=1.0
    )
    fall: float = _number(
        0.01,
        (
            "A log score that falls by more than this per sample speaks against a model, unless its free runs"
            " err by much less."
        ),
    )
    less: float = _number(0.5, "Free runs err by much less when their error falls below this share.", most=1.0)
    chance: float = _number(
        0.05,
        "The chance of calling a model better that is not: Student's paired test over ten parts of held-out data.",
        most=1.0,
    )
    explains: float = _number(
        0.5,
        "A set of terms that may predict better must win this share of what the chosen one wins on the fitted data.",
        most=1.0,
    )
    behind: float = _number(
        10.0,
        (
            "A term that a smooth force leads by more than these log odds on the fitted data is not asked "
            "about held-out data."
        ),
    )


@dataclass(frozen=True)
class NameSettings:
    """What is said of a finding: named, likely or open."""

    sure: float = _number(
        0.95, "What is named has a probability above this; with a doubt it is told with no more.", most=1.0
    )
    rival: float = _number(0.05, "A set of terms with a larger share of the posterior is told as a rival.", most=1.0)
    worth: float = _number(0.01, "A term that was not found is told when its probability is above this.", most=1.0)
    related: float = _number(
        math.log(20.0),
        (
            "A relative of what was found is told when its log evidence, without the price of its parameters,"
            " is so close."
        ),
    )
    moved: float = _number(
        5.0, "A level that moves by so many standard deviations when a further term comes in was not known."
    )
    moved_share: float = _number(0.2, "And by this share of it.", most=1.0)
    beside: float = _number(
        3.0,
        "Beside a learned curve a name is sure when it wins so many times the log evidence that the curve wins: less"
        " may be a part of what has no name.",
        "`lostmotion prove --world imperfect --seed 900`: names below were as often wrong as right",
    )
    remains: float = _number(
        0.5,
        "A name is no more than likely where a random force is left of more than this share of what was missing.",
        most=1.0,
    )
    late: float = _number(
        0.05,
        "A delay of more than this share of a natural period is unusual: acquisition systems are faster.",
        most=1.0,
    )
    early: float = _number(
        0.04,
        "A change that is over within this share of the recording is no more than likely: a known value that is wrong"
        " from the beginning looks the same.",
        most=1.0,
    )
    error: float = _number(0.3, "A model does not hold whose free runs err by more than this share of the response.")
    error_noise: float = _number(5.0, "And by so many times the noise.")
    white: float = _number(
        0.01, "A p-value of whiteness below this is told as a finding, and below five times this as a doubt.", most=1.0
    )


@dataclass(frozen=True)
class SharedSettings:
    """Whether a parameter is the same in several recordings."""

    level: float = _number(0.01, "The chance of calling parameters different that are not.", most=1.0)
    alike: float = _number(0.01, "Values that differ by less than this share are the same for an engineer.", most=1.0)


@dataclass(frozen=True)
class ChainSettings:
    """When a chain of draws is believed."""

    long: float = _number(
        50.0,
        "A chain is this many autocorrelation times long: shorter ones do not know their own.",
        "Foreman-Mackey et al., PASP 125 (2013) 306",
    )
    steady: float = _number(
        0.02,
        "The longest autocorrelation time has settled when it grows by less than this share between checks.",
        most=1.0,
    )
    agreed: float = _number(
        1.01, "The largest R-hat that is believed.", "Vehtari et al., Bayesian Analysis 16 (2021) 667-718", least=1.0
    )


@dataclass(frozen=True)
class LevelSettings:
    """Which motions count as chaotic when parameters are identified from exponents and dimensions."""

    chaotic: float = _number(
        2.0, "A motion is chaotic when its exponent exceeds zero by more than this many standard errors."
    )
    weak: float = _number(
        0.5,
        "Chaos is weak when the exponent is below this, in nat per drive period: a recording may show nothing of it.",
        "`benchmarks/levels.py errors`: 6 of 10 recordings of weak chaos were classified correctly",
    )


@dataclass(frozen=True)
class MotionSettings:
    """When a recorded motion is called periodic, quasiperiodic, chaotic or noise."""

    level: float = _number(
        0.05, "The level of each surrogate test.", "Theiler et al., Physica D 58 (1992) 77-94", most=1.0
    )
    efolds: float = _number(
        0.8,
        (
            "Growth over fewer e-foldings is no sign: noise with a long memory shows up to 0.65 "
            "(`benchmarks/verdicts.py`)."
        ),
    )
    turns: float = _number(
        1.0, "Growth over fewer turns of the motion is no sign: within a turn distances rise and fall by themselves."
    )
    flat: float = _number(
        1.5, "A dimension whose interval ends below this is that of a closed curve: a chaotic flow has more than 2."
    )
    still: float = _number(0.05, "An entropy below so many e-foldings in a turn cannot be told from zero.")
    left: float = _number(
        0.5,
        "The share of the variance that may not repeat in a motion that is called periodic but for fluctuations.",
        most=1.0,
    )
    uneven: float = _number(
        2.0, "The ratio of the standard deviations of two halves from which on a recording is not steady.", least=1.0
    )
    measured: float = _number(
        2.0, "How many of exponent, dimension and entropy must speak for chaos.", least=1.0, most=3.0
    )


class Setting(NamedTuple):
    """One threshold as people look it up: `stage.name`, value and default, why it is so, its source, and its range."""

    key: str
    value: float
    default: float
    why: str
    source: str
    least: float
    most: float


@dataclass(frozen=True)
class Settings:
    """All thresholds that decide, by stage; frozen. `Settings().changed({"select.decisive": 4.0})` makes others."""

    locate: LocateSettings = field(default_factory=LocateSettings)
    select: SelectSettings = field(default_factory=SelectSettings)
    rival: RivalSettings = field(default_factory=RivalSettings)
    unknown: UnknownSettings = field(default_factory=UnknownSettings)
    heldout: HeldOutSettings = field(default_factory=HeldOutSettings)
    name: NameSettings = field(default_factory=NameSettings)
    shared: SharedSettings = field(default_factory=SharedSettings)
    chain: ChainSettings = field(default_factory=ChainSettings)
    levels: LevelSettings = field(default_factory=LevelSettings)
    motion: MotionSettings = field(default_factory=MotionSettings)

    def changed(self, values: Mapping[str, float | str]) -> Settings:
        """Return the settings with some of them changed, by `stage.name`; raise `CaseError` for what there is not."""
        made, known = self, {setting.key: setting for setting in self}
        for key, value in values.items():
            if key not in known:
                raise CaseError(f"there is no setting {key!r}{nearest(key, known)}: `lostmotion settings` lists them")
            stage, _, name = key.partition(".")
            made = replace(made, **{stage: replace(getattr(made, stage), **{name: _checked(known[key], value)})})
        return made

    def __iter__(self) -> Iterator[Setting]:
        """Yield every setting."""
        for stage in fields(self):
            own = getattr(self, stage.name)
            for f in fields(own):
                yield Setting(f"{stage.name}.{f.name}", getattr(own, f.name), **f.metadata)

    def as_dict(self) -> dict[str, dict[str, float]]:
        """Return all of them as nested mappings, for the provenance of a result."""
        return asdict(self)


DEFAULT = Settings()
"""The settings that hold where nobody says anything."""


def _checked(setting: Setting, value: object) -> float:
    """Return a value for a setting, or raise `CaseError` with what was wanted."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        number = math.nan
    if not setting.least <= number <= setting.most or not math.isfinite(number):
        wanted = f"a number from {setting.least:g} to {setting.most:g}"
        raise CaseError(f"the setting {setting.key} is {value!r}: wanted {wanted}")
    return number


def read(pairs: Mapping[str, float | str] | Settings | None) -> Settings:
    """Return settings from what a caller gave: settings, a mapping of changes, or nothing."""
    return pairs if isinstance(pairs, Settings) else DEFAULT.changed(pairs or {})
