"""Models from the field followed by our flow, and their equations followed by an integrator that shares nothing."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from lostmotion.likelihood.system import System
from lostmotion_chaos.flows.flow import make_stepped_flow


def flow_of(model, values, *, drive, start, steps=0):
    """Return the flow of a model by RK4."""
    return make_stepped_flow(System.of(model), values, drive=drive, start=np.array(start, dtype=float), steps=steps)


def followed(model, values, *, drive, start, periods=1, looks=200, steps=0):
    """Return the states (periods * looks + 1, n) of a model."""
    flow = flow_of(model, values, drive=drive, start=start, steps=steps)
    return flow.sample(flow.start, periods=periods, looks=looks)


def elsewhere(rates, t, start, **kind):
    """Return the states (samples, n) at the times `t` by an integrator of another family."""
    tight = {"rtol": 1e-11, "atol": 1e-13, **kind}
    return solve_ivp(rates, (t[0], t[-1]), start, "DOP853", t_eval=t, **tight).y.T
