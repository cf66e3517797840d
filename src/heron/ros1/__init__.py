"""A live ROS 1 instead of this process: topics over TCPROS, and the generated guard node.

Time advances only when the node has handled all messages of an instant, so its behavior does not
depend on the load of the machine.
"""

from heron.ros1.errors import Ros1Error
from heron.ros1.link import Ros1Link

__all__ = ["Ros1Error", "Ros1Link"]
