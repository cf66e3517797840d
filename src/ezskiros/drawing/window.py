"""The frame of an SVG picture: light and dark colors, and scripts that zoom and fold.

A viewer without scripts, or an embedding page, shows the same static picture. The file needs no
font, no other file and no network.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from xml.sax.saxutils import escape

_STYLE = """
.tools rect, .handle { fill: #ffffff; stroke: #8a95a1; stroke-width: 1; }
.tools text { font: 13px sans-serif; }
.sign { font: bold 13px sans-serif; }
[role="button"] { cursor: pointer; }
[role="button"]:focus-visible { outline: 2px solid #2f6497; }
.paper { fill: #ffffff; }
"""
_DARK = """
.paper { fill: #121518; }
text { fill: #e7eaec; }
.tools rect, .handle { fill: #23282d; stroke: #7d8791; }
"""


def framed(
    body: str,
    *,
    width: int,
    height: int,
    name: str,
    style: str,
    dark: str,
    scripts: tuple[str, ...] = ("zoom.js",),
    numbers: dict[str, int] | None = None,
) -> str:
    """The text of an SVG file of `width` and `height` pixels, with a name for screen readers.

    `style` and `dark` are the style sheets of its elements, `numbers` the constants of its scripts.
    """
    constants = "".join(f"const {key} = {value};\n" for key, value in (numbers or {}).items())
    code = "\n".join((constants, *map(_asset, scripts)))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        # A browser shows the whole picture, however large it is.
        f'style="max-width: 100vw; max-height: 100vh" '
        f'viewBox="0 0 {width} {height}" role="img">\n<title>{escape(name)}</title>\n'
        f"<style>{_STYLE}{style}"
        f"@media screen and (prefers-color-scheme: dark) {{{_DARK}{dark}}}\n</style>\n"
        f'<rect class="paper" width="{width}" height="{height}"/>\n'
        f'<g class="all">\n{body}\n</g>\n'
        f'<script><![CDATA[\n(() => {{\n"use strict";\n{code}}})();\n]]></script>\n</svg>\n'
    )


@cache
def _asset(name: str) -> str:
    return (files("ezskiros.drawing") / "assets" / name).read_text(encoding="utf-8")
