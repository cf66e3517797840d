"""The picture of a robot: skills on the left, their resources in the middle, rules on the right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

from crosscheck.picture import Pictured
from ezskiros.drawing.window import framed

_ROW, _WIDTH, _BOX, _HEIGHT, _MARGIN = 46, 1080, 270, 30, 50
_COLUMNS = (20, 405, 790)
_TITLES = ("skills", "topics and servers", "rules")
_STYLE = """
text { font: 14px sans-serif; fill: #1b2733; }
.title { font-weight: bold; }
.resource { fill: #f4f7fa; stroke: #7a8c9e; rx: 5; }
path { fill: none; stroke: #7a8c9e; stroke-width: 1.5; }
.takes { stroke: #c0392b; }
.exempt { stroke: #2874a6; stroke-dasharray: 6 4; }
"""
_DARK = """
.resource { fill: #1f2830; }
.takes { stroke: #ff7b66; }
.exempt { stroke: #6fb1e4; }
"""


@dataclass(frozen=True)
class _Edge:
    start: tuple[int, str]
    end: tuple[int, str]
    style: str
    title: str


def svg_of(skills: Sequence[Pictured]) -> str:
    """The picture as SVG, which any browser shows; each line has a title in words."""
    names = _names(skills)
    places = {
        (column, name): row for column, group in enumerate(names) for row, name in enumerate(group)
    }
    height = _MARGIN + _ROW * max(map(len, names), default=0) + 40
    parts: list[str] = []
    for column, title in enumerate(_TITLES):
        parts.append(f'<text class="title" x="{_COLUMNS[column]}" y="28">{title}</text>')
    parts += [_line(edge, places) for edge in dict.fromkeys(_edges(skills))]
    parts += [_box(column, name, row) for (column, name), row in places.items()]
    legend = "red: can take away; blue: not applied while the skill runs"
    parts.append(f'<text x="{_COLUMNS[0]}" y="{height - 14}">{legend}</text>')
    name = "Skills, topics and servers, rules"
    body = "\n".join(parts)
    return framed(body, width=_WIDTH, height=height, name=name, style=_STYLE, dark=_DARK)


def _names(skills: Sequence[Pictured]) -> tuple[list[str], list[str], list[str]]:
    used = dict.fromkeys(name for skill in skills for name in skill.uses)
    rules = dict.fromkeys(
        name
        for skill in skills
        for name in (*(each.rule for each in skill.guards), *skill.exempt_from, *skill.asked_by)
    )
    return [skill.name for skill in skills], list(used), list(rules)


def _edges(skills: Sequence[Pictured]) -> Iterator[_Edge]:
    for skill in skills:
        own = (0, skill.name)
        for name in skill.uses:
            yield _Edge(own, (1, name), "uses", f"{skill.name} uses {name}")
        for each in skill.guards:
            style, verb = ("takes", "can take away") if each.is_taken else ("uses", "guards")
            title = f"{each.rule} {verb} {each.resource}"
            yield _Edge((1, each.resource), (2, each.rule), style, title)
        for rule in skill.exempt_from:
            title = f"{rule} is not applied while {skill.name} runs"
            yield _Edge(own, (2, rule), "exempt", title)


def _line(edge: _Edge, places: dict[tuple[int, str], int]) -> str:
    start_x = _COLUMNS[edge.start[0]] + _BOX
    end_x = _COLUMNS[edge.end[0]]
    start_y, end_y = (
        _MARGIN + _ROW * places[each] + _HEIGHT // 2 for each in (edge.start, edge.end)
    )
    bend = (end_x - start_x) // 2
    path = (
        f"M{start_x},{start_y} C{start_x + bend},{start_y} {end_x - bend},{end_y} {end_x},{end_y}"
    )
    return f'<path class="{edge.style}" d="{path}"><title>{escape(edge.title)}</title></path>'


def _box(column: int, name: str, row: int) -> str:
    x, y = _COLUMNS[column], _MARGIN + _ROW * row
    shown = name if len(name) <= 34 else f"{name[:33]}…"
    return (
        f'<rect class="resource" x="{x}" y="{y}" width="{_BOX}" height="{_HEIGHT}">'
        f"<title>{escape(name)}</title>"
        f'</rect><text x="{x + 10}" y="{y + 20}">{escape(shown)}</text>'
    )
