"""Mistakes about behavior trees that rules run."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class MissingTreeArgument(Error, code="ROSS268", name="missing-tree-argument"):
    """A tree without a value for a parameter that it needs."""

    title = "`{skill}` needs {missing}"
    label = "the rule gives no value for the missing parameters"
    help = (
        "write `{skill}({form})`; a running skill can provide a value: `{first}: doing "
        "SKILL.PARAMETER`"
    )
    skill: str
    missing: str
    form: str
    first: str


class UnfitTreeArgument(Error, code="ROSS269", name="unfit-tree-argument"):
    """A value that a parameter of a tree cannot have."""

    title = "`{parameter}` of `{skill}` is {expected}"
    label = "this is {found}"
    parameter: str
    skill: str
    expected: str
    found: str

    class Declared(Remark):
        says = "`{parameter}` is declared here"
        parameter: str


ALL: tuple[type[Template], ...] = (MissingTreeArgument, UnfitTreeArgument)
