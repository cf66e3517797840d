# mypy: ignore-errors
"""A robot that feels a force (N) and hears topics, in live tests: `forceful.py TOPIC TYPE ...`. The
force is in the namespace of the node whose topic comes first: `/robot1/stuck_safety/state`.
"""

import sys

from ears import Listener, run
from std_msgs.msg import Float64

SPACE = sys.argv[1].rpartition("/")[0].rpartition("/")[0]


class Forceful(Listener):
    """Publishes the force on /force: again and again, and at once when it is another one."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self._forces = self.publisher(SPACE + "/force", Float64)
        self._force = 0.0
        self.every(0.05, self._feel)

    @property
    def force(self):
        return self._force

    @force.setter
    def force(self, newton):
        self._force = newton
        self._feel()

    def _feel(self):
        self._forces.publish(Float64(data=self._force))


if __name__ == "__main__":
    run(Forceful, "forceful" + SPACE.replace("/", "_"))
