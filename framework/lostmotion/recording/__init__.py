"""Recordings: files of several formats are read, checked and converted to SI units."""

from lostmotion.recording.arrays import table_of_arrays
from lostmotion.recording.formats import ENDINGS, read_columns, read_table
from lostmotion.recording.load import Recording, load_recording
from lostmotion.recording.spec import Channel, Hold, RecordingSpec
from lostmotion.recording.table import Table

__all__ = [
    "ENDINGS", "Channel", "Hold", "Recording", "RecordingSpec", "Table", "load_recording", "read_columns", "read_table",
    "table_of_arrays",
]  # fmt: skip
