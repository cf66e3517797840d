"""ROSS6xx: recordings, and how they fit the rules that run over them.

A problem with a topic or a field is a warning at the input that reads it: readable values are still
used. A problem with a whole file has no place in a rules file. It is reported at the start of the
file itself, and is a `RecordingError` only if nothing can be read.
"""

from __future__ import annotations

from pathlib import Path

from dslkit.diagnostics import Diagnostic, Error, Remark, Template, Warning
from dslkit.source import SourceFile, Span


class RecordingError(Exception):
    """A recording cannot be read, or no report can be written about it. `diagnostic` gives the
    reason.
    """

    def __init__(self, diagnostic: Diagnostic) -> None:
        self.diagnostic = diagnostic
        path = diagnostic.primary.span.file.path
        texts = (diagnostic.title, diagnostic.primary.text, diagnostic.help)
        super().__init__(
            f"{path}: [{diagnostic.code}] " + "; ".join(text for text in texts if text)
        )


def at_file(finding: Template, path: Path, help: Remark | None = None) -> Diagnostic:
    """A finding about a recording as a whole."""
    return finding.at(Span(SourceFile(str(path), ""), 0, 0), help=help)


class TopicLeftOut(Remark):
    """The note that tells why a topic or a column is not read."""

    says = "{title}; {help}"
    title: str
    help: str


# --- a topic or a field, at the input that reads it ------------------------------------------


class TopicNotRecorded(Warning, code="ROSS601", name="topic-not-recorded"):
    """An input whose topic is not in the recording."""

    title = "`{topic}` is not in the recording"
    label = "this input stays unknown in this replay"
    note = "the recording holds {recorded}"
    help = (
        "replay a recording that has this topic, or give the recorded name: `--topic-map "
        "{read_as}=NAME`"
    )
    topic: str
    read_as: str
    recorded: str

    class Near(Remark):
        says = "did you mean `{near}`? then add `--topic-map {topic}={near}`"
        near: str
        topic: str


class TopicOfAnotherType(Warning, code="ROSS602", name="topic-of-another-type"):
    """An input whose topic was recorded with another message type."""

    title = "`{topic}` was recorded as {recorded}"
    label = "this input expects {expected}, and stays unknown in this replay"
    help = "declare the input as {recorded}, or check that `{topic}` is the right topic"
    topic: str
    recorded: str
    expected: str


class TopicNeverSent(Warning, code="ROSS603", name="topic-never-sent"):
    """An input whose topic is in the recording, without a single message."""

    title = "`{topic}` is in the recording, but has no messages"
    label = "this input stays unknown in this replay"
    help = "check that the publisher of `{topic}` was running during the recording"
    topic: str


class FieldNotRecorded(Warning, code="ROSS604", name="field-not-recorded"):
    """A field that a recorded topic does not have, or not as a value of this kind."""

    title = "the recorded `{topic}` has no field `{field}` that holds {kind}"
    label = "this field stays unknown in this replay"
    note = "{reason}"
    help = "record again with {field}, or read another field"
    topic: str
    field: str
    kind: str
    reason: str

    class NoColumn(Remark):
        says = "add a column `{column}`"
        column: str

    class OtherCloud(Remark):
        says = "record again with point clouds in the ROS layout of {message_type}"
        message_type: str

    class OtherScan(Remark):
        says = "record again with laser scans in the ROS layout of {message_type}"
        message_type: str

    class Beams(Remark):
        says = "a CSV table cannot hold laser scans: replay the bag or the MCAP file"

    class Points(Remark):
        says = "a CSV table cannot hold point clouds: replay the bag or the MCAP file"


class NameNeverRecorded(Warning, code="ROSS609", name="name-never-recorded"):
    """An element that goes by a name that no recorded message has."""

    title = "no message on `{topic}` has an element `{element}`"
    label = "`{field}` stays unknown in this replay"
    note = "the recorded elements are {names}"
    topic: str
    element: str
    field: str
    names: str

    class Check(Remark):
        says = "check the name, and check that this robot made the recording"


class LengthNeverRecorded(Warning, code="ROSS619", name="length-never-recorded"):
    """Elements with declared names, of an array that never has as many elements."""

    title = "`{field}` on `{topic}` never has {count} elements (one for each name)"
    label = "elements with these names stay unknown in this replay"
    note = "the array has {lengths}"
    help = "correct the list of names, or replay a recording of this robot"
    topic: str
    field: str
    count: int
    lengths: str


class SkillsOfAnotherExport(Warning, code="ROSS624", name="skills-of-another-export"):
    """A topic that tells which skills run, never of those that the rules were checked with."""

    title = "the skills on `{topic}` come from another export than the skills of the rules"
    label = "the replay cannot tell which of these skills run"
    note = "the rules use the export {known}, the recording has {recorded}"
    help = "check the rules with the `skills.json` of the recorded robot"
    topic: str
    known: str
    recorded: str


class MessagesUnreadable(Warning, code="ROSS605", name="messages-unreadable"):
    """Messages of a topic, or cells of a CSV file, that are not what they should be."""

    title = "{count} of {total} {what} cannot be read"
    label = "this input is unknown at these times"
    note = "the first one, {seconds:.3f} s into the recording: {reason}"
    help = "check the recording; its type definitions must be the definitions used for recording"
    what: str
    count: int
    total: int
    seconds: float
    reason: str

    class Cells(Remark):
        says = "correct these cells, or leave them empty (an empty cell is unknown)"


class DefinitionMissing(Warning, code="ROSS606", name="definition-missing"):
    """A topic with a type whose definition is unknown."""

    title = "there is no definition of {type_name}, the type of `{topic}`"
    label = "this input stays unknown in this replay"
    note = "{reason}"
    help = "give the folder that holds {type_name} as a .msg file: `--messages DIR`"
    type_name: str
    topic: str
    reason: str


class MessagesPassedOver(Warning, code="ROSS608", name="messages-passed-over"):
    """Messages of a topic that are skipped: rules do not read them, or their instant is not
    possible.
    """

    title = "{count} of {total} messages on `{topic}` are skipped"
    label = "this input does not receive the skipped messages"
    note = "{reason}"
    help = "check what else was sent on `{topic}` during the recording"
    topic: str
    count: int
    total: int
    reason: str


# --- the command line ------------------------------------------------------------------------


class TopicMapUnused(Error, code="ROSS607", name="topic-map-unused"):
    """A topic map that renames a topic which no rule reads."""

    title = "no rule reads the topic `{topic}`"
    label = "write the topic of the rules left of `=`, and the recorded topic right of `=`"
    help = "the rules read {known}"
    topic: str
    known: str

    class Near(Remark):
        says = "did you mean `{near}={recorded}`?"
        near: str
        recorded: str


# --- a file as a whole -----------------------------------------------------------------------


class RecordingNotFound(Error, code="ROSS610", name="recording-not-found"):
    """A path without a file."""

    title = "there is no recording at this path"

    class CheckPath(Remark):
        says = "check the path"


class RecordingUnreadable(Error, code="ROSS611", name="recording-unreadable"):
    """A file that the operating system cannot open."""

    title = "the recording cannot be opened: {reason}"
    help = "check the read permission of the file"
    reason: str


class RecordingKindUnknown(Error, code="ROSS612", name="recording-kind-unknown"):
    """A file or directory that is not a recording of a known kind."""

    title = "{reason}"
    help = (
        "name a ROS 1 .bag, a ROS 2 .db3 or .mcap or the directory that holds one, or a .csv whose "
        "first column is `time`"
    )
    reason: str


class RecordingEmpty(Error, code="ROSS613", name="recording-empty"):
    """A recording without a message."""

    title = "the recording is empty: {reason}"
    help = "record again, and wait until the recorder reports that it has subscribed"
    reason: str


class RecordingCorrupt(Error, code="ROSS614", name="recording-corrupt"):
    """A file without readable content."""

    title = "nothing in this recording can be read: {reason}"
    help = "check that the file was copied completely, and that the extension matches the content"
    reason: str


class RecordingDamaged(Warning, code="ROSS615", name="recording-damaged"):
    """A file with partly readable content."""

    title = "the recording is damaged: {reason}"
    note = "{kept} messages could be read and are used"
    help = "expect gaps: an input with a timeout is stale where its messages are missing"
    reason: str
    kept: int


class NothingToReplay(Error, code="ROSS616", name="nothing-to-replay"):
    """A recording without any message that the rules read."""

    title = "the recording holds nothing that the rules read"
    note = "the rules read {expected}; the recording holds {recorded}"
    help = "name the recorded topics with `--topic-map TOPIC=RECORDED`"
    expected: str
    recorded: str

    class Columns(Remark):
        says = "name each column after an input, or after a field of a topic: `/topic.field`"


class RecordingUntyped(Error, code="ROSS617", name="recording-untyped"):
    """A system model is requested from a recording without types."""

    title = "a CSV file does not contain the message types of its topics"
    help = "write the system model from a .bag, .db3 or .mcap file, or by hand"


class ClockSetBack(Warning, code="ROSS618", name="clock-set-back"):
    """A recording whose stamps go back, in the order in which its messages were stored."""

    title = "the timestamps go back {often}, by up to {length}"
    label = "the clock was set back during the recording"
    note = "{effect}"
    help = "record again, or replay the parts before and after each jump separately"
    often: str
    length: str
    effect: str


# --- CSV -------------------------------------------------------------------------------------


class TimeColumnMissing(Error, code="ROSS620", name="time-column-missing"):
    """A CSV file whose first column is not the time."""

    title = "the first column is not the time"
    label = "expected `time`, `t` or `stamp` (seconds) or `time_ns`"
    help = "name the time column `time`, and put it first"


class RowsSkipped(Warning, code="ROSS621", name="rows-skipped"):
    """Rows of a CSV file that do not consist of an instant and values."""

    title = "{count} of {total} rows are skipped"
    label = "{reason}"
    help = "give every row a time, and as many cells as there are columns"
    count: int
    total: int
    reason: str


class ColumnRepeated(Error, code="ROSS622", name="column-repeated"):
    """Two columns of one name."""

    title = "two columns are named `{column}`"
    label = "an earlier column has this name"
    help = "give each column a unique name, or remove one of the two columns"
    column: str


class ColumnMissing(Warning, code="ROSS623", name="column-missing"):
    """An input without a CSV column of its name."""

    title = "no column is named after the input `{input}`"
    label = "this input stays unknown in this replay"
    note = "columns that no input reads: {unread}"
    help = "add {expected}, or rename the column that holds it"
    input: str
    unread: str
    expected: str

    class Near(Remark):
        says = "did you mean `{near}`? then name this column `{expected}`"
        near: str
        expected: str


ALL: tuple[type[Template], ...] = (
    TopicNotRecorded,
    TopicOfAnotherType,
    TopicNeverSent,
    FieldNotRecorded,
    NameNeverRecorded,
    LengthNeverRecorded,
    SkillsOfAnotherExport,
    MessagesUnreadable,
    DefinitionMissing,
    MessagesPassedOver,
    TopicMapUnused,
    RecordingNotFound,
    RecordingUnreadable,
    RecordingKindUnknown,
    RecordingEmpty,
    RecordingCorrupt,
    RecordingDamaged,
    NothingToReplay,
    RecordingUntyped,
    ClockSetBack,
    TimeColumnMissing,
    RowsSkipped,
    ColumnRepeated,
    ColumnMissing,
)
