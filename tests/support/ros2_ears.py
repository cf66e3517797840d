# mypy: ignore-errors
"""The ROS 2 functions for nodes of live tests, with the names of `ros1_ears.py`."""

import math
import threading

import rclpy
from builtin_interfaces.msg import Duration, Time
from memory import NAMESPACE, Memory, in_namespace, serve
from rcl_interfaces.msg import SetParametersResult
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rosidl_runtime_py.utilities import get_message

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Ears(Memory):
    """A node that remembers what comes on topics, and when it came."""

    def __init__(self, node):
        super().__init__()
        self.node = node
        self._subscriptions = {}
        self._group = ReentrantCallbackGroup()

    def hear(self, topic, kind, read=None, qos=1000):
        """`read` says what of a message is kept; all of it if nothing else is said."""
        keep = read or plain
        self._subscriptions[topic] = self.node.create_subscription(
            kind, in_namespace(topic), lambda m: self.note(topic, keep(m)), qos
        )

    def deafen(self, topic):
        """Do not listen any more."""
        self.node.destroy_subscription(self._subscriptions.pop(topic))

    def hear_latched(self, topic, kind):
        self.hear(topic, kind, qos=LATCHED)

    def publisher(self, topic, kind):
        return self.node.create_publisher(kind, in_namespace(topic), 1)

    def sensor(self, topic, kind):
        return self.node.create_publisher(kind, in_namespace(topic), qos_profile_sensor_data)

    def every(self, seconds, do):
        """Call a function at a rate."""
        self.node.create_timer(seconds, do)

    def offer(self, service, kind, answer):
        """`answer` gives the fields of the response to a request."""

        def respond(request, response):
            for name, value in answer(request).items():
                setattr(response, name, value)
            return response

        self.node.create_service(kind, in_namespace(service), respond, callback_group=self._group)

    def call(self, service, kind, arguments):
        client = self.node.create_client(kind, in_namespace(service), callback_group=self._group)
        client.wait_for_service(timeout_sec=5.0)
        return plain(client.call(kind.Request(**arguments)))

    def offer_parameter(self, node, name, value):
        """A node with a parameter that takes every number."""
        owner = rclpy.create_node(node[1:])
        owner.declare_parameter(name, value)

        def set_parameters(parameters):
            for each in parameters:
                self.note(node + "/" + each.name, each.value)
            return SetParametersResult(successful=True)

        owner.add_on_set_parameters_callback(set_parameters)
        self.node.executor.add_node(owner)

    def message_class(self, name):
        return get_message(name)

    def time_of(self, seconds):
        whole = math.floor(seconds)
        return Time(sec=whole, nanosec=min(round((seconds - whole) * 1e9), 999_999_999))

    def duration_of(self, seconds):
        time = self.time_of(seconds)
        return Duration(sec=time.sec, nanosec=time.nanosec)

    def answer(self, request):
        """Answer a request."""
        if "publishers" in request:
            return self._subscriptions[request["publishers"]].get_publisher_count()
        return super().answer(request)


def plain(value):
    """A message as JSON has it."""
    if isinstance(value, (Time, Duration)):
        return value.sec + value.nanosec / 1e9
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, bytes):
        return value[0]
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value


def run(make, name="robot"):
    """Answer requests until there are no more."""
    rclpy.init()
    node = rclpy.create_node(name, namespace=NAMESPACE)
    executor = MultiThreadedExecutor(6)
    executor.add_node(node)
    ears = make(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    serve(ears)
