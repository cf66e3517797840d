"""Messages of any type, with zeros in all fields but those that are given."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore


def made(store: Typestore, kind: str, **given: object) -> Any:
    """A message of a type such as `nav_msgs/Path`; `given` are fields, inner ones as `a__b`."""
    name = kind.replace("/", "/msg/")
    message = _blank(store, (Nodetype.NAME, name))
    for path, value in given.items():
        *outside, last = path.split("__")
        inside = message
        for field in outside:
            inside = getattr(inside, field)
        present = getattr(inside, last)
        is_array = isinstance(present, np.ndarray)
        setattr(inside, last, np.array(value, present.dtype) if is_array else value)
    return message


def _blank(store: Typestore, description: Any) -> Any:
    kind, content = description
    if kind == Nodetype.NAME:
        fields: Mapping[str, Any] = dict(store.fielddefs[content][1])
        return store.types[content](**{name: _blank(store, each) for name, each in fields.items()})
    if kind == Nodetype.BASE:
        return "" if content[0] == "string" else False if content[0] == "bool" else 0
    element, length = content
    if element[0] == Nodetype.BASE and element[1][0] != "string":
        return np.zeros(length if kind == Nodetype.ARRAY else 0, element[1][0])
    return [_blank(store, element) for _ in range(length if kind == Nodetype.ARRAY else 0)]
