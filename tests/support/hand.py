# mypy: ignore-errors
"""The hand of the robot for live tests, in a process of its own: `hand.py ACTION`.

It pursues each goal until it is cancelled, or until it dies.
"""

import sys

from ears import Ears, Server, run


class Hand(Ears):
    """An action server."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self._server = Server(self, "/hand", sys.argv[1], "goal", lambda _: None)

    def answer(self, request):
        """Answer a request."""
        if "obeys" in request:
            self._server.obeys = request["obeys"]
        return super().answer(request)


if __name__ == "__main__":
    run(Hand, "hand")
