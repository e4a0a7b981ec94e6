"""What was recorded: files of several formats, read, checked and turned into SI units."""

from lostmotion.recording.formats import ENDINGS, read_columns
from lostmotion.recording.load import Recording, load_recording
from lostmotion.recording.spec import Channel, Hold, RecordingSpec

__all__ = ["ENDINGS", "Channel", "Hold", "Recording", "RecordingSpec", "load_recording", "read_columns"]
