"""EZS25x: the permissions of a skill, and the topics and servers that it uses."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoPermission(Error, code="EZS250", name="no-permission"):
    """An entry of `permits` that is not a permission."""

    title = "this is {found}, not a permission"
    label = "expected `contact`, `closeness`, `speed` or `force`"
    help = 'write `self.permits += force(Object, "20 N")`, one line per permission'
    found: str


class PermittedNoIndividual(Error, code="EZS251", name="permitted-no-individual"):
    """A permission for a value that is not an individual of the world model."""

    title = "`{kind}` takes an individual of the world model, not {found}"
    label = "expected a class of the ontology, or a parameter with such a type"
    kind: str
    found: str


class NoQuantity(Error, code="EZS252", name="no-quantity"):
    """A limit that is not a number with a unit."""

    title = "the limit of `{kind}` is {found}, not a quantity"
    help = "write the number and its unit as a string: `{example}`"
    kind: str
    found: str
    example: str

    class NoUnit(Remark):
        says = "write the unit as well: {units}"
        units: str

    class NotKnownBefore(Remark):
        says = "write a fixed limit: permissions must be known before the skill runs"


class UnknownUnit(Error, code="EZS253", name="unknown-unit"):
    """A unit that is not in the table of units."""

    title = "`{unit}` is not a known unit"
    help = "the units of `{kind}` are {units}"
    unit: str
    kind: str
    units: str


class WrongDimension(Error, code="EZS254", name="wrong-dimension"):
    """A limit in a unit of another dimension."""

    title = "the limit of `{kind}` needs {units}, not `{unit}`"
    label = "`{unit}` is a unit of {dimension}"
    kind: str
    units: str
    unit: str
    dimension: str


class PermittedLimit(Error, code="EZS255", name="permitted-limit"):
    """A limit that is negative, infinite or not a number."""

    title = "the limit of `{kind}` is {found}, which is {fault}"
    help = "write a finite number that is at least 0"
    kind: str
    found: str
    fault: str


class NoUse(Error, code="EZS256", name="no-use"):
    """An entry of `uses` that is neither a topic nor an action server."""

    title = "this is {found}, not a topic or an action server"
    label = "expected `topic` or `server`"
    help = 'write `self.uses += topic("/cmd_vel", "geometry_msgs/Twist")`, one line per name'
    found: str


class WrongRosName(Error, code="EZS257", name="wrong-ros-name"):
    """A topic or server name that ROS does not accept, or that depends on a namespace."""

    title = "{found} is not a valid name of {a_kind}"
    label = "{reason}"
    help = "write the full name, such as `{example}`"
    found: str
    a_kind: str
    reason: str
    example: str


class WrongRosType(Error, code="EZS258", name="wrong-ros-type"):
    """A message or action type that ROS cannot have."""

    title = "{found} is not a valid type of {a_kind}"
    help = "write the package and the name of the type, such as `{example}`"
    found: str
    a_kind: str
    example: str


ALL: tuple[type[Template], ...] = (
    NoPermission,
    PermittedNoIndividual,
    NoQuantity,
    UnknownUnit,
    WrongDimension,
    PermittedLimit,
    NoUse,
    WrongRosName,
    WrongRosType,
)
