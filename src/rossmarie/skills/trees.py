"""Behavior trees of compound skills in a skills file.

The code does not recurse, because a file may be nested to any depth.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence
from typing import TypeVar

from rossmarie.skills.json_reader import Json
from rossmarie.skills.locations import place_of
from rossmarie.skills.model import Control, Node, SkillNode

SERIAL = ("serial", "serialstar")
"""The words for nodes that tick their children in order while these succeed."""
SELECTOR = ("selector", "selectorstar")
"""The words for nodes that tick their children in order until one succeeds."""
FIRST_SUCCESS = "parallelfs"
FIRST_FAILURE = "parallelff"
RETRY, TIMEOUT = "retry", "timeout"
NO_FAIL, INVERTER = "nofail", "inverter"
_LIMITS = {RETRY: "tries", TIMEOUT: "seconds"}
"""The keys of the numbers in nodes."""

_Made = TypeVar("_Made")


def folded(
    tree: Node,
    of_step: Callable[[SkillNode], _Made],
    of_control: Callable[[Control, Sequence[_Made]], _Made],
) -> _Made:
    """The result for a tree: the results of its skills, combined by the nodes above them."""
    found: list[_Made] = []
    waiting: list[tuple[Node, bool]] = [(tree, False)]
    while waiting:
        node, is_below_done = waiting.pop()
        if isinstance(node, SkillNode):
            found.append(of_step(node))
        elif is_below_done:
            first = len(found) - len(node.children)
            found[first:] = [of_control(node, found[first:])]
        else:
            waiting.append((node, True))
            waiting += [(each, False) for each in reversed(node.children)]
    return found[0]


def steps(tree: Node) -> Iterator[tuple[SkillNode, tuple[Control, ...]]]:
    """The skills of a tree in their order, each with the nodes above it, the root first."""
    waiting: list[tuple[Node, tuple[Control, ...]]] = [(tree, ())]
    while waiting:
        node, above = waiting.pop()
        if isinstance(node, SkillNode):
            yield node, above
        else:
            waiting += [(each, (*above, node)) for each in reversed(node.children)]


def read_tree(tree: Json, name: Callable[[Json], str], numbers: Container[str]) -> Control:
    """One tree of a compound; `numbers` are its number parameters. `name` reads the name of a
    skill. Raises `UnreadableJson`.
    """
    found: list[Node] = []
    waiting: list[tuple[Json, list[Json] | None]] = [(tree, None)]
    while waiting:
        item, below = waiting.pop()
        if below is not None:
            first = len(found) - len(below)
            found[first:] = [_control(item, tuple(found[first:]), numbers, is_root=item is tree)]
        elif item is not tree and item.find("skill") is not None:
            found.append(_step(item, name))
        else:
            below = [*item.get("children").elements()]
            waiting.append((item, below))
            waiting += [(each, None) for each in reversed(below)]
    (root,) = found
    assert isinstance(root, Control), "it is read as one"
    return root


def _step(item: Json, name: Callable[[Json], str]) -> SkillNode:
    given = item.find("arguments")
    arguments = {} if given is None else given.members(lambda each: each.optional(Json.text))
    return SkillNode(name(item.get("skill")), arguments, place_of(item))


def _control(
    item: Json, children: tuple[Node, ...], numbers: Container[str], *, is_root: bool
) -> Control:
    kind = None if is_root else item.find("control")
    word = SERIAL[0] if is_root else "" if kind is None else kind.text()
    key = _LIMITS.get(word)
    found = None if key is None else item.find(key)
    limit = None if found is None else _limit(found, numbers)
    return Control(word, children, place_of(item), limit)


def _limit(found: Json, numbers: Container[str]) -> float | str:
    if isinstance(found.value, str):
        if found.value not in numbers:
            found.fail("is no parameter of the skill that is a number")
        return found.value
    number = found.number()
    if number <= 0:
        found.fail("is not above 0")
    return number
