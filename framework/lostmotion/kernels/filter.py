"""The filter through a model at many parameter points at once, in lock-step, for a model of `N` states.

Statistical linearisation by divided differences over sqrt(3) standard deviations (Norgaard, Poulsen, Ravn, Automatica
36 (2000) 1627-1638). The mean includes the curvature of the force, so a kink or a jump is smoothed over the uncertainty
of the state. Sensors are processed sequentially, with one scalar measurement update each. The output of a sensor is
linearised over five points in each state (Gauss-Hermite; Arasaratnam, Haykin, Elliott, Proc. IEEE 95 (2007) 953-977),
and the residual of the linearisation is added to its variance: a force sensor with a kink that the state may or may not
have reached gives little information on the position. With three points the gain would jump where the outermost point
reaches the kink.

`lostmotion.likelihood.kernels` compiles this text, after those of `crossing.py` and `propagation.py`, once for each
number of states.
"""

from __future__ import annotations

import math

from lostmotion.kernels.crossing import (
    ALIVE,
    END,
    EXPECTED,
    LOOSE,
    MIDDLE,
    NEAR,
    NEXT_STEP,
    NOISE,
    REACH,
    SEEN,
    TINY,
    UP,
    H,
    N,
    P,
    T,
    Y,
)  # fmt: skip
from lostmotion.kernels.inputs import (
    DRAWN,
    INPUTS,
    SOURCES,
    STEP,
    interpolate_input,
    set_inputs,
)  # fmt: skip
from lostmotion.kernels.noise_states import (
    add_clock_noise,
    initialise_noises,
    propagate_noises,
    update_noises,
)  # fmt: skip
from lostmotion.kernels.propagation import (
    cross_sample,
)  # fmt: skip
from lostmotion.kernels.vector import (
    WIDTH,
    absolute,
    assign,
    call,
    is_finite,
    jit,
    load,
    pointer,
    select,
    square_root,
    store,
    value,
    whole,
)  # fmt: skip

LEVELS = 5
"""Rows for each sensor: variances of white noise and of stamps (s^2), gain, offset and lag (s)."""
INNER_POINT, OUTER_POINT = 1.355626179974266, 2.8569700138728056
INNER_WEIGHT, OUTER_WEIGHT = 0.22207592200561263, 0.011257411327720683
"""Gauss-Hermite points beside the mean, in standard deviations, and their weights (Abramowitz, Stegun, table 25.10)."""
UNREAD_VARIANCE = 1.0 / (2.0 * math.pi)
"""The variance that is stored where nothing was read: with an error of zero it adds nothing to a log-likelihood."""


@jit
def set_inputs_late(space, wires, u, which, begin, k, levels, row, share, dt, lanes):  # type: ignore[no-untyped-def]
    """Set the model's inputs and time to those a `share` of each point's lag before sample `k`."""
    for lane in range(lanes):
        past = share * value(levels, row, lane)
        sample = which[lane] + k
        for i in range(wires[INPUTS]):
            assign(space, wires[3] + i, lane, interpolate_input(u, sample, wires[INPUTS], i, -past / dt))
        assign(space, wires[0], lane, value(begin, 0, lane) + k * dt - past)


@jit
def rewind_states(derive, space, wires, work, inputs, lanes):  # type: ignore[no-untyped-def]
    """Move the states in the block back by the lag of a sensor, by one midpoint step; return nonzero on failure."""
    u, which, begin, k, levels, row, dt, _ = inputs
    set_inputs_late(space, wires, u, which, begin, k, levels, row, 0.0, dt, lanes)
    failed = call(derive, space, wires, lanes)
    for o in range(0, lanes, WIDTH):
        lag = load(levels, row, o)
        for a in range(N):
            y = load(space, wires[1] + a, o)
            store(work, T + a, o, y)
            store(space, wires[1] + a, o, y - 0.5 * lag * load(space, wires[2] + a, o))
    set_inputs_late(space, wires, u, which, begin, k, levels, row, 0.5, dt, lanes)
    failed |= call(derive, space, wires, lanes)
    for o in range(0, lanes, WIDTH):
        lag = load(levels, row, o)
        for a in range(N):
            store(space, wires[1] + a, o, load(work, T + a, o) - lag * load(space, wires[2] + a, o))
    set_inputs_late(space, wires, u, which, begin, k, levels, row, 1.0, dt, lanes)
    return failed


@jit
def observe_at(functions, space, wires, work, column, side, inputs, lanes):  # type: ignore[no-untyped-def]
    """Evaluate the channels with state `column` moved by `side` deviations (-1: none); return nonzero on failure."""
    derive, observe = functions
    for o in range(0, lanes, WIDTH):
        for a in range(N):
            y = load(work, Y + a, o)
            if a == column:
                y = y + side * load(work, REACH + a, o) + (TINY if side > 0.0 else -TINY) * (1.0 + absolute(y))
            store(space, wires[1] + a, o, y)
    failed = False
    if inputs[7]:
        failed |= rewind_states(derive, space, wires, work, inputs, lanes)
    return failed | call(derive, space, wires, lanes) | call(observe, space, wires, lanes)


@jit
def linearise_sensor(functions, space, wires, work, channel, step, inputs, lanes):  # type: ignore[no-untyped-def]
    """Write the expected output of a sensor into `EXPECTED` and its slopes over the states into `H`; return a failure.

    `LOOSE` receives the variance that the nonlinearity adds.
    """
    row = wires[4] + channel
    for o in range(0, lanes, WIDTH):
        store(space, wires[STEP], o, step)
        for a in range(N):
            store(work, REACH + a, o, square_root(load(work, P + a * N + a, o)))
    failed = observe_at(functions, space, wires, work, -1, 0.0, inputs, lanes)
    for o in range(0, lanes, WIDTH):
        store(work, SEEN, o, load(space, row, o))
        store(work, EXPECTED, o, load(space, row, o))
        store(work, LOOSE, o, 0.0)
    for c in range(N):
        for o in range(0, lanes, WIDTH):
            store(work, H + c, o, 0.0)
            store(work, MIDDLE, o, 0.0)
            store(work, END, o, 0.0)
        for ring in range(2):
            reach, weight = (INNER_POINT, INNER_WEIGHT) if ring == 0 else (OUTER_POINT, OUTER_WEIGHT)
            for side in range(2):
                failed |= observe_at(functions, space, wires, work, c, reach * (1.0 - 2.0 * side), inputs, lanes)
                for o in range(0, lanes, WIDTH):
                    store(work, UP + side, o, load(space, row, o) - load(work, SEEN, o))
            for o in range(0, lanes, WIDTH):
                d = reach * load(work, REACH + c, o) + TINY * (1.0 + absolute(load(work, Y + c, o)))
                up, down = load(work, UP, o), load(work, UP + 1, o)
                store(work, H + c, o, load(work, H + c, o) + weight * reach * reach * (up - down) / d)
                store(work, MIDDLE, o, load(work, MIDDLE, o) + weight * (up + down))
                store(work, END, o, load(work, END, o) + weight * (up * up + down * down))
        for o in range(0, lanes, WIDTH):
            mean, along = load(work, MIDDLE, o), load(work, H + c, o) * load(work, REACH + c, o)
            left = load(work, END, o) - mean * mean - along * along
            store(work, EXPECTED, o, load(work, EXPECTED, o) + mean)
            store(work, LOOSE, o, load(work, LOOSE, o) + select(left < 0.0, 0.0, left))
    return failed


@jit
def update_states(work, noises, blocks, levels, sensor, many, own, errors, variances, k, lanes):  # type: ignore[no-untyped-def]
    """Update the states by one reading of a sensor, in `END`; `EXPECTED` and `H` hold its prediction and its slopes.

    `levels` has for each sensor the variances of white noise and of its stamps, gain, offset and lag. `own` are the
    first of its noise states and the one behind the last; `kernels/noise_states.py` describes `noises` and `blocks`.
    """
    first, wide, rows = LEVELS * sensor, 1 + N + many, 1 + 3 * many
    begin, end = own
    for o in range(0, lanes, WIDTH):
        gauge = load(levels, first + 2, o)
        miss = load(work, END, o) - (gauge * load(work, EXPECTED, o) + load(levels, first + 3, o))
        var = load(levels, first, o) + gauge * gauge * load(work, LOOSE, o)
        for a in range(N):
            s = load(work, P + a * N, o) * load(work, H, o)
            for b in range(1, N):
                s = s + load(work, P + a * N + b, o) * load(work, H + b, o)
            s = gauge * s
            for i in range(begin, end):
                s = s + load(blocks, i * rows, o) * load(noises, i * wide + 1 + a, o)
            store(work, UP + a, o, s)
        for a in range(N):
            var = var + gauge * load(work, H + a, o) * load(work, UP + a, o)
        for i in range(begin, end):
            shown = load(blocks, i * rows, o)
            miss = miss - shown * load(noises, i * wide, o)
            pulled = load(blocks, begin * rows, o) * load(noises, i * wide + 1 + N + begin, o)
            for j in range(begin + 1, end):
                pulled = pulled + load(blocks, j * rows, o) * load(noises, i * wide + 1 + N + j, o)
            for a in range(N):
                pulled = pulled + gauge * load(work, H + a, o) * load(noises, i * wide + 1 + a, o)
            var = var + shown * pulled
        precision = 1.0 / var
        update_noises(work, noises, blocks, gauge, many, begin, end, precision, miss, o)
        for a in range(N):
            store(work, Y + a, o, load(work, Y + a, o) + load(work, UP + a, o) * (precision * miss))
        for a in range(N):
            for b in range(a, N):
                s = load(work, P + a * N + b, o) - load(work, UP + a, o) * load(work, UP + b, o) * precision
                if a == b:
                    s = select(s < 0.0, 0.0, s)
                store(work, P + a * N + b, o, s)
                store(work, P + b * N + a, o, s)
        alive = load(work, ALIVE, o) > 0.5
        alive = alive & is_finite(load(work, Y, o)) & (var > 0.0) & is_finite(load(work, P + N + 1, o))
        store(work, ALIVE, o, select(alive, 1.0, 0.0))
        store(work, MIDDLE, o, miss)
        store(work, END, o, var)
    for lane in range(lanes):
        errors[lane, k, sensor] = value(work, MIDDLE, lane)
        variances[lane, k, sensor] = value(work, END, lane)


@jit
def initialise(work, start, noise, sources, nsub, lanes):  # type: ignore[no-untyped-def]
    """Set everything of the model to its value before the first sample."""
    for o in range(0, lanes, WIDTH):
        for a in range(N + N * N):
            store(work, Y + a, o, load(start, a, o))
        for j in range(2 * sources):
            store(work, NOISE + j, o, load(noise, j, o))
        store(work, ALIVE, o, 1.0)
        store(work, NEXT_STEP, o, float(nsub))
        for a in range(N):
            store(work, NEAR + a, o, 0.0)


@jit
def redraw_forces(work, noise, sources, drawn, lanes):  # type: ignore[no-untyped-def]
    """Reset the forces that are held over a sample to their prior."""
    for d in range(drawn):
        row = int(value(noise, 2 * (sources + d), 0))
        for o in range(0, lanes, WIDTH):
            store(work, Y + row, o, 0.0)
            for a in range(N):
                store(work, P + a * N + row, o, 0.0)
                store(work, P + row * N + a, o, 0.0)
            store(work, P + row * N + row, o, load(noise, 2 * (sources + d) + 1, o))


@jit
def add_input_uncertainty(work, noise, sources, drawn, unsure, lanes):  # type: ignore[no-untyped-def]
    """Add the uncertainty of the measured input to the variance of the first held force, up to the next sample."""
    if drawn > 0 and unsure > 0.0:
        row = int(value(noise, 2 * sources, 0))
        for o in range(0, lanes, WIDTH):
            store(work, P + row * N + row, o, load(work, P + row * N + row, o) + unsure)


@whole
def run_filter(functions, blocks, wiring, inputs, drives, z, sensors, unsure, dt, nsub, written, kept, led, lanes):  # type: ignore[no-untyped-def]
    """Filter readings at `lanes` points; write their innovations; return nonzero if a law raised an error.

    `z` (sets, samples, sensors) are the readings, one set for all points or one for each (the last serves the rest).
    `functions` are the addresses of `derive` and `observe`. `blocks` are those of the model, of work and of noise
    states, then the data of each point: its time at the first sample (1 row); for each sensor the variances of white
    noise and of stamps, gain, offset and lag (5 rows each); for each source of process noise the number of the state
    that it enters and its intensity, then for each force that is redrawn at each sample its state and variance (2 rows
    each); initial states and covariances (N + N * N rows); noise states (`kernels/noise_states.py`). `wiring` holds the
    wires of the model, with the numbers of sources, of redrawn forces, of inputs and of drives from `SOURCES` on.
    `inputs` (rows, 4, inputs) holds a cubic for each sample, and `drives` (lanes,) the first row of each point.
    `sensors` (sensors, 6) holds the channel of each, the state that it shows directly or -1, the first of its noise
    states and the one behind the last, whether it is late, and whether its stamps jitter; `unsure` (samples,) is the
    variance that the measured input adds to a held force up to the next sample. The arrays in `written` are errors and
    variances (lanes, samples, sensors), and `reached` (lanes,), the number of samples that were computed. `kept` is
    what a smoother needs of the first point: states and covariances after and before each sample and the transition
    matrices between, empty if not wanted. Points that are `led` take the steps of the first
    one, so that differences between them are derivatives of one rule.
    """
    derive, observe = functions[0], functions[1]
    errors, variances, reached = written
    space, work, noises, begin = pointer(blocks[0]), pointer(blocks[1]), pointer(blocks[2]), pointer(blocks[3])
    levels, noise, start, kinds = pointer(blocks[4]), pointer(blocks[5]), pointer(blocks[6]), pointer(blocks[7])
    wires, u, which = pointer(wiring), pointer(inputs), pointer(drives)
    samples, keep, failed = z.shape[1], kept[0].shape[0] > 1, 0
    seen_states, seen_cov, ahead_states, ahead_cov, steps = kept
    sources, drawn = wires[SOURCES], wires[DRAWN]
    many = sensors[z.shape[2] - 1, 3]
    initialise(work, start, noise, sources, nsub, lanes)
    initialise_noises(noises, kinds, many, lanes)
    for k in range(samples):
        redraw_forces(work, noise, sources, drawn, lanes)
        if keep:
            for a in range(N):
                ahead_states[k, a] = value(work, Y + a, 0)
                for b in range(N):
                    ahead_cov[k, a, b] = value(work, P + a * N + b, 0)
        for s in range(z.shape[2]):
            if math.isnan(z[0, k, s]):
                for lane in range(lanes):
                    errors[lane, k, s] = 0.0
                    variances[lane, k, s] = UNREAD_VARIANCE
                continue
            direct, lagging = sensors[s, 1], sensors[s, 4] > 0
            if direct >= 0 and not lagging:
                for o in range(0, lanes, WIDTH):
                    for a in range(N):
                        store(work, H + a, o, 1.0 if a == direct else 0.0)
                    store(work, EXPECTED, o, load(work, Y + direct, o))
                    store(work, LOOSE, o, 0.0)
            else:
                set_inputs(space, wires, u, which, begin, k, 0.0, dt, lanes)
                given = (u, which, begin, k, levels, LEVELS * s + 4, dt, lagging)
                failed |= linearise_sensor(
                    (derive, observe), space, wires, work, sensors[s, 0], dt / nsub, given, lanes
                )
            if sensors[s, 5] > 0:
                moving = (u, which, begin, k, dt)
                failed |= add_clock_noise(derive, space, wires, work, levels, LEVELS * s + 1, moving, lanes)
            for lane in range(lanes):
                assign(work, END, lane, z[min(lane, z.shape[0] - 1), k, s])
            own = (sensors[s, 2], sensors[s, 3])
            update_states(work, noises, kinds, levels, s, many, own, errors, variances, k, lanes)
        living = False
        for lane in range(lanes):
            if value(work, ALIVE, lane) > 0.5:
                living = True
                reached[lane] = k + 1
        if failed or not living:
            return failed
        if keep:
            for a in range(N):
                seen_states[k, a] = value(work, Y + a, 0)
                for b in range(N):
                    seen_cov[k, a, b] = value(work, P + a * N + b, 0)
                    for o in range(0, lanes, WIDTH):
                        store(work, T + a * N + b, o, 1.0 if a == b else 0.0)
        if k == samples - 1:
            break
        add_input_uncertainty(work, noise, sources, drawn, unsure[k], lanes)
        failed |= cross_sample(
            derive, space, wires, work, noises, u, which, begin, k, nsub, dt, sources, many, keep, led, lanes
        )
        for s in range(z.shape[2]):
            if sensors[s, 3] > sensors[s, 2]:
                propagate_noises(noises, kinds, many, sensors[s, 2], sensors[s, 3], lanes)
        if keep:
            for a in range(N):
                for b in range(N):
                    steps[k, a, b] = value(work, T + a * N + b, 0)
            for d in range(drawn):
                for b in range(N):
                    steps[k, int(value(noise, 2 * (sources + d), 0)), b] = 0.0
    return failed
