# mypy: ignore-errors
"""Plays messages with simulated time: `ros2_play.py FILE`, a line [topic, type, ns, hex] for each.

ROS 2 need not come with rosbag2, which could do the same.
"""

import json
import sys
import time
from pathlib import Path

import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from rosidl_runtime_py.utilities import get_message

TICK_NS = 2_000_000
# A node that listens with best effort stays connected; nothing gets lost on one machine.
QOS = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)


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
    now_ns = messages[0][2] - TICK_NS
    for topic, _, at_ns, content in messages:
        while now_ns < at_ns:
            now_ns = min(now_ns + TICK_NS, at_ns)
            clock.publish(Clock(clock=Time(nanoseconds=now_ns).to_msg()))
            time.sleep(TICK_NS / 1e9)
        topics[topic].publish(bytes.fromhex(content))
    time.sleep(1.0)  # what was sent last is on its way


if __name__ == "__main__":
    main()
