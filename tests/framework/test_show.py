"""Distances between clouds of points, growth rates in blocks, and the table of before, after and noise floor."""

from dataclasses import astuple

import numpy as np
import pytest
import report_fixture as made
from lostmotion.diagnosis.attractors import MOST, measure_distances, take_section

from lostmotion.codec import from_plain, to_plain
from lostmotion.diagnosis.report import show
from lostmotion.diagnosis.show_words import describe_behaviour
from lostmotion.likelihood.observation import Observation
from lostmotion.results.behaviour import Behaviour
from lostmotion_chaos.signals.distances import distances, energy_distance, same_chance

PERIOD = 40.0


def recorded(samples, driven=True):
    """A observation of which only the drive counts: 40 samples a period, or none."""
    u = np.cos(2 * np.pi * np.arange(samples) / PERIOD) if driven else np.zeros(samples)
    return Observation.of("sections", np.zeros(samples), u[:, None], 0.01, "position")


def wandering(seed, samples=8000, middle=0.0):
    """States (samples, 2) of an orbit with a new amplitude each period, as chaos has it."""
    rng = np.random.default_rng(seed)
    size = np.repeat(1.0 + 0.4 * rng.random(samples // 40), 40)
    angle = 2 * np.pi * np.arange(samples) / PERIOD
    return np.stack([middle + size * np.sin(angle), size * np.cos(angle)], axis=1)


def test_energy_distance_of_two_points_is_twice_their_distance():
    points = np.array([[[0.0, 0.0], [0.0, 0.0], [3.0, 4.0], [3.0, 4.0]]])
    table = distances(points)
    assert energy_distance(table, np.arange(2), np.arange(2, 4)) == pytest.approx(10.0, abs=1e-6)


def test_energy_distance_is_that_of_scipy_in_one_dimension():
    from scipy.stats import energy_distance as scipys

    rng = np.random.default_rng(3)
    a, b = rng.standard_normal(60), 0.5 + rng.standard_normal(80)
    table = distances(np.concatenate([a, b])[None, :, None])
    own = energy_distance(table, np.arange(60), np.arange(60, 140))
    assert own == pytest.approx(scipys(a, b) ** 2, rel=1e-6)


def test_chance_is_even_for_equal_clouds_and_small_for_others():
    """Forty pairs of equal clouds: p below 0.05 in 2 of them on average; more than 8 has a chance of 1e-4."""
    rng = np.random.default_rng(5)
    small = 0
    for _ in range(40):
        table = distances(rng.standard_normal((1, 160, 2)))
        small += same_chance(table, 80, rng) < 0.05
    assert small <= 8
    moved = rng.standard_normal((1, 160, 2))
    moved[0, 80:] += 1.0
    assert same_chance(distances(moved), 80, rng) == pytest.approx(0.005)


def test_model_with_the_right_orbit_is_at_the_floor_and_another_is_not():
    motions = {"recorded": wandering(1), "before": wandering(2, middle=0.3), "after": wandering(3)}
    apart, strobed = measure_distances(motions, recorded(8000), np.random.default_rng(0))
    assert strobed
    assert apart["before"].chance < 0.01 < apart["after"].chance
    assert apart["before"].value > 3.0 * apart["noise_floor"].value
    assert apart["after"].value < 3.0 * apart["noise_floor"].value


def test_without_a_drive_looks_at_the_whole_orbit_are_compared():
    motions = {"recorded": wandering(1), "before": wandering(2, middle=0.5)}
    apart, strobed = measure_distances(motions, recorded(8000, driven=False), np.random.default_rng(0))
    assert not strobed
    assert apart["before"].status == "ok"
    assert apart["before"].chance < 0.01


def test_short_recordings_and_runaways_have_a_status():
    runaway = wandering(2)
    runaway[500:] = np.nan
    apart, _ = measure_distances(
        {"recorded": wandering(1), "before": runaway}, recorded(8000), np.random.default_rng(0)
    )
    assert apart["before"].status == "diverged"
    apart, _ = measure_distances(
        {"recorded": wandering(1, 400), "before": wandering(2, 400)}, recorded(400), np.random.default_rng(0)
    )
    assert apart["before"].status == apart["noise_floor"].status == "too_short"


def test_sections_are_taken_at_the_phase_asked_for():
    points = take_section(wandering(1), PERIOD, 0.25)
    assert len(points) == 200
    np.testing.assert_allclose(points[:, 1], 0.0, atol=1e-9)
    assert MOST >= 200


def facts_with(augmented=True, d2=None):
    """Return a diagnosis with the sentences of the measures as they are written; `d2` in place of its dimensions."""
    facts = (made.mismatch if augmented else made.adequate)()
    columns = [name for name in ("before", "after", "noise_floor") if name in facts["show"]]
    facts["show"] |= {name: facts["show"][name] | ({"d2": d2} if d2 else {}) for name in columns}
    facts["show"]["says"] = to_plain(sentences(from_plain(Behaviour, facts["show"])))
    return facts


def sentences(measured, strobed=True, **options):
    """Return a sentence on each measure of the last model."""
    return describe_behaviour(
        measured.after or measured.before, measured.noise_floor, measured.horizon, strobed, **options
    )


def plain(text):
    return text.replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(("free", "how"), [(False, "under the recorded drive"), (True, "without a drive")])
def test_an_exponent_says_what_drove_the_model(free, how):
    says = sentences(from_plain(Behaviour, made.show()), not free, driven=not free)
    assert says.largest_exponent.startswith(f"Of the model {how}")


def test_what_could_not_be_measured_keeps_its_sentence():
    refused = {"value": None, "low": None, "high": None, "status": "too_short", "says": "Too few periods."}
    facts = facts_with(d2=refused)
    row = next(r for r in show.make_table(made.evidence(facts)).rows if r[0] == "Correlation dimension")
    assert row[1:4] == ["–"] * 3
    assert "Too few periods." in row[4]


def test_table_of_the_report_has_every_measure_with_a_sentence():
    table = show.make_table(made.evidence(facts_with()))
    assert [row[0].partition(" (")[0] for row in table.rows] == list(astuple(show.MEASURE_NAMES))
    assert all(row[-1].endswith(".") for row in table.rows)
    distance = next(row for row in table.rows if row[0] == "Distance between attractors")
    assert [plain(cell) for cell in distance[1:4]] == ["0.3 (p = 0.005)", "0.02 (p = 0.4)", "0.01 (p = 0.5)"]
    exponent = next(row for row in table.rows if row[0] == "Largest exponent (1/s)")
    assert plain(exponent[1]) == "1.00 [0.80, 1.20]"


def test_table_of_an_adequate_model_has_one_model():
    table = show.make_table(made.evidence(facts_with(augmented=False)))
    assert table.head[1] == "Nominal model"
    assert all(len(row) == len(table.head) for row in table.rows)


def test_a_model_whose_motion_was_not_measured_has_dashes():
    facts = facts_with()
    del facts["show"]["after"]
    table = show.make_table(made.evidence(facts))
    assert table.head[1:4] == ["Before", "After", "Noise floor or recording"]
    assert {row[2] for row in table.rows} == {"–"}
