"""The metadata of a generated package, for targets that make packages, and of the package that
contains a node.

The texts of a manifest are used unchanged. Create a manifest with the functions here, which check
them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_PERSON = re.compile(r"\s*([^<>\s][^<>]*?)\s*<([^\s@<>]+@[^\s@<>]+)>\s*")


@dataclass(frozen=True)
class Maintainer:
    """A maintainer of a package."""

    name: str
    mail: str


class BadFieldError(ValueError):
    """An invalid licence or maintainer. The text of the error describes the valid form."""


def parse_license(text: str) -> str:
    """A licence. Raises `BadFieldError` if it is not valid."""
    if not text.strip():
        raise BadFieldError("a licence has a name, such as `Apache-2.0` (see spdx.org/licenses)")
    return text.strip()


def parse_maintainer(text: str) -> Maintainer:
    """A maintainer, from `Ada Lovelace <ada@example.org>`. Raises `BadFieldError` if it is not
    valid.
    """
    match = _PERSON.fullmatch(text)
    if match is None:
        raise BadFieldError("a maintainer has a name and a mail address: `Name <name@example.org>`")
    return Maintainer(match[1], match[2])


@dataclass(frozen=True)
class Manifest:
    """The fields of a `package.xml` that do not come from the rules.

    An unknown field is None or empty. The package then contains a text that states this.
    """

    version: str | None = None
    licenses: tuple[str, ...] = ()
    maintainers: tuple[Maintainer, ...] = ()


UNKNOWN = Manifest()
"""A manifest without known fields."""


@dataclass(frozen=True)
class Placement:
    """The package in which a node is built: a package of its own with this manifest or, if
    `part_of` names one, a package that the user writes.
    """

    manifest: Manifest = UNKNOWN
    part_of: str | None = None


OWN_PACKAGE = Placement()
"""A package of its own with an unknown manifest."""
