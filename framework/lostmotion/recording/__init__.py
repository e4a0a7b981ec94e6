"""What was recorded: files of several formats, read, checked and turned into SI units."""

from lostmotion.recording.formats import ENDINGS, read_columns, read_table
from lostmotion.recording.load import Recording, load_recording
from lostmotion.recording.spec import Channel, Hold, RecordingSpec
from lostmotion.recording.table import Table

__all__ = [
    "ENDINGS", "Channel", "Hold", "Recording", "RecordingSpec", "Table", "load_recording", "read_columns", "read_table",
]  # fmt: skip
