"""The search of a diagnosis: fit, select terms, learn curves, and locate the missing force."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from lostmotion.case import CaseFile
from lostmotion.contracts import Array, Machine, SensorTerm, Values
from lostmotion.diagnosis.compare import cut_heldout
from lostmotion.diagnosis.moving import check_motion, cut_rest
from lostmotion.diagnosis.outliers import leave_out_outliers
from lostmotion.diagnosis.periodic_drive import leave_out_gauge_noise
from lostmotion.diagnosis.scales import find_wrong_scales
from lostmotion.errors import DataError
from lostmotion.evidence.bare import Budget
from lostmotion.evidence.corrections import Corrections, find_corrections
from lostmotion.evidence.course import Course
from lostmotion.evidence.explanations import Explanations
from lostmotion.evidence.hypothesis import UNKNOWN
from lostmotion.inference.fit import Fit
from lostmotion.inference.learned import LearnedTerm
from lostmotion.inference.locate import (
    Curve,
    average_curve,
    choose_edges,
    describe_location,
    list_covariates,
    list_further_covariates,
)
from lostmotion.inference.odds import LikelihoodRatio, compute_log_ratios, list_likely
from lostmotion.inference.random_force import compute_random_force_gain
from lostmotion.inference.setup import choose_steps, make_posterior, polish_fit, search_maximum, split_heldout
from lostmotion.inference.shares import Covariate, Share, compute_shares, list_significant
from lostmotion.inference.unexplained import CurveSearch, UnknownForce
from lostmotion.kernels.threads import each
from lostmotion.likelihood.latent import LatentForce, smooth_latent_force
from lostmotion.likelihood.observation import Observation
from lostmotion.likelihood.posterior import Posterior
from lostmotion.likelihood.system import System
from lostmotion.results.expectation import WrongScale
from lostmotion.settings import DEFAULT, LocateSettings, Settings

STEPS, PER = 6e8, 5e4
"""The work of a search in steps of filters, 30 s on a usual machine, and the readings times states that double it."""
LARGEST = 1e100
"""A missing force beyond this means that the filter diverged; its square would overflow."""


def list_fitted_keys(system: System) -> tuple[str, ...]:
    """Return the keys of the terms that are found by likelihood; others are visible in the stored values."""
    return tuple(k for k, t in zip(system.keys, system.terms, strict=True) if not t.marked)


@dataclass(frozen=True)
class ForceLocation:
    """A missing force over time and over each covariate, and the share that each covariate explains.

    `odds` are the log likelihood ratios of a curve over each covariate, which decide on significance; without them the
    shares decide.
    """

    missing: LatentForce
    curves: dict[str, Curve]
    explained: dict[str, Share]
    summary: str
    odds: Mapping[str, LikelihoodRatio] = field(default_factory=dict)
    limits: LocateSettings = DEFAULT.locate

    @property
    def shares(self) -> dict[str, float]:
        """The share of the variance of the force that each covariate explains."""
        return {name: share.value for name, share in self.explained.items()}

    @property
    def significant(self) -> list[str]:
        """The significant covariates, most likely first."""
        level = self.limits.level
        return list_likely(self.odds, level) if self.odds else list_significant(self.explained, level)

    @property
    def structure(self) -> list[str]:
        """The significant covariates that explain much of the force."""
        return [name for name in self.significant if self.explained[name].value > self.limits.structured]


@dataclass(frozen=True)
class SearchResult:
    """The result of a search: fits of the nominal and the augmented model, all explanations, and forces.

    `quantised` has the terms that are visible in the stored values, with their parameters and standard errors. `shown`
    is the recording (or the first held-out one) that curves and figures show; `law` (samples,) is the force of the
    found terms along it. `random_gain` is the log-likelihood that a random force beyond the usual adds. `learned` are
    the curves that were learned because the library did not suffice; `after` is the fit with them. `withdrawn` are the
    keys of terms that were found by likelihood and withdrawn because of held-out data. The given `recordings` are
    corrected for usual errors of their channels (`corrections`); all others are corrected recordings. `scales` are the
    columns whose scale does not fit the model.
    """

    before: Fit
    after: Fit
    explained: Explanations
    shown: Observation
    located: ForceLocation
    left: ForceLocation | None
    law: Array
    laws: dict[str, Array]
    law_curves: dict[str, Curve]
    random_gain: float
    train: tuple[Observation, ...]
    held: tuple[Observation, ...]
    recordings: tuple[Observation, ...]
    corrections: Corrections = field(default_factory=Corrections)
    quantised: Mapping[str, tuple[Values, Values]] = field(default_factory=dict)
    learned: UnknownForce | None = None
    withdrawn: tuple[str, ...] = ()
    scales: tuple[WrongScale, ...] = ()

    @property
    def settings(self) -> Settings:
        """The thresholds that were used."""
        return self.before.posterior.settings

    @property
    def found(self) -> tuple[str, ...]:
        """The keys of the missing terms that were found, most probable first; learned curves come last."""
        return tuple(sorted(self.after.posterior.active, key=lambda k: -self.explained.inclusion(k)))

    @property
    def named(self) -> tuple[str, ...]:
        """The keys of the missing terms of the library that were found."""
        return tuple(key for key in self.found if not self.learned or key not in self.learned.keys)

    @property
    def yardstick(self) -> str:
        """The force with which other forces are compared: the drive, or for a free motion the inertial force."""
        return name_yardstick(self.shown)

    @property
    def corrected(self) -> tuple[Observation, ...]:
        """The recordings, corrected for usual errors of their channels."""
        return tuple(map(self.corrections.correct, self.recordings))

    @property
    def unexplained(self) -> bool:
        """Whether a random force beyond the usual noise of the drive remains."""
        return self.random_gain > self.settings.locate.significant

    @property
    def unknown(self) -> bool:
        """Whether a force with structure is missing that no term of the library explains."""
        return bool(self.learned) or (not self.found and self.unexplained and bool(self.located.structure))


def name_yardstick(observation: Observation) -> str:
    """Return the force with which other forces are compared: the drive, or for a free motion the inertial force."""
    return "the inertial force" if observation.free else "the drive"


def diagnose(
    case: CaseFile,
    observations: Sequence[Observation],
    system: System,
    *,
    rng: np.random.Generator,
    jobs: int = 2,
    say: Callable[[str], None] = lambda _: None,
    settings: Settings = DEFAULT,
) -> SearchResult:
    """Return the diagnosis of a case; `system` has the model and all candidate terms.

    The search for explanations ends after `select.budget` seconds of processor time; 0 stands for `choose_budget`.
    """
    check_motion(observations, system.model.motion)
    observations = cut_rest(observations, settings.heldout)
    train, held = split_heldout(observations, settings.heldout)
    _check_moving(held)
    say("fit of the nominal model")
    nominal = search_maximum(make_posterior(system, case, train, jobs=jobs, settings=settings), rng)
    nominal, observations = leave_out_gauge_noise(nominal, observations)
    nominal, observations = leave_out_outliers(nominal, observations)
    train, held = split_heldout(observations, settings.heldout)
    scales = find_wrong_scales(nominal, case, rng.spawn(1)[0])
    pieces = [(piece.observation, piece.begin) for piece in cut_heldout(observations, held)]
    course = Course(list_fitted_keys(system), pieces, choose_budget(nominal.posterior), say)
    explained = course.find_explanations(nominal)
    first = SearchResult(
        nominal, nominal, explained, held[0], _NOT_LOCATED, None, _EMPTY, {}, {}, 0.0, train, held, tuple(observations)
    )
    return explain_by(explained, replace(first, scales=scales), rng.spawn(1)[0], say)


def choose_budget(posterior: Posterior) -> Budget:
    """Return the budget of a search: `select.budget`, or work in proportion to the readings and the states."""
    if posterior.settings.select.budget:
        return Budget(seconds=posterior.settings.select.budget)
    readings = posterior.samples * len(posterior.observations[0].sensors)
    return Budget(steps=STEPS * (1.0 + readings * posterior.dynamics.states / PER))


def explain_by(
    explained: Explanations, d: SearchResult, rng: np.random.Generator, say: Callable[[str], None] = lambda _: None
) -> SearchResult:
    """Return a diagnosis by the most probable explanation: final estimates, learned curves, and the missing force."""
    say("final estimates")
    corrections = find_corrections(explained.best)
    recordings = tuple(map(corrections.correct, d.recordings))
    train, held = split_heldout(recordings, d.settings.heldout)
    before = polish_fit(corrections.refit(explained.nominal))
    shown = held[0]
    if len(recordings) == 1:
        shown = replace(recordings[0], begun=before.posterior.observations[0].begun)
    chosen = corrections.refit(explained.chosen)
    after, learned = polish_fit(chosen) if explained.terms else before, None
    if UNKNOWN in explained.best.terms or _leaves_force(explained, before):
        curves = CurveSearch(len(list_fitted_keys(after.posterior.system)), say)
        learned = curves.unknown(corrections.refit(explained.nominal), chosen)
    if learned is not None:
        after = polish_fit(learned.fit)
        learned = replace(learned, fit=after)
    say("missing force")
    kept = frozenset(key for key in d.found if not d.learned or key not in d.learned.keys)
    changed = replace(
        d,
        before=before,
        after=after,
        explained=explained,
        shown=shown,
        train=train,
        held=held,
        corrections=corrections,
        random_gain=compute_random_force_gain(after),
        quantised=find_quantised(after, split_heldout(d.recordings, d.settings.heldout)[0]),
        learned=learned,
        withdrawn=tuple(dict.fromkeys((*d.withdrawn, *sorted(kept - explained.terms)))),
        left=None,
        law=_EMPTY,
        laws={},
        law_curves={},
    )
    return _locate_forces(changed, rng)


def _leaves_force(explained: Explanations, before: Fit) -> bool:
    """Return whether nothing was found, and the nominal model leaves a force that curves may describe.

    A smooth force of the usual size can explain as much as an unknown one: then no set is better than no term.
    """
    if explained.terms or frozenset({UNKNOWN}) in explained.refuted:
        return False
    return compute_random_force_gain(before) > before.posterior.settings.locate.significant


def _check_moving(held: Sequence[Observation]) -> None:
    """Refuse held-out data with a constant sensor: errors are divided by the standard deviation of its readings."""
    for i, sensor in enumerate(held[0].sensors):
        if not np.nanstd(np.concatenate([o.readings[:, i] for o in held])) > 0.0:
            names = ", ".join(o.name for o in held)
            raise DataError(
                f"{names}: the sensor {sensor.label!r} is constant in the held-out part, so predictions cannot be"
                " compared; end the recording with t_end where the motion ends, or put a recording with motion last"
            )


def find_quantised(fit: Fit, observations: Sequence[Observation]) -> dict[str, tuple[Values, Values]]:
    """Return the sensor terms that are visible in the stored values and are a share of the noise, by key.

    `observations` are the recordings of the fit as they were stored: corrected values are no multiples of a step.
    """
    found: dict[str, tuple[Values, Values]] = {}
    for key, term in fit.posterior.system.channel_terms.items():
        if not isinstance(term, SensorTerm) or not term.marked:
            continue
        for i, sensor in enumerate(observations[0].sensors):
            if sensor.place == term.at and not sensor.quantised:
                noise = max(fit.posterior.recordings[k].measurement(fit.theta, i) for k in range(len(observations)))
                seen = [term.quantisation(observation.readings[:, i]) for observation in observations]
                least = fit.posterior.settings.locate.quantisation * noise
                if all(p for p, _ in seen) and term.scatter(seen[0][0]) ** 2 > least:
                    found[key] = seen[0]
    return found


_EMPTY = np.zeros(0)
_NOT_LOCATED = ForceLocation(LatentForce(_EMPTY, _EMPTY, np.zeros((0, 2)), 0.0, 0.0), {}, {}, "")


def _locate_forces(bare: SearchResult, rng: np.random.Generator) -> SearchResult:
    """Return the diagnosis with the missing force located, without the found terms and with them."""
    after, shown = bare.after, bare.shown
    refined = choose_steps(after.posterior, after.theta).on((shown,))
    model, plays, limits = after.posterior.system.model, list_half_gaps(refined, after.theta), bare.settings.locate
    of_left, of_all = rng, rng.spawn(1)[0]

    def locate_one(posterior: Posterior, theta: Array, chance: np.random.Generator, fit: Fit) -> ForceLocation:
        missing = smooth_latent_force(posterior, theta)
        return locate(
            model, shown, missing, plays=plays, rng=chance, odds=lambda: compute_log_ratios(fit), limits=limits
        )

    if not bare.found:
        return replace(bare, located=locate_one(refined, after.theta, of_left, after))
    single = replace(refined, jobs=1)
    asked = [(single, after.theta, of_left, after), (*remove_terms(single, after.theta), of_all, bare.before)]
    left, located = each(lambda one: locate_one(*one), asked, refined.jobs)
    laws = {key: compute_force(after, shown, left.missing.states, key) for key in bare.found}
    law = np.sum(list(laws.values()), axis=0)
    table = list_covariates(model, shown, left.missing)
    curves = {k: average_curve(v, law, choose_edges(table[k])) for k, v in table.items()}
    return replace(bare, located=located, left=left, law=law, laws=laws, law_curves=curves)


def remove_terms(posterior: Posterior, theta: Array) -> tuple[Posterior, Array]:
    """Return a posterior without its terms and otherwise unchanged, and its coordinates."""
    kept = [i for i, f in enumerate(posterior.space.free) if "." not in f.parameter]
    return posterior.over(posterior.space.free[i] for i in kept).acting(()), theta[kept]


def list_half_gaps(posterior: Posterior, theta: Array) -> dict[str, float]:
    """Return the half gap (m or rad) at each place of the model that has one."""
    full, system = posterior.recordings[0].full(theta), posterior.system
    return {i.name: float(full[system.index[i.play]]) for i in system.model.places if i.play}


def locate(
    model: Machine,
    observation: Observation,
    missing: LatentForce,
    *,
    plays: Mapping[str, float] | None = None,
    rng: np.random.Generator | None = None,
    odds: Callable[[], Mapping[str, LikelihoodRatio]] = dict,
    limits: LocateSettings = DEFAULT.locate,
) -> ForceLocation:
    """Return the location of a missing force; `plays` are the half gaps by place, `rng` draws surrogates.

    `odds` returns log likelihood ratios by covariate, as `compute_log_ratios` does.
    """
    if not np.all(np.abs(missing.force) < LARGEST):
        raise DataError(
            f"{observation.name}: the model cannot follow this recording: check the units and columns of inputs and"
            " sensors, the known values and the priors"
        )
    table = list_covariates(model, observation, missing)
    asked = {name: Covariate((values,)) for name, values in table.items()} | list_further_covariates(
        model, observation, missing, plays
    )
    found = compute_shares(asked, missing.force, rng)
    curves = {name: average_curve(values, missing.force) for name, values in table.items()}
    ratios = {name: value for name, value in odds().items() if name in found}
    return ForceLocation(
        missing, curves, found, describe_location(table, missing.force, found, ratios, limits), ratios, limits
    )


def compute_force(fit: Fit, observation: Observation, states: Array, key: str) -> Array:
    """Return the force (samples,) of one term of a fit along the smoothed `states` of a recording."""
    posterior = fit.posterior.on((observation,))
    system, recording = posterior.system, posterior.recordings[0]
    full = recording.full(fit.theta)
    drive = recording.drive(full)
    packed = posterior.dynamics.pack(full[None], drive)
    times: Array = np.asarray(drive.begin + np.arange(len(states)) * drive.dt, dtype=float)
    seen, inputs = states[:, : posterior.dynamics.states], drive.inputs[: len(states)]
    if key not in system.channel_terms:
        return system.compute_force(key, posterior.active, packed, (seen, inputs, times))
    other = posterior.acting(posterior.active - {key}).recordings[0].drive(full).inputs[: len(states)]
    both = (system.compute_derivatives(posterior.active, packed, seen, u, times)[0] for u in (inputs, other))
    with_term, without = (system.accelerate(rates, system.model.first_place) for rates in both)
    return np.asarray((with_term - without) * system.own_inertia(full, system.model.first_place))


def list_physical_keys(fit: Fit) -> list[str]:
    """Return the keys of the physical parameters of a fit, without noise levels and coefficients of curves."""
    system = fit.posterior.system
    curves = tuple(f"{k}." for k, t in zip(system.keys, system.terms, strict=True) if isinstance(t, LearnedTerm))
    physical = [f.key for f in fit.posterior.space.free if f.physical]
    return [k for k in physical if not (curves and k.startswith(curves))]
