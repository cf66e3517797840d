"""Effects: rule R10 of docs/explanation/reactions.md."""

import re

from rossmarie.ir import reactions
from rossmarie.ir.reactions import Interrupted
from support.drafts import SECOND
from support.plans import (
    call,
    cancel,
    diagnose,
    limit,
    log,
    publish,
    retrace,
    scale,
    send,
    set_parameter,
    switch,
)
from support.rule_pages import ROOT

EFFECTS: dict[str, reactions.Effect] = {
    "`limit`, `block`": limit(0.0, 0.0),
    "`scale`": scale(0.5),
    "`publish` once": publish(),
    "`publish` at a rate": publish(SECOND),
    "`retrace`": retrace(),
    "`call`": call(),
    "`set`": set_parameter(),
    "`switch`": switch(),
    "`send` then drop": send(Interrupted.DROP),
    "`send` then resend": send(Interrupted.RESEND),
    "`cancel`": cancel(),
    "`log`": log(),
    "`diagnose`": diagnose(),
    "`hook`": reactions.Hook("beep"),
    "`reset`": reactions.Reset(),
}


def rows() -> dict[str, list[str]]:
    """The first table of the page."""
    page = (ROOT / "docs/explanation/reactions.md").read_text(encoding="utf-8")
    table = page.partition("| waits |\n")[2].partition("\n\n")[0]
    found = (re.split(r" *\| *", line.strip("| ")) for line in table.splitlines()[1:])
    return {first: (rest + [""] * 4)[:4] for first, *rest in found}


def test_r10_effects_behave_as_the_table_says() -> None:
    def behaviour(effect: reactions.Effect) -> list[str]:
        is_awaited = reactions.timeout_ns(effect) is not None
        properties = (
            reactions.target_of(effect) is not None,
            is_awaited,
            reactions.is_lasting(effect),
            reactions.waits(effect),
        )
        return ["yes" if each else "" for each in properties]

    assert rows() == {name: behaviour(effect) for name, effect in EFFECTS.items()}
    assert {type(effect) for effect in EFFECTS.values()} == set(reactions.Effect.__args__)
