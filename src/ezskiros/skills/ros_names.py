"""Names of topics, action servers and types in the form of rules."""

from __future__ import annotations

import re

_LONGEST = 255
"""Characters of a name: the middleware of ROS 2 takes no more."""
_NAME = re.compile(r"/[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z0-9_]+)*")
_TYPE = re.compile(r"([A-Za-z][A-Za-z0-9_]*)/(?:(?:msg|action)/)?([A-Z][A-Za-z0-9]*)")


def why_no_name(spelled: str) -> str | None:
    """The reason why a text is not an absolute name; None if it is one."""
    if not spelled.startswith("/"):
        return "it does not begin with `/`, so it depends on a namespace"
    if len(spelled) > _LONGEST:
        return f"it is longer than {_LONGEST} characters"
    if not _NAME.fullmatch(spelled):
        return "between the `/`, use letters, digits and `_`, not beginning with a digit"
    return None


def type_name(spelled: str) -> str | None:
    """The name of a type in the form `package/Type`, also of `package/msg/Type`; None if it is no
    such name.
    """
    found = _TYPE.fullmatch(spelled)
    return f"{found[1]}/{found[2]}" if found else None
