"""The templates of pages, and the styles and scripts that templates include."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

import jinja2


@cache
def template(name: str) -> jinja2.Template:
    """A template; filling it raises an error if a name is missing."""
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    return environment.from_string(asset(name))


def asset(name: str) -> str:
    """The text of a file of the pages."""
    return (files("rossmarie.report") / "assets" / name).read_text(encoding="utf-8")
