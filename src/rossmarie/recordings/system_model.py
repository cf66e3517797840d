"""A system model as text in the rule language, written from a recording."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Sequence
from pathlib import PurePosixPath

from rossmarie.recordings.errors import RecordingError, RecordingUntyped, at_file
from rossmarie.recordings.model import FramesFound, RecordedTopic, Recording, Transforms
from rossmarie.syntax.words import RESERVED

_TYPE = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*", re.ASCII)
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_TENTH_NS = 100_000_000
_TOPIC = re.compile(r"/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*", re.ASCII)


MESSAGES = "msg"
"""The folder beside a model, with the definitions from its recording."""


def definition_path(name: str) -> PurePosixPath:
    """The place of the .msg file of a type such as `my_msgs/Wheel`, relative to the model's
    folder.
    """
    package, _, short = name.partition("/")
    return PurePosixPath(MESSAGES, package, "msg", f"{short}.msg")


def write_model(
    recording: Recording,
    definitions: Collection[str] | None = None,
    frames: FramesFound | None = None,
) -> str:
    """The frames and the topics of a recording, with types, and with numbers of messages as
    comments.

    `definitions` are the types whose .msg files are at `definition_path`; None if these files are
    not written. `frames` are the frames of the recording, if they are already known. Names that the
    rule language cannot express become comments, and so do topics without a definition. Raises
    `RecordingError` if the recording has no types (CSV).
    """
    topics = sorted(recording.topics.values(), key=lambda topic: topic.name)
    if any(topic.message_type is None for topic in topics) or not topics:
        raise RecordingError(at_file(RecordingUntyped(), recording.path))
    frames = recording.frames() if frames is None else frames
    lines = [_frame(each, frames.transforms) for each in frames.transforms]
    own = _own(topics)
    missing = own.difference(definitions) if definitions is not None else set()
    lines += [_line(topic, frames.headers.get(topic.name), missing) for topic in topics]
    width = max(len(line) for line in lines)
    seconds = (recording.end_ns - recording.start_ns) / 1e9
    counts = [*(each.count for each in frames.transforms), *(each.count for each in topics)]
    remarks = [_remark(count, seconds) for count in counts]
    body = [f"{line:<{width}} // {remark}" for line, remark in zip(lines, remarks, strict=True)]
    title = f"// Written from {recording.path.name}: {seconds:.1f} s."
    opening = f"system {_identifier(recording.path.stem)} {{"
    hints = _definitions(own, definitions)
    return "\n".join([title, opening, *hints, *body, "}", ""])


def _frame(transforms: Transforms, every: Sequence[Transforms]) -> str:
    """The declaration of a frame with transforms. The timeout of a moving frame tolerates one
    missing transform. If a frame lies in two frames, the user has to decide.
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


def can_be_declared(topic: RecordedTopic, definitions: Collection[str] = ()) -> bool:
    """Say whether a system model can declare a topic. Its name and type must be words of the rule
    language, and its type must be standard or among the definitions.
    """
    from rossmarie.recordings.definitions import is_standard  # imports rosbags, which is slow

    name = topic.message_type or ""
    if not (_TYPE.fullmatch(name) and _TOPIC.fullmatch(topic.name)):
        return False
    return is_standard(name) or name in definitions


def _line(topic: RecordedTopic, frame: str | None, undefined: Collection[str]) -> str:
    name = topic.name if topic.name.startswith("/") else f"/{topic.name}"
    source = "" if frame is None or '"' in frame else f" from {_frame_name(frame)}"
    declaration = f"topic {name} : {topic.message_type}{source};"
    type_name = topic.message_type or ""
    can_be_named = _TYPE.fullmatch(type_name) and _TOPIC.fullmatch(topic.name)
    is_known = can_be_named and type_name not in undefined
    return f"    {declaration}" if is_known else f"    // {declaration}"


def _remark(count: int, seconds: float) -> str:
    messages = "1 message" if count == 1 else f"{count} messages"
    rate = f", {count / seconds:.1f} Hz" if count > 1 and seconds > 0 else ""
    return messages + rate


def _own(topics: Sequence[RecordedTopic]) -> set[str]:
    """The types that are not built into the rule language."""
    from rossmarie.recordings.definitions import is_standard  # imports rosbags, which is slow

    types = {topic.message_type or "" for topic in topics}
    return {name for name in types if _TYPE.fullmatch(name) and not is_standard(name)}


def _definitions(own: set[str], definitions: Collection[str] | None) -> Iterator[str]:
    """The folder with the definitions of the user's types, or hints if the folder is missing."""
    if definitions:
        yield f'    messages "{MESSAGES}";'
    missing = sorted(own.difference(definitions or ()))
    if missing:
        yield f"    // not in the standard packages: {', '.join(missing)}"
    if missing and not definitions:
        yield f'    // messages "{MESSAGES}";  // name the folder with their .msg files'


def _identifier(name: str) -> str:
    identifier = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_")
    return identifier if identifier[:1].isalpha() else f"recording_{identifier}".rstrip("_")
