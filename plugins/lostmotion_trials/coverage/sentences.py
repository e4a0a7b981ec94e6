"""What a calibration says in sentences."""

from __future__ import annotations

from collections.abc import Sequence

from lostmotion_trials.coverage.results import CalibrationSummary, ParameterCheck

FEW = 100
"""With fewer machines only gross faults show."""
BIASED = 3.0
"""Standard errors by which the mean of z must be off before a posterior is called biased."""


def says_of(told: CalibrationSummary, wrong: Sequence[str]) -> tuple[str, ...]:
    """Return the sentences that a report opens with; `wrong` are the parameters that do not hold what they promise."""
    return (
        *_opening(told, wrong),
        *(_fault(told.parameters[name], name) for name in wrong),
        *_limits(told),
    )


def _opening(told: CalibrationSummary, wrong: Sequence[str]) -> list[str]:
    count = told.machines - len(told.unconverged) - len(told.failed)
    if not count:
        return ["Not one machine has a posterior."]
    if told.passes and count < FEW:
        return [f"Nothing speaks against the intervals, over {count} machines."]
    if told.passes:
        return [f"The intervals hold what they promise, over {count} machines: ranks are uniform, and intervals cover."]
    if not wrong:
        return ["Ranks are uniform and intervals cover, but too many machines are left without a posterior."]
    return [f"The intervals do not hold what they promise: {', '.join(wrong)}, over {count} machines."]


def _fault(row: ParameterCheck, name: str) -> str:
    """Return what is wrong with a parameter."""
    count = sum(row.histogram)
    if abs(row.mean_z) > BIASED / count**0.5:
        way = f"biased: the truth lies {abs(row.mean_z):.2f} deviations {'above' if row.mean_z > 0 else 'below'}"
    else:
        way = f"too {'narrow' if row.rms_z > 1.0 else 'wide'}: the truth lies {row.rms_z:.2f} deviations off (rms)"
    share, one = list(row.coverage.items())[-1]
    return (
        f"{name} is {way}; the {share} % interval holds {one.inside} of {one.of} truths, {one.low} to"
        f" {one.high} wanted; the ranks have p = {row.ecdf_p:.2g}."
    )


def _limits(told: CalibrationSummary) -> list[str]:
    """Return what keeps the calibration from saying more."""
    lost = {word: len(machines) for word, machines in told.lost.items() if machines}
    said = []
    if lost:
        listed = " and ".join(f"{count} {word}" for word, count in lost.items())
        said.append(f"Of {told.machines} machines {listed}: they are listed, and no rank holds them.")
    if told.machines < FEW:
        said.append(f"With {told.machines} machines only gross faults can show: take 200.")
    return said
