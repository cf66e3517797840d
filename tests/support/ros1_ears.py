# mypy: ignore-errors
"""The ROS 1 functions for nodes of live tests, with the names of `ros2_ears.py`.

It runs with the system's Python, which has rospy.
"""

import roslib.message
import rospy
from dynamic_reconfigure.msg import Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure
from memory import NAMESPACE, Memory, in_namespace, serve


class Ears(Memory):
    """A node that remembers what comes on topics, and when it came."""

    def __init__(self):
        super().__init__()
        self._subscribers = {}
        self._offered = []  # what holds the services

    def hear(self, topic, kind, read=None):
        """`read` says what of a message is kept; all of it if nothing else is said."""
        keep = read or plain
        self._subscribers[topic] = rospy.Subscriber(
            in_namespace(topic), kind, lambda m: self.note(topic, keep(m)), tcp_nodelay=True
        )

    hear_latched = hear

    def deafen(self, topic):
        """Do not listen any more."""
        self._subscribers.pop(topic).unregister()

    def publisher(self, topic, kind):
        return rospy.Publisher(in_namespace(topic), kind, queue_size=1)

    sensor = publisher

    def every(self, seconds, do):
        """Call a function at a rate."""
        rospy.Timer(rospy.Duration(seconds), lambda _: do())

    def offer(self, service, kind, answer):
        """`answer` gives the fields of the response to a request."""
        self._offered.append(rospy.Service(in_namespace(service), kind, answer))

    def call(self, service, kind, arguments):
        name = in_namespace(service)
        rospy.wait_for_service(name, timeout=5.0)
        return plain(rospy.ServiceProxy(name, kind)(**arguments))

    def offer_parameter(self, node, name, value):
        """A node with a parameter that takes every number."""
        given = {name: value}

        def reconfigure(request):
            for each in request.config.doubles:
                given[each.name] = each.value
                self.note(node + "/" + each.name, each.value)
            doubles = [DoubleParameter(*each) for each in given.items()]
            return {"config": Config(doubles=doubles)}

        self.offer(node + "/set_parameters", Reconfigure, reconfigure)

    def message_class(self, name):
        return roslib.message.get_message_class(name)

    def time_of(self, seconds):
        return rospy.Time.from_sec(seconds)

    def duration_of(self, seconds):
        return rospy.Duration(seconds)

    def answer(self, request):
        """Answer a request."""
        if "publishers" in request:
            return self._subscribers[request["publishers"]].get_num_connections()
        return super().answer(request)


def plain(value):
    """A message as JSON has it."""
    if hasattr(value, "__slots__") and not hasattr(value, "to_sec"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if hasattr(value, "to_sec"):
        return value.to_sec()
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value


def run(make, name="robot"):
    """Answer requests until there are no more."""
    # The namespace of the process was fixed when rospy was imported.
    rospy.init_node(name + NAMESPACE.replace("/", "_"), disable_signals=True)
    serve(make())
