# mypy: ignore-errors
"""A ROS node for live tests that remembers what it hears: `ros1_ears.py TOPIC TYPE ...`.

Runs with the system's Python, which has rospy. Reads one request from each line, a JSON object, and
answers with one line. Robots for live tests are built on it.
"""

import json
import os
import sys
from collections import deque

import roslib.message
import rospy


class Ears:
    """Remembers what comes on topics, and when it came."""

    def __init__(self):
        self.heard = {}
        self._subscribers = {}

    def hear(self, topic, kind, read=None):
        """`read` says what of a message is kept; all of it if nothing else is said."""
        self.heard[topic] = deque(maxlen=50000)
        note = self.heard[topic].append
        keep = read or plain
        self._subscribers[topic] = rospy.Subscriber(
            topic, kind, lambda m: note([rospy.get_time(), keep(m)]), tcp_nodelay=True
        )

    def answer(self, request):
        """What a request asks for."""
        for name, value in request.get("set", {}).items():
            setattr(self, name, value)
        if "forget" in request:
            self.heard.get(request["forget"], deque()).clear()
        if "publishers" in request:
            return self._subscribers[request["publishers"]].get_num_connections()
        if "heard" in request:
            return list(self.heard.get(request["heard"], ()))
        return None


def plain(value):
    """A message as JSON has it."""
    if hasattr(value, "__slots__") and not hasattr(value, "to_sec"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if hasattr(value, "to_sec"):
        return value.to_sec()
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value


def run(make):
    """Answer requests until there are no more."""
    rospy.init_node("robot", disable_signals=True)
    ears = make()
    for line in sys.stdin:
        sys.stdout.write(json.dumps(ears.answer(json.loads(line))) + "\n")
        sys.stdout.flush()
    os._exit(0)  # rospy keeps threads that would not end


def main():
    """Hear the topics of the command line."""
    ears = Ears()
    for topic, kind in zip(sys.argv[1::2], sys.argv[2::2], strict=True):
        ears.hear(topic, roslib.message.get_message_class(kind))
    return ears


if __name__ == "__main__":
    run(main)
