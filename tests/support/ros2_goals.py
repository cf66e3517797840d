# mypy: ignore-errors
"""Action servers of ROS 2 for live tests, and clients before the relays of the node."""

import time

from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rosidl_runtime_py.utilities import get_action


class Server:
    """Pursues a goal until it is cancelled, or until `end_of` says how it ends.

    A goal is reported by one of its fields.
    """

    def __init__(self, ears, server, action, field, end_of):
        self.pursued = None
        self.obeys = True  # whether it lets itself be cancelled
        self._note, self._server_name = ears.note, server
        self._field, self._end_of = field, end_of
        self._kind = kind_of(action)
        self._server = ActionServer(
            ears.node,
            self._kind,
            server,
            self._pursue,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def _pursue(self, goal):
        wanted = self.pursued = getattr(goal.request, self._field)
        self._note(self._server_name, ["begins", wanted])
        ends = {"succeeds": goal.succeed, "aborts": goal.abort}
        end = None
        while end not in ends and not (self.obeys and goal.is_cancel_requested):
            time.sleep(0.01)
            end = self._end_of(wanted)
        self.pursued = None
        self._note(self._server_name, [end if end in ends else "is cancelled", wanted])
        ends.get(end, goal.canceled)()
        return self._kind.Result()


class Client:
    """Sends goals to the relay of a server."""

    def __init__(self, ears, server, action, field):
        self._note, self._field, self._kind = ears.note, field, kind_of(action)
        relay = "/unfil_" + server[1:]
        group = ReentrantCallbackGroup()
        self._client = ActionClient(ears.node, self._kind, relay, callback_group=group)

    def send(self, wanted):
        self._client.wait_for_server(timeout_sec=30.0)
        sent = self._client.send_goal_async(self._kind.Goal(**{self._field: wanted}))
        sent.add_done_callback(
            lambda done: (
                done.result()
                .get_result_async()
                .add_done_callback(lambda _: self._note("/goals", ["ends", wanted]))
            )
        )


def kind_of(action):
    """The type of an action that is called like `arm_msgs/Move`."""
    package, _, name = action.partition("/")
    return get_action(f"{package}/action/{name}")
