"""The page about the rules of the library that the included robots use."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from rossmarie.driver.robots import BuiltInRobot, robots
from rossmarie.driver.workspace import LIBRARY, SYSTEM_MODEL
from rossmarie.syntax import ast
from support.library import library_files, module_of, name_of, parameters_of, rules_of

_REASON = re.compile(r"^// Not rossmarie/(\S+): (.*)$", re.MULTILINE)
_SHIPPED = "rossmarie/"

_HEAD = """\
# One library, five robots

Written by `benchmarks/library_reuse.py` from the rules of the robots of
[`rossmarie example`](command-line.md#rossmarie-example) and the rules of [the library](library.md);
do not edit. The page [one library, several robots](../explanation/one-library.md) explains the
results.

A robot uses a rule *as it is* if the import changes no number of the rule; names of topics, joints
and frames do not count. A robot uses a rule *with other numbers* if the import sets at least one
number of the rule.
"""


@dataclass(frozen=True)
class _Use:
    """The reuse of a library file by a robot: the arguments of its import."""

    path: Path
    numbers: frozenset[str]

    @cached_property
    def changed(self) -> list[str]:
        """The rules that depend on one of these numbers."""
        return [
            rule.name.text
            for rule in rules_of(self.path)
            if rule.name and self.numbers & {*parameters_of(self.path, rule)}
        ]


@dataclass(frozen=True)
class _Reported:
    """A robot, and the contents of its rules."""

    robot: BuiltInRobot

    @cached_property
    def uses(self) -> dict[str, _Use]:
        """The imported files of the library that have rules, by their names."""
        found = {}
        for item in module_of(self.robot.rules).items:
            if isinstance(item, ast.Import) and item.path.value.startswith(_SHIPPED):
                name = item.path.value.removeprefix(_SHIPPED)
                given = (each for each in item.given if not _is_name(LIBRARY / name, each))
                numbers = frozenset(each.name.text for each in given)
                found[name] = _Use(LIBRARY / name, numbers)
        return {name: use for name, use in found.items() if rules_of(use.path)}

    @cached_property
    def reasons(self) -> dict[str, str]:
        """The reasons in the rules for the files that they do not import."""
        text = self.robot.rules.read_text(encoding="utf-8")
        return {name: reason.rstrip(".") for name, reason in _REASON.findall(text)}

    @cached_property
    def types(self) -> set[str]:
        """The types of the messages that the robot publishes or receives."""
        model = module_of(self.robot.folder / SYSTEM_MODEL)
        return {
            part.message_type.text
            for item in model.items
            if isinstance(item, ast.System)
            for part in item.members
            if isinstance(part, ast.TopicDeclaration)
        }

    @cached_property
    def replaced(self) -> set[str]:
        """The actions of the library that a copy beside the rules changes."""
        folder = self.robot.folder / "rossmarie"
        copies = sorted(folder.glob("*.ross")) if folder.exists() else []
        return {
            name
            for copy in copies
            for name, text in _actions(LIBRARY / copy.name).items()
            if _actions(copy).get(name) != text
        }

    def lacks(self, path: Path) -> list[str]:
        """The types of messages that a file reads but the robot does not have."""
        inputs = [item for item in module_of(path).items if isinstance(item, ast.Input)]
        types = {item.message_type.text for item in inputs if item.message_type}
        return sorted(types - self.types)


def _is_name(path: Path, given: ast.Given) -> bool:
    """Say whether a parameter is a topic, a frame or another name, but not a number."""
    for item in module_of(path).items:
        if isinstance(item, ast.Parameter) and item.name.text == given.name.text:
            words = item.span.text.split("=", 1)[-1].split()
            return words[0] in ("topic", "frame") or words[0].startswith('"')
    return False


def _actions(path: Path) -> dict[str, str]:
    """The text of each action of a file."""
    items = module_of(path).items if path.exists() else ()
    return {
        item.name.text: " ".join(item.span.text.split())
        for item in items
        if isinstance(item, ast.Action)
    }


def page() -> str:
    """The text of the page."""
    reported = [_Reported(robot) for robot in robots()]
    files = [path for path in library_files() if rules_of(path)]
    parts = [
        _rules(reported, files),
        _files(reported, files),
        _own(reported),
        _recoveries(reported, files),
    ]
    return _HEAD + "".join("\n" + "\n".join(part) + "\n" for part in parts)


def _rules(reported: Sequence[_Reported], files: Sequence[Path]) -> Iterator[str]:
    every = sum(len(rules_of(path)) for path in files)
    yield "## Rules"
    yield ""
    yield (
        "| Robot | Used as they are | Used with other numbers | Not used: message missing "
        "| Not used: other reason | Own rules |"
    )
    yield "|---|---|---|---|---|---|"
    for each in reported:
        changed = sum(len(use.changed) for use in each.uses.values())
        used = sum(len(rules_of(use.path)) for use in each.uses.values())
        own = len(rules_of(each.robot.rules))
        left = [path for path in files if name_of(path) not in each.uses]
        lacking = sum(len(rules_of(path)) for path in left if each.lacks(path))
        numbers = (used - changed, changed, lacking, every - used - lacking, own)
        yield f"| {each.robot.name} | {' | '.join(map(str, numbers))} |"
    anywhere = {name for each in reported for name in each.uses}
    used = sum(len(rules_of(path)) for path in files if name_of(path) in anywhere)
    several = {name for name in anywhere if sum(name in each.uses for each in reported) > 1}
    shared = sum(len(rules_of(path)) for path in files if name_of(path) in several)
    yield ""
    yield f"The library has {every} rules. The robots use {used} of them, and several robots use"
    yield f"{shared} of them."


def _files(reported: Sequence[_Reported], files: Sequence[Path]) -> Iterator[str]:
    yield "## Files of the library"
    yield ""
    yield "Each cell lists the numbers that the import sets. A dash means that the robot does not"
    yield "use the file."
    yield ""
    yield f"| File | {' | '.join(each.robot.name for each in reported)} |"
    yield f"|---|{'---|' * len(reported)}"
    for path in files:
        cells = (_cell(each.uses.get(name_of(path))) for each in reported)
        yield f"| {name_of(path)} | {' | '.join(cells)} |"
    yield ""
    yield "Files that a robot does not use, and the reasons:"
    yield ""
    for each in reported:
        for path in files:
            if name_of(path) not in each.uses:
                yield f"- {each.robot.name}, {name_of(path)}: {_reason(each, path)}."


def _cell(use: _Use | None) -> str:
    if use is None:
        return "-"
    return ", ".join(f"`{name}`" for name in sorted(use.numbers)) or "as it is"


def _reason(reported: _Reported, path: Path) -> str:
    lacking = reported.lacks(path)
    if name_of(path) in reported.reasons:
        return reported.reasons[name_of(path)]
    if lacking:
        return "the robot has no " + " and no ".join(lacking)
    return "the robot could use the file, but its rules do not import it"


def _own(reported: Sequence[_Reported]) -> Iterator[str]:
    yield "## Rules of a single robot"
    yield ""
    for each in reported:
        names = [f"`{rule.name.text}`" for rule in rules_of(each.robot.rules) if rule.name]
        yield f"- {each.robot.name}: {', '.join(names) or 'none'}"


def _recoveries(reported: Sequence[_Reported], files: Sequence[Path]) -> Iterator[str]:
    yield "## Recoveries"
    yield ""
    yield "The table lists the actions in the rules of the library. Each rule declares if its"
    yield "recovery depends on the task. The last two columns list the robots that use the action,"
    yield "and the robots that replace the action by their own action."
    yield ""
    yield "| Action | Rules for all tasks | Rules for a task | Robots | Replaced by |"
    yield "|---|---|---|---|---|"
    tasks: dict[str, dict[str, set[str]]] = {}
    for path in files:
        for rule in rules_of(path):
            for action in rule.actions:
                name = action.text.rpartition(".")[2]
                found = tasks.setdefault(name, {"independent": set(), "dependent": set()})
                assert rule.task is not None
                assert rule.name is not None
                found[rule.task.text].add(f"{name_of(path)} {rule.name.text}")
    for name, found in sorted(tasks.items()):
        rules = {each for group in found.values() for each in group}
        users = [
            each for each in reported if any(rule.partition(" ")[0] in each.uses for rule in rules)
        ]
        robots_ = ", ".join(each.robot.name for each in users) or "-"
        replaced = ", ".join(each.robot.name for each in users if name in each.replaced) or "-"
        counts = f"{len(found['independent'])} | {len(found['dependent'])}"
        yield f"| `{name}` | {counts} | {robots_} | {replaced} |"
