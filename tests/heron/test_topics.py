"""Messages go by the name of their topic, and topics have one type."""

from __future__ import annotations

import pytest
from rosbags.typesys import Stores, get_typestore

from heron import messages
from heron.messages import Message
from heron.topics import COMMAND, IMU, ODOMETRY, POSE, InProcess, Remapped, Topic, TopicTypeError


def test_listeners_get_what_is_published_in_the_order_in_which_they_came() -> None:
    carrier = InProcess()
    heard: list[tuple[str, Message]] = []
    publish = carrier.publisher(COMMAND)
    carrier.subscribe(COMMAND, lambda message: heard.append(("first", message)))
    carrier.subscribe(COMMAND, lambda message: heard.append(("second", message)))
    publish("stop")
    assert heard == [("first", "stop"), ("second", "stop")]


def test_a_topic_has_one_type() -> None:
    carrier = InProcess()
    carrier.publisher(COMMAND)
    with pytest.raises(TopicTypeError, match="/cmd_vel carries geometry_msgs/Twist, not std_msgs"):
        carrier.subscribe(Topic("/cmd_vel", "std_msgs/Bool"), print)


def test_a_node_may_be_started_with_other_names() -> None:
    carrier = InProcess()
    heard: list[Message] = []
    carrier.subscribe(Topic("/unfil_cmd_vel", COMMAND.type), heard.append)
    node = Remapped(carrier, {"/cmd_vel": "/unfil_cmd_vel"})
    node.publisher(COMMAND)("forward")
    assert heard == ["forward"]


@pytest.mark.parametrize(
    ("topic", "message"),
    [
        (IMU, messages.imu(10**9, messages.quaternion_about_z(1.0), (0.0,) * 3, (0.0, 0.1, 9.8))),
        (ODOMETRY, messages.odometry(10**9, 1.0, 2.0, 0.5, messages.twist(0.3, 0.1))),
        (POSE, messages.stamped_pose(10**9, 1.0, 2.0, 0.5)),
        (COMMAND, messages.twist(0.3, 0.1)),
    ],
)
def test_messages_are_those_of_ros(topic: Topic, message: Message) -> None:
    store = get_typestore(Stores.ROS1_NOETIC)
    name = topic.type.replace("/", "/msg/")
    read = store.deserialize_ros1(store.serialize_ros1(message, name), name)
    assert repr(read) == repr(message)


def test_a_new_message_has_all_fields_zero() -> None:
    assert messages.new_message("geometry_msgs/Twist") == messages.twist(0.0, 0.0)
    scan = messages.new_message("sensor_msgs/LaserScan")
    assert (scan.header.frame_id, scan.range_max, len(scan.ranges)) == ("", 0.0, 0)
    store = get_typestore(Stores.ROS1_NOETIC)
    for name in ("sensor_msgs/msg/Imu", "nav_msgs/msg/Path", "sensor_msgs/msg/JointState"):
        store.serialize_ros1(messages.new_message(name), name)


def test_yaw_is_read_as_it_was_written() -> None:
    assert messages.yaw_of(messages.quaternion_about_z(-2.5)) == pytest.approx(-2.5)
