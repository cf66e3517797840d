"""Types of expressions, the table of operators, and the messages of ROS."""

from rossmarie.types.definitions import Kind, MessageDefinitionError
from rossmarie.types.field_units import RATIOS
from rossmarie.types.model import (
    AXES,
    Array,
    Boolean,
    Box,
    Entry,
    Interval,
    List,
    Message,
    Motion,
    Point,
    Quantity,
    Quaternion,
    Region,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
)
from rossmarie.types.operators import SIGNATURES, Operator, apply
from rossmarie.types.ros_messages import (
    Leaf,
    MessageCatalog,
    message_value,
    std_msgs_data,
)
from rossmarie.types.rules import Fault, Outcome, faults_of_position, unit_faults, way_of

__all__ = [
    "AXES",
    "RATIOS",
    "SIGNATURES",
    "Array",
    "Boolean",
    "Box",
    "Entry",
    "Fault",
    "Interval",
    "Kind",
    "Leaf",
    "List",
    "Message",
    "MessageCatalog",
    "MessageDefinitionError",
    "Motion",
    "Operator",
    "Outcome",
    "Point",
    "Quantity",
    "Quaternion",
    "Region",
    "Text",
    "Type",
    "Unknown",
    "Unsupported",
    "Vector",
    "apply",
    "faults_of_position",
    "message_value",
    "std_msgs_data",
    "unit_faults",
    "way_of",
]
