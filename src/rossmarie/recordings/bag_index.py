"""ROS 1 bags whose index stays in the file: it is read chunk by chunk, as columns.

rosbags creates an object for each message when it opens a bag. Here rosbags reads everything except
the index.
"""

from __future__ import annotations

import struct
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rosbags import rosbag1
from rosbags.rosbag1.reader import Chunk, Header, IndexData, read_bytes

_ENTRY = np.dtype([("seconds", "<u4"), ("nanoseconds", "<u4"), ("offset", "<u4")])
_ENTRIES = np.dtype([("at_ns", "<i8"), ("offset", "<i8")])
_NUMBER = struct.Struct("<I")
_HEAD = 55
"""The bytes before the entries: a header, the header's length, and the length of the entries."""


class IndexedBag(rosbag1.Reader):
    """A reader of a bag. `spans` are the first and the last stamp in each chunk with messages,
    `sizes` the bytes in it; both have the chunk's position in the file as key.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self.spans: dict[int, tuple[int, int]] = {}
        self.sizes: dict[int, int] = {}
        self._counts: Counter[int] = Counter()
        self._places: dict[int, tuple[int, int]] = {}

    def open(self) -> None:
        """Open the bag."""
        super().open()
        if len(self.chunks) < len(self.chunk_infos):
            self.close()
            raise rosbag1.ReaderError("The index names a chunk twice.")
        self.connections = [
            each._replace(msgcount=self._counts[each.id]) for each in self.connections
        ]

    def read_chunk(self) -> Chunk:
        """The head of the chunk that begins here."""
        assert self.bio is not None, "the bag is open"
        position = self.bio.tell()
        size = int.from_bytes(Header.read(self.bio).get("size", b""), "little")
        self.bio.seek(position)
        chunk = super().read_chunk()
        self.sizes[position] = max(size, chunk.datasize)
        return chunk

    def read_index_data(self, pos: int, _: dict[int, list[IndexData]]) -> None:
        """Note the place, the count and the stamps of an index record after a chunk; rosbags calls
        this function.
        """
        assert self.bio is not None, "the bag is open"
        first, count = self._places.get(pos, (self.bio.tell(), 0))
        self._places[pos] = first, count + 1
        number, entries = self._record()
        self._counts[number] += len(entries)
        if len(entries):
            stamps = entries["at_ns"]
            start, end = self.spans.get(pos, (stamps[0], stamps[0]))
            self.spans[pos] = min(start, int(stamps.min())), max(end, int(stamps.max()))

    def entries(self, position: int) -> Iterator[tuple[int, NDArray[np.void]]]:
        """The messages in a chunk: for each of its index records, the number of a connection, and
        the stamps (`at_ns`) and places in the chunk (`offset`) of its messages.
        """
        assert self.bio is not None, "the bag is open"
        place, count = self._places.get(position, (0, 0))
        for _ in range(count):
            self.bio.seek(place)
            yield self._record()
            place = self.bio.tell()

    def _record(self) -> tuple[int, NDArray[np.void]]:
        """The index record that begins here."""
        assert self.bio is not None, "the bag is open"
        if self.index_data_header_offsets is None:  # rosbags finds them in the first record
            place = self.bio.tell()
            super().read_index_data(0, defaultdict(list))
            self.bio.seek(place)
        assert self.index_data_header_offsets is not None, "rosbags has looked for them"
        head = self.bio.read(_HEAD)
        places = (*self.index_data_header_offsets, _HEAD - 4)
        number, count, size = (_NUMBER.unpack_from(head, place)[0] for place in places)
        if size != count * _ENTRY.itemsize:
            raise rosbag1.ReaderError("An index record has another size than its entries.")
        stored = np.frombuffer(read_bytes(self.bio, size), _ENTRY)
        entries = np.empty(len(stored), _ENTRIES)
        entries["at_ns"] = stored["seconds"].astype(np.int64) * 10**9 + stored["nanoseconds"]
        entries["offset"] = stored["offset"]
        return number, entries
