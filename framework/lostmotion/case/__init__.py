"""What a case file says: what was measured, the model, what is known and what is to be estimated.

What was measured stands in `[[recordings]]`, or in `[[levels]]` where only measures of chaos are at hand; a command
says which of the two it wants. Beside them and `[model]` (`name`, `motion`, `[model.known]`, `[model.estimate]`) a
case may hold:

- `title`, a line of text;
- `plugins = ["file.py"]`: files, relative to the case, that bring models or terms of their own;
- `[truth]`: true values of parameters, where there are any; they are drawn in the report and used for nothing else;
- `[sensor]`: `noise = "each"` when each of several recordings has its own measurement noise and random force (as it
  is when nothing is said), `noise = "shared"` when they have them in common; `offset = { a prior }` when the zeros of
  the sensors are unknown, of each and in each recording anew (SI unit of the channel).
- `[experiment]`: what the next experiment may ask of the machine, where a diagnosis proposes one: `max_level`, the
  largest amplitude (SI unit of the excitation; a signal of another form has the rms of such a sine), and
  `max_frequency` (Hz). Twice those of the recording when nothing is said.

In place of `name`, `[model]` may hold the machine itself: `equations`, one for each body, such as `"m*x'' + c*x' + k*x
= force"`. A prime is d/dt; names that are neither a coordinate, an input nor a known function are parameters, and so
are all in `known` and `estimate`. Each equation has the second derivative of one coordinate, times one parameter.
Functions are `gap(x, k, x0)`, `stop(x, k, x0)` (one side), `sat(x, limit)`, `sign`, `abs`, `min`, `max`, `sqrt`, `exp`,
`log` and those of trigonometry. Dimensions are checked; `units = { m = "kg" }` (SI) tells those that the equations
leave open. Each coordinate is a channel (`x`, `x.velocity`, `x.acceleration`; the first is `position`, `velocity`,
`acceleration` too) and a place for terms (`ground` for the first, else its name), as is each pair of coordinates that
appears as a difference (`x1-x2`).

`motion` is "translation" or "rotation". Where it is not given the units of the recordings tell; where it is, units
that say otherwise are refused, as are lengths and angles in one case.

Per recording: `file`; `time` or `rate` (Hz); what drove the machine, as `excitation` or `inputs`; what was measured,
as `response` or `sensors`; `name` (in results; the stem of the file otherwise); `hold = "step"` when a digital
controller holds the inputs between samples ("smooth" otherwise); `t_start` and `t_end` (s) to cut out a piece;
`start`, when it was recorded, which is kept and used for nothing. `time` is a column, or `{ column, unit }` with a
unit out of s, ms, us, ns, min and h. Where the case gives none the file tells, by its header or by time stamps; else
it is s. A unit that contradicts the header is refused.

The short form is one of each, and nothing has a name: `excitation` and `response` with `column`, `quantity`, `unit`,
and `factor`, which multiplies the column before the unit is applied, for instance newtons per volt. `excitation =
"none"` is a machine that nothing drives.

The long form is two lists. `inputs` has each input of the model at most once, those that are not there being zero; it
is `[]` where nothing drives the machine, and the state in which it begins is then estimated. Per input: `input` (as
the model names it: `force`, `second_force`, `base_position`, `base_acceleration`), `column`, `unit`, `factor`.
`sensors` has one sensor or more. Per sensor: `channel` (as the model names it: `position`, `second_velocity`,
`acceleration`), `column`, `unit`, `factor`, and

- `name`: what results call it, and the place of its terms, as in `sensor_delay@load encoder`. That of its channel
  where none is given. Names differ within a recording and have none of `[ ] : / @ .` in them;
- `noise`: "white" where nothing is said; "quantised", in whole steps that are read off the stored values; "ar1", with
  a part that has a memory. A diagnosis tries a memory by itself where the recording asks for it.

The last part of an input or a channel is its quantity (position, velocity, acceleration or force), which says what
units it may have. A torque is the force of a rotation, and `g` is 9.80665 m/s^2 in an acceleration. A reading of a
sensor that is NaN or empty was not taken: sensors of different rates share one table. All recordings of a case have
the same sensors, by name and channel.

Per level of a sinusoidal drive: `amplitude` and its `unit` (of a force, a torque or a base motion); `frequency` (Hz)
or `omega` (rad/s); `name`; and what was measured there, at least one of `motion = "periodic"` or `"chaotic"`,
`lyapunov` (`unit = "1/s"` or `"bit/s"`) and `d2`. A measured number is `{ value, sd }`, or `{ value, low, high }`
with a 95 % interval.

A prior in `[model.estimate]` is one of

- `{ low, high }`: uniform, or log-uniform with `scale = "log"`;
- `{ mean, sd }`: normal;
- `{ median, sd_log }`: log-normal, `sd_log` being the standard deviation of the natural logarithm;
- `{ half_sd }`: half-normal, from 0 up;

and with `each = true` each recording has a value of its own, where otherwise all share one.
"""

from lostmotion.case.channels import check_alike
from lostmotion.case.levels import Level, Measured
from lostmotion.case.load import WRITTEN, CaseFile, Experiment, SensorSpec, load_case
from lostmotion.case.prior import Prior
from lostmotion.case.write import dump_case
from lostmotion.recording import Channel, RecordingSpec

__all__ = [
    "WRITTEN", "CaseFile", "Channel", "Experiment", "Level", "Measured", "Prior", "RecordingSpec", "SensorSpec",
    "check_alike", "dump_case", "load_case",
]  # fmt: skip
