"""Plugins as other people write them: one good of each kind, and those that break in every way there is."""

import math
from dataclasses import dataclass

import numpy as np

from lostmotion.contracts import Denoiser, Embedder, Flow, Interface, Model, Param, Quantifier, Series, Surrogate, Term
from lostmotion.quantities import DAMPING, INERTIA, STIFFNESS
from lostmotion.results import Embedding, Estimate

PAPER = "Somebody, Journal 1 (2000) 1"


def body(y, u):
    return y[0], y[1]


@dataclass(frozen=True)
class Cart(Model):
    """m x'' + c x' + k x = force."""

    name = "guest_cart"
    paper = PAPER
    motion = "translation"
    states = ("position", "velocity")
    inputs = ("force",)
    channels = ("position", "velocity")
    params = (
        Param("m", "mass", INERTIA, low=0.0, scale="log"),
        Param("c", "damping", DAMPING, low=0.0, scale="log"),
        Param("k", "stiffness", STIFFNESS, low=0.0, scale="log"),
    )
    interfaces = (Interface("ground", row=1, inertia="m", motion=body),)

    @staticmethod
    def rhs(t, y, u, p, dydt):
        dydt[0] = y[1]
        dydt[1] = (u[0] - p[1] * y[1] - p[2] * y[0]) / p[0]

    @staticmethod
    def observe(t, y, dydt, u, p, seen):
        seen[0] = y[0]
        seen[1] = y[1]


@dataclass(frozen=True)
class Drag(Term):
    """A drag."""

    at: str = "ground"
    name = "guest_drag"
    physics = "Drag of {size} acts"
    formula = "-size * v"
    paper = PAPER
    params = (Param("size", "drag", DAMPING, low=0.0, null=0.0),)

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * v


@dataclass(frozen=True)
class Pair(Embedder):
    """Three coordinates, eight samples apart."""

    name = "guest_pair"
    paper = PAPER

    def choose(self, x, *, dt):
        return Embedding(8, 3, 10)


@dataclass(frozen=True)
class Crest(Quantifier[Series]):
    """The largest value over the standard deviation."""

    name = "guest_crest"
    paper = PAPER
    unit = "1"

    def estimate(self, data, *, rng):
        value = float(np.max(np.abs(data.x)) / np.std(data.x))
        return Estimate(value, value, value, "ok")


@dataclass(frozen=True)
class Reach(Quantifier[Flow]):
    """How far a model moves."""

    name = "guest_reach"
    paper = PAPER
    unit = "1"
    reads = "flow"

    def estimate(self, data, *, rng):
        value = float(np.max(np.abs(data.strobe(data.start, periods=40, tangents=1).states[:, 0])))
        return Estimate(value, value, value, "ok")


@dataclass(frozen=True)
class Shuffle(Surrogate):
    """The values in another order."""

    name = "guest_shuffle"
    paper = PAPER
    null = "independent samples"
    preserves = frozenset({"mean", "variance", "amplitudes"})

    def draw(self, series, *, draws, rng):
        return np.array([rng.permutation(series.x) for _ in range(draws)])


@dataclass(frozen=True)
class Mean3(Denoiser):
    """The mean of three samples."""

    name = "guest_mean"
    paper = PAPER

    def clean(self, series, *, noise, rng):
        return np.convolve(np.pad(series.x, 1, mode="edge"), np.ones(3) / 3, "valid")


GOOD = (Cart, Drag, Pair, Crest, Reach, Shuffle, Mean3)


def spoiled(base, name, **methods):
    """Return a frozen class called `name` with some methods of `base` replaced."""
    return dataclass(frozen=True)(type(name, (base,), {"name": name, "__doc__": "Bad.", **methods}))


def raises(*_args, **_options):
    raise ZeroDivisionError("all is lost")


def words(t, x, v, u, p, s):
    return str(p[0])


def pair(t, x, v, u, p, s):
    return p[0], v


def no_number(t, x, v, u, p, s):
    return math.nan * p[0]


def pushes(t, x, v, u, p, s):
    return 1.0


TERMS = [
    (spoiled(Drag, "guest_raises", force=staticmethod(raises)), "ZeroDivisionError"),
    (spoiled(Drag, "guest_words", force=staticmethod(words)), "force_is_zero_at_null"),
    (spoiled(Drag, "guest_tuple", force=staticmethod(pair)), "force_is_zero_at_null"),
    (spoiled(Drag, "guest_nan", force=staticmethod(no_number)), "nan"),
    (spoiled(Drag, "guest_pushes", force=staticmethod(pushes)), "force is 1.0"),
    (spoiled(Drag, "guest_null", params=(Param("size", "drag", DAMPING),)), "no parameter has a null"),
    (spoiled(Drag, "guest_method", force=Drag.force), "is not a static method"),
]


def blank(self, data, *, rng):
    data.x[:] = 0.0
    return Estimate(1.0, 1.0, 1.0, "ok")


def wild(self, data, *, rng):
    value = float(np.random.random())  # noqa: NPY002
    return Estimate(value, value, value, "ok")


METHODS = [
    (spoiled(Crest, "guest_q_raises", estimate=raises), "raised ZeroDivisionError (all is lost)"),
    (spoiled(Crest, "guest_q_float", estimate=lambda self, data, *, rng: 3.0), "an Estimate was expected"),
    (
        spoiled(Crest, "guest_q_nan", estimate=lambda self, data, *, rng: Estimate(math.nan, 0.0, 1.0, "ok")),
        "returned the status 'ok' with the value nan",
    ),
    (spoiled(Crest, "guest_q_blank", estimate=blank), "changed the samples that it was given"),
    (spoiled(Crest, "guest_q_wild", estimate=wild), "drew from NumPy's global generator"),
    (spoiled(Pair, "guest_e_raises", choose=raises), "raised ZeroDivisionError"),
    (spoiled(Pair, "guest_e_half", choose=lambda self, x, *, dt: Embedding(1.5, 3)), "whole numbers"),
    (spoiled(Pair, "guest_e_none", choose=lambda self, x, *, dt: None), "raised AttributeError"),
    (spoiled(Shuffle, "guest_s_raises", draw=raises), "raised ZeroDivisionError"),
    (
        spoiled(Shuffle, "guest_s_short", draw=lambda self, series, *, draws, rng: np.zeros((2, 3))),
        "finite rows of at most 1200 samples were expected",
    ),
    (spoiled(Mean3, "guest_d_raises", clean=raises), "raised ZeroDivisionError"),
    (
        spoiled(Mean3, "guest_d_short", clean=lambda self, series, *, noise, rng: series.x[:5]),
        "finite values were expected",
    ),
]
