"""A witness as a small picture: the instants of messages, and the times during which rules are
active.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

from rossmarie import ir
from rossmarie.analysis.witness import View, Witness, views
from rossmarie.ir.duration_text import duration_text

_WIDTH, _TAIL = 360.0, 48.0
_ROW, _BAR, _AXIS = 22.0, 12.0, 20.0
_LETTER = 7.2
_CLOSEST = 46.0
"""The least distance between two labelled instants, in the units of the picture."""


def witness_svg(machine: ir.Machine, witness: Witness) -> str:
    """The text of an SVG element that the page styles; empty if no rule becomes active."""
    seen = list(views(machine, witness))
    rules = [
        index for index in range(len(machine.rules)) if any(view.active[index] for view in seen)
    ]
    if not rules:
        return ""
    left = 12 + _LETTER * max(len(machine.rules[rule].name) for rule in rules)
    first_ns, last_ns = seen[0].at_ns, max(seen[-1].at_ns, witness.end_ns)
    scale = _WIDTH / max(last_ns - first_ns, 1)

    def x(at_ns: int) -> float:
        return left + (at_ns - first_ns) * scale

    height = _ROW * len(rules) + _AXIS
    width = left + _WIDTH + _TAIL
    box = f"0 0 {width:g} {height:g}"
    root = ET.Element(
        "svg",
        {"class": "witness", "role": "img", "viewBox": box, "width": f"{width:g}",
         "height": f"{height:g}"},
    )  # fmt: skip
    names = ", ".join(machine.rules[rule].name for rule in rules)
    ET.SubElement(root, "title").text = f"When {names} are active"
    for row, rule in enumerate(rules):
        top = row * _ROW
        _text(root, "rule", 0.0, top + _ROW - 8, machine.rules[rule].name)
        _line(root, "base", left, top + _ROW - 2, left + _WIDTH + _TAIL)
        for begin_ns, end_ns in _stretches(seen, rule):
            end = left + _WIDTH + _TAIL if end_ns is None else x(end_ns)
            place = {"x": f"{x(begin_ns):g}", "y": f"{top + _ROW - 4 - _BAR:g}"}
            size = {"width": f"{max(end - x(begin_ns), 2.0):g}", "height": f"{_BAR:g}"}
            ET.SubElement(root, "rect", {"class": "active", **place, **size})
    for at_ns in _written([event.at_ns for event in witness.events], scale):
        _text(root, "instant", x(at_ns), height - 4, duration_text(at_ns) if at_ns else "0 s")
    return ET.tostring(root, encoding="unicode")


def _text(root: ET.Element, kind: str, x: float, y: float, words: str) -> None:
    ET.SubElement(root, "text", {"class": kind, "x": f"{x:g}", "y": f"{y:g}"}).text = words


def _line(root: ET.Element, kind: str, x1: float, y: float, x2: float) -> None:
    ends = {"x1": f"{x1:g}", "x2": f"{x2:g}", "y1": f"{y:g}", "y2": f"{y:g}"}
    ET.SubElement(root, "line", {"class": kind, **ends})


def _stretches(seen: Sequence[View], rule: int) -> Iterator[tuple[int, int | None]]:
    """The times during which a rule is active, as start and end; an end of None is the end of the
    witness.
    """
    begin_ns: int | None = None
    for view in seen:
        if view.active[rule] and begin_ns is None:
            begin_ns = view.at_ns
        elif not view.active[rule] and begin_ns is not None:
            yield begin_ns, view.at_ns
            begin_ns = None
    if begin_ns is not None:
        yield begin_ns, None


def _written(instants: Sequence[int], scale: float) -> Iterator[int]:
    """The instants that are far enough from each other to be labelled."""
    last_ns: int | None = None
    for at_ns in instants:
        if last_ns is None or (at_ns - last_ns) * scale >= _CLOSEST:
            yield at_ns
            last_ns = at_ns
