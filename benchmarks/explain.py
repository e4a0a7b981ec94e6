"""The hypotheses of a case by one score: `python benchmarks/explain.py CASE.toml [--budget 60]`.

Prints each hypothesis that was fitted: score less the best one, log evidence of the fitted and of the held-out data,
the part of it that smooth forces add, and its parameters with their standard deviations. Then the probability of each
term.
This is the search of `lostmotion diagnose`, without its course over stretches of long recordings.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np

from lostmotion.diagnosis.compare import cut_heldout
from lostmotion.diagnosis.stages import list_fitted_keys
from lostmotion.evidence.bare import Budget
from lostmotion.evidence.probabilities import compute_probabilities
from lostmotion.evidence.search import ExplanationSearch
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.kernels.threads import hold_linear_algebra
from lostmotion.likelihood.system import System
from lostmotion.preparation.prepare import prepare
from lostmotion.registry import default
from lostmotion.settings import DEFAULT


def explain(path: Path, seconds: float) -> ExplanationSearch:
    """Return the search for explanations of a case."""
    prepared = prepare(path, default(), DEFAULT)
    system = System(prepared.model, prepared.terms)
    train, held = split_heldout(prepared.observations, DEFAULT.heldout)
    nominal = search_maximum(make_posterior(system, prepared.case, train, jobs=1), np.random.default_rng(0))
    pieces = [(piece.observation, piece.begin) for piece in cut_heldout(prepared.observations, held)]
    begun = time.process_time()
    say = lambda text: print(f"{time.process_time() - begun:7.1f} s  {text}", flush=True)  # noqa: E731
    return ExplanationSearch(nominal, list_fitted_keys(system), pieces, Budget(seconds=seconds), say=say).run()


def describe(hypothesis, best):
    """Return the lines of a hypothesis."""
    keys = hypothesis.frame.posterior.space.free[: hypothesis.frame.own]
    sds = np.sqrt(np.maximum(np.diag(hypothesis.covariance), 0.0))
    rows = []
    for f, at, sd in zip(keys, hypothesis.theta, sds, strict=True):
        value = f.value(float(at))
        rows.append(f"{f.key} = {value:.4g} +- {abs(value) * sd if f.log else sd:.2g} {f.unit}")
    head = f"{hypothesis.score() - best:9.1f}  {' and '.join(sorted(hypothesis.terms)) or 'nothing missing'}"
    told = f"fitted {hypothesis.log_evidence:.1f}, held out {hypothesis.heldout:.1f}, smooth {hypothesis.smooth:.1f}"
    state = "" if hypothesis.converged else ", not converged"
    return f"{head}\n           {told}{state}\n           {'; '.join(rows)}"


def main() -> None:
    """Explain a case and print what was found."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--budget", type=float, default=120.0, help="processor time of the search, in s")
    told = parser.parse_args()
    with hold_linear_algebra():
        found = explain(told.case, told.budget)
    ranked = sorted(found.found.values(), key=lambda h: -h.score())
    for hypothesis in ranked:
        print(describe(hypothesis, ranked[0].score()))
    shares = compute_probabilities(ranked, ranked[0].scatter)
    print(f"nothing missing: {shares[frozenset()]:.4f}")
    for key in sorted({key for terms in shares for key in terms}):
        print(f"{key}: {sum(p for terms, p in shares.items() if key in terms):.4f}")
    if found.skipped:
        print(f"not extended, because the time was used up: {', '.join(found.skipped)}")


if __name__ == "__main__":
    main()
