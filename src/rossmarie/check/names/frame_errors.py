"""Mistakes about frames."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class UnknownFrame(Error, code="ROSS150", name="unknown-frame"):
    """A frame that no system model declares, but to which a path is needed."""

    title = "no system model declares the frame `{identifier}`"
    label = "the position of this frame is not known"
    help = "declare it in the system model: `frame {identifier} in PARENT;`"
    identifier: str


class FrameConflict(Error, code="ROSS151", name="frame-conflict"):
    """Two declarations with different frames for one subject."""

    title = "{subject} cannot be both in `{found}` and in `{expected}`"
    label = "{words}"
    note = "each message names one frame, and each frame lies in one other frame"
    help = "write the same frame in both places, or leave one of the two out"
    subject: str
    found: str
    expected: str
    words: str


class CircularFrames(Error, code="ROSS152", name="circular-frames"):
    """Frames that lie in each other."""

    title = "the frame `{identifier}` lies in itself: {cycle}"
    label = "this frame is part of the cycle"
    note = "frames form a tree: the root, such as `map` or `odom`, lies in no other frame"
    help = "remove the declaration of the root frame"
    identifier: str
    cycle: str


class Seen(Remark):
    """The label of one of two values in different frames."""

    says = "`{text}` is in `{frame}`"
    text: str
    frame: str


class MixedFrames(Error, code="ROSS275", name="mixed-frames"):
    """Two values in different frames where one frame is needed."""

    title = "`{text}` is in the frame `{found}`, but `{other}` is in `{expected}`"
    label = "`{text}` is in `{found}`"
    note = "the coordinates of a point differ from frame to frame"
    text: str
    found: str
    other: str
    expected: str

    class Transform(Remark):
        says = "write `in {expected}` after the input `{name}`"
        name: str
        expected: str

    class Declare(Remark):
        says = (
            "declare the position of `{found}` in `{expected}` in the system model (`frame {found} "
            "in {expected};`), and write `in {expected}` after the input `{name}`"
        )
        name: str
        found: str
        expected: str


class NothingToTransform(Error, code="ROSS276", name="nothing-to-transform"):
    """`in FRAME` at an input that does not depend on a frame."""

    title = "`{field}` cannot be transformed to `{frame}`"
    label = "{reason}"
    note = "only positions, orientations and vectors can be transformed"
    field: str
    frame: str
    reason: str

    class Whole(Remark):
        says = "choose the whole field: `.{field}`"
        field: str

    class LeaveOut(Remark):
        says = "leave `in {frame}` out"
        frame: str

    class Field(Remark):
        says = "declare an input of its own for `.{field}`, with `from` and its frame"
        field: str

    class Untransformed(Remark):
        says = "declare an input of its own for `.{field}`, without `in` and a frame"
        field: str


class UnknownSource(Error, code="ROSS277", name="unknown-source"):
    """`in FRAME` at an input whose source frame is unknown."""

    title = "the frame in which `{field}` arrives is not known"
    label = "a value in an unknown frame cannot be transformed"
    note = (
        "the transform is computed before the monitor runs; a message in another frame counts as "
        "stale"
    )
    help = "write the frame of the messages: `from FRAME in {frame}`"
    field: str
    frame: str


class UnfitPlacement(Error, code="ROSS278", name="unfit-placement"):
    """A declaration of a frame with a placement that is not possible."""

    title = "`{word}` of the frame `{frame}` {reason}"
    label = "this is {found}"
    help = "write {form}"
    word: str
    frame: str
    reason: str
    found: str
    form: str


class NoPath(Error, code="ROSS279", name="no-path-between-frames"):
    """Two frames that no declarations connect."""

    title = "no declared frame connects `{source}` with `{target}`"
    label = "this needs the transform"
    help = "declare in the system model which frame connects them: `frame {source} in {target};`"
    source: str
    target: str

    class From(Remark):
        says = "`{source}` is named here"
        source: str


ALL: tuple[type[Template], ...] = (
    UnknownFrame,
    FrameConflict,
    CircularFrames,
    MixedFrames,
    NothingToTransform,
    UnknownSource,
    UnfitPlacement,
    NoPath,
)
