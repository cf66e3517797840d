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
from rossmarie.types.operators import SIGNATURES, Fault, Operator, Outcome, apply, unit_faults
from rossmarie.types.ros_messages import (
    Leaf,
    MessageCatalog,
    message_value,
    std_msgs_data,
)

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
    "message_value",
    "std_msgs_data",
    "unit_faults",
]
