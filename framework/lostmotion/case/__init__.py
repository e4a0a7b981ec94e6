"""What a case file says: what was measured, the model, what is known and what is to be estimated.

What was measured stands in `[[recordings]]`, or in `[[levels]]` where only measures of chaos are at hand; a command
says which of the two it wants. Beside them and `[model]` (`name`, `[model.known]`, `[model.estimate]`) a case may hold:

- `title`, a line of text;
- `plugins = ["file.py"]`: files, relative to the case, that bring models or terms of their own;
- `[truth]`: true values of parameters, where there are any; they are drawn in the report and used for nothing else;
- `[sensor]`: `noise = "each"` when each of several recordings has its own measurement noise and random force (as it
  is when nothing is said), `noise = "shared"` when they have them in common; `offset = { a prior }` when the zero of
  the response sensor is unknown, in each recording anew (SI unit of the channel).
- `[experiment]`: what the next experiment may ask of the machine, where a diagnosis proposes one: `max_level`, the
  largest amplitude (SI unit of the excitation; a signal of another form has the rms of such a sine), and
  `max_frequency` (Hz). Twice those of the recording when nothing is said.

Per recording: `file`; `time` (a column in seconds) or `rate` (Hz); `excitation` and `response`; `name` (in results; the
stem of the file otherwise); `hold = "step"` when a digital controller holds the excitation between samples ("smooth"
otherwise); `t_start` and `t_end` (s) to cut out a piece. Per channel: `column`, `quantity`, `unit`, and `factor`, which
multiplies the column before the unit is applied, for instance newtons per volt.

Per level of a sinusoidal drive: `amplitude` and its `unit` (of a force, a torque or a base motion); `frequency` (Hz)
or `omega` (rad/s); `name`; and what was measured there, at least one of `motion = "periodic"` or `"chaotic"`,
`lyapunov` (`unit = "1/s"` or `"bit/s"`) and `d2`. A measured number is `{ value, sd }`, or `{ value, low, high }` with
a 95 % interval.

A prior in `[model.estimate]` is one of

- `{ low, high }`: uniform, or log-uniform with `scale = "log"`;
- `{ mean, sd }`: normal;
- `{ median, sd_log }`: log-normal, `sd_log` being the standard deviation of the natural logarithm;
- `{ half_sd }`: half-normal, from 0 up;

and with `each = true` each recording has a value of its own, where otherwise all share one.
"""

from lostmotion.case.channels import check_alike
from lostmotion.case.levels import Level, Measured
from lostmotion.case.load import Case, Experiment, Sensor, load_case
from lostmotion.case.prior import Prior
from lostmotion.case.write import dump_case
from lostmotion.recording import Channel, RecordingSpec

__all__ = [
    "Case", "Channel", "Experiment", "Level", "Measured", "Prior", "RecordingSpec", "Sensor", "check_alike",
    "dump_case", "load_case",
]  # fmt: skip
