"""The filter over recordings at coordinates of a posterior: equal points once, points with one view together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lostmotion.contracts import Array
from lostmotion.kernels.threads import each
from lostmotion.likelihood.bends import SensorCorrections, correct_twice, filter_corrected, list_corrections
from lostmotion.likelihood.innovations import Innovations, Smoothed, join_innovations
from lostmotion.likelihood.observation import Observation, shift_sensors
from lostmotion.likelihood.posed import PosedRecording


@dataclass(frozen=True)
class RecordingFilter:
    """The filter over one recording, whose readings are corrected and moved where sensors bend, change or are late."""

    recording: PosedRecording

    def view(self, late: tuple[int, ...] = ()) -> Observation:
        """Return the recording as it is filtered: with the noises of its sensors, moved by whole samples.

        `late` says by how many samples each sensor is late. Where sensors may be late, the same first readings are left
        out for any `late`, so that likelihoods can be compared.
        """
        late = late or (0,) * len(self.recording.sensors)
        if late not in self._views:
            view, most = self.recording.observation.read_again(sensors=self.recording.sensors), self.recording.latest
            self._views[late] = shift_sensors(view, late, most) if most else view
        return self._views[late]

    @cached_property
    def _views(self) -> dict[tuple[int, ...], Observation]:
        """The views that were filtered, so that their cached properties are computed once."""
        return {}

    def filter(self, thetas: Array) -> Innovations:
        """Return one-step errors and variances (points, samples, sensors) at coordinates (points, n) with one view."""
        recording, system = self.recording, self.recording.system
        late = recording.count_delays(thetas[:1])[0]
        changing = recording.dynamics.active & {*system.bending_terms, *system.rescaling}
        corrections = [self._list_corrections(theta) for theta in thetas] if changing else []
        awake = self._drop_idle_lags(thetas[0])
        found = filter_corrected(awake.dynamics.filter, self.view(late), corrections, awake.points(thetas))
        return found.realign(late) if any(late) else found

    def smooth(self, theta: Array) -> Smoothed:
        """Return the filtered and the smoothed states at the coordinates `theta`."""
        recording = self.recording
        view, points = self.view(recording.count_delays(theta[None])[0]), recording.points(theta[None])
        readings, _ = correct_twice(recording.dynamics.filter, view, [self._list_corrections(theta)], points)
        return recording.dynamics.smooth(view, replace(points, readings=readings))

    def _list_corrections(self, theta: Array) -> SensorCorrections:
        """Return the corrections of the readings at some coordinates."""
        recording = self.recording
        return list_corrections(
            recording.system, recording.dynamics.active, recording.full(theta), recording.observation.sensors
        )

    def _drop_idle_lags(self, theta: Array) -> PosedRecording:
        """Return the recording without lags of sensors that are shorter than a step at some coordinates.

        The integration cannot follow them: they would have the effect of a lag of one step.
        """
        recording, dynamics = self.recording, self.recording.dynamics
        lagging = dynamics.active & set(recording.system.lagging_terms)
        step = recording.observation.dt / dynamics.nsub
        idle = {key for key in lagging if recording.system.is_idle(recording.full(theta), key, step)}
        return replace(recording, dynamics=replace(dynamics, active=dynamics.active - idle)) if idle else recording

    def _list_views(self, thetas: Array) -> list[tuple[Any, ...]]:
        """Return for each of some coordinates (points, n) what changes the view of readings: delay, idle lags."""
        late: list[tuple[Any, ...]] = list(self.recording.count_delays(thetas))
        if not self.recording.dynamics.active & set(self.recording.system.lagging_terms):
            return late
        awake = [self._drop_idle_lags(theta).dynamics.active for theta in thetas]
        return list(zip(late, awake, strict=True))

    def split(self, thetas: Array, jobs: int) -> SplitPoints:
        """Return coordinates (points, n) in parts for `jobs` cores: each of equal ones once, each part of one view."""
        rows, equal = _find_distinct(thetas[:, self.recording.coordinates.used])
        groups: dict[tuple[Any, ...], list[int]] = {}
        for row, view in zip(rows.tolist(), self._list_views(thetas[rows]), strict=True):
            groups.setdefault(view, []).append(row)
        share = self.recording.dynamics.count_together(len(rows), jobs)
        parts = [np.array(some[k : k + share]) for some in groups.values() for k in range(0, len(some), share)]
        place = np.empty(len(thetas), dtype=np.intp)
        place[np.concatenate(parts)] = np.arange(len(rows))
        return SplitPoints(parts, place[equal])


@dataclass(frozen=True)
class SplitPoints:
    """Points in `parts` that are filtered at once; `place` (points,) is where each is in the results of all parts."""

    parts: list[NDArray[np.intp]]
    place: NDArray[np.intp]

    def collect(self, done: Sequence[Innovations]) -> Innovations:
        """Return the innovations of all points from those of the parts."""
        whole = done[0] if len(done) == 1 else join_innovations(done)
        in_order = np.array_equal(self.place, np.arange(len(whole)))
        return whole if in_order else whole[self.place]


def _find_distinct(used: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first of each set of equal rows of `used` (points, n), and the first that each row equals."""
    _, rows, inverse = np.unique(used, axis=0, return_index=True, return_inverse=True)
    return np.sort(rows), rows[inverse.reshape(-1)]


def filter_recordings(filters: Sequence[RecordingFilter], thetas: Array, jobs: int) -> list[Innovations]:
    """Return the innovations of each recording at coordinates (points, n), from all cores together."""
    splits = [one.split(thetas, jobs) for one in filters]
    tasks = [(one, part) for one, split in zip(filters, splits, strict=True) for part in split.parts]
    done = iter(each(lambda task: task[0].filter(thetas[task[1]]), tasks, jobs))
    return [split.collect([next(done) for _ in split.parts]) for split in splits]
