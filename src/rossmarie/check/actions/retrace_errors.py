"""Mistakes in `retrace` effects."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class NotAPose(Error, code="ROSS253", name="not-a-pose"):
    """A `retrace` of an expression that is not a pose from messages."""

    title = "`{identifier}` is no pose that can be retraced"
    label = "this is {found}"
    note = "a pose is a position in m, or a geometry_msgs/Pose, of an input"
    help = "name an input of poses, or the part of one: `retrace INPUT.pose on ...`"
    identifier: str
    found: str


class MessageWithoutPose(Error, code="ROSS254", name="message-without-pose"):
    """A topic to retrace on whose messages have no such pose."""

    title = "a message {type} does not hold one {pose}"
    label = "the poses would be sent here"
    help = "use a topic of {examples}"
    type: str
    pose: str
    examples: str


class OddDistance(Error, code="ROSS255", name="odd-distance"):
    """An `apart` that is neither a distance nor a time, or is given twice."""

    title = "poses are a distance or a time apart"
    label = "{found}"
    note = "without it, poses of a robot that stands would fill the memory"
    help = "write it like this: `apart 1 cm`, `apart 0.2 sec` or `apart 1 cm, 0.2 sec`"
    found: str


class PoseCount(Error, code="ROSS428", name="pose-count"):
    """A number of poses that a memory cannot have."""

    title = "a memory holds a whole number of poses, from 1 to {most}"
    label = "this is {found}"
    help = "write how many poses are kept, as in `up to 100`; when there are more the oldest goes"
    most: int
    found: str


class RetracedCommand(Error, code="ROSS429", name="retraced-command"):
    """A topic to retrace on that another node uses to command the robot."""

    title = "the poses would be mixed with the commands of others on {topic}"
    label = "a node publishes on this topic, or an action bounds it"
    note = "a robot that gets two targets in turn goes to neither"
    help = "retrace on a topic of its own, and let the controller take it while it has messages"
    topic: str


class PosesInAll(Error, code="ROSS430", name="poses-in-all"):
    """Memories of poses that together exceed the capacity of a monitor."""

    title = "all memories together hold more than {most} poses"
    label = "with these there are {found}"
    help = "keep fewer, or poses that are further apart"
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
