# mypy: ignore-errors
"""A ROS node for live tests that remembers what it hears: `ears.py TOPIC TYPE ...`.

`Ears` is the one of the generation of ROS with whose Python this runs. Robots are built on it.
"""

import os
import sys

if os.environ["ROS_VERSION"] == "1":
    from ros1_ears import Ears, run
    from ros1_goals import Client, Server
else:
    from ros2_ears import Ears, run
    from ros2_goals import Client, Server

__all__ = ["Client", "Ears", "Server", "run"]


class Listener(Ears):
    """Hears the topics of the command line."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        for topic, kind in zip(sys.argv[1::2], sys.argv[2::2], strict=True):
            self.hear(topic, self.message_class(kind))


if __name__ == "__main__":
    run(Listener, "listener")
