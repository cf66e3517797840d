"""Opening a recording by its path."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rossmarie.recordings.csv_table import CsvRecording
from rossmarie.recordings.files import recording_files
from rossmarie.recordings.model import Recording


def open_recording(path: Path, message_folders: Sequence[Path] = ()) -> Recording:
    """Open a ROS 1 .bag, a ROS 2 .db3 or .mcap or the directory that contains it, or a .csv.

    `message_folders` contain the .msg files of types that neither the recording nor a standard
    package of ROS defines. The readable part of a damaged file is opened, see `Recording.findings`.
    Raises `RecordingError` if nothing can be read.
    """
    files = recording_files(path)
    if files[0].suffix == ".csv":
        return CsvRecording(files[0])
    # rosbags is slow to import, and only needed for bags.
    from rossmarie.recordings.bag_opening import open_bag

    return open_bag(path, files, message_folders)
