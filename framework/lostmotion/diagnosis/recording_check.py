"""The check of a case before the fit: what its recording can tell, and what would help."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from lostmotion.codec import to_plain
from lostmotion.diagnosis.expected_findings import describe_expectation, forecast_recordings
from lostmotion.diagnosis.gather_facts import find_angle_unit
from lostmotion.diagnosis.improvements import list_improvements
from lostmotion.diagnosis.moving import check_motion, cut_rest
from lostmotion.diagnosis.report.check_page import summarise_check, write_check
from lostmotion.diagnosis.scales import describe_wrong_scales, find_wrong_scales
from lostmotion.diagnosis.stages import list_fitted_keys, name_yardstick
from lostmotion.diagnosis.write_result import label_model
from lostmotion.errors import DataError
from lostmotion.inference.fit import Fit
from lostmotion.inference.random_force import compute_random_force_gain
from lostmotion.inference.setup import make_posterior, search_maximum, split_heldout
from lostmotion.inference.stretches import cut_stretches
from lostmotion.kernels.threads import hold_linear_algebra
from lostmotion.likelihood.stepped import make_system
from lostmotion.preparation.prepare import Prepared, prepare
from lostmotion.preparation.vetting import catch_divergence
from lostmotion.provenance import origin_of
from lostmotion.registry import Registry
from lostmotion.results.expectation import CaseCheck, Improvement
from lostmotion.settings import DEFAULT, Settings
from lostmotion.storage import folder_for, save_json

Say = Callable[[str], None]
CHECK = "check.json"
MOST = 20_000
"""From this many fitted samples on, stretches of the recordings are used."""


def run_check(
    path: Path,
    out: Path,
    registry: Registry,
    *,
    seed: int = 0,
    jobs: int = 2,
    say: Say = lambda _: None,
    settings: Settings = DEFAULT,
) -> CaseCheck:
    """Return the check of a case after writing `check.json` and `check.html` into the folder `out`."""
    say("reading the case")
    prepared = prepare(path, registry, settings)
    found = check_prepared(prepared, seed=seed, jobs=jobs, say=say, settings=settings)
    folder = folder_for(out)
    save_json(folder / CHECK, to_plain(found))
    write_check(folder)
    return found


@catch_divergence()
@hold_linear_algebra()
def check_prepared(
    prepared: Prepared, *, seed: int = 0, jobs: int = 2, say: Say = lambda _: None, settings: Settings = DEFAULT
) -> CaseCheck:
    """Return what the recordings of a case can tell; nothing is written.

    Raises `DataError` where the nominal model cannot follow the recordings.
    """
    rng, case = np.random.default_rng(seed), prepared.case
    system = make_system(prepared.model, prepared.terms)
    check_motion(prepared.observations, system.model.motion)
    recordings = cut_rest(prepared.observations, settings.heldout)
    train, _ = split_heldout(recordings, settings.heldout)
    say("fit of the nominal model")
    posterior = make_posterior(system, case, train, jobs=jobs, settings=settings)
    nominal = search_maximum(cut_stretches(posterior) if posterior.samples > MOST else posterior, rng)
    say("what the recording can tell")
    forecast = forecast_recordings(nominal, recordings, rng)
    scales = find_wrong_scales(nominal, case, rng.spawn(1)[0])
    if not forecast.valid:
        raise DataError(
            f"{recordings[0].name}: the nominal model cannot follow this recording: check the units and columns of"
            f" inputs and sensors, the known values and the priors. {' '.join(describe_wrong_scales(scales))}".rstrip()
        )
    angle, yardstick = find_angle_unit(case.recordings), name_yardstick(recordings[0])
    expected = describe_expectation(forecast, yardstick, angle)
    say("what would help")
    improvements = list_improvements(nominal, list_fitted_keys(system), case.experiment, rng)
    return CaseCheck(
        title=case.title,
        says=(*describe_wrong_scales(scales), *summarise_check(expected, improvements, angle)),
        model=label_model(nominal),
        yardstick=yardstick,
        angle=angle,
        expected=expected,
        improvements=improvements,
        scales=scales,
        notes=(*_write_notes(nominal, improvements, free=recordings[0].free), *prepared.notes),
        provenance=origin_of("check", {"model": case.model, "known": dict(case.known)}, seed, prepared.inputs),
    )


def _write_notes(nominal: Fit, improvements: tuple[Improvement, ...], *, free: bool) -> list[str]:
    """Return the limitations of a check."""
    notes = [
        "Intervals and sizes suppose that the nominal model is right, and that the drive has its usual noise of a"
        " thousandth. Sizes are those of one missing term, present from the beginning."
    ]
    if compute_random_force_gain(nominal) > nominal.posterior.settings.locate.significant:
        notes.insert(
            0,
            "The nominal model leaves a force that the usual noise of the drive does not explain: something is missing,"
            " or a known value is wrong. Run `diagnose`; sizes are valid beside what it finds.",
        )
    if not improvements and not free:
        notes.append(
            "No change of level, frequency or waveform that was tried, and no further sensor, would help much."
        )
    return notes
