"""What a diagnosis said, made by hand: `answer(found=[entry("coulomb_friction")])` has all else that it must have."""

from report_fixture import mismatch, row, score

from lostmotion.codec import from_plain
from lostmotion.results.diagnosis import Diagnosis

SAYS = "It says so."


def entry(mechanism, at="", probability=0.9, **more):
    """Return an entry of `found` as a file has it; it serves as one of the ranking and of the rivals, too."""
    told = {"mechanism": mechanism, "at": at, "probability": probability, "state": "named"}
    return {**told, "parameters": {}, "says": SAYS, **more}


def plain(*, errors=(0.3, 0.01), ranking=(), confused_with=(), **changes):
    """Return the content of a file of a diagnosis; `errors` are the held-out ones, before and after."""
    before, after = ({**score(0.0, error), "horizon": 0.5} for error in errors)
    told = {
        "found": [],
        "ranking": [{**row(one["mechanism"], 0.0, one["probability"]), "at": one["at"]} for one in ranking],
        "confused_with": [{"says": SAYS, **one} for one in confused_with],
        "unexplained": {"significant": False, "rms": 0.01, "unit": "N", "share_of_drive": 1e-4},
        "parameters": {"before": {}, "after": {}},
        "fit": {
            "before": before, "after": after, "noise_floor_nrmse": None,
            "horizon_unit": "drive periods", "horizon_unit_time": 0.1,
        },
        "says": [SAYS],
    }  # fmt: skip
    return {**mismatch(), **told, **changes}


def answer(**changes):
    """Return what a diagnosis said, with these changes."""
    return from_plain(Diagnosis, plain(**changes))


def interval(median, low=None, high=None, unit="1"):
    """Return an interval as a file has it."""
    return {"median": median, "low": low, "high": high, "unit": unit}
