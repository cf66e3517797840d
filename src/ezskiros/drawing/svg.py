"""A behavior tree as a self-contained SVG picture, laid out from left to right.

The layout is a simple tidy tree: leaves are below each other in the order of their ticks, each node
is at the middle of its children, and children begin at the end of their parent. The font has a
fixed width, so that text sizes are known without a browser. `assets/fold.js` has the same layout,
for trees with folded boxes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from xml.sax.saxutils import escape

from ezskiros.drawing.outline import Line, NodeBox, Outline
from ezskiros.drawing.window import framed

FONT, LINE, PADDING = 13, 18, 10
CHARACTER = 0.62 * FONT
"""The largest width in the fixed-width fonts of browsers."""
BESIDE, BELOW, MARGIN = 44, 14, 24
MOST_CHARACTERS = 64
"""The maximum number of characters per line. The tooltip has the full text."""

_STYLE = """
text { font: 13px ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace; fill: #1c2733; }
.title { font-weight: bold; }
.caption { fill: #8a5a00; font-weight: bold; }
.passed { fill: #0b5c8a; }
.value { fill: #7a2a7a; }
.pre, .hold, .post { fill: #55606c; }
rect.skill { fill: #eaf3fb; stroke: #4a7fb0; }
rect.flow { fill: #fdf3dc; stroke: #c08a1e; }
path { fill: none; stroke: #8a95a1; stroke-width: 1.4; }
"""
_DARK = """
.caption { fill: #e3b65a; }
.passed { fill: #86b8ea; }
.value { fill: #d8a2d8; }
.pre, .hold, .post { fill: #a9b3bc; }
rect.skill { fill: #1b2a38; stroke: #6f9fcc; }
rect.flow { fill: #352a12; stroke: #d6a23c; }
"""


@dataclass
class _Placed:
    """A box with its position, in pixels."""

    box: NodeBox
    texts: list[tuple[str, str]]
    children: list[_Placed] = field(default_factory=list)
    x: float = 0.0
    y: float = 0.0

    @property
    def width(self) -> float:
        longest = max(len(_shortened(text)) for _, text in self.texts)
        return longest * CHARACTER + 2 * PADDING

    @property
    def height(self) -> float:
        return len(self.texts) * LINE + 2 * PADDING - 4

    @property
    def middle(self) -> float:
        return self.y + self.height / 2

    def all(self) -> Iterator[_Placed]:
        """The node and all nodes below it."""
        yield self
        for child in self.children:
            yield from child.all()


def svg(outlines: Sequence[Outline]) -> str:
    """A picture of some trees, one below the other."""
    trees: list[str] = []
    top, right = float(MARGIN), 0.0
    for found in outlines:
        caption = ""
        if found.branch:
            words = "if " + " and ".join(found.branch)
            caption = _text(MARGIN, top + FONT, "caption", words)
            right = max(right, MARGIN + len(_shortened(words)) * CHARACTER)
            top += 2 * LINE
        root = _measured(found.root)
        bottom = _place(root, top)
        _indent(root, MARGIN)
        trees.append(f'<g class="tree">{caption}\n{_drawn(root)}\n</g>')
        right = max(right, *(node.x + node.width for node in root.all()))
        top = bottom + 2 * LINE
    return framed(
        "\n".join(trees),
        width=round(right + MARGIN),
        height=round(top - 2 * LINE + MARGIN),
        name=outlines[0].root.title if outlines else "",
        style=_STYLE,
        dark=_DARK,
        scripts=("zoom.js", "fold.js"),
        numbers={"FONT": FONT, "LINE": LINE, "BELOW": BELOW, "MARGIN": MARGIN},
    )


def _measured(box: NodeBox) -> _Placed:
    title = f"{box.token} {box.title}" if box.token else box.title
    texts = [("title", title), *((line.role.value, _line(line)) for line in box.lines)]
    return _Placed(box, texts, [_measured(child) for child in box.children])


def _line(line: Line) -> str:
    return f"{line.role.value:<4} {line.text}" if line.role.is_condition else line.text


def _place(node: _Placed, top: float) -> float:
    """Place a node and all nodes below it, from a height downwards. Returns the height of their
    end.
    """
    bottom = top
    for child in node.children:
        bottom = _place(child, bottom) + BELOW
    bottom -= BELOW if node.children else 0.0
    if node.children:
        node.y = (node.children[0].middle + node.children[-1].middle - node.height) / 2
    missing = max(top - node.y, 0.0) if node.children else 0.0
    for each in node.all() if missing else ():
        each.y += missing
    if not node.children:
        node.y = top
    return max(bottom + missing, node.y + node.height)


def _indent(node: _Placed, left: float) -> None:
    """Place children at the right end of their parent."""
    node.x = left
    for child in node.children:
        _indent(child, left + node.width + BESIDE)


def _edge(node: _Placed, child: _Placed) -> str:
    start, end = node.x + node.width, child.x
    bend = end - BESIDE / 2
    return (
        f'<path d="M{start:.1f} {node.middle:.1f} '
        f"C{bend:.1f} {node.middle:.1f} {bend:.1f} {child.middle:.1f} {end:.1f} "
        f'{child.middle:.1f}"/>'
    )


def _drawn(node: _Placed) -> str:
    """A node with all nodes below it, inside its group."""
    kind, corner = ("flow", 14) if node.box.token else ("skill", 4)
    place = (node.x, node.y, node.width, node.height)
    own = [
        f'<rect class="{kind}" x="{node.x:.1f}" y="{node.y:.1f}" width="{node.width:.1f}" '
        f'height="{node.height:.1f}" rx="{corner}"/>'
    ]
    for number, (style, text) in enumerate(node.texts):
        base = node.y + PADDING + FONT - 2 + number * LINE
        own.append(_text(node.x + PADDING, base, style, text))
    below = "".join(f"\n{_edge(node, child)}\n{_drawn(child)}" for child in node.children)
    return (
        f'<g class="node" data-box="{" ".join(f"{each:.1f}" for each in place)}">'
        f'<g class="own">{"".join(own)}</g>'
        + (f'<g class="below">{below}</g>' if below else "")
        + "</g>"
    )


def _text(x: float, y: float, style: str, text: str) -> str:
    shown = _shortened(text)
    whole = f"<title>{escape(text)}</title>" if shown != text else ""
    return (
        f'<text class="{style}" x="{x:.1f}" y="{y:.1f}" xml:space="preserve">{whole}'
        f"{escape(shown)}</text>"
    )


def _shortened(text: str) -> str:
    return text if len(text) <= MOST_CHARACTERS else text[: MOST_CHARACTERS - 3] + "..."
