"""Mistakes in queries about the elements of a list of messages."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class UnboundedList(Error, code="ROSS237", name="unbounded-list"):
    """A list of messages in an input without a bound."""

    title = "the list `{text}` needs a bound"
    label = "it can have any number of elements"
    note = (
        "a monitor has room for as many elements as its input declares; a message with more "
        "elements counts as stale"
    )
    help = "declare the bound at the input: `up to {bound}`"
    text: str
    bound: int

    class Declared(Remark):
        says = "the input is declared here"


class NotOfTheElement(Error, code="ROSS240", name="not-of-the-element"):
    """A part that uses neither the element nor a number, where elements are compared."""

    title = (
        "after `{variable} in {text}:` only `{variable}`, constants and numbers of messages are "
        "allowed"
    )
    label = "{found}"
    note = (
        "`{function}` looks at the elements of one list one by one, while their message is "
        "available"
    )
    help = "move the other part outside: `{function}({variable} in {text}: ...) and ...`"
    function: str
    variable: str
    text: str
    found: str

    class NotWatched(Remark):
        says = "single elements cannot be watched over time: put `for` after the whole condition"

    class WatchedTogether(Remark):
        says = "single elements cannot be watched over time: write `{meant}`"
        meant: str

    class Samples(Remark):
        says = "apply the function to the result, as in `{called}(min({variable} in {text}: ...))`"
        called: str
        variable: str
        text: str

    class Number(Remark):
        says = (
            "compare the result with this number, as in `min({variable} in {text}: ...) < {number}`"
        )
        variable: str
        text: str
        number: str

    class OneLevel(Remark):
        says = "rules look at one list at a time: join two such queries by `and` or `or`"

    class Unused(Remark):
        says = "name a field of the element, `{variable}. ...`"
        variable: str


class NotOverAList(Error, code="ROSS241", name="not-over-a-list"):
    """`NAME in ...:` in a call that looks at no list of messages."""

    title = "`{variable} in ...` looks at the elements of a list of messages"
    label = "this is {found}"
    help = "write `any({variable} in LIST: ...)`, or `all`, `count`, `min` or `max`"
    variable: str
    found: str

    class OfArray(Remark):
        says = "an array needs no name for its elements: `{function}({text} ...)`"
        function: str
        text: str

    class ChooseList(Remark):
        says = "choose a list of it: {lists}"
        lists: str


ALL: tuple[type[Template], ...] = (
    UnboundedList,
    NotOfTheElement,
    NotOverAList,
)
