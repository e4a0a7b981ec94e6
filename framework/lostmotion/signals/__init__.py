"""Common operations on a series: checks, delay vectors, sampling, spectra, sections, decays, hits, cycles."""

from lostmotion.signals.decay import Decay, decay_of, decays_of
from lostmotion.signals.impacts import Hit, hits_of, note_hits, note_overload, onsets_of, overloaded
from lostmotion.signals.repetition import Repetition, period_found, repeated_share, repetition_of
from lostmotion.signals.sampling import Locked, commensurate, resampled, unlocked
from lostmotion.signals.sections import poincare, return_spread, stroboscopic
from lostmotion.signals.series import checked, delay_vectors
from lostmotion.signals.spectra import fundamental, refined_period, spectrum, without_harmonics
from lostmotion.signals.tones import base_line, two_tones
from lostmotion.signals.trends import Trend, trend_of

__all__ = [
    "Decay",
    "Hit",
    "Locked",
    "Repetition",
    "Trend",
    "base_line",
    "checked",
    "commensurate",
    "decay_of",
    "decays_of",
    "delay_vectors",
    "fundamental",
    "hits_of",
    "note_hits",
    "note_overload",
    "onsets_of",
    "overloaded",
    "period_found",
    "poincare",
    "refined_period",
    "repeated_share",
    "repetition_of",
    "resampled",
    "return_spread",
    "spectrum",
    "stroboscopic",
    "trend_of",
    "two_tones",
    "unlocked",
    "without_harmonics",
]
