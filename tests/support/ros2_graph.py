# mypy: ignore-errors
"""Writes as JSON what a node of ROS 2 publishes, hears, offers and asks: `ros2_graph.py NODE`.

It writes anew whenever the graph has changed.
"""

import json
import sys
import time

import rclpy

rclpy.init()
looking = rclpy.create_node("looking")
RIGHTS = {
    "publish": looking.get_publisher_names_and_types_by_node,
    "subscribe": looking.get_subscriber_names_and_types_by_node,
    "reply": looking.get_service_names_and_types_by_node,
    "request": looking.get_client_names_and_types_by_node,
}
reported = None
while True:
    try:
        found = {
            right: sorted(name for name, _ in ask(sys.argv[1], "/"))
            for right, ask in RIGHTS.items()
        }
    except rclpy.node.NodeNameNonExistentError:
        found = {}
    if found != reported:
        sys.stdout.write(json.dumps(found) + "\n")
        sys.stdout.flush()
        reported = found
    time.sleep(0.1)
