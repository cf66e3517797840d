"""CHK4xx: findings on a running robot."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UnusableContext(Error, code="CHK401", name="unusable-context"):
    """A message about running skills that the rules cannot use."""

    title = "the rules do not take what {topic} tells: {reason}"
    label = "these rules know the export {digest}"
    note = "to them nobody tells which skills run: exemptions end, and `while` holds"
    help = "export the skills, build the node from these rules, and start both again"
    topic: str
    reason: str
    digest: str


class NotExported(Error, code="CHK402", name="skill-not-exported"):
    """Running skills that the file of skills does not have."""

    title = "the rules do not know what runs: {skills}"
    label = "this file has no skill of the name"
    help = "run `ezskiros export` with all skills of the robot, and build the rules anew"
    skills: str


class SilentContext(Error, code="CHK403", name="silent-context"):
    """No message about running skills arrives."""

    title = "nobody has reported on {topic} for {seconds:.3g} s which skills run"
    label = "these rules wait no longer than {timeout:g} s"
    note = "exemptions have ended, and `while` holds"
    help = "look after the skill manager: does it run, does it name this file as its context?"
    topic: str
    seconds: float
    timeout: float


class SilentNode(Error, code="CHK404", name="silent-node"):
    """No message from the node of the rules arrives."""

    title = "{node} has said nothing for {seconds:.3g} s"
    label = "nobody knows whether these rules are watched"
    help = "start the node, or name its namespace: `--namespace NS`"
    node: str
    seconds: float


class OtherRules(Error, code="CHK405", name="node-of-other-rules"):
    """A node with rules that this file does not have."""

    title = "{node} was made from other rules: it tells of {rules}"
    label = "no rule here is called so"
    help = "build the node from these rules, and start it again"
    node: str
    rules: str


ALL: tuple[type[Template], ...] = (
    UnusableContext,
    NotExported,
    SilentContext,
    SilentNode,
    OtherRules,
)
