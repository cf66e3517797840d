# mypy: ignore-errors
"""Action servers of ROS 1 for live tests, and their clients."""

import time

import actionlib
import roslib.message
import rospy


class Server:
    """Pursues a goal until it is cancelled, or until `end_of` says how it ends.

    A goal is reported by one of its fields.
    """

    def __init__(self, ears, server, action, field, end_of):
        self.pursued = None
        self.obeys = True  # whether it lets itself be cancelled
        self._note, self._server_name = ears.note, server
        self._field, self._end_of = field, end_of
        kind = roslib.message.get_message_class(action + "Action")
        self._server = actionlib.SimpleActionServer(server, kind, self._pursue, False)
        self._server.start()

    def _pursue(self, goal):
        wanted = self.pursued = getattr(goal, self._field)
        self._note(self._server_name, ["begins", wanted])
        ends = {"succeeds": self._server.set_succeeded, "aborts": self._server.set_aborted}
        end = None
        while end not in ends and not (self.obeys and self._server.is_preempt_requested()):
            rospy.sleep(0.01)
            end = self._end_of(wanted)
        self.pursued = None
        self._note(self._server_name, [end if end in ends else "is cancelled", wanted])
        ends.get(end, self._server.set_preempted)()


class Client:
    """Sends goals to a server."""

    def __init__(self, ears, server, action, field):
        self._note, self._field = ears.note, field
        kind = roslib.message.get_message_class(action + "Action")
        self._goal = type(kind().action_goal.goal)
        self._client = actionlib.SimpleActionClient(server, kind)

    def send(self, wanted):
        """Waits for the server and for the node: it cannot send again what it has not heard."""
        self._client.wait_for_server()
        end = time.monotonic() + 5.0
        while self._client.action_client.pub_goal.get_num_connections() < 2:
            if time.monotonic() > end:
                break
            time.sleep(0.02)
        self._client.send_goal(
            self._goal(**{self._field: wanted}), lambda *_: self._note("/goals", ["ends", wanted])
        )
