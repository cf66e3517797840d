# mypy: ignore-errors
"""Heron's arm in the cell of experiment IV, behind ROS 1, at the pace of the wall clock.

It serves `/arm`, publishes `/wrench`, and tells how far the box was pushed: `/pushed` (m).
"""

from __future__ import annotations

import time
from threading import Lock

import actionlib
import numpy as np
import roslib.message
import rospy
from actionlib_msgs.msg import GoalStatus
from heron_msgs.msg import MoveArmAction
from std_msgs.msg import Float64

from heron import messages
from heron.experiments.contact import CAREFUL, SPONGE, places_of, pressings_of, varied_cell
from heron.experiments.contact_witness import BOX
from heron.experiments.runner import Turns
from heron.robot import Arm, ArmController, ForceTorque, ForceTorqueParameters
from heron.scene import PersonParameters, build_cell
from heron.topics import InProcess
from heron.variants import Encounter

SEED = 3
SETTLING_STEPS = 250
PUSHED_EVERY_NS = 100_000_000


class RospyCarrier(InProcess):
    """Messages go out into ROS, and come in while nobody else has the arm: under a lock."""

    def __init__(self, lock: Lock) -> None:
        super().__init__()
        self._lock = lock

    def publisher(self, topic):
        hand_over = super().publisher(topic)
        there = roslib.message.get_message_class(topic.type)
        publisher = rospy.Publisher(topic.name, there, queue_size=10)

        def publish(message):
            hand_over(message)
            sent = there()
            sent.deserialize(bytes(messages.store().serialize_ros1(message, full(topic))))
            sent.header.stamp = rospy.Time.now()
            publisher.publish(sent)

        return publish

    def subscribe(self, topic, receive):
        super().subscribe(topic, receive)
        rospy.Subscriber(topic.name, rospy.AnyMsg, lambda heard: self._take(topic, receive, heard))

    def serve(self, name, server):
        super().serve(name, server)
        there = actionlib.ActionServer(
            name,
            MoveArmAction,
            lambda goal: self._begin(server, goal),
            lambda _goal: self._cancel(server),
            auto_start=False,
        )
        there.start()

    def _take(self, topic, receive, heard):
        if heard._connection_header["callerid"] == rospy.get_name():
            return
        with self._lock:
            receive(messages.store().deserialize_ros1(heard._buff, full(topic)))

    def _begin(self, server, goal):
        goal.set_accepted()
        wanted = goal.get_goal()
        with self._lock:
            server.send(
                {"pose": wanted.pose, "seconds": wanted.seconds},
                lambda is_reached: ended(goal, is_reached),
            )

    def _cancel(self, server):
        with self._lock:
            server.cancel()


def full(topic):
    return messages.full_name(topic.type)


def ended(goal, is_reached):
    if is_reached:
        goal.set_succeeded()
    elif goal.get_goal_status().status == GoalStatus.PREEMPTING:
        goal.set_canceled()
    else:
        goal.set_aborted()


def main():
    rospy.init_node("heron_arm")
    lock = Lock()
    cell = varied_cell(Encounter.MEANT, np.random.default_rng(SEED))
    arm = Arm(build_cell(cell, SPONGE, PersonParameters()), SPONGE)
    arm.settle(SETTLING_STEPS)
    carrier = RospyCarrier(lock)
    places = places_of(cell) | {"home": arm.grasp.copy()}
    force = ForceTorque(arm, carrier, np.random.default_rng(SEED), ForceTorqueParameters())
    controller = ArmController(arm, carrier, places, CAREFUL, pressings_of(cell))
    turns = Turns(arm, [force, controller])
    pushed = rospy.Publisher("/pushed", Float64, queue_size=1)
    began = time.monotonic_ns() - arm.now_ns
    while not rospy.is_shutdown():
        with lock:
            turns.step()
            distance = cell.box_place[1] - float(arm.data.body(BOX).xpos[1])
        if arm.now_ns % PUSHED_EVERY_NS == 0:
            pushed.publish(distance)
        time.sleep(max(0, began + arm.now_ns - time.monotonic_ns()) * 1e-9)


if __name__ == "__main__":
    main()
