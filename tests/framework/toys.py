"""Posteriors whose answers are known, for the tests of the sampler."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lostmotion.identification.sampling import ShownCoordinate, Task, TMixture
from lostmotion.likelihood.space import FreeParameter, ParameterSpace


@dataclass(frozen=True)
class Toy:
    """A posterior whose log-likelihood is a function of points (count, parameters)."""

    height: Callable
    free: tuple[FreeParameter, ...]

    @property
    def space(self):
        return ParameterSpace(self.free)

    def log_likelihood(self, points):
        return self.height(points)


def free_of(size, low=-20.0, high=20.0):
    return tuple(FreeParameter(f"p{i}", "1", 0.0, low, high) for i in range(size))


def task_at(toy, modes, covariances, weights=None):
    modes = np.atleast_2d(modes)
    weights = np.ones(len(modes)) if weights is None else np.array(weights)
    shown = tuple(ShownCoordinate(f.key, f.unit, 0.0) for f in toy.free)
    return Task(toy, TMixture.of_modes(modes, covariances, weights, toy.free), shown, modes[0])
