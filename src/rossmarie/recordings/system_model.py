"""A system model, as text in the rule language, of what a recording holds."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rossmarie.recordings.errors import RecordingError, RecordingUntyped, at_file
from rossmarie.recordings.model import Recording, Topic

_TYPE = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*")
_TOPIC = re.compile(r"/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*", re.ASCII)


def write_model(recording: Recording) -> str:
    """The topics of a recording with their types, and in comments how many messages they carry.

    What the rule language cannot name is left as a comment. Raises `RecordingError` if the
    recording does not know types (CSV).
    """
    topics = sorted(recording.topics.values(), key=lambda topic: topic.name)
    if any(topic.message_type is None for topic in topics) or not topics:
        raise RecordingError(at_file(RecordingUntyped(), recording.path))
    lines = [_line(topic) for topic in topics]
    width = max(len(line) for line in lines)
    seconds = (recording.end_ns - recording.start_ns) / 1e9
    remarks = [_remark(topic, seconds) for topic in topics]
    body = [f"{line:<{width}} // {remark}" for line, remark in zip(lines, remarks, strict=True)]
    title = f"// Written from {recording.path.name}: {seconds:.1f} s."
    opening = f"system {_identifier(recording.path.stem)} {{"
    return "\n".join([title, opening, *_definitions(topics), *body, "}", ""])


def _line(topic: Topic) -> str:
    name = topic.name if topic.name.startswith("/") else f"/{topic.name}"
    declaration = f"topic {name} : {topic.message_type};"
    can_be_named = _TYPE.fullmatch(topic.message_type or "") and _TOPIC.fullmatch(topic.name)
    return f"    {declaration}" if can_be_named else f"    // {declaration}"


def _remark(topic: Topic, seconds: float) -> str:
    messages = "1 message" if topic.count == 1 else f"{topic.count} messages"
    rate = f", {topic.count / seconds:.1f} Hz" if topic.count > 1 and seconds > 0 else ""
    return messages + rate


def _definitions(topics: list[Topic]) -> Iterator[str]:
    """A hint if there are types that the rule language does not know by itself."""
    from rossmarie.recordings.definitions import is_standard  # imports rosbags, which is slow

    types = {topic.message_type or "" for topic in topics}
    own = sorted(name for name in types if _TYPE.fullmatch(name) and not is_standard(name))
    if own:
        yield f"    // not in the standard packages: {', '.join(own)}"
        yield '    // messages "msg";  // name the folder with their .msg files'


def _identifier(name: str) -> str:
    identifier = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_")
    return identifier if identifier[:1].isalpha() else f"recording_{identifier}".rstrip("_")
