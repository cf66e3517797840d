"""A system model, as text in the rule language, of what a recording holds."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from rossmarie.recordings.errors import RecordingError, RecordingUntyped, at_file
from rossmarie.recordings.model import Recording, Topic, Transforms
from rossmarie.syntax.words import RESERVED

_TYPE = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*")
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_TENTH_NS = 100_000_000
_TOPIC = re.compile(r"/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*", re.ASCII)


def write_model(recording: Recording) -> str:
    """The frames and the topics of a recording, with types, and in comments how many messages there
    are.

    What the rule language cannot name is left as a comment. Raises `RecordingError` if the
    recording does not know types (CSV).
    """
    topics = sorted(recording.topics.values(), key=lambda topic: topic.name)
    if any(topic.message_type is None for topic in topics) or not topics:
        raise RecordingError(at_file(RecordingUntyped(), recording.path))
    frames = recording.frames()
    lines = [_frame(each, frames.transforms) for each in frames.transforms]
    lines += [_line(topic, frames.headers.get(topic.name)) for topic in topics]
    width = max(len(line) for line in lines)
    seconds = (recording.end_ns - recording.start_ns) / 1e9
    counts = [*(each.count for each in frames.transforms), *(each.count for each in topics)]
    remarks = [_remark(count, seconds) for count in counts]
    body = [f"{line:<{width}} // {remark}" for line, remark in zip(lines, remarks, strict=True)]
    title = f"// Written from {recording.path.name}: {seconds:.1f} s."
    opening = f"system {_identifier(recording.path.stem)} {{"
    return "\n".join([title, opening, *_definitions(topics), *body, "}", ""])


def _frame(transforms: Transforms, every: Sequence[Transforms]) -> str:
    """A frame of which there are transforms. The timeout of one that moves leaves room for one that
    is missed. One that lies in two frames has to be looked at by the user.
    """
    declaration = f"frame {_frame_name(transforms.child)} in {_frame_name(transforms.parent)}"
    if not transforms.is_static:
        tenths = max(1, math.ceil(2 * transforms.longest_ns / _TENTH_NS))
        declaration += f" timeout {tenths / 10:g} sec"
    parents = [each.parent for each in every if each.child == transforms.child]
    can_be_named = '"' not in transforms.child + transforms.parent and len(parents) == 1
    return f"    {'' if can_be_named else '// '}{declaration};"


def _frame_name(name: str) -> str:
    return name if _NAME.fullmatch(name) and name not in RESERVED else f'"{name}"'


def _line(topic: Topic, frame: str | None) -> str:
    name = topic.name if topic.name.startswith("/") else f"/{topic.name}"
    source = "" if frame is None or '"' in frame else f" from {_frame_name(frame)}"
    declaration = f"topic {name} : {topic.message_type}{source};"
    can_be_named = _TYPE.fullmatch(topic.message_type or "") and _TOPIC.fullmatch(topic.name)
    return f"    {declaration}" if can_be_named else f"    // {declaration}"


def _remark(count: int, seconds: float) -> str:
    messages = "1 message" if count == 1 else f"{count} messages"
    rate = f", {count / seconds:.1f} Hz" if count > 1 and seconds > 0 else ""
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
