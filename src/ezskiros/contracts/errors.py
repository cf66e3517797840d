"""EZS550 to EZS560: conditions of compound skills and of their children."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class CannotStart(Error, code="EZS550", name="cannot-start"):
    """A child with a condition that is false when it starts."""

    title = "`{child}` cannot start here: `{condition}` is false"
    label = "`{child}` would start here"
    child: str
    condition: str


class NotShown(Warning, code="EZS551", name="not-shown"):
    """A child with a condition of unknown truth value."""

    title = "nothing ensures that `{condition}` holds when `{child}` starts"
    label = "`{child}` may fail here"
    child: str
    condition: str


class MayBeLost(Warning, code="EZS552", name="may-be-lost"):
    """A condition of a child that another child may have ended."""

    title = "`{condition}` may no longer hold when `{child}` starts"
    label = "`{child}` may fail here"
    child: str
    condition: str


class NeverStarts(Warning, code="EZS553", name="never-starts"):
    """A child that cannot start and has a fallback."""

    title = "`{child}` cannot start here: `{condition}` is false on its turn"
    label = "`{child}` would start here"
    child: str
    condition: str


class TriedInVain(Warning, code="EZS554", name="tried-in-vain"):
    """A child with a fallback and a condition of unknown truth value."""

    title = "nothing ensures that `{condition}` holds when `{child}` is tried"
    label = "`{child}` may fail here"
    note = "if `{child}` fails, `{skill}` continues with another child or ignores the failure"
    child: str
    condition: str
    skill: str


class NeverAchieved(Error, code="EZS555", name="never-achieved"):
    """A post-condition of a compound skill that is false after its tree succeeds."""

    title = "`{tree}` cannot succeed: `{condition}` is false at its end"
    label = "this post-condition must hold after `{tree}`"
    tree: str
    condition: str


class NotAchieved(Warning, code="EZS556", name="not-achieved"):
    """A post-condition of a compound skill that its tree does not ensure."""

    title = "nothing ensures that `{condition}` holds after `{tree}` succeeds"
    label = "this post-condition must hold after `{tree}`"
    tree: str
    condition: str


class EndsHold(Error, code="EZS557", name="ends-hold"):
    """A child that ends a hold-condition of the compound skill."""

    title = "`{skill}` fails before it reaches `{child}`: its hold-condition `{condition}` is false"
    label = "`{skill}` never reaches this child"
    skill: str
    child: str
    condition: str

    class Repair(Remark):
        says = "delete the hold-condition, or run `{child}` before the condition ends"
        child: str


class MayEndHold(Warning, code="EZS558", name="may-end-hold"):
    """A child that may end a hold-condition of the compound skill."""

    title = "the hold-condition `{condition}` of `{skill}` may no longer hold when `{child}` starts"
    label = "`{skill}` may not reach this child"
    skill: str
    child: str
    condition: str


class EndsBeside(Error, code="EZS559", name="ends-beside"):
    """A child of a parallel that ends a condition of another child."""

    title = "`{other}` ends `{condition}`, which `{child}` needs at the same time"
    label = "this runs in parallel with `{child}`"
    help = "run them one after the other: `self.serialstar(...)`"
    other: str
    child: str
    condition: str


class CannotRestart(Warning, code="EZS560", name="cannot-restart"):
    """A child that restarts after one of its conditions has ended."""

    title = "`{child}` fails when it restarts: `{condition}` {ended}"
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
