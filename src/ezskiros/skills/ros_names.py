"""Names of topics, action servers and types in the form of rules."""

from __future__ import annotations

import re

_LONGEST = 255
"""The most characters of a name that the middleware of ROS 2 supports."""
_NAME = re.compile(r"/[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z0-9_]+)*")
_TYPE = re.compile(r"([A-Za-z][A-Za-z0-9_]*)/(?:(?:msg|action)/)?([A-Z][A-Za-z0-9]*)")


def why_no_name(spelled: str) -> str | None:
    """The reason why a text is not an absolute name; None for a valid name."""
    if not spelled.startswith("/"):
        return "it does not begin with `/`, so it depends on a namespace"
    if len(spelled) > _LONGEST:
        return f"it is longer than {_LONGEST} characters"
    if not _NAME.fullmatch(spelled):
        return "between the `/`, use letters, digits and `_`, not beginning with a digit"
    return None


def type_name(spelled: str) -> str | None:
    """The type name in the form `package/Type`, also for `package/msg/Type`; None for an invalid
    name.
    """
    found = _TYPE.fullmatch(spelled)
    return f"{found[1]}/{found[2]}" if found else None
