"""What a diagnosis said, made by hand: `answer(found=[entry("coulomb_friction")])` has all else that it must have."""

from lostmotion.codec import from_plain
from lostmotion.workflow.answer import Answer


def entry(mechanism, at="", probability=0.9, **more):
    """Return an entry of `found` as a file has it; it serves as one of the ranking, too."""
    return {"mechanism": mechanism, "at": at, "probability": probability, "parameters": {}, **more}


def plain(*, errors=(0.3, 0.01), **changes):
    """Return the content of a file of a diagnosis; `errors` are the held-out ones, before and after."""
    before, after = ({"heldout_nrmse": error, "horizon": 0.5} for error in errors)
    told = {
        "verdict": "mismatch",
        "found": [],
        "ranking": [],
        "confused_with": [],
        "unexplained": {"share_of_drive": 1e-4},
        "parameters": {"before": {}, "after": {}},
        "fit": {
            "before": before, "after": after, "noise_floor_nrmse": None,
            "horizon_unit": "drive periods", "horizon_unit_time": 0.1,
        },
        "says": ["It says so."],
    }  # fmt: skip
    return {**told, **changes}


def answer(**changes):
    """Return what a diagnosis said, with these changes."""
    return from_plain(Answer, plain(**changes))


def interval(median, low=None, high=None, unit="1"):
    """Return an interval as a file has it."""
    return {"median": median, "low": low, "high": high, "unit": unit}
