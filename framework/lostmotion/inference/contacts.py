"""Contacts that are too short for the sampling rate of a recording."""

from __future__ import annotations

import numpy as np

from lostmotion.inference.fit import Fit
from lostmotion.results import rounded


def list_short_contacts(fit: Fit) -> list[str]:
    """Return a note for each contact that is so stiff that a bounce is shorter than a sample."""
    posterior, notes = fit.posterior, []
    for place in posterior.system.model.places:
        for i, observation in enumerate(posterior.observations):
            full = posterior.recordings[i].full(fit.theta)
            stiff = full[posterior.system.index[place.stiffness]] if place.stiffness and place.play else 0.0
            lasts = np.pi * np.sqrt(posterior.system.inertia(full, place) / stiff) if stiff > 0.0 else np.inf
            if lasts < observation.dt:
                notes.append(
                    f"{observation.name}: a bounce at the {place.name} lasts {rounded(lasts)} s and samples are"
                    f" {rounded(observation.dt)} s apart. The motion between them is not measured, so"
                    " intervals may be too"
                    " narrow and findings wrong:"
                    f" sample at {rounded(2.0 / lasts)} Hz or more."
                )
    return notes
