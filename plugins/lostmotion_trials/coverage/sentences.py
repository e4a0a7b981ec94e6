"""The sentences of a calibration."""

from __future__ import annotations

from collections.abc import Sequence

from lostmotion_trials.coverage.results import CalibrationSummary, ParameterCheck

FEW_MACHINES = 100
"""With fewer machines only large errors can be detected. Chosen by experience; no measurement recorded."""
BIAS_ERRORS = 3.0
"""Standard errors by which the mean of z must be off before a posterior is called biased. Chosen by experience; no
measurement recorded."""


def write_sentences(told: CalibrationSummary, wrong: Sequence[str]) -> tuple[str, ...]:
    """Return the sentences at the top of a report; `wrong` are the parameters that are not calibrated."""
    return (
        *_describe_result(told, wrong),
        *(_describe_fault(told.parameters[name], name) for name in wrong),
        *_describe_limits(told),
    )


def _describe_result(told: CalibrationSummary, wrong: Sequence[str]) -> list[str]:
    count = told.machines - len(told.unconverged) - len(told.failed)
    if not count:
        return ["None of the machines has a posterior."]
    if told.passes and count < FEW_MACHINES:
        return [f"No fault of the intervals was found with {count} machines."]
    if told.passes:
        return [f"The intervals are calibrated, tested with {count} machines: ranks are uniform, and intervals cover."]
    if not wrong:
        return ["Ranks are uniform and intervals cover, but too many machines have no posterior."]
    return [f"The intervals are not calibrated for {', '.join(wrong)}, tested with {count} machines."]


def _describe_fault(row: ParameterCheck, name: str) -> str:
    """Return the sentence on the error of the intervals of a parameter."""
    count = sum(row.histogram)
    if abs(row.mean_z) > BIAS_ERRORS / count**0.5:
        way = f"biased: the truth lies {abs(row.mean_z):.2f} deviations {'above' if row.mean_z > 0 else 'below'}"
    else:
        way = f"too {'narrow' if row.rms_z > 1.0 else 'wide'}: the truth lies {row.rms_z:.2f} deviations off (rms)"
    share, one = list(row.coverage.items())[-1]
    return (
        f"The posterior of {name} is {way}; the {share} % interval covers {one.inside} of {one.of} truths, where"
        f" {one.low} to {one.high} are expected; the ranks have p = {row.ecdf_p:.2g}."
    )


def _describe_limits(told: CalibrationSummary) -> list[str]:
    """Return the sentences on the limits of the calibration."""
    lost = {word: len(machines) for word, machines in told.lost.items() if machines}
    said = []
    if lost:
        listed = " and ".join(f"{count} {word}" for word, count in lost.items())
        said.append(f"Of {told.machines} machines {listed}: they are listed, and the ranks do not include them.")
    if told.machines < FEW_MACHINES:
        said.append(f"With {told.machines} machines only large errors can be detected: use 200.")
    return said
