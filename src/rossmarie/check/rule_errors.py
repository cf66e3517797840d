"""What is wrong with the order of rules, and with the resources that they need."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UndeclaredRule(Error, code="ROSS120", name="undeclared-rule"):
    """An order of rules that names a rule that does not exist."""

    title = "there is no rule `{identifier}`"
    label = "no rule has this name"
    help = "name the rule that is meant: `rule {identifier}: if ...`"
    identifier: str


class CircularPriority(Error, code="ROSS123", name="circular-priority"):
    """Rules of which each is more important than the next, in a circle."""

    title = "rule `{identifier}` is put over itself"
    label = "this leads back: {cycle}"
    help = "remove one of the orders"
    identifier: str
    cycle: str


class UnknownTarget(Error, code="ROSS140", name="unknown-target"):
    """A resource to which something belongs that nothing else speaks of."""

    title = "nothing is sent to `{identifier}`"
    label = "no system model declares it, and no action names it"
    help = "name a topic, a service, an action server, a node or a controller manager"
    identifier: str


class SharedTarget(Error, code="ROSS141", name="shared-target"):
    """A topic or the like that belongs to two resources, or to one twice."""

    title = "`{target}` belongs to resource `{resource}` already"
    label = "named again"
    help = "name it once; what commands the same thing is one resource"
    target: str
    resource: str


class CircularUnless(Error, code="ROSS142", name="circular-unless"):
    """Rules each of which is not carried out while the next one is active, in a circle."""

    title = "rule `{identifier}` gives way to itself"
    label = "this leads back: {cycle}"
    note = "while all of them are active none would be carried out"
    help = "remove one `unless`, so that one rule comes first"
    identifier: str
    cycle: str


class LastResortOverruled(Error, code="ROSS422", name="last-resort-overruled"):
    """The last action of a chain of escalations, which needs what another rule may have."""

    title = "the last escalation of rule `{rule}` needs {resource}, which rule `{other}` has first"
    label = "while `{other}` is engaged this is overruled, and nothing follows"
    note = "a chain of escalations has to end with something that no other rule can overrule"
    help = (
        "end the chain with an action that blocks or limits commands: no rule overrules that; "
        "or put rule `{rule}` over rule `{other}` with `priority`"
    )
    rule: str
    other: str
    resource: str


ALL: tuple[type[Template], ...] = (
    UndeclaredRule,
    CircularPriority,
    UnknownTarget,
    SharedTarget,
    CircularUnless,
    LastResortOverruled,
)
