"""ROS 2 .db3 files that rosbags does not read: cut short, or with damaged pages.

Rows are read from both ends, in the order in which they were written, up to the damage.
"""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import replace
from pathlib import Path

from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat

from rossmarie.recordings.clock import Arrivals, by_topic
from rossmarie.recordings.stored import Packed, RecordedConnection, Stored, packed, plain_type
from rossmarie.recordings.tables import check_tables

_FORMATS = {"ros2msg": MessageDefinitionFormat.MSG, "ros2idl": MessageDefinitionFormat.IDL}
_UNDEFINED = MessageDefinition(MessageDefinitionFormat.NONE, "")


def salvage_sqlite(path: Path) -> SalvagedRows:
    """The readable rest of a .db3 file. Raises `ValueError` if the file is not a recording."""
    return SalvagedRows(path)


class SalvagedRows:
    """The messages in the readable rows, in the order of their stamps."""

    def __init__(self, path: Path) -> None:
        uri = f"{path.absolute().as_uri()}?mode=ro&immutable=1"
        try:
            self._database = sqlite3.connect(uri, uri=True)
        except sqlite3.Error as error:
            raise ValueError(f"its database cannot be opened ({error})") from error
        try:
            # Without this, SQLite refuses a file that is shorter than its header states.
            self._database.execute("PRAGMA writable_schema = ON")
            check_tables(self._database.execute)
            found = {connection.id: connection for connection in self._read_connections()}
        except (sqlite3.Error, ValueError) as error:
            self._database.close()
            raise ValueError(f"it is not a ROS 2 database ({error})") from error
        self.loss: str | None = None
        rows = {row: (at_ns, topic) for row, topic, at_ns in self._read_rows("ASC")}
        if self.loss is not None:
            rows |= {row: (at_ns, topic) for row, topic, at_ns in self._read_rows("DESC")}
        counts = Counter(topic for _, topic in rows.values())
        self._by_id = {
            number: replace(connection, count=counts[number])
            for number, connection in found.items()
        }
        self.connections = list(self._by_id.values())
        known = ((at_ns, row, topic) for row, (at_ns, topic) in rows.items() if topic in found)
        self._rows = sorted(known)  # ordered by their stamps

    def span(self) -> tuple[int, int] | None:
        """The stamps of the first and the last message; None if there is none."""
        return (self._rows[0][0], self._rows[-1][0]) if self._rows else None

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        """The messages on some topics."""
        for at_ns, row, topic in self._rows:
            connection = self._by_id[topic]
            if connection.topic in topics:
                content = self._content(row)
                if content is not None:
                    yield Stored(connection, at_ns, content)

    def batches(self, topics: Collection[str]) -> Iterator[Packed]:
        """The same messages in batches."""
        return packed(self.messages(topics))

    def arrivals(self) -> Iterator[Arrivals]:
        """All messages. The messages of each topic have the order in which they were stored."""
        stored = sorted(self._rows, key=lambda row: row[1])
        return by_topic((self._by_id[topic].topic, at_ns) for at_ns, _, topic in stored)

    def close(self) -> None:
        """Release the file."""
        self._database.close()

    def _content(self, row: int) -> bytes | None:
        query = "SELECT data FROM messages WHERE id = ? AND typeof(data) = 'blob'"
        try:
            found: tuple[bytes] | None = self._database.execute(query, (row,)).fetchone()
        except sqlite3.Error:
            return None  # the row exists, but an overflow page of its content does not
        return None if found is None else found[0]

    def _read_rows(self, direction: str) -> Iterator[tuple[int, int, int]]:
        """The row, topic and stamp of the messages, up to the first unreadable message."""
        try:
            yield from self._database.execute(
                "SELECT id, topic_id, timestamp FROM messages NOT INDEXED "
                "WHERE typeof(topic_id) = 'integer' AND typeof(timestamp) = 'integer' "
                f"ORDER BY id {direction}"
            )
        except sqlite3.Error as error:
            self.loss = f"its database breaks off ({error})"

    def _read_connections(self) -> Iterator[RecordedConnection]:
        definitions = dict(self._read_definitions())
        for number, topic, message_type, encoding in self._database.execute(
            "SELECT id, name, type, serialization_format FROM topics WHERE typeof(id) = 'integer' "
            "AND typeof(name) = 'text' AND typeof(type) = 'text'"
        ):
            definition = definitions.get(message_type, _UNDEFINED)
            yield RecordedConnection(
                number, topic, plain_type(message_type), str(encoding), definition, 0
            )

    def _read_definitions(self) -> Iterator[tuple[str, MessageDefinition]]:
        """The definitions in the database. ROS 2 writes them since Iron."""
        try:
            for message_type, encoding, text in self._database.execute(
                "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
            ):
                form = _FORMATS.get(encoding, MessageDefinitionFormat.NONE)
                yield message_type, MessageDefinition(form, str(text))
        except sqlite3.Error:
            return
