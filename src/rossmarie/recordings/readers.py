"""The readers of rosbags, with limits that apply before memory is used.

rosbags decompresses any amount of data, and reads any YAML in a file. This module sets the limits.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

from rosbags import rosbag2
from rosbags.rosbag1 import reader as bag_reader
from rosbags.rosbag2 import reader as folder_reader
from rosbags.rosbag2 import storage_mcap, storage_sqlite3
from rosbags.rosbag2.metadata import parse_qos
from rosbags.rosbag2.reader import DirectoryReader
from rosbags.rosbag2.storage_mcap import McapReader

from rossmarie.recordings.bag_index import IndexedBag
from rossmarie.recordings.compression import decompress
from rossmarie.recordings.files import METADATA
from rossmarie.recordings.limits import Allowance, check_yaml
from rossmarie.recordings.tables import check_tables


class _Mcap(McapReader):
    """An MCAP file with an index. rosbags would decompress a file without an index completely, to
    count the messages. The salvage reads such a file within its allowance.
    """

    def meta_scan(self) -> None:
        """Refuse to count the messages."""
        raise rosbag2.ReaderError("it has no index")


class _Folder(DirectoryReader):
    STORAGE_PLUGINS: Mapping[str, Any] = {**DirectoryReader.STORAGE_PLUGINS, "mcap": _Mcap}


class _Reader(rosbag2.Reader):
    STORAGE_PLUGINS: Mapping[str, Any] = {
        **rosbag2.Reader.STORAGE_PLUGINS,
        "dir": _Folder,
        ".mcap": _Mcap,
    }


def open_bag_reader(path: Path, allowance: Allowance) -> IndexedBag:
    """An open reader of a ROS 1 bag, whose chunks are decompressed within the allowance."""
    reader = IndexedBag(path)
    reader.open()
    names = {function: name for name, function in bag_reader.decompressors.items()}
    for position, chunk in reader.chunks.items():
        name = names[chunk.decompressor]
        limited = partial(decompress, name, allowance=allowance)
        reader.chunks[position] = chunk._replace(decompressor=limited)
    return reader


def open_ros2_reader(path: Path, allowance: Allowance) -> tuple[rosbag2.Reader, bool]:
    """An open reader, and whether its messages are compressed one by one. The reader does not
    decompress such messages.
    """
    if path.is_dir():
        check_yaml((path / METADATA).read_text(encoding="utf-8"))
    reader = _Reader(path)
    with ExitStack() as opened:
        reader.open()
        opened.callback(reader.close)
        for part in parts_of(reader):
            if isinstance(part, McapReader):
                allowance.take(sum(chunk.uncompressed_size for chunk in part.chunks))
            elif part.dbconn is not None:
                check_tables(part.dbconn.execute)
        is_packed = reader.compression_mode == "message"
        if is_packed:
            metadata = reader.storage.metadata
            reader.storage.metadata = metadata._replace(compression_mode=None)
        opened.pop_all()  # the caller closes the reader
    return reader, is_packed


def parts_of(reader: rosbag2.Reader) -> list[Any]:
    """The readers of the files of a recording."""
    return list(getattr(reader.storage, "storages", [reader.storage]))


def _decompress_chunk(compression: str, data: bytes, _: int) -> bytes:
    """A chunk of an MCAP file. The total size of all chunks has been checked before."""
    return decompress(compression, data, Allowance(len(data)))


def _parse_qos(profiles: Any) -> Any:
    if isinstance(profiles, str):
        check_yaml(profiles)
    return parse_qos(profiles)


for _name in ("lz4", "zstd"):
    storage_mcap.DECOMPRESSORS[_name] = partial(_decompress_chunk, _name)
for _module in (folder_reader, storage_mcap, storage_sqlite3):
    vars(_module)["parse_qos"] = _parse_qos
