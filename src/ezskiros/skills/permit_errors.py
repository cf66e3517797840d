"""EZS25x: what a skill permits, and what it uses."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoPermission(Error, code="EZS250", name="no-permission"):
    """Something else in the place of a permission."""

    title = "this is no permission, but {found}"
    label = "expected `contact`, `closeness`, `speed` or `force`"
    help = 'write `self.permits += force(Object, "20 N")`, a line for each'
    found: str


class PermittedNoThing(Error, code="EZS251", name="permitted-no-thing"):
    """A permission that is about no thing of the world."""

    title = "`{kind}` is with things of the world, not with {found}"
    label = "a parameter is needed whose type is a class of the ontology, or such a class"
    kind: str
    found: str


class NoQuantity(Error, code="EZS252", name="no-quantity"):
    """A limit that is no number with a unit."""

    title = "the limit of `{kind}` is {found}, not a quantity"
    help = "write a number with its unit, as a text: `{example}`"
    kind: str
    found: str
    example: str

    class NoUnit(Remark):
        says = "write the unit as well: {units}"
        units: str

    class NotKnownBefore(Remark):
        says = "write it down: what a skill permits is known before it runs"


class UnknownUnit(Error, code="EZS253", name="unknown-unit"):
    """A unit that is none of the table."""

    title = "`{unit}` is no unit that is known"
    help = "`{kind}` is limited in {units}"
    unit: str
    kind: str
    units: str


class WrongDimension(Error, code="EZS254", name="wrong-dimension"):
    """A limit in a unit of something else."""

    title = "`{kind}` is limited in {units}, not in `{unit}`"
    label = "`{unit}` is a unit of {dimension}"
    kind: str
    units: str
    unit: str
    dimension: str


class PermittedLimit(Error, code="EZS255", name="permitted-limit"):
    """A limit that is negative, infinite or not a number."""

    title = "the limit of `{kind}` is {found}, which is {fault}"
    help = "write a number that is finite and not below 0"
    kind: str
    found: str
    fault: str


class NoUse(Error, code="EZS256", name="no-use"):
    """Something else in the place of a topic or a server."""

    title = "this is no topic or action server, but {found}"
    label = "expected `topic` or `server`"
    help = 'write `self.uses += topic("/cmd_vel", "geometry_msgs/Twist")`, a line for each'
    found: str


class WrongRosName(Error, code="EZS257", name="wrong-ros-name"):
    """A name of a topic or server that ROS does not take, or that depends on a namespace."""

    title = "{found} is no name of {a_kind}"
    label = "{reason}"
    help = "write its whole name, such as `{example}`"
    found: str
    a_kind: str
    reason: str
    example: str


class WrongRosType(Error, code="EZS258", name="wrong-ros-type"):
    """A type of messages or actions that ROS cannot have."""

    title = "{found} is no type of {a_kind}"
    help = "write its package and its name, such as `{example}`"
    found: str
    a_kind: str
    example: str


ALL: tuple[type[Template], ...] = (
    NoPermission,
    PermittedNoThing,
    NoQuantity,
    UnknownUnit,
    WrongDimension,
    PermittedLimit,
    NoUse,
    WrongRosName,
    WrongRosType,
)
