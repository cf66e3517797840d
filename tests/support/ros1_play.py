# mypy: ignore-errors
"""Plays a recording with simulated time: `ros1_play.py RECORDING [START SECONDS]`.

Time goes on only when the generated node, of which there has to be one, has heard what was said
before: so its verdicts do not depend on how busy the machine is. Each message comes at the instant
of its stamp.
"""

import sys
import time

import rosbag
import rosgraph
import roslib.message
import rospy
from rosgraph_msgs.msg import Clock
from rosservice import get_service_class_by_name

TICK = rospy.Duration.from_sec(0.01)
CALLS = 3  # after which a node of roscpp has heard what came before them


class Exchange:
    """A service of a node, called for the sake of its answer."""

    def __init__(self, name, *arguments):
        kind = get_service_class_by_name(name)
        self._call = rospy.ServiceProxy(name, kind, persistent=True)
        self._request = kind._request_class(*arguments)

    def wait(self):
        """Wait until the node has heard what came before."""
        for _ in range(CALLS):
            self._call(self._request)


def node_of(master):
    """The node that can say why, as soon as it is there."""
    while True:
        for service, (node, *_) in master.getSystemState()[2]:
            if service == node + "/why":
                return node
        time.sleep(0.02)


def publisher(topic, kind, node):
    """One that a node listens to. What is published has been sent when `publish` returns."""
    found = rospy.Publisher(topic, kind, tcp_nodelay=True, queue_size=None)
    while node not in (connection[1] for connection in found.impl.get_stats_info()):
        time.sleep(0.02)
    return found


def play(bag, begin, end):
    """Play what came from an instant to another."""
    master = rosgraph.Master(rospy.get_name())
    node = node_of(master)
    wanted = {topic for topic, nodes in master.getSystemState()[1] if node in nodes}
    types = {topic: info.msg_type for topic, info in bag.get_type_and_topic_info().topics.items()}
    clock = publisher("/clock", Clock, node)
    topics = {
        topic: publisher(topic, roslib.message.get_message_class(types[topic]), node)
        for topic in sorted(wanted & types.keys())
    }
    # Loggers are seen to by the thread that hears /clock, and all else by that of the node.
    time_is_heard = Exchange(node + "/set_logger_level", "ros.player", "info")
    all_is_heard = Exchange(node + "/why")
    now = begin - TICK
    for topic, message, at in bag.read_messages(list(topics), begin, end):
        while now < at:
            now = min(now + TICK, at)
            clock.publish(now)
            time_is_heard.wait()
            all_is_heard.wait()
        topics[topic].publish(message)
        all_is_heard.wait()  # the thread that hears /clock could be faster


def main():
    """Play the recording of the command line."""
    rospy.init_node("player", disable_rostime=True)
    with rosbag.Bag(sys.argv[1]) as bag:
        start, seconds = map(float, sys.argv[2:] or ("0", "1e9"))
        begin = rospy.Time.from_sec(bag.get_start_time() + start)
        play(bag, begin, begin + rospy.Duration.from_sec(seconds))


if __name__ == "__main__":
    main()
