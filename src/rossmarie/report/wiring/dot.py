"""A wiring in the language of Graphviz: nodes are ellipses; topics, services and other resources
that nodes use are boxes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rossmarie.ir.duration_text import duration_text
from rossmarie.report.wiring.model import (
    PLANNER,
    ROBOT,
    NodeWiring,
    Output,
    Subscription,
    TargetKind,
    WiredCommand,
)


def wiring_dot(wiring: NodeWiring) -> str:
    """The text of a file for `dot`."""
    lines = [line for command in wiring.commands for line in _command(wiring.node, command)]
    lines += [line for each in wiring.inputs for line in _input(wiring.node, each)]
    lines += [line for each in wiring.outputs for line in _output(wiring.node, each)]
    if wiring.remark:
        lines.append(f"label={_quoted(wiring.remark)};")
    inside = "".join(f"    {line}\n" for line in lines)
    return (
        f"digraph {_quoted(wiring.node)} {{\n"
        f"    rankdir=LR;\n    node [shape=box];\n"
        f"    {_node(wiring.node)} [label={_quoted(wiring.node)}, shape=ellipse, penwidth=2];\n"
        f"{inside}}}\n"
    )


def _command(node: str, command: WiredCommand) -> Iterator[str]:
    for end in (PLANNER, ROBOT):
        yield f"{_node(end)} [label={_quoted(end)}, shape=ellipse];"
    for topic in (command.unfiltered, command.topic):
        yield _resource(TargetKind.TOPIC, topic, command.message_type)
    unfiltered, filtered = (
        _id(TargetKind.TOPIC, command.unfiltered),
        _id(TargetKind.TOPIC, command.topic),
    )
    yield f"{_node(PLANNER)} -> {unfiltered} -> {_node(node)} [penwidth=2];"
    yield f"{_node(node)} -> {filtered} [label={_lines(map(str, command.uses))}, penwidth=2];"
    yield f"{filtered} -> {_node(ROBOT)} [penwidth=2];"


def _input(node: str, each: Subscription) -> Iterator[str]:
    timeout = "no timeout" if each.timeout_ns is None else duration_text(each.timeout_ns)
    yield _resource(TargetKind.TOPIC, each.topic, each.message_type)
    label = _lines((timeout, f"for {', '.join(each.rules)}"))
    yield f"{_id(TargetKind.TOPIC, each.topic)} -> {_node(node)} [label={label}];"


def _output(node: str, each: Output) -> Iterator[str]:
    yield _resource(each.kind, each.name, each.type or each.kind.value)
    label = _lines(map(str, each.uses))
    yield f"{_node(node)} -> {_id(each.kind, each.name)} [label={label}];"


def _resource(kind: TargetKind, name: str, below: str) -> str:
    return f"{_id(kind, name)} [label={_lines((name, below))}];"


def _id(kind: TargetKind, name: str) -> str:
    """An identifier. A topic and a service with the same name have different identifiers."""
    return _quoted(f"{kind.value} {name}")


def _node(name: str) -> str:
    return _quoted(f"node {name}")


def _lines(lines: Iterable[str]) -> str:
    return _quoted("\\n".join(lines))


def _quoted(text: str) -> str:
    """The quoted text. Names in ROS and in rules contain no character that ends a quotation."""
    return f'"{text}"'
