"""Fewer samples where a recorder took far more than the signal needs.

The band of a signal ends where its spectrum sinks into the noise floor. Samples are merged by a linear-phase FIR
low-pass filter (Kaiser window; Oppenheim and Schafer 2010, section 7.5), centred on the samples that are kept, so that
nothing is delayed.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lostmotion.recording.checks import filled, runs_of

if TYPE_CHECKING:
    import xarray as xr

    from lostmotion.recording.load import Recording

Array = NDArray[np.float64]
PER_PERIOD = 20
"""Samples that are left in the shortest period that stands out of the noise."""
ABOVE = 4.0
"""Times the noise floor from which a part of the spectrum counts as signal."""
LOUD = 1e-10
"""Share of the power in one frequency over that of the loudest below which nothing counts: rounding of the samples."""
SEGMENT, FEWEST = 8192, 8
"""Samples in one segment of the spectrum at most, and segments that are averaged at least."""
FLOOR, WIDEST = 0.25, 0.5
"""Part of the spectrum, at its end, in which the noise floor is seen; and the widest band that leaves room for it."""
ATTENUATION = 70.0
"""Attenuation (dB) of what would fold back, to within 2 dB; the ripple below is 0.06 % of the amplitude at most."""
PASS = 0.85
"""Share of the new Nyquist frequency up to which nothing is changed; from twice that less PASS on, all is taken out.

With 0.5 the noise of what remained had a memory, and a diagnosis found it."""
SPARE, LEAST = 5, 2000
"""Sampling is far too fast where so many times as many samples as could be kept with nothing lost are still too many;
and so many samples are kept at least."""
TRUSTED = 0.9
"""Share of the filter's squared weight that must not lie in a long gap."""


def thinned(recording: Recording) -> Recording:
    """Return a recording that was sampled far too fast with one sample of several kept, and a note; any other as it is.

    At least `PER_PERIOD` times `SPARE` samples remain in the shortest period that stands out of the noise of any
    channel. One whose inputs are held between the samples stays as it is.
    """
    channels = (*recording.inputs, *recording.sensors)
    if recording.hold == "step" or recording.n < 2 * LEAST:
        return recording
    most = min(factor_for(channel.to_numpy(), recording.dt) for channel in channels)
    factor = min(most // SPARE, recording.n // LEAST)
    if factor < 2:
        return recording

    def thin(channel: xr.DataArray) -> xr.DataArray:
        kept = channel.isel(time=slice(None, None, factor))
        return kept.copy(data=decimated(channel.to_numpy(), factor))

    note = (
        f"it was sampled at {recording.rate:.6g} Hz, {most * PER_PERIOD} samples in the shortest period that stands out"
        f" of the noise: one sample of {factor} is used ({recording.rate / factor:.6g} Hz), behind a low-pass filter"
    )
    return replace(
        recording,
        inputs=tuple(map(thin, recording.inputs)),
        sensors=tuple(map(thin, recording.sensors)),
        dt=recording.dt * factor,
        notes=(*recording.notes, note),
    )


def factor_for(values: Array, dt: float) -> int:
    """Return how many samples (n,), `dt` s apart, can be merged into one with nothing lost; 1 where it cannot be told.

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
    whole = filled(values)
    frequency, power = welch(whole / np.abs(whole).max(), 1.0 / dt, "blackmanharris", size, detrend="linear")
    floor = float(np.median(power[-int(FLOOR * power.size) :]))
    signal = np.flatnonzero(np.convolve(power, np.ones(3) / 3.0, "same") > max(ABOVE * floor, LOUD * power.max()))
    if not signal.size or signal[-1] > WIDEST * power.size:
        return 1
    return max(1, int(1.0 / (PER_PERIOD * dt * frequency[max(1, signal[-1])])))


def decimated(values: Array, factor: int) -> Array:
    """Return every `factor`-th sample (ceil(n / factor),) of a signal (n,), after a low-pass filter without delay.

    Up to 0.42 of the new rate, amplitudes stay within 0.1 % and phases as they are. From 0.58 of it on, which would
    fold back below that, amplitudes are taken down by 68 dB or more. The filter falls off steeply between them, so that
    white noise stays white but for the end of the band.
    The signal goes on beyond its ends as its own mirror image turned about the last sample (odd extension). Lost
    samples (NaN) are interpolated first. In the band that is kept, a gap of up to half a new step is filled that way;
    the result is NaN where samples with more than a tenth of the squared weight lie in longer gaps.
    """
    if factor < 1:
        raise ValueError(f"factor is {factor}: wanted 1 or more")
    if factor == 1:
        return values.copy()
    taps = low_pass(factor)
    half = taps.size // 2
    if values.size <= half:
        raise ValueError(f"{values.size} samples are too few to merge {factor} of them: wanted more than {half}")
    lost = ~np.isfinite(values)
    merged = _filtered(_bridged(values, lost), taps, factor)
    gone = _long(lost, max(1, factor // 2))
    if not gone.any():
        return merged
    share = _filtered(np.where(gone, 0.0, 1.0), taps**2 / np.sum(taps**2), factor, odd=False)
    return np.where(share < TRUSTED, np.nan, merged)


def _long(lost: NDArray[np.bool_], most: int) -> NDArray[np.bool_]:
    """Return which samples (n,) lie in gaps of more than `most` samples."""
    gone = np.zeros(lost.size, dtype=bool)
    for first, last in runs_of(lost):
        gone[first:last] = last - first > most
    return gone


def low_pass(factor: int) -> Array:
    """Return the taps (odd number,) of the low-pass filter, which add up to 1."""
    from scipy.signal import firwin, kaiserord

    stop = 2.0 - PASS
    count, beta = kaiserord(ATTENUATION, (stop - PASS) / factor)
    return np.asarray(firwin(count | 1, 1.0 / factor, window=("kaiser", beta)), dtype=float)


def _bridged(values: Array, lost: NDArray[np.bool_]) -> Array:
    """Return the samples with cubic pieces over the lost ones, which follow the neighbours and do not overshoot."""
    if not lost.any():
        return values
    from scipy.interpolate import PchipInterpolator

    there, at = np.flatnonzero(~lost), np.arange(values.size)
    if there.size < 2:
        return np.zeros(values.size)
    filled = np.asarray(PchipInterpolator(there, values[there])(np.clip(at, there[0], there[-1])), dtype=float)
    return np.where(lost, filled, values)


def _filtered(values: Array, taps: Array, factor: int, *, odd: bool = True) -> Array:
    """Return every `factor`-th sample of a signal that was extended at its ends and convolved with symmetric taps."""
    from scipy.signal import upfirdn

    half = taps.size // 2
    before, after = values[half:0:-1], values[-2 : -half - 2 : -1]
    if odd:
        before, after = 2.0 * values[0] - before, 2.0 * values[-1] - after
    whole = upfirdn(taps, np.concatenate([before, values, after]), 1, 1)[2 * half :][: values.size]
    return np.asarray(whole[::factor], dtype=float)
