"""Common operations on a series: spectra, decays, hits, cycles."""

from lostmotion.signals.decay import Decay, decay_of, decays_of
from lostmotion.signals.impacts import Hit, hits_of, note_hits, note_overload, onsets_of, overloaded
from lostmotion.signals.repetition import Repetition, period_found, repeated_share, repetition_of
from lostmotion.signals.spectra import fundamental, refined_period, spectrum, without_harmonics
from lostmotion.signals.trends import Trend, trend_of

__all__ = [
    "Decay",
    "Hit",
    "Repetition",
    "Trend",
    "decay_of",
    "decays_of",
    "fundamental",
    "hits_of",
    "note_hits",
    "note_overload",
    "onsets_of",
    "overloaded",
    "period_found",
    "refined_period",
    "repeated_share",
    "repetition_of",
    "spectrum",
    "trend_of",
    "without_harmonics",
]
