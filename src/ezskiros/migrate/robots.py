"""The robot parameter that SkiROS2 adds to each skill, and the skills that must declare it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

import libcst as cst

from ezskiros.migrate.calls import literal_text, method
from ezskiros.migrate.implementations import described_by, description_name
from ezskiros.migrate.keys import ROBOT
from ezskiros.migrate.parameter_uses import PARAMS, own
from ezskiros.migrate.skills import MigratedSkill


@dataclass(frozen=True)
class Robots:
    """The uses of robots in the implementations of a file: the skills whose robot is used, and for
    each skill the names of its children.
    """

    spoken_of: Collection[str] = ()
    children: Mapping[str, Collection[str]] = field(default_factory=dict)


def robots_in(classes: Iterable[cst.ClassDef]) -> Robots:
    """Find all uses of robots in the classes that implement skills."""
    spoken_of: set[str] = set()
    children: dict[str, set[str]] = {}
    for node in classes:
        call = described_by(node)
        if call is None:
            continue
        found = _Visitor()
        node.visit(found)
        spoken_of |= found.given
        name = description_name(call)
        if name:
            spoken_of |= {name} if found.is_spoken_of else set()
            children.setdefault(name, set()).update(found.children)
    return Robots(spoken_of, children)


def with_robots(said: Iterable[Robots], skills: Iterable[MigratedSkill]) -> set[str]:
    """The skills that must declare their robot. Code uses the robot, or a child needs one, which
    SkiROS2 passes because all children have the parameters of their parents.
    """
    said, needing = list(said), {each.name for each in skills if each.needs_robot}
    found = {name for each in said for name in each.spoken_of}
    callers = (item for each in said for item in each.children.items())
    return found | {name for name, children in callers if not needing.isdisjoint(children)}


def is_about_robot(node: cst.ClassDef) -> bool:
    """Say whether a class uses the robot."""
    found = _Visitor()
    node.visit(found)
    return found.is_spoken_of


class _Visitor(cst.CSTVisitor):
    """A visitor that finds uses of the robot, the children, and the children with an explicit
    robot.
    """

    def __init__(self) -> None:
        self.is_spoken_of = False
        self.given: set[str] = set()
        self.children: set[str] = set()

    def visit_Call(self, node: cst.Call) -> None:  # noqa: N802
        if method(node) != "skill" or not node.args:
            return
        name = (literal_text(node.args[0].value) or "").rpartition(":")[2]
        self.children.add(name)
        keys = [
            literal_text(each.key)
            for argument in node.args[1:]
            for each in getattr(argument.value, "elements", ())
            if isinstance(each, cst.DictElement)
        ]
        if ROBOT in keys:
            self.given.add(name)

    def visit_SimpleString(self, node: cst.SimpleString) -> None:  # noqa: N802
        self.is_spoken_of = self.is_spoken_of or literal_text(node) == ROBOT

    def visit_Attribute(self, node: cst.Attribute) -> None:  # noqa: N802
        is_one = node.attr.value == ROBOT and own(node.value, PARAMS)
        self.is_spoken_of = self.is_spoken_of or is_one
