"""A wiring as a picture: the node in the middle, commands across its top, inputs below on the left,
and outputs below on the right.

Widths are computed from numbers of characters, a little too wide for most fonts.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from textwrap import wrap

from rossmarie.ir.duration_text import duration_text
from rossmarie.report.wiring.model import (
    PLANNER,
    ROBOT,
    NodeWiring,
    Output,
    Subscription,
    WiredCommand,
)

_MARGIN = 24
_PADDING = 12
_LINE = 16
_GAP = 14
_SHORTEST_WIRE = 56
_NODE_HEAD = 38
_LONGEST_LINE = 52
_TITLE_WIDTH = 10
_NAME_WIDTH = 7.4
_WORDS_WIDTH = 6.2
"""The widths of a character of the title, of names, and of other words, in the units of the
picture.
"""


@dataclass(frozen=True)
class Block:
    """A name with lines of words below it, and the width and height of a box around them."""

    name: str
    lines: tuple[str, ...]

    @property
    def width(self) -> float:
        """The width of its box."""
        widest = max((len(line) * _WORDS_WIDTH for line in self.lines), default=0)
        return 2 * _PADDING + max(len(self.name) * _NAME_WIDTH, widest)

    @property
    def height(self) -> float:
        """The height of its box."""
        return 2 * _PADDING - 4 + _LINE * (1 + len(self.lines))


def wiring_svg(wiring: NodeWiring) -> str:
    """The text of an SVG file without any external references."""
    picture = _Picture(wiring)
    ET.indent(picture.root)
    return ET.tostring(picture.root, encoding="unicode") + "\n"


def _filter_block(command: WiredCommand) -> Block:
    return _block("safety filter", command.message_type, *map(str, command.uses))


def _input_block(each: Subscription) -> Block:
    timeout = "no timeout"
    if each.timeout_ns is not None:
        timeout = f"timeout {duration_text(each.timeout_ns)}"
    return _block(each.topic, f"{each.message_type}, {timeout}", f"for {', '.join(each.rules)}")


def _output_block(each: Output) -> Block:
    kind = each.kind.value if each.type is None else f"{each.kind.value}, {each.type}"
    return _block(each.name, kind, *map(str, each.uses))


def _block(name: str, *lines: str) -> Block:
    """A block whose long lines are broken between words."""
    broken = (
        wrap(line, _LONGEST_LINE, subsequent_indent="    ", break_long_words=False)
        for line in lines
    )
    return Block(name, tuple(part for parts in broken for part in parts))


class _Picture:
    """Draws from top to bottom. The content determines the width of columns."""

    def __init__(self, wiring: NodeWiring) -> None:
        self._wiring = wiring
        self._filters = [_filter_block(command) for command in wiring.commands]
        self._inputs = [_input_block(each) for each in wiring.inputs]
        self._outputs = [_output_block(each) for each in wiring.outputs]
        self._set_columns()
        about = {"xmlns": "http://www.w3.org/2000/svg", "class": "wiring", "role": "img"}
        self.root = ET.Element("svg", about)
        ET.SubElement(self.root, "title").text = f"The wiring of {wiring.node}"
        ET.SubElement(self.root, "style").text = _style()
        self._add("rect", "paper", width="100%", height="100%")
        remark = self._left + len(wiring.remark or "") * _WORDS_WIDTH
        width = f"{max(self._right_end, remark) + _MARGIN:g}"
        height = f"{self._draw():g}"
        self.root.attrib |= {"width": width, "height": height, "viewBox": f"0 0 {width} {height}"}

    def _set_columns(self) -> None:
        """Compute the left and right ends of the boxes on the left, of the node, and of the boxes
        on the right.
        """
        wiring = self._wiring
        ends = [Block(name, ()) for name in (PLANNER, ROBOT)] if wiring.commands else []
        left, right = [*self._inputs, *ends[:1]], [*self._outputs, *ends[1:]]
        inside = [block.width for block in self._filters] + [len(wiring.node) * _TITLE_WIDTH]
        before = [command.unfiltered for command in wiring.commands]
        after = [command.topic for command in wiring.commands]
        self._left = _MARGIN
        self._left_end = self._left + _widest(left)
        self._node = self._left_end + (_wire_length(before) if left else 0)
        self._node_end = self._node + max(inside) + 2 * _PADDING
        self._right = self._node_end + (_wire_length(after) if right else 0)
        self._right_end = self._right + _widest(right)

    # --- drawing -----------------------------------------------------------------------------

    def _draw(self) -> float:
        """Draw everything. Returns the height of the picture."""
        width = self._node_end - self._node
        node = self._add("rect", "node", x=self._node, y=_MARGIN, width=width, rx=10)
        self._text(self._node + width / 2, _MARGIN + 25, self._wiring.node, "node-name")
        top = self._draw_commands(_MARGIN + _NODE_HEAD)
        bottom = max(self._draw_inputs(top), self._draw_outputs(top), top)
        node.set("height", f"{bottom - _MARGIN:g}")
        if self._wiring.remark:
            bottom += _LINE + 6
            self._text(self._left, bottom, self._wiring.remark, "words")
        return bottom + _MARGIN

    def _draw_commands(self, first: float) -> float:
        """Draw the planner and the robot beside all filters. Returns their lower end."""
        top = first
        inside = self._node_end - self._node - 2 * _PADDING
        for command, block in zip(self._wiring.commands, self._filters, strict=True):
            y = top + block.height / 2
            self._text((self._left_end + self._node) / 2, y - 8, command.unfiltered, "topic")
            self._wire(self._left_end, self._node + _PADDING, y, "command")
            self._text((self._node_end + self._right) / 2, y - 8, command.topic, "topic")
            self._wire(self._node_end - _PADDING, self._right, y, "command")
            self._box(self._node + _PADDING, top, block, inside, "filter")
            top += block.height + _GAP
        if self._filters:
            self._end(PLANNER, self._left, self._left_end, first, top - _GAP)
            self._end(ROBOT, self._right, self._right_end, first, top - _GAP)
        return top

    def _end(self, name: str, x: float, x_end: float, y: float, y_end: float) -> None:
        """Draw the source or the target of commands."""
        self._add("rect", "box", x=x, y=y, width=x_end - x, height=y_end - y, rx=6)
        self._text((x + x_end) / 2, (y + y_end) / 2 + 4, name, "end")

    def _draw_inputs(self, top: float) -> float:
        for block in self._inputs:
            self._box(self._left, top, block, self._left_end - self._left)
            self._wire(self._left_end, self._node, top + block.height / 2)
            top += block.height + _GAP
        return top

    def _draw_outputs(self, top: float) -> float:
        for block in self._outputs:
            self._box(self._right, top, block, self._right_end - self._right)
            self._wire(self._node_end, self._right, top + block.height / 2)
            top += block.height + _GAP
        return top

    # --- elements ----------------------------------------------------------------------------

    def _box(self, x: float, y: float, block: Block, width: float, kind: str = "box") -> None:
        self._add("rect", kind, x=x, y=y, width=width, height=block.height, rx=6)
        baseline = y + _PADDING + 8
        self._text(x + _PADDING, baseline, block.name, "name")
        for number, line in enumerate(block.lines, start=1):
            self._text(x + _PADDING, baseline + number * _LINE, line, "words")

    def _wire(self, x: float, end: float, y: float, kind: str = "other") -> None:
        self._add("path", f"wire {kind}", d=f"M{x:g} {y:g}H{end - 8:g}")
        self._add("path", f"head {kind}", d=f"M{end:g} {y:g}l-9 -5v10z")

    def _text(self, x: float, y: float, text: str, kind: str) -> None:
        self._add("text", kind, x=x, y=y).text = text

    def _add(self, tag: str, kind: str, **attributes: float | str) -> ET.Element:
        written = {
            name: value if isinstance(value, str) else f"{value:g}"
            for name, value in attributes.items()
        }
        return ET.SubElement(self.root, tag, {"class": kind, **written})


def _widest(blocks: Sequence[Block]) -> float:
    return max((block.width for block in blocks), default=0)


def _wire_length(labels: Sequence[str]) -> float:
    """The length of a wire, on which the longest label has to fit."""
    longest = max(map(len, labels), default=0)
    return max(_SHORTEST_WIRE, longest * _NAME_WIDTH + 2 * _PADDING)


def _style() -> str:
    """The styles of the picture. They do not affect the page around it."""
    folder = files("rossmarie.report") / "assets"
    names = ("palette.css", "wiring.css")
    text = "\n".join((folder / name).read_text(encoding="utf-8") for name in names)
    return text.replace(":root", ".wiring")
