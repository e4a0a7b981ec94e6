"""What a case file says: the recordings, the model, what is known and what is to be estimated.

Beyond `title`, `[[recordings]]` and `[model]` a case may hold:

- `plugins = ["file.py"]`: files, relative to the case, that bring models or terms of their own;
- `[truth]`: true values of parameters, where there are any; they are drawn in the report and used for nothing else;
- per recording `name` (in results; the stem of the file otherwise), `hold = "step"` when a digital controller holds
  the excitation between samples ("smooth" otherwise), `t_start` and `t_end` (s) to cut out a piece;
- per channel `factor`, which multiplies the column before the unit is applied, for instance newtons per volt.
"""

from lostmotion.case.load import Case, load_case
from lostmotion.case.prior import Prior
from lostmotion.case.write import dump_case
from lostmotion.recording import Channel, RecordingSpec

__all__ = ["Case", "Channel", "Prior", "RecordingSpec", "dump_case", "load_case"]
