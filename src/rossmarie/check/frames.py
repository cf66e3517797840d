"""The frames that system models declare, as a tree, and the paths from one frame to another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rossmarie.syntax import ast

MOVING = "/tf"
STATIC = "/tf_static"
"""The topics of transforms that never change."""

LONGEST_NS = 10**18
"""The timeout in ns of a static frame: the frame is stale until it arrives, and never
afterwards.
"""


@dataclass(frozen=True)
class CheckedFrame:
    """A frame with its name in headers, and its parent frame. With a `timeout_ns` it arrives on
    /tf, otherwise on /tf_static. If the rules give its transform, `mounted` contains it: x, y and z
    in m, and the quaternion x, y, z, w of its rotation.
    """

    declaration: ast.FrameDeclaration
    name: str
    parent: str
    timeout_ns: int | None = None
    mounted: tuple[float, ...] | None = None

    @property
    def topic(self) -> str | None:
        """The topic of the frame's transform; None if there is none."""
        if self.mounted is not None or self.declaration.at or self.declaration.turned:
            return None
        return STATIC if self.declaration.timeout is None else MOVING


@dataclass(frozen=True)
class FrameStep:
    """A step of a path between frames: from a frame to its parent, or back."""

    frame: CheckedFrame
    is_back: bool


@dataclass
class FrameTree:
    """All frames by name. `aliases` map names in rules to names in headers."""

    frames: dict[str, CheckedFrame] = field(default_factory=dict)
    aliases: dict[str, str] = field(default_factory=dict)

    def named(self, text: str) -> str:
        """The name in headers of a frame that rules name."""
        return self.aliases.get(text, text)

    def __contains__(self, name: str) -> bool:
        """Say whether a declaration names a frame, as a child or as a parent."""
        return name in self.frames or any(each.parent == name for each in self.frames.values())

    @property
    def names(self) -> tuple[str, ...]:
        """All names that rules can use for frames."""
        parents = (each.parent for each in self.frames.values())
        return tuple(dict.fromkeys((*self.aliases, *self.frames, *parents)))

    def path(self, source: str, target: str) -> tuple[FrameStep, ...] | None:
        """The path from one frame to another; None if there is none. The tree has no circle."""
        up, down = self._above(source), self._above(target)
        above = {each.parent: number for number, each in enumerate(up, start=1)} | {source: 0}
        meeting = {each.parent: number for number, each in enumerate(down, start=1)} | {target: 0}
        common = next((name for name in (source, *above) if name in meeting), None)
        if common is None:
            return None
        there = [FrameStep(each, is_back=False) for each in up[: above[common]]]
        back = [FrameStep(each, is_back=True) for each in reversed(down[: meeting[common]])]
        return (*there, *back)

    def _above(self, name: str) -> list[CheckedFrame]:
        """The frames on the path from a frame to the root, the frame itself first."""
        found: list[CheckedFrame] = []
        while name in self.frames and self.frames[name] not in found:
            found.append(self.frames[name])
            name = self.frames[name].parent
        return found


def named_inputs(tree: FrameTree, taken: Mapping[str, object]) -> dict[str, str]:
    """The name of the input for each frame, by the name of the frame: its alias, or its own name if
    rules can write it.
    """
    called = {frame: alias for alias, frame in tree.aliases.items()}
    found: dict[str, str] = {}
    for frame in tree.frames.values():
        if frame.topic is None:
            continue
        name = called.get(frame.name, frame.name)
        name = "".join(each if each.isascii() and each.isalnum() else "_" for each in name)
        if not name[:1].isalpha():
            name = f"frame_{name}"
        while name in taken or name in found.values():
            name += "_frame"
        found[frame.name] = name
    return found
