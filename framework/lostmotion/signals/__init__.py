"""What any method does with a sampled series: checks, delay vectors, sampling against the drive, spectra, sections."""

from lostmotion.signals.sampling import Locked, commensurate, resampled, unlocked
from lostmotion.signals.sections import poincare, return_spread, stroboscopic
from lostmotion.signals.series import checked, delay_vectors
from lostmotion.signals.spectra import fundamental, refined_period, spectrum, without_harmonics
from lostmotion.signals.tones import base_line, two_tones

__all__ = [
    "Locked",
    "base_line",
    "checked",
    "commensurate",
    "delay_vectors",
    "fundamental",
    "poincare",
    "refined_period",
    "resampled",
    "return_spread",
    "spectrum",
    "stroboscopic",
    "two_tones",
    "unlocked",
    "without_harmonics",
]
