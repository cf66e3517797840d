"""Rewrites the tree of a file with the names of the whole program.

The recursion follows the tree, with two or three Python frames per level; the syntax limits its
depth.
"""

from __future__ import annotations

import dataclasses
import enum
from collections.abc import Collection, Mapping
from typing import Any, TypeVar

from dslkit.source import SourceFile, Span
from rossmarie.check.instances.spaces import Instances, Path, Space, Spaces, flat
from rossmarie.check.wording.suggestions import near_name
from rossmarie.syntax import ast

_Node = TypeVar("_Node")


class Kind(enum.Enum):
    """The set that a name belongs to. Names of no set stay unchanged."""

    NAME = enum.auto()
    RULE = enum.auto()
    TOPIC = enum.auto()
    ALIAS = enum.auto()
    FRAME = enum.auto()


KINDS: Mapping[type[object], Mapping[str, Kind]] = {
    ast.Action: {"name": Kind.NAME},
    ast.Constant: {"name": Kind.NAME},
    ast.Parameter: {"name": Kind.NAME},
    ast.Entity: {"name": Kind.NAME},
    ast.Motion: {"name": Kind.NAME},
    ast.Zone: {"name": Kind.NAME, "frame": Kind.FRAME},
    ast.Input: {
        "name": Kind.NAME,
        "topic": Kind.TOPIC,
        "source": Kind.FRAME,
        "frame": Kind.FRAME,
    },
    ast.Index: {"constant": Kind.NAME},
    ast.Step: {"action": Kind.NAME, "otherwise": Kind.NAME},
    ast.Keeps: {"motion": Kind.NAME},
    ast.Reference: {"name": Kind.NAME},
    ast.ListFold: {"variable": Kind.NAME},
    ast.CallService: {"otherwise": Kind.NAME},
    ast.SetParameter: {"otherwise": Kind.NAME, "node": Kind.TOPIC},
    ast.SwitchControllers: {"otherwise": Kind.NAME, "manager": Kind.TOPIC},
    ast.SendGoal: {"otherwise": Kind.NAME},
    ast.CancelGoal: {"otherwise": Kind.NAME, "server": Kind.TOPIC},
    ast.RunTree: {"otherwise": Kind.NAME},
    ast.Rule: {"name": Kind.RULE, "unless": Kind.RULE},
    ast.Priority: {"rules": Kind.RULE},
    ast.Expectation: {"rule": Kind.RULE},
    ast.OperatorReset: {"rule": Kind.RULE},
    ast.TopicDeclaration: {"alias": Kind.ALIAS, "topic": Kind.TOPIC, "source": Kind.FRAME},
    ast.FrameDeclaration: {"frame": Kind.FRAME, "parent": Kind.FRAME},
    ast.ServiceDeclaration: {"name": Kind.TOPIC},
    ast.ServerDeclaration: {"name": Kind.TOPIC},
    ast.ResourceDeclaration: {"targets": Kind.TOPIC},
    ast.NodeDeclaration: {"publishes": Kind.TOPIC, "subscribes": Kind.TOPIC},
    ast.Target: {"name": Kind.TOPIC},
    ast.CommandExpectation: {"topic": Kind.TOPIC},
}
"""The fields that contain names of a set, by node type. All other names mean the same
everywhere.
"""


class Rewriter:
    """Rewrites the nodes of one file of a name space. The places of the new nodes are in `file`."""

    def __init__(
        self, file: SourceFile, space: Space, spaces: Spaces, instances: Instances
    ) -> None:
        self.file = file
        self._space = space
        self._whole = spaces[()]
        self._spaces = spaces
        self._instances = instances
        self._conditions: frozenset[str] = frozenset()
        self._variables: list[str] = []

    def node(self, node: _Node) -> _Node:
        """A node with everything inside it."""
        return self._rebuilt(node)  # type: ignore[no-any-return]

    def span(self, span: Span) -> Span:
        """The same place, in the file of this name space."""
        return Span(self.file, span.start, span.end)

    def topic(self, name: ast.Name) -> ast.Name:
        """The topic that a name stands for, or its alias."""
        text = name.text
        for space in (self._space, self._whole):
            if text in space.topics:
                text = space.topics[text].text
                break
            if text in space.aliases:
                text = self._made(space.path, text)
                break
        return ast.Name(text, self.span(name.span))

    def frame(self, name: ast.Name) -> ast.Name:
        """The frame that a name stands for, in the name from headers or from the system model."""
        spaces = (self._space, self._whole)
        found = next((each.frames[name.text] for each in spaces if name.text in each.frames), name)
        return ast.Name(found.text, self.span(name.span))

    # --- nodes -------------------------------------------------------------------------------

    def _rebuilt(self, value: Any) -> Any:
        if isinstance(value, Span):
            return Span(self.file, value.start, value.end)
        if isinstance(value, tuple):
            return tuple([self._rebuilt(each) for each in value])
        if not dataclasses.is_dataclass(value) or isinstance(value, type):
            return value
        match value:
            case ast.Member():
                return self._member(value)
            case ast.Entity():
                return self._entity(value)
            case ast.ListFold():
                return self._fold(value)
            case ast.Setting():
                return self._setting(value)
            case ast.Input(unit=ast.Unit() as unit, frame=None) if self._is_frame(unit.text):
                frame = ast.Name(unit.text, unit.span)
                return self._parts(dataclasses.replace(value, unit=None, frame=frame))
            case _:  # open: all other nodes are rebuilt part by part
                return self._parts(value)

    def _parts(self, node: Any) -> Any:
        kinds = KINDS.get(type(node), {})
        if isinstance(node, ast.Reference) and self._is_condition(node.name.text):
            kinds = {}
        found = {}
        for each in dataclasses.fields(node):
            value, kind = getattr(node, each.name), kinds.get(each.name)
            found[each.name] = self._rebuilt(value) if kind is None else self._named(value, kind)
        return type(node)(**found)

    def _named(self, value: Any, kind: Kind) -> Any:
        if isinstance(value, tuple):
            return tuple([self._named(each, kind) for each in value])
        if not isinstance(value, ast.Name):
            return self._rebuilt(value)
        match kind:
            case Kind.TOPIC:
                return self.topic(value)
            case Kind.FRAME:
                return self.frame(value)
            case Kind.ALIAS:
                return ast.Name(self._made(self._space.path, value.text), self.span(value.span))
            case Kind.NAME | Kind.RULE:
                words = tuple(value.text.split("."))
                text, rest = self._resolved(words, kind)
                return ast.Name(".".join((text, *rest)), self.span(value.span))

    def _entity(self, node: ast.Entity) -> ast.Entity:
        """Inside an entity, the conditions of the entity take precedence over declarations of the
        file.
        """
        self._conditions = frozenset(each.name.text for each in node.conditions)
        found: ast.Entity = self._parts(node)
        self._conditions = frozenset()
        return found

    def _fold(self, node: ast.ListFold) -> ast.ListFold:
        its_list = self._rebuilt(node.list)
        self._variables.append(node.variable.text)
        found: ast.ListFold = self._parts(node)
        self._variables.pop()
        return dataclasses.replace(found, list=its_list)

    def _is_condition(self, name: str) -> bool:
        return name in self._conditions and name not in self._space.values

    def _member(self, node: ast.Member) -> ast.Expression:
        """`front.near` is one name. In other chains, the first name is looked up."""
        chain: list[ast.Member] = []
        root: ast.Expression = node
        while isinstance(root, ast.Member):
            chain.append(root)
            root = root.value
        if not isinstance(root, ast.Reference):
            found = self._rebuilt(root)
        else:
            words = (root.name.text, *(each.member.text for each in reversed(chain)))
            text, rest = self._resolved(words, None)
            taken = len(words) - len(rest) - 1
            last = chain[-taken] if taken else root
            del chain[len(chain) - taken :]
            span = self.span(last.span)
            found = ast.Reference(ast.Name(text, span), span)
        for each in reversed(chain):
            found = ast.Member(found, self._rebuilt(each.member), self.span(each.span))
        return found  # type: ignore[no-any-return]

    def _setting(self, node: ast.Setting) -> ast.Setting:
        """The input at the beginning of a setting."""
        steps = node.path.steps
        names = [each for each in steps if isinstance(each, ast.Name)]
        words = tuple(each.text for each in names) if len(names) == len(steps) else ()
        for index, step in enumerate(steps):
            if not isinstance(step, ast.Name):
                words = tuple(each.text for each in names[:index])
                break
        text, rest = self._resolved(words, Kind.NAME)
        taken = len(words) - len(rest)
        first = ast.Name(text, self.span(steps[0].span.to(steps[taken - 1].span)))
        path = ast.SettingPath((first, *self._rebuilt(steps[taken:])), self.span(node.path.span))
        value = self._rebuilt(node.value)
        return ast.Setting(path, value, node.is_unknown, self.span(node.span))

    # --- names -------------------------------------------------------------------------------

    def _resolved(self, words: tuple[str, ...], kind: Kind | None) -> tuple[str, tuple[str, ...]]:
        """The name that words between dots stand for, and the remaining words. Without a kind, the
        first word may be an element of a list, or a message. Declarations of the file take
        precedence over names of the whole program.
        """
        first, *_ = words
        is_declared = kind is not Kind.RULE and first in self._space.names
        spaces = (self._space,) if is_declared else (self._space, self._whole)
        for space in spaces if first not in self._variables else ():
            path, at = space.path, 0
            while at + 1 < len(words) and self._leads_on(path, words[at]):
                path, at = (*path, words[at]), at + 1
            if at:
                return self._made(path, words[at]), words[at + 1 :]
        own, whole = self._known(self._space, kind), self._known(self._whole, kind)
        is_guess = kind is not None and first not in whole
        is_own = first in own or (is_guess and self._is_meant(first, own))
        return self._made(self._space.path, first) if is_own else first, words[1:]

    def _is_frame(self, name: str) -> bool:
        """Say whether a parameter for a frame has this name."""
        return name in self._space.frames or name in self._whole.frames

    def _leads_on(self, path: Path, name: str) -> bool:
        """Say whether a name space contains another name space with this name. A file that cannot
        be read has no name space.
        """
        return path in self._spaces and name in self._spaces[path].inner

    def _known(self, space: Space, kind: Kind | None) -> Collection[str]:
        return space.rules if kind is Kind.RULE else space.names

    def _is_meant(self, name: str, own: Collection[str]) -> bool:
        """Say whether an undeclared name is a misspelt name of this name space, and is therefore
        reported as such. With skills, the name may be a class of individuals.
        """
        is_other = name in self._conditions or name in self._variables
        if not self._space.path or is_other or not self._instances.guesses.take(len(own)):
            return False
        return near_name(name, own) is not None

    def _made(self, path: Path, name: str) -> str:
        if not path:
            return name
        found = flat(path, name)
        self._instances.names.setdefault(found, (path, name))
        return found
