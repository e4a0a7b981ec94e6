"""What any method does with a sampled series: checks, delay vectors, sampling against the drive, spectra, sections."""

from lostmotion.signals.series import checked, delay_vectors

__all__ = ["checked", "delay_vectors"]
