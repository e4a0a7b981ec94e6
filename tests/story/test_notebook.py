"""The notebook of the docs, cell by cell, as Jupyter runs it: the last expression of a cell is shown."""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path

import arviz_stats
import pytest

NOTEBOOK = Path(__file__).parents[2] / "docs" / "howto" / "diagnosis.ipynb"


def shown_by(source, space):
    """Return what a cell shows: HTML of its last expression where that has any, else its `repr`."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "<cell>", "exec"), space)  # noqa: S102 - our own notebook
    if last is None:
        return ""
    value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), space)  # noqa: S307
    return (value._repr_html_() if hasattr(value, "_repr_html_") else None) or repr(value)


@pytest.fixture(scope="module")
def run():
    """Return the names that the notebook has defined, and what each cell of code has shown."""
    space = {"__name__": "__main__"}
    cells = [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]
    return space, [shown_by("".join(cell["source"]), space) for cell in cells]


def test_the_friction_is_found(run):
    space, _ = run
    (mechanism,) = space["found"].found
    assert mechanism.mechanism == "coulomb_friction"
    assert 1.2 in mechanism.parameters["force"]
    assert 900.0 in space["found"].parameters_after["k"]
    after, before = (space["found"].heldout[when].nrmse for when in ("after", "before"))
    assert after < 0.1 * before


def test_the_fitted_model_predicts_another_drive(run):
    import numpy as np
    from scipy.integrate import solve_ivp

    space, _ = run

    def rates(t, y):
        push = 10.0 * np.sin(9.0 * t) - 6.0 * y[1] - 900.0 * y[0] - 1.2 * np.tanh(y[1] / 2e-5)
        return [y[1], push / 2.5]

    t = np.arange(1000) / 200.0
    true = solve_ivp(rates, (0.0, t[-1]), [0.0, 0.0], "DOP853", t_eval=t, rtol=1e-8, atol=1e-11, max_step=1e-3).y[0]
    seen = np.asarray(space["other"].sensors[0])
    assert np.std(seen - true) < 0.01 * np.std(true)


def test_results_show_themselves_in_words(run):
    _, shown = run
    assert any(re.search(r"Dry friction of 1\.(19[5-9]|20[0-4]|2 )", text) and "<svg" in text for text in shown)
    assert any("position (m); 1500 samples at 100 Hz" in text for text in shown)


def test_what_was_saved_is_the_same(run):
    space, _ = run
    assert space["again"].to_dict() == space["found"].to_dict()
    assert space["again"].model.values == space["found"].model.values


def test_figures_of_a_result_are_figures(run):
    from matplotlib.figure import Figure

    plots = run[0]["found"].plot
    drawn = [plots.prediction(), plots.missing_force(), plots.ranking(), plots.parameters(), plots.sections()]
    assert all(isinstance(one, Figure) and one.axes for one in drawn)


def test_the_posterior_agrees_with_the_diagnosis(run):
    space, _ = run
    assert space["posterior"].converged
    force = space["posterior"].parameters["coulomb_friction.force"]
    assert 1.2 in force
    assert "coulomb_friction.force" in space["posterior"].to_arviz().posterior


def share_inside(data):
    """The share of the readings that lie in the central 95 % of their replicates, matched by their numbers."""
    low, high = data.posterior_predictive["readings"].quantile([0.025, 0.975], dim=("chain", "draw"))
    seen = data.observed_data["readings"]
    inside = (seen > low) & (seen < high)
    assert inside.sizes == seen.sizes
    return float(inside.mean())


def test_the_diagnosis_serves_arviz(run):
    data = run[0]["found"].to_arviz()
    left_out = arviz_stats.loo(data)
    assert 1.0 < left_out.p < 20.0
    assert float((left_out.pareto_k > 0.7).mean()) < 0.05
    assert 0.9 < share_inside(data) <= 1.0


def test_the_posterior_serves_arviz(run):
    """Blocks add up to the density that was sampled but for the priors, which are flat but for their coordinates."""
    data = run[0]["posterior"].to_arviz()
    whole = data.log_likelihood["readings"].sum("block")
    assert float((data.sample_stats["lp"] - whole).std()) < 0.1 * float(whole.std())
    left_out = arviz_stats.loo(data)
    assert 1.0 < left_out.p < 20.0
    assert float(left_out.pareto_k.max()) < 0.7
    assert 0.9 < share_inside(data) <= 1.0
    assert {"c", "k"} <= set(data.prior.data_vars)
