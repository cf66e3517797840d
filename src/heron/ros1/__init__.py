"""A live ROS 1 in the place of this process: topics by TCPROS, and the generated node on guard.

Time goes on only when the node has dealt with all that was said at an instant, so that what it does
does not depend on how busy the machine is.
"""

from heron.ros1.errors import Ros1Error
from heron.ros1.link import Ros1Link

__all__ = ["Ros1Error", "Ros1Link"]
