# mypy: ignore-errors
"""Plays messages with simulated time: `ros2_play.py FILE`, a line [topic, type, ns, hex] for each.

ROS 2 need not come with rosbag2, which could do nearly the same: here time goes on only when the
generated node, of which there has to be one, has heard what was said before.
"""

import json
import sys
import time
from pathlib import Path

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from rosidl_runtime_py.utilities import get_message, get_service

TICK_NS = 10_000_000
# A node that listens with best effort stays connected; nothing gets lost on one machine.
QOS = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
CALLS = 3  # after which a node has heard what came before them


class Guard:
    """The node that can say why, as soon as it is there."""

    def __init__(self, node):
        self._node = node
        while not (found := self._services()):
            time.sleep(0.05)
        ((name, (kind,)),) = found
        self._client = node.create_client(get_service(kind), name)
        self._client.wait_for_service()
        self._request = get_service(kind).Request()

    def _services(self):
        offered = self._node.get_service_names_and_types()
        return [each for each in offered if each[0].endswith("/why")]

    def hear(self):
        """Wait until it has heard what came before."""
        for _ in range(CALLS):
            answer = self._client.call_async(self._request)
            executor = SingleThreadedExecutor()  # one that lives long gets slower and slower
            executor.add_node(self._node)
            while not answer.done():
                executor.spin_once(timeout_sec=1.0)
            executor.remove_node(self._node)


def main():
    rclpy.init()
    node = rclpy.create_node("player")
    clock = node.create_publisher(Clock, "/clock", QOS)
    lines = Path(sys.argv[1]).read_text(encoding="ascii").splitlines()
    messages = [json.loads(line) for line in lines]
    kinds = {topic: get_message(kind) for topic, kind, _, _ in messages}
    topics = {topic: node.create_publisher(kind, topic, QOS) for topic, kind in kinds.items()}
    while any(each.get_subscription_count() == 0 for each in (clock, *topics.values())):
        time.sleep(0.05)
    time.sleep(1.0)  # the node has to know of it as well
    guard = Guard(node)
    now_ns = messages[0][2] - TICK_NS
    for topic, _, at_ns, content in messages:
        while now_ns < at_ns:
            now_ns = min(now_ns + TICK_NS, at_ns)
            clock.publish(Clock(clock=Time(nanoseconds=now_ns).to_msg()))
            guard.hear()
        topics[topic].publish(bytes.fromhex(content))
        guard.hear()
    time.sleep(1.0)  # what was sent last is on its way


if __name__ == "__main__":
    main()
