"""The display of a running task: lines, or a tree on a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from rich.console import Console
from rich.live import Live
from rich.text import Text

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.skill import SkillChild
from ezskiros.engine.task import Task

_STATES = {
    Happened.STARTED: "Running",
    Happened.CHOSEN: "Running",
    Happened.RUNNING: "Running",
    Happened.SUCCEEDED: "Success",
    Happened.FAILED: "Failure",
    Happened.PREEMPTED: "Failure",
}
_MARKS = {
    Status.INVALID: (" ", "dim"),
    Status.RUNNING: (">", "bold yellow"),
    Status.SUCCESS: ("+", "green"),
    Status.FAILURE: ("x", "red"),
}


def line(event: Event) -> str:
    """An event as SkiROS2 prints progress: `--->Wait-wait(Running)[1] waiting`."""
    indent = "-" * (2 * (len(event.path) - 1))
    state = _STATES[event.happened]
    return f"{indent}->{event.skill}-{event.implementation}({state})[{event.code}] {event.text}"


class LiveTree:
    """The tree of a task, drawn again after each tick."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._texts: dict[tuple[str, ...], str] = {}
        self._live = Live(console=console, auto_refresh=False, vertical_overflow="ellipsis")

    def start(self) -> None:
        """Start to draw."""
        self._live.start()

    def stop(self) -> None:
        """Stop to draw, and keep the last drawing."""
        self._live.stop()

    def tell(self, event: Event) -> None:
        """Record the message of a skill."""
        self._texts[event.path] = f"[{event.code}] {event.text}"

    def draw(self, task: Task) -> None:
        """Draw the current tree, as far as it fits on the terminal."""
        shown = Text()
        for count, row in enumerate(self._rows(task.root, 0)):
            if count >= self._console.height - 1:
                break
            shown.append_text(row)
        self._live.update(shown, refresh=True)

    def _rows(self, node: Behaviour, depth: int) -> Iterator[Text]:
        mark, style = _MARKS[node.status]
        text = ""
        below = list(node.children)
        if isinstance(node, SkillChild):
            text = self._texts.get(node.path, "")
            below += [node.tree] if node.tree is not None else []
        yield Text.assemble("  " * depth, (mark, style), f" {node.name}  ", (text, "dim"), "\n")
        for child in below:
            yield from self._rows(child, depth + 1)
