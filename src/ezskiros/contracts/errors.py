"""EZS550 to EZS560: conditions of compound skills and of their children."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class CannotStart(Error, code="EZS550", name="cannot-start"):
    """A child of which a condition is false when it is its turn."""

    title = "`{child}` cannot start here: `{condition}` is false"
    label = "it would start here"
    child: str
    condition: str


class NotShown(Warning, code="EZS551", name="not-shown"):
    """A condition of a child of which nothing is known."""

    title = "nothing says that `{condition}` holds when `{child}` starts"
    label = "it may fail here"
    child: str
    condition: str


class MayBeLost(Warning, code="EZS552", name="may-be-lost"):
    """A condition of a child that another child may have ended."""

    title = "`{condition}` may have ended when `{child}` starts"
    label = "it may fail here"
    child: str
    condition: str


class NeverStarts(Warning, code="EZS553", name="never-starts"):
    """A child that cannot start, and for which others stand in."""

    title = "`{child}` cannot start here: `{condition}` is false when it is its turn"
    label = "it would start here"
    child: str
    condition: str


class TriedInVain(Warning, code="EZS554", name="tried-in-vain"):
    """A condition of a child of which nothing is known, and for which others stand in."""

    title = "nothing says that `{condition}` holds when `{child}` is tried"
    label = "it may fail here"
    note = "its failure is not that of `{skill}`: another child stands in, or it does not matter"
    child: str
    condition: str
    skill: str


class NeverAchieved(Error, code="EZS555", name="never-achieved"):
    """A post-condition of a compound that is false when its tree has succeeded."""

    title = "`{tree}` cannot succeed: `{condition}` is false at its end"
    label = "this is to hold after it"
    tree: str
    condition: str


class NotAchieved(Warning, code="EZS556", name="not-achieved"):
    """A post-condition of a compound that its tree does not see to."""

    title = "nothing says that `{condition}` holds when `{tree}` has succeeded"
    label = "this is to hold after it"
    tree: str
    condition: str


class EndsHold(Error, code="EZS557", name="ends-hold"):
    """A child that ends what has to hold while the compound runs."""

    title = (
        "`{skill}` fails before it gets to `{child}`: it has to hold `{condition}`, which is false"
    )
    label = "the skill does not get here"
    skill: str
    child: str
    condition: str

    class Repair(Remark):
        says = "leave the hold-condition out, or let `{child}` come before"
        child: str


class MayEndHold(Warning, code="EZS558", name="may-end-hold"):
    """A child that may end what has to hold while the compound runs."""

    title = "`{skill}` has to hold `{condition}`, which may have ended when `{child}` starts"
    label = "the skill may not get here"
    skill: str
    child: str
    condition: str


class EndsBeside(Error, code="EZS559", name="ends-beside"):
    """A child of a parallel that ends a condition of another one."""

    title = "`{other}` ends `{condition}`, which `{child}` needs at the same time"
    label = "this runs beside it"
    help = "run them one after the other: `self.serialstar(...)`"
    other: str
    child: str
    condition: str


class CannotRestart(Warning, code="EZS560", name="cannot-restart"):
    """A child that is started again when one of its conditions has ended."""

    title = "`{child}` fails when it is started again: `{condition}` {ended}"
    label = "{again}"
    child: str
    condition: str
    ended: str
    again: str


ALL: tuple[type[Template], ...] = (
    CannotStart,
    NotShown,
    MayBeLost,
    NeverStarts,
    TriedInVain,
    NeverAchieved,
    NotAchieved,
    EndsHold,
    MayEndHold,
    EndsBeside,
    CannotRestart,
)
