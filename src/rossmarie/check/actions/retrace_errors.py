"""Mistakes in `retrace` effects."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class NotAPose(Error, code="ROSS253", name="not-a-pose"):
    """A `retrace` of an expression that is not a pose from messages."""

    title = "`{identifier}` is not a pose that can be retraced"
    label = "this is {found}"
    note = (
        "a pose is an input, or a field of an input, with a position in m or a geometry_msgs/Pose"
    )
    help = "name an input that is a pose, or the pose in an input: `retrace INPUT.pose on ...`"
    identifier: str
    found: str


class MessageWithoutPose(Error, code="ROSS254", name="message-without-pose"):
    """A topic to retrace on whose messages have no such pose."""

    title = "a message of type {type} does not hold exactly one {pose}"
    label = "the poses would be published here"
    help = "use a topic of {examples}"
    type: str
    pose: str
    examples: str


class OddDistance(Error, code="ROSS255", name="odd-distance"):
    """An `apart` that is neither a distance nor a time, or is given twice."""

    title = "`apart` needs a distance or a time"
    label = "{found}"
    note = "without `apart`, the poses of a robot that stands still would fill the memory"
    help = "write for example `apart 1 cm`, `apart 0.2 sec` or `apart 1 cm, 0.2 sec`"
    found: str


class PoseCount(Error, code="ROSS428", name="pose-count"):
    """A number of poses that a memory cannot have."""

    title = "`up to` needs a whole number of poses, from 1 to {most}"
    label = "this is {found}"
    help = "write how many poses are kept, as in `up to 100`; a full memory drops the oldest pose"
    most: int
    found: str


class RetracedCommand(Error, code="ROSS429", name="retraced-command"):
    """A topic to retrace on that another node uses to command the robot."""

    title = "the poses would be mixed with other commands on {topic}"
    label = "a node publishes on this topic, or an action bounds it"
    note = "a robot that gets two targets in turn reaches neither"
    help = (
        "retrace on a separate topic, and let the controller prefer this topic while it has "
        "messages"
    )
    topic: str


class PosesInAll(Error, code="ROSS430", name="poses-in-all"):
    """Memories of poses that together exceed the capacity of a monitor."""

    title = "all memories together hold more than {most} poses"
    label = "with this memory there are {found}"
    help = "keep fewer poses, or keep poses that are further apart"
    most: int
    found: int


ALL: tuple[type[Template], ...] = (
    NotAPose,
    MessageWithoutPose,
    OddDistance,
    PoseCount,
    RetracedCommand,
    PosesInAll,
)
