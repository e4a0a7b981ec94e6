"""Operations on a series that measures of chaos need: checks, delay vectors, sections, sampling, tones, distances."""

from lostmotion_chaos.signals.sampling import Locked, commensurate, resampled, unlocked
from lostmotion_chaos.signals.sections import poincare, return_spread, stroboscopic
from lostmotion_chaos.signals.series import checked, delay_vectors
from lostmotion_chaos.signals.tones import base_line, two_tones

__all__ = [
    "Locked",
    "base_line",
    "checked",
    "commensurate",
    "delay_vectors",
    "poincare",
    "resampled",
    "return_spread",
    "stroboscopic",
    "two_tones",
    "unlocked",
]
