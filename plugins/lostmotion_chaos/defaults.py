"""The methods that are used by default."""

from __future__ import annotations

EMBEDDER = "ami_cao"
EXPONENT = "lyapunov_kantz"
EXPONENT_CHECKS = ("lyapunov_rosenstein",)
"""Further methods for the exponent, with which the first one is compared."""
DIMENSION, ENTROPY = "correlation_dimension", "correlation_entropy"
METER, DENOISER = "noise_level", "local_projective"
"""The methods that measure and remove the noise of a series."""
STATISTIC = "prediction_error"
"""The number that is compared between a recording and its surrogates."""
SURROGATE, SURROGATE_OF_CYCLES = "iaaft", "pseudo_periodic"
FLOW_EXPONENT, SECTION_DIMENSION = "lyapunov_max", "section_dimension"
"""The quantities that a map of a model contains."""
