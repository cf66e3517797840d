"""The base classes of an implementation other than SkiROS2's own."""

from __future__ import annotations

from collections.abc import Mapping

import libcst as cst

from dslkit.diagnostics import listed
from ezskiros.migrate.bases import Root
from ezskiros.migrate.calls import last_name
from ezskiros.migrate.implementation_errors import OtherBase
from ezskiros.migrate.tree_context import TreeContext

SKIROS2_BASES = frozenset({"SkillBase", "PrimitiveBase"})
"""The SkiROS2 classes from which implementations are derived."""


def other_base(
    node: cst.ClassDef, context: TreeContext, names: Mapping[str, str]
) -> OtherBase | None:
    """The finding if the skill's `SkillBase` cannot be added to the bases of a class; None if it
    can.
    """
    called = [last_name(each.value) or "" for each in node.bases]
    bases = [names.get(each, each) for each in called]
    below = [(base, *context.skills.bases.below(base, context.path)) for base in bases]
    base, root, end = min(below, key=lambda each: each[1].value, default=("", Root.PLAIN, ""))
    name = node.name.value
    if root is Root.DESCRIBED or not {*bases} - {"object"}:
        said = f"inherits from {listed(bases) or 'nothing'}"
        return OtherBase(implementation=name, found=said)
    if root is not Root.UNKNOWN:
        return None
    through = f" through `{base}`" if base != end else ""
    return OtherBase(
        implementation=name,
        found=f"inherits from `{end}`{through}, which none of these files defines",
        advice=f"if a library defines `{end}`, give its file as well",
        base=end,
    )


def left_with(node: cst.ClassDef, context: TreeContext) -> OtherBase | None:
    """The finding that names the other class because of which a class stays unchanged; None if
    there is none.
    """
    own = (context.path, node.name.value)
    cause = context.skills.bases.left.get(own)
    if cause is None or cause.id == own:
        return None
    path, other = cause.id
    codes = " and ".join(cause.codes)
    found = f"depends on `{other}`, which is not translated because of {codes}"
    return OtherBase(implementation=node.name.value, found=found, base=other, path=path)
