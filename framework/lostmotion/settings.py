"""The thresholds on which conclusions depend: significance, naming, held-out comparison, convergence of chains.

Each has a reason and, where one exists, a source. They are passed as arguments, are recorded in the provenance of each
result, and can be changed: `lostmotion diagnose CASE.toml --set select.decisive=4`, or
`lostmotion.diagnose(case, settings={"select.decisive": 4.0})`. `lostmotion settings` lists them. Numerical details,
such as the step of a finite difference, are constants of the module that uses them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, NamedTuple

from lostmotion.errors import CaseError, nearest


def _number(value: float, why: str, source: str = "", least: float = 0.0, most: float = math.inf) -> Any:
    """Return a dataclass field with its default, its reason, its source and its allowed range."""
    metadata = {"default": value, "why": why, "source": source, "least": least, "most": most}
    return field(default=value, metadata=metadata)


@dataclass(frozen=True)
class LocateSettings:
    """Locating the missing force."""

    significant: float = _number(
        8.0, "A random force beyond the usual noise of the drive counts when it gains this much in log-likelihood."
    )
    structured: float = _number(
        0.1, "A covariate counts as structure when it explains more than this share of the missing force.", most=1.0
    )
    level: float = _number(
        0.05,
        "The probability of a false positive over all covariates together.",
        "Vovk, Wang, Annals of Statistics 49 (2021) 1736-1754",
        most=1.0,
    )
    told: float = _number(
        0.05, "A covariate that explains less than this share of the variance is not reported.", most=1.0
    )
    tied: float = _number(
        3.0,
        "Covariates whose log likelihood ratios differ by less than this (a factor of twenty) are reported together.",
    )
    signed: float = _number(
        0.97,
        (
            "The sign of the velocity is reported in place of the velocity when it explains at least this share of "
            "what the velocity explains."
        ),
        most=1.0,
    )
    quantisation: float = _number(
        0.05,
        "Quantisation of the stored values counts when its variance exceeds this share of the noise variance.",
        most=1.0,
    )


@dataclass(frozen=True)
class SelectSettings:
    """Selecting terms."""

    decisive: float = _number(
        math.log(20.0),
        "A term is selected when its log odds exceed this value (odds of twenty).",
        "Kass, Raftery, J. Am. Stat. Assoc. 90 (1995) 773-795",
    )
    promising: float = _number(
        3.0, "A term is fitted when its score test predicts at least this gain in log-likelihood."
    )
    most_terms: float = _number(5.0, "The greatest number of terms that are selected.", least=1.0)
    further: float = _number(1.5, "The log prior penalty of each further parameter of a term.")
    onset: float = _number(
        math.log(100.0), "The log prior penalty of a term that begins during the recording: one in a hundred."
    )
    certain: float = _number(
        3.0,
        "An amplitude counts when it is at least this many robust standard deviations from its null.",
        "White, Econometrica 50 (1982) 1-25",
    )
    memory: float = _number(
        2.0,
        "From this ratio of robust to usual standard deviations on, the residuals count as correlated in time.",
        least=1.0,
    )
    share: float = _number(
        0.2, "Where residuals are correlated in time, a term has to reduce the random force by this share.", most=1.0
    )
    outshone: float = _number(
        0.1,
        "Terms of which each gains less than this share of the gain that one learned curve predicts only imitate it.",
        most=1.0,
    )
    commoner: float = _number(
        6.0, "A more common law is reported in place of a found one whose log evidence is higher by no more than this."
    )
    noise_memory: float = _number(
        8.0,
        (
            "Noise of a sensor is modelled as AR(1) when this raises the log-likelihood by at least this much: for "
            "white noise the two parameters of AR(1) have no effect."
        ),
    )


@dataclass(frozen=True)
class RivalSettings:
    """Usual imperfections of real machines, with which each candidate term is compared."""

    known: float = _number(
        0.01,
        "The relative standard deviation of a known value: drawings and data sheets are not more accurate.",
        most=1.0,
    )
    scale: float = _number(0.01, "The relative standard deviation of the gain of a sensor and of a drive.", most=1.0)
    bent: float = _number(
        0.005,
        "The standard deviation of the quadratic and of the cubic error of a sensor, relative to its range.",
        most=1.0,
    )
    late: float = _number(
        0.5,
        "The standard deviation of the delay between channels, in samples: acquisition systems filter and multiplex.",
    )
    much: float = _number(
        20.0,
        (
            "A smooth force that predicts at least this gain in log evidence is fitted before a term is named, and a "
            "prediction counts for no more than this."
        ),
    )
    absurd: float = _number(
        100.0,
        "A predicted gain above this of which a fit realises nothing shows that the local expansion is not valid.",
    )
    lasting: float = _number(
        4.0,
        "From this excess of the scatter of scores on, their correlation is long and only predicted gains count.",
        least=1.0,
    )


@dataclass(frozen=True)
class UnknownSettings:
    """Learning an unexplained force as a curve, and describing it."""

    hope: float = _number(
        0.3, "Curves are tried that predict at least this share of the gain of the best set of terms.", most=1.0
    )
    kept: float = _number(
        0.2, "A curve that changes the size of a named law by more than this share belongs to that law.", most=1.0
    )
    alike: float = _number(0.8, "A curve resembles a law that explains at least this share of its variance.", most=1.0)
    alike_two: float = _number(
        0.9, "A curve resembles two laws that together explain at least this share of its variance.", most=1.0
    )
    formula: float = _number(
        0.8, "A formula is proposed when it explains at least this share of the variance of a curve.", most=1.0
    )


@dataclass(frozen=True)
class HeldOutSettings:
    """Comparing models on held-out data."""

    share: float = _number(
        0.3, "The share of a recording, or of the recordings, that is held out.", least=0.05, most=0.7
    )
    rise: float = _number(0.01, "An error of free runs that rises by a smaller share than this counts as unchanged.")
    missing: float = _number(
        1.02,
        "A missing force that rises by more than this factor on held-out data is not explained by the found terms.",
        least=1.0,
    )
    fall: float = _number(
        0.01,
        (
            "A log score that falls by more than this per sample is evidence against a model, unless the error of its"
            " free runs is much smaller."
        ),
    )
    less: float = _number(0.5, "The error of free runs is much smaller when it falls below this share.", most=1.0)
    chance: float = _number(
        0.05,
        "The significance level for calling a model better: Student's paired test over ten parts of held-out data.",
        most=1.0,
    )
    explains: float = _number(
        0.5,
        "A set of terms is compared on held-out data when its gain in the fit is this share of that of the chosen set.",
        most=1.0,
    )
    behind: float = _number(
        10.0,
        (
            "A term is not compared on held-out data when a smooth force exceeds it by more than these log odds in "
            "the fit."
        ),
    )


@dataclass(frozen=True)
class NameSettings:
    """Reporting a finding as named, likely or open."""

    sure: float = _number(
        0.95,
        "A named finding has a probability above this; a finding with a doubt is reported with at most this.",
        most=1.0,
    )
    simplest: float = _number(
        0.5,
        "A term that explains the data better than any learned curve, but no better than a generic smooth force, has"
        " its probability among the terms times this: the smooth force may be real.",
        most=1.0,
    )
    rival: float = _number(
        0.05, "A set of terms with a larger share of the posterior is reported as a rival.", most=1.0
    )
    worth: float = _number(0.01, "A term that was not found is listed when its probability is above this.", most=1.0)
    related: float = _number(
        math.log(20.0),
        (
            "A term that resembles a found one is reported when its log evidence, without the penalty of its"
            " parameters, is within this distance."
        ),
    )
    moved: float = _number(
        5.0, "An amplitude that moves by this many standard deviations when a further term is added was not identified."
    )
    moved_share: float = _number(
        0.2, "The amplitude must also move by this share of itself (see `name.moved`).", most=1.0
    )
    beside: float = _number(
        3.0,
        "Where a curve was learned too, a finding is named when its gain in log evidence is this many times that of the"
        " curve: with less it may be a part of the unexplained force.",
        "`lostmotion prove --world imperfect --seed 900`: names below this ratio were wrong as often as right",
    )
    remains: float = _number(
        0.5,
        "A finding is at most likely where the remaining random force exceeds this share of the missing force.",
        most=1.0,
    )
    late: float = _number(
        0.05,
        "A delay of more than this share of a natural period is unusual: acquisition systems are faster.",
        most=1.0,
    )
    early: float = _number(
        0.04,
        "A change that is complete within this share of the recording is at most likely: a known value that is wrong"
        " from the beginning looks the same.",
        most=1.0,
    )
    error: float = _number(
        0.3,
        "A model is rejected when the error of free runs exceeds this share of the response (see `name.error_noise`).",
    )
    error_noise: float = _number(
        5.0, "The error of free runs must also exceed this many times the noise (see `name.error`)."
    )
    white: float = _number(
        0.01,
        "A p-value of whiteness below this is reported as a finding, and below five times this as a doubt.",
        most=1.0,
    )


@dataclass(frozen=True)
class SharedSettings:
    """Comparing a parameter between several recordings."""

    level: float = _number(0.01, "The significance level for calling parameters different.", most=1.0)
    alike: float = _number(
        0.01, "Values that differ by less than this share count as equal in engineering terms.", most=1.0
    )


@dataclass(frozen=True)
class ChainSettings:
    """Convergence of a Markov chain."""

    long: float = _number(
        50.0,
        "The least length of a chain in autocorrelation times: from shorter chains that time cannot be estimated.",
        "Foreman-Mackey et al., PASP 125 (2013) 306",
    )
    steady: float = _number(
        0.02,
        "The longest autocorrelation time has converged when it grows by less than this share between checks.",
        most=1.0,
    )
    agreed: float = _number(
        1.01, "The largest accepted R-hat.", "Vehtari et al., Bayesian Analysis 16 (2021) 667-718", least=1.0
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
    harmonic: float = _number(
        0.1,
        "A drive is harmonic when this share of its standard deviation, or less, is not a sine of one frequency: its"
        " noise and small harmonics.",
        most=1.0,
    )


@dataclass(frozen=True)
class MotionSettings:
    """Classifying a recorded motion as periodic, quasiperiodic, chaotic or noise."""

    level: float = _number(
        0.05, "The significance level of each surrogate test.", "Theiler et al., Physica D 58 (1992) 77-94", most=1.0
    )
    efolds: float = _number(
        0.8,
        (
            "Growth over fewer e-foldings is no evidence: noise with a long memory shows up to 0.65 "
            "(`benchmarks/verdicts.py`)."
        ),
    )
    turns: float = _number(
        1.0, "Growth over fewer cycles of the motion is no evidence: distances rise and fall within a cycle."
    )
    flat: float = _number(
        1.5, "A dimension whose interval ends below this belongs to a closed curve: a chaotic flow has more than 2."
    )
    still: float = _number(0.05, "An entropy of fewer e-foldings per cycle cannot be distinguished from zero.")
    left: float = _number(
        0.5,
        "The greatest share of the variance that does not repeat in a motion called periodic with fluctuations.",
        most=1.0,
    )
    uneven: float = _number(
        2.0,
        "From this ratio of the standard deviations of its two halves on, a recording is not stationary.",
        least=1.0,
    )
    measured: float = _number(
        2.0, "How many of exponent, dimension and entropy must indicate chaos.", least=1.0, most=3.0
    )


class Setting(NamedTuple):
    """One threshold: its key `stage.name`, value and default, the reason for it, its source and its range."""

    key: str
    value: float
    default: float
    why: str
    source: str
    least: float
    most: float


@dataclass(frozen=True)
class Settings:
    """All thresholds, by stage; frozen. `Settings().changed({"select.decisive": 4.0})` returns changed ones."""

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
        """Return the settings with some values changed, by `stage.name`; unknown keys or values raise `CaseError`."""
        made, known = self, {setting.key: setting for setting in self}
        for key, value in values.items():
            if key not in known:
                raise CaseError(f"there is no setting {key!r}{nearest(key, known)}: `lostmotion settings` lists them")
            stage, _, name = key.partition(".")
            made = replace(made, **{stage: replace(getattr(made, stage), **{name: _check_value(known[key], value)})})
        return made

    def __iter__(self) -> Iterator[Setting]:
        """Yield every setting."""
        for stage in fields(self):
            own = getattr(self, stage.name)
            for f in fields(own):
                yield Setting(f"{stage.name}.{f.name}", getattr(own, f.name), **f.metadata)

    def as_dict(self) -> dict[str, dict[str, float]]:
        """Return all values as nested mappings, `{stage: {name: value}}`, for the provenance of a result."""
        return asdict(self)


DEFAULT = Settings()
"""The default settings."""


def _check_value(setting: Setting, value: object) -> float:
    """Return a value for a setting as a number; raise `CaseError` where it is no number in the allowed range."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        number = math.nan
    if not setting.least <= number <= setting.most or not math.isfinite(number):
        wanted = f"a number from {setting.least:g} to {setting.most:g}"
        raise CaseError(f"the setting {setting.key} is {value!r}: wanted {wanted}")
    return number


def read(pairs: Mapping[str, float | str] | Settings | None) -> Settings:
    """Return settings from the argument of a caller: settings, a mapping of changes, or None."""
    return pairs if isinstance(pairs, Settings) else DEFAULT.changed(pairs or {})
