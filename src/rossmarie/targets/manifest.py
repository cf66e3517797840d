"""The metadata of a generated package, for targets that make packages, and of the package that
contains a node.

The texts of a manifest are used unchanged: use the functions here, which check them, to make one.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_PERSON = re.compile(r"\s*([^<>\s][^<>]*?)\s*<([^\s@<>]+@[^\s@<>]+)>\s*")


@dataclass(frozen=True)
class Person:
    """Somebody who maintains a package."""

    name: str
    mail: str


class BadFieldError(ValueError):
    """A licence or a maintainer that is not valid. The text describes the valid form."""


def parse_license(text: str) -> str:
    """A licence. Raises `BadFieldError`."""
    if not text.strip():
        raise BadFieldError("a licence has a name, such as `Apache-2.0` (see spdx.org/licenses)")
    return text.strip()


def parse_maintainer(text: str) -> Person:
    """A maintainer, from `Ada Lovelace <ada@example.org>`. Raises `BadFieldError`."""
    match = _PERSON.fullmatch(text)
    if match is None:
        raise BadFieldError("a maintainer has a name and a mail address: `Name <name@example.org>`")
    return Person(match[1], match[2])


@dataclass(frozen=True)
class Manifest:
    """The fields of a `package.xml` that do not come from the rules.

    What is not known is None or empty: the package then has a text that says so.
    """

    version: str | None = None
    licenses: tuple[str, ...] = ()
    maintainers: tuple[Person, ...] = ()


UNKNOWN = Manifest()
"""Nothing is known."""


@dataclass(frozen=True)
class Placement:
    """The package that a node is built in: one of its own with this manifest, or, if `part_of`
    names it, one that a user writes.
    """

    manifest: Manifest = UNKNOWN
    part_of: str | None = None


OWN_PACKAGE = Placement()
"""A package of its own of which nothing is known."""
