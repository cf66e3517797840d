"""Recordings of robots, as updates for a monitor.

`open_recording` opens ROS 1 and ROS 2 bags, MCAP and CSV; `Recording.batches` gives what they say
to a machine, in the order of time, and `updates_in` the updates in that.
"""

from rossmarie.recordings.batches import begun_together, updates_in
from rossmarie.recordings.errors import ALL, RecordingError
from rossmarie.recordings.model import Recording, Topic, Update
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.system_model import definition_path, write_model

__all__ = [
    "ALL",
    "Recording",
    "RecordingError",
    "Topic",
    "Update",
    "begun_together",
    "definition_path",
    "open_recording",
    "updates_in",
    "write_model",
]
