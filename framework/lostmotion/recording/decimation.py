"""Decimation of a recording that was sampled far faster than its signals need.

The band of a signal ends where its spectrum falls to the noise floor. Samples are merged by a linear-phase FIR
low-pass filter (Kaiser window; Oppenheim and Schafer 2010, section 7.5), centred on the samples that are kept, so that
there is no delay.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lostmotion.recording.value_checks import fill_lost, runs_of
from lostmotion.settings import DEFAULT, RecordingSettings

if TYPE_CHECKING:
    import xarray as xr

    from lostmotion.recording.load import Recording

Array = NDArray[np.float64]
PER_PERIOD = 20
"""Samples in the shortest period above the noise that preserve the signal."""
ABOVE = 4.0
"""A part of the spectrum counts as signal from this multiple of the noise floor on."""
LOUD = 1e-10
"""A frequency with less than this share of the strongest power does not count: it may be rounding of the samples."""
SEGMENT, FEWEST = 8192, 8
"""The most samples in a segment of the spectrum, and the fewest segments that are averaged."""
FLOOR, WIDEST = 0.25, 0.5
"""The share of the spectrum, at its end, from which the noise floor is taken; the widest band of a signal."""
ATTENUATION = 70.0
"""Attenuation (dB) of frequencies that would alias, within 2 dB; the passband ripple is at most 0.06 %."""
PASS = 0.85
"""The passband ends at this share of the new Nyquist frequency; the stopband begins at 2 - PASS of it.

With 0.5 the remaining noise was correlated in time, and a diagnosis detected that."""
LEAST = 2000
"""The least number of samples that remain after decimation."""
TRUSTED = 0.9
"""The least share of the squared weight of the filter that must lie outside of long gaps."""


def thin_recording(recording: Recording, limits: RecordingSettings = DEFAULT.recording) -> Recording:
    """Return a recording decimated, with a note, if it was sampled far too fast; otherwise the recording itself.

    At least `PER_PERIOD` times `limits.oversampled` samples remain in the shortest period above the noise of any
    channel. A recording whose inputs are held between samples is never decimated.
    """
    channels = (*recording.inputs, *recording.sensors)
    if recording.hold == "step" or recording.n < 2 * LEAST:
        return recording
    most = min(factor_for(channel.to_numpy(), recording.dt) for channel in channels)
    factor = min(int(most / limits.oversampled), recording.n // LEAST)
    if factor < 2:
        return recording

    def thin(channel: xr.DataArray) -> xr.DataArray:
        kept = channel.isel(time=slice(None, None, factor))
        return kept.copy(data=decimate(channel.to_numpy(), factor))

    note = (
        f"it was sampled at {recording.rate:.6g} Hz, {most * PER_PERIOD} samples in the shortest period above the"
        f" noise: one sample of {factor} is used ({recording.rate / factor:.6g} Hz), after a low-pass filter"
    )
    return replace(
        recording,
        inputs=tuple(map(thin, recording.inputs)),
        sensors=tuple(map(thin, recording.sensors)),
        dt=recording.dt * factor,
        notes=(*recording.notes, note),
    )


def factor_for(values: Array, dt: float) -> int:
    """Return how many samples (n,), `dt` s apart, can be merged into one without loss; 1 where that is unknown.

    The power spectrum is averaged over segments (Welch 1967). The noise floor is its median over the last quarter of
    the frequencies; the signal reaches up to the highest frequency at which the spectrum, smoothed over three, is
    `ABOVE` times as large. `PER_PERIOD` samples remain in the period of that frequency.
    """
    from scipy.signal import welch

    there = np.isfinite(values)
    if not dt > 0 or np.count_nonzero(there) < 0.95 * values.size:
        return 1
    size = min(SEGMENT, 2 * values.size // (FEWEST + 1))
    if size < 64 or np.ptp(values[there]) == 0.0:
        return 1
    whole = fill_lost(values)
    frequency, power = welch(whole / np.abs(whole).max(), 1.0 / dt, "blackmanharris", size, detrend="linear")
    floor = float(np.median(power[-int(FLOOR * power.size) :]))
    signal = np.flatnonzero(np.convolve(power, np.ones(3) / 3.0, "same") > max(ABOVE * floor, LOUD * power.max()))
    if not signal.size or signal[-1] > WIDEST * power.size:
        return 1
    return max(1, int(1.0 / (PER_PERIOD * dt * frequency[max(1, signal[-1])])))


def decimate(values: Array, factor: int) -> Array:
    """Return every `factor`-th sample (ceil(n / factor),) of a signal (n,), after a low-pass filter without delay.

    Up to 0.42 of the new rate, amplitudes change by less than 0.1 % and phases not at all. From 0.58 of it on, from
    where aliases would fall below 0.42, amplitudes are reduced by 68 dB or more. The transition is steep, so that white
    noise stays white except at the end of the band.
    The signal is extended beyond its ends by point reflection (odd extension). Lost samples (NaN) are interpolated
    first, which fills gaps of up to half a new step in the passband; the result is NaN where samples with more than a
    tenth of the squared weight lie in longer gaps.
    """
    if factor < 1:
        raise ValueError(f"factor is {factor}: expected 1 or more")
    if factor == 1:
        return values.copy()
    taps = low_pass(factor)
    half = taps.size // 2
    if values.size <= half:
        raise ValueError(f"{values.size} samples are too few to merge {factor} of them: expected more than {half}")
    lost = ~np.isfinite(values)
    merged = _filter_and_pick(_interpolate_lost(values, lost), taps, factor)
    gone = _flag_long_gaps(lost, max(1, factor // 2))
    if not gone.any():
        return merged
    share = _filter_and_pick(np.where(gone, 0.0, 1.0), taps**2 / np.sum(taps**2), factor, odd=False)
    return np.where(share < TRUSTED, np.nan, merged)


def _flag_long_gaps(lost: NDArray[np.bool_], most: int) -> NDArray[np.bool_]:
    """Return a flag (n,) for each sample: whether it lies in a gap of more than `most` samples."""
    gone = np.zeros(lost.size, dtype=bool)
    for first, last in runs_of(lost):
        gone[first:last] = last - first > most
    return gone


def low_pass(factor: int) -> Array:
    """Return the taps of the low-pass filter, an odd number of them with the sum 1."""
    from scipy.signal import firwin, kaiserord

    stop = 2.0 - PASS
    count, beta = kaiserord(ATTENUATION, (stop - PASS) / factor)
    return np.asarray(firwin(count | 1, 1.0 / factor, window=("kaiser", beta)), dtype=float)


def _interpolate_lost(values: Array, lost: NDArray[np.bool_]) -> Array:
    """Return the samples with lost ones interpolated by monotone cubic pieces, which do not overshoot."""
    if not lost.any():
        return values
    from scipy.interpolate import PchipInterpolator

    there, at = np.flatnonzero(~lost), np.arange(values.size)
    if there.size < 2:
        return np.zeros(values.size)
    bridged = np.asarray(PchipInterpolator(there, values[there])(np.clip(at, there[0], there[-1])), dtype=float)
    return np.where(lost, bridged, values)


def _filter_and_pick(values: Array, taps: Array, factor: int, *, odd: bool = True) -> Array:
    """Return every `factor`-th sample of the signal, extended at its ends and convolved with symmetric taps."""
    from scipy.signal import upfirdn

    half = taps.size // 2
    before, after = values[half:0:-1], values[-2 : -half - 2 : -1]
    if odd:
        before, after = 2.0 * values[0] - before, 2.0 * values[-1] - after
    whole = upfirdn(taps, np.concatenate([before, values, after]), 1, 1)[2 * half :][: values.size]
    return np.asarray(whole[::factor], dtype=float)
