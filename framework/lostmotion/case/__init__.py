"""The format of a case file: measurements, model, known parameters and parameters to be estimated.

Measurements are in `[[recordings]]`, or in `[[levels]]` where only measures of chaos are available; each command tells
which of the two it needs. Besides them and `[model]` (`name`, `motion`, `[model.known]`, `[model.estimate]`) a case may
contain:

- `title`, a line of text;
- `guessed = ["..."]`: sentences on what `lostmotion init` supposed; they stand in each result until they are removed;
- `plugins = ["file.py"]`: files, relative to the case, that contain further models or terms;
- `[truth]`: true values of parameters, where they are known; they are only drawn in the report;
- `[sensor]`: `noise = "each"` when each of several recordings has its own measurement noise and random force (the
  default), `noise = "shared"` when they have them in common; `offset = { a prior }` when the zeros of the sensors are
  unknown, separately for each sensor and recording (SI unit of the channel).
- `[experiment]`: limits for the next experiment that a diagnosis proposes: `max_level`, the largest amplitude (SI unit
  of the excitation; another signal has the rms of such a sine), and `max_frequency` (Hz). The defaults are twice those
  of the recording.

Instead of `name`, `[model]` may contain the machine itself: `equations`, one for each body, such as `"m*x'' + c*x' +
k*x = force"`. A prime is d/dt; names that are neither a coordinate, an input nor a known function are parameters, and
so are all in `known` and `estimate`. Each equation has the second derivative of one coordinate, times one parameter.
A recorded input that no equation names is the one name that is no parameter and a summand without a coordinate, such
as `F` in `... = F`; a note says so, and where there are several such names or none, the case is refused.
Functions are `gap(x, k, x0)`, `stop(x, k, x0)` (one side), `sat(x, limit)`, `sign`, `abs`, `min`, `max`, `sqrt`,
`exp`, `log` and the trigonometric functions. Dimensions are checked; `units = { m = "kg" }` (SI) gives those that the
equations do not determine. Each coordinate is a channel (`x`, `x.velocity`, `x.acceleration`; the first is also
`position`, `velocity`, `acceleration`) and a place for terms (`ground` for the first, else its name), as is each pair
of coordinates that appears as a difference (`x1-x2`).

Or it may contain `dynamics`: a machine in NumPy that is stepped, as the name of a plugin, or as "my_arm.py:MyArm", a
class of the kind `Dynamics` in a file beside the case.

`motion` is "translation" or "rotation". By default it follows from the units of the recordings. Units that contradict
it are refused, as are lengths and angles in one case.

Per recording: `file`; `time` or `rate` (Hz); the drive, as `excitation` or `inputs`; the readings, as `response` or
`sensors`; `name` (in results; by default the stem of the file); `hold = "step"` when a digital controller holds the
inputs between samples ("smooth" otherwise); `t_start` and `t_end` (s) to select a part; `start`, the time of the
recording, which is only stored. `time` is a column, or `{ column, unit }` with one of the units s, ms, us, ns, min and
h. By default the unit follows from the header of the file or from time stamps, else it is s. A unit that contradicts
the header is refused.

The short form has one drive and one reading, without names: `excitation` and `response` with `column`, `quantity`,
`unit`, and `factor`, which multiplies the column before the unit is applied, for instance newtons per volt.
`excitation = "none"` means a machine that nothing drives.

The long form has two lists. `inputs` contains each input of the model at most once; inputs that are not listed are
zero. It is `[]` where nothing drives the machine; the initial state is then estimated. Per input: `input` (its name in
the model: `force`, `second_force`, `base_position`, `base_acceleration`), `column`, `unit`, `factor`.
`sensors` contains at least one sensor. Per sensor: `channel` (its name in the model: `position`, `second_velocity`,
`acceleration`), `column`, `unit`, `factor`, and

- `name`: its name in results, and the place of its terms, as in `sensor_delay@load encoder`. The default is the name
  of its channel. Names differ within a recording and contain none of `[ ] : / @ .`;
- `noise`: "white" (the default); "quantised", in whole steps that are found from the stored values; "ar1", with a part
  that is correlated in time; "jitter", of stamps whose clock jitters; "drift", of a zero that drifts; "flicker", 1/f
  noise; "hum" or "hum60", of the mains; or the name of a noise of a plugin. Several are written with plus signs,
  `"jitter + drift"`. A diagnosis tries correlated noise itself where the recording shows it;
- `differences = true`: each value of a position is the change since the row before, as from a counter of an encoder
  that is read and reset. The values are summed. With `unit = "turn"` and `factor = 0.000244140625` they are counts of
  an encoder with 4096 counts a turn;
- `zero = "unknown"`: the position has an arbitrary zero, as that of an incremental encoder; readings are taken about
  their mean, and an offset is estimated. Differences have an unknown zero.

The last part of an input or a channel is its quantity (position, velocity, acceleration or force), which
determines the allowed units. A torque is the force of a rotation, and `g` is 9.80665 m/s^2 in an acceleration. A
reading of a sensor that is NaN or empty is missing: sensors of different rates can share one table. All recordings of a
case have the same sensors, by name and channel.

Per level of a sinusoidal drive: `amplitude` and its `unit` (of a force, a torque or a base motion); `frequency` (Hz)
or `omega` (rad/s); `name`; and the measured results, at least one of `motion = "periodic"` or `"chaotic"`,
`lyapunov` (`unit = "1/s"` or `"bit/s"`) and `d2`. A measured number is `{ value, sd }`, or `{ value, low, high }`
with a 95 % interval.

A prior in `[model.estimate]` is one of

- `{ low, high }`: uniform, or log-uniform with `scale = "log"`;
- `{ mean, sd }`: normal;
- `{ median, sd_log }`: log-normal, `sd_log` being the standard deviation of the natural logarithm;
- `{ half_sd }`: half-normal, from 0 up;

and with `each = true` each recording has its own value; otherwise all share one.
"""

from lostmotion.case.channels import check_same_sensors
from lostmotion.case.drive_levels import Level, Measured
from lostmotion.case.prior import Prior
from lostmotion.case.reading import GUESSED, WRITTEN, CaseFile, Experiment, SensorSpec, load_case
from lostmotion.case.write import dump_case, format_case
from lostmotion.recording import Channel, RecordingSpec

__all__ = [
    "GUESSED", "WRITTEN", "CaseFile", "Channel", "Experiment", "Level", "Measured", "Prior", "RecordingSpec",
    "SensorSpec", "check_same_sensors", "dump_case", "format_case", "load_case",
]  # fmt: skip
