"""Table 1 and Figs. 3, 4, 5, 8 and 9: the three cases, their phase plots and Poincare maps."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from lostmotion.contracts import Array
from lostmotion_chaos.paper.cases import CASES, PRINTED, PaperCase
from lostmotion_chaos.paper.drawings import ForceDrawing, PhaseDrawing, SectionsDrawing, UnfoldedDrawing
from lostmotion_chaos.paper.lab import FollowedMotions, Lab, SampledFlow
from lostmotion_chaos.paper.outcome import PaperOutcome, PaperTable, Verdict, judge_claims

LOOKS = 600
"""Samples per drive period of the phase plots."""
DELAY = 0.102
"""The delay (s) of Fig. 4, which the paper takes from the mutual information."""
PLACES = (2.0, 2.6, 4.1, 7.6)
"""1/alpha in Figs. 8 and 9."""
SECTION_DELAY = 0.01
"""The delay (s) of Fig. 9."""


def follow_motions(lab: Lab, case: PaperCase) -> FollowedMotions:
    """Return the motions of a case from many starts."""
    flow = case.make_flow(lab)
    return lab.follow(
        flow, lab.draw_starts(flow, lab.pick(64, 8)), periods=lab.pick(2000, 400), transient=lab.pick(1000, 300)
    )


def follow_case(lab: Lab, number: int) -> FollowedMotions:
    """Return the motions of one of the three cases; computed once for all figures."""
    return lab.compute_once(f"case {number}", lambda: follow_motions(lab, CASES[number]))


def choose_motion(found: FollowedMotions) -> int:
    """Return the index of the motion to draw: the first chaotic one, or 0 if none is chaotic."""
    return int(np.argmax(found.chaotic))


def sample_portrait(lab: Lab, case: PaperCase, found: FollowedMotions, periods: int) -> Array:
    """Return states (periods * LOOKS + 1, 2) of the motion to draw, after its transient."""
    return case.make_flow(lab).sample(found.states[choose_motion(found), -1], periods=periods, looks=LOOKS)


def describe_motions(found: FollowedMotions, bit: float, unit: str) -> str:
    """Return the number of starts that end in chaos and the range of their exponents as text."""
    many, chaotic = len(found.exponents), found.chaotic
    values = bit * found.exponents[chaotic]
    if not chaotic.any():
        return f"periodic from all {many} starts (periods {format_periods(found)})"
    spread = f"{values.min():.3g} to {values.max():.3g} {unit}" if len(values) > 1 else f"{values[0]:.3g} {unit}"
    return f"chaotic from {int(chaotic.sum())} of {many} starts ({spread})"


def format_periods(found: FollowedMotions) -> str:
    """Return the periods that occur as text, e.g. "1, 3"."""
    return ", ".join(str(p) if p else "none" for p in np.unique(found.periods))


def fig3(lab: Lab) -> PaperOutcome:
    """Return phase plots of Cases 1 and 2."""
    first, second = follow_case(lab, 1), follow_case(lab, 2)
    states = [sample_portrait(lab, CASES[k], f, lab.pick(150, 60)) for k, f in ((1, first), (2, second))]
    holds = bool(first.chaotic.all()), bool(second.chaotic.any())
    bit = 1.0 / math.log(2.0)
    says = (
        f"Case 1 is {describe_motions(first, bit, 'bit/s')}; Case 2 at 240 N, which the paper calls chaotic, is "
        f"{describe_motions(second, bit, 'bit/s')}."
    )
    numbers = {
        "case1_chaotic_share": float(first.chaotic.mean()),
        "case1_bit_per_s": float(first.bits.mean()),
        "case2_chaotic_share": float(second.chaotic.mean()),
    }
    titles = (f"Case 1, A = 100 N: {describe_motion(first)}", f"Case 2, A = 240 N: {describe_motion(second)}")
    return PaperOutcome(judge_claims(*holds), says, numbers, PhaseDrawing(states, titles))


def describe_motion(found: FollowedMotions) -> str:
    """Return the kind of the motion to draw as text: "chaotic" or its period."""
    one = choose_motion(found)
    return "chaotic" if found.chaotic[one] else f"period {found.periods[one]}"


def fig4(lab: Lab) -> PaperOutcome:
    """Return the phase plot of Case 3 in state coordinates and in delay coordinates."""
    found, case = follow_case(lab, 3), CASES[3]
    states = sample_portrait(lab, case, found, lab.pick(150, 60))
    lag = round(DELAY / (2.0 * math.pi / case.omega) * LOOKS)
    calm = ~found.chaotic
    printed = follow_motions(lab, replace(case, omega=PRINTED))
    says = f"Case 3 is {describe_motions(found, 1.0 / math.log(2.0), 'bit/s')}, as in the paper"
    if calm.any():
        says += f"; a periodic attractor coexists with the chaotic one ({found.bits[calm].mean():.2f} bit/s)"
    says += (
        f". Its frequency is 1.57 Hz to the digits given; at 1.57 Hz exactly, 1e-5 higher, the motion is "
        f"{describe_motions(printed, 1.0 / math.log(2.0), 'bit/s')}: the case lies at the edge of a window."
    )
    numbers = {"chaotic_share": float(found.chaotic.mean()), "bit_per_s": float(found.bits[found.chaotic].mean())}
    numbers["periodic_bit_per_s"] = float(found.bits[calm].mean()) if calm.any() else math.nan
    numbers["printed_bit_per_s"] = float(printed.bits[printed.chaotic].mean()) if printed.chaotic.any() else math.nan
    return PaperOutcome(judge_claims(bool(found.chaotic.any())), says, numbers, UnfoldedDrawing(states, lag))


def fig5(lab: Lab) -> PaperOutcome:
    """Return the normalised force of the backlash, computed from the acceleration of the model at rest."""
    model = lab.make("model", "lin_backlash")
    p = np.linspace(-3.0, 3.0, 121)
    force, out = np.empty(len(p)), np.zeros(2)
    for k, place in enumerate(p):
        model.rhs(0.0, np.array([place, 0.0]), np.zeros(len(model.inputs)), np.array([1.0, 0.0, 0.0, 1.0, 1.0]), out)
        force[k] = -out[1]
    expected = np.sign(p) * np.maximum(np.abs(p) - 1.0, 0.0)
    off = float(np.abs(force - expected).max())
    digits = "" if off == 0.0 else f" to {off:.1g}"
    says = f"The force of the model, computed from its acceleration at rest, equals that of eq. (3){digits}."
    return PaperOutcome(judge_claims(off < 1e-12), says, {"largest_difference": off}, ForceDrawing(p, force))


def follow_four_cases(lab: Lab) -> dict[float, FollowedMotions]:
    """Return the motions of Case 1 at the four values of 1/alpha of Figs. 8 and 9."""
    return lab.compute_once(
        "four places", lambda: {x: follow_motions(lab, CASES[1].vary(alpha=1.0 / x)) for x in PLACES}
    )


def fig8(lab: Lab) -> PaperOutcome:
    """Return phase plots at the four values of 1/alpha."""
    found = follow_four_cases(lab)
    cases = {x: CASES[1].vary(alpha=1.0 / x) for x in PLACES}
    states = [sample_portrait(lab, cases[x], found[x], lab.pick(150, 60)) for x in PLACES]
    titles = [f"1/alpha = {x:g}: {describe_motion(found[x])}" for x in PLACES]
    verdict, says = _describe_four_cases(found)
    numbers = {f"chaotic_share_{x:g}": float(found[x].chaotic.mean()) for x in PLACES}
    numbers |= {f"bit_per_time_{x:g}": float(CASES[1].bit * found[x].exponents.mean()) for x in PLACES}
    numbers |= {f"highest_bit_per_time_{x:g}": float(CASES[1].bit * found[x].exponents.max()) for x in PLACES}
    return PaperOutcome(verdict, says, numbers, PhaseDrawing(states, titles))


def _describe_four_cases(found: dict[float, FollowedMotions]) -> tuple[Verdict, str]:
    """Return the verdict and the sentence for the motions at the four values of 1/alpha."""
    bit = CASES[1].bit
    words = [f"{x:g}: {describe_motions(found[x], bit, 'bit/time')}" for x in PLACES]
    verdict = judge_claims(
        bool(found[2.0].chaotic.all()), not found[2.6].chaotic.any(),
        bool(found[4.1].chaotic.any()), bool(found[7.6].chaotic.mean() > 0.5 and found[4.1].chaotic.any()),
    )  # fmt: skip
    says = (
        f"At 1/alpha = {'; '.join(words)}. The paper has chaos at 2.0 (0.06 bit/time), none at 2.6, and chaos with "
        "equal exponents at 4.1 and 7.6. The claim for 4.1 and 7.6 does not hold: 4.1 lies before the window of chaos, "
        "and 7.6 in a gap between two windows, with long transients."
    )
    return verdict, says


def fig9(lab: Lab) -> PaperOutcome:
    """Return Poincare maps at the four values of 1/alpha: x at phase 0 of the drive against x after the delay."""
    found = follow_four_cases(lab)
    points = [_sample_section(lab, CASES[1].vary(alpha=1.0 / x), found[x]) for x in PLACES]
    counts = {x: len(np.unique(np.round(xy / 1e-7), axis=0)) for x, xy in zip(PLACES, points, strict=True)}
    verdict, _ = _describe_four_cases(found)
    says = (
        f"The map is fractal at 2.0 and {_format_points(counts[2.6])} at 2.6, as in the paper; at 4.1, where the paper "
        f"shows a fractal, it is {_format_points(counts[4.1])}; at 7.6 the points that look like a fractal are a "
        f"transient of a hundred periods and more, and the motion shown ends on {_format_points(counts[7.6])}."
    )
    titles = [f"1/alpha = {x:g}: {describe_motion(found[x])}" for x in PLACES]
    numbers = {f"points_{x:g}": float(counts[x]) for x in PLACES}
    data = SectionsDrawing(points, titles, _sample_transient(lab, CASES[1].vary(alpha=1.0 / PLACES[-1])))
    return PaperOutcome(verdict, says, numbers, data)


def _format_points(count: int) -> str:
    """Return a number of points as text."""
    return "one point" if count == 1 else f"{count} points"


def _sample_section(lab: Lab, case: PaperCase, found: FollowedMotions) -> Array:
    """Return x and x after the delay (periods, 2) in m of the motion to draw, once per drive period."""
    return _sample_delayed(case.make_flow(lab), found.states[choose_motion(found), -1], lab.pick(6000, 1500))


def _sample_delayed(flow: SampledFlow, start: Array, periods: int) -> Array:
    """Return x and x after the delay (periods, 2) in m of the motion from `start`, once per drive period."""
    looks = 400
    lag = round(SECTION_DELAY / flow.period * looks)
    x = flow.sample(start, periods=periods, looks=looks)[:, 0]
    return np.column_stack([x[:-lag:looks], x[lag::looks]])


def _sample_transient(lab: Lab, case: PaperCase) -> Array:
    """Return the Poincare map (points, 2) in m of the transients from several starts."""
    flow = case.make_flow(lab)
    starts = lab.draw_starts(flow, lab.pick(24, 8))[1:]
    return np.concatenate([_sample_delayed(flow, start, 150)[20:] for start in starts])


def table1(lab: Lab) -> PaperOutcome:
    """Return the parameters of the three cases, the derived numbers, and the motion of each case."""
    heads = ("case", "m (kg)", "k1 (N/m)", "k0 (N/m)", "c (N s/m)", "x0 (m)", "A (N)", "2 zeta", "alpha",
             "omega/omega_0", "share of starts in chaos", "exponent (bit/s)")  # fmt: skip
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    for k, case in CASES.items():
        found = follow_case(lab, k)
        bits = float(found.bits[found.chaotic].mean()) if found.chaotic.any() else float(found.bits.max())
        given = (case.m, case.k1, case.k0, case.c, case.x0, case.amplitude)
        derived = (round(case.damping, 4), round(case.alpha, 4), round(case.ratio, 4))
        rows.append((f"{k}", *given, *derived, round(float(found.chaotic.mean()), 3), round(bits, 3)))
        numbers |= {f"case{k}_alpha": case.alpha, f"case{k}_damping": case.damping, f"case{k}_ratio": case.ratio}
        numbers |= {f"case{k}_chaotic_share": float(found.chaotic.mean()), f"case{k}_bit_per_s": bits}
    good = [k for k in CASES if follow_case(lab, k).chaotic.any()]
    says = (
        f"The parameters are those of the paper. Of the three cases that it calls chaotic, "
        f"{' and '.join(f'Case {k}' for k in good)} {'is' if len(good) == 1 else 'are'} chaotic"
        + ("." if len(good) == 3 else "; Case 2 settles on periodic orbits from every start (it is chaotic at 230 N).")
    )
    return PaperOutcome(judge_claims(*(k in good for k in CASES)), says, numbers, table=PaperTable(heads, tuple(rows)))
