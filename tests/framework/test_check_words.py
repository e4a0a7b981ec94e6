"""What a check and the section "What is not missing" say: short lists, reasons together, units or names of numbers."""

from lostmotion.diagnosis.report.absent_table import format_amplitude, group_unlimited
from lostmotion.diagnosis.report.check_page import list_pair_sentences, shorten_pairs, summarise_check
from lostmotion.results.absent import AbsentTerm, UnlimitedTerm
from lostmotion.results.expectation import Expectation, Improvement, ParameterPair


def test_many_pairs_of_parameters_are_one_short_sentence():
    pairs = tuple(ParameterPair("m", f"k{i}", 0.99) for i in range(24))
    (said,) = list_pair_sentences(Expectation(parameters={}, pairs=pairs, effects=(), unseen=()))
    assert said.startswith("This recording hardly tells m from k0 (correlation 0.99); m from k1")
    assert said.endswith("; and 19 further pairs.")
    assert shorten_pairs(["a from b"]) == "a from b"


def test_terms_without_a_bound_are_told_by_reason():
    rows = [
        UnlimitedTerm(name, "ground", f"{name} has no bound: {why}.")
        for name, why in (("hidden_mode", "it is small"), ("linear_stiffness", "k"), ("sensor_lag", "it is small"))
    ]
    assert group_unlimited(rows, "bound") == [
        "No bound for hidden mode and sensor lag, because it is small.",
        "No bound for linear stiffness, because k.",
    ]


def test_a_number_without_unit_is_told_with_its_name():
    said = {"share_of_drive": None, "says": ""}
    dead = AbsentTerm(mechanism="drive_dead_zone", at="drive", parameter="share", upper=0.0027, unit="1", **said)
    slip = AbsentTerm(mechanism="coulomb_friction", at="ground", parameter="force", upper=0.0027, unit="N", **said)
    assert format_amplitude(dead, dead.upper) == "share 0.0027"
    assert format_amplitude(slip, slip.upper) == "2.7 mN"


def test_what_would_help_is_told_in_times():
    change = Improvement(
        change="Add a sensor of the velocity", waveform="repeat", level=1.0, unit="N", band=(1.0, 2.0), intervals=0.25,
        effects=1.5,
    )  # fmt: skip
    (said,) = summarise_check(Expectation(parameters={}, pairs=(), effects=(), unseen=()), [change])
    assert said == (
        "It would help to add a sensor of the velocity: intervals 4 times narrower, smallest sizes 1.5 times larger."
    )
