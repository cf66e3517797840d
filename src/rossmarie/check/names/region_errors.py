"""Mistakes about the places of individuals."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoLocation(Error, code="ROSS258", name="no-location"):
    """A class without individuals in the scene, or exported without a scene."""

    title = "there is no {owl_class} in {path}"
    label = "the rules use the places of this class"
    help = "export the scene with the skills: `ezskiros export SKILLS SCENE.turtle -o {path}`"
    owl_class: str
    path: str


class UnknownLocation(Error, code="ROSS259", name="unknown-location"):
    """An individual without a location in the scene."""

    title = "the place of {individual}, which is a {owl_class}, is not known"
    label = "this condition would ignore {individual}"
    help = (
        "give {individual} a polygon or a position in the scene; then run `ezskiros export` again"
    )
    individual: str
    owl_class: str

    class Described(Remark):
        says = "the scene describes the individual here"


class SeveralFrames(Error, code="ROSS260", name="several-frames"):
    """A class with individuals in more than one frame."""

    title = "the places of {owl_class} are in several frames: {frames}"
    label = "a position is in only one of these frames"
    help = (
        "describe all of these places in one frame, or use a class whose individuals are in one "
        "frame"
    )
    owl_class: str
    frames: str


class NoFrame(Error, code="ROSS261", name="no-frame"):
    """A position without a frame in a header."""

    title = "the frame of `{text}` is not known"
    label = "{reason}"
    help = "use a field of a message with a header, such as nav_msgs/Odometry.pose.pose"
    text: str
    reason: str


class SeveralClasses(Error, code="ROSS262", name="several-classes"):
    """A name that several classes share."""

    title = "several classes are named `{identifier}`"
    help = "write which class is meant: {known}"
    identifier: str
    known: str


ALL: tuple[type[Template], ...] = (
    NoLocation,
    UnknownLocation,
    SeveralFrames,
    NoFrame,
    SeveralClasses,
)
