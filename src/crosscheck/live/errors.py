"""CHK4xx: findings on a running robot."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class UnusableContext(Error, code="CHK401", name="unusable-context"):
    """A message about running skills that the rules reject."""

    title = "the rules reject the messages on {topic}: {reason}"
    label = "these rules were built with the export {digest}"
    note = "the running skills are unknown, so exemptions end and `while` is true"
    help = "export the skills, rebuild the node from these rules, and restart both"
    topic: str
    reason: str
    digest: str


class NotExported(Error, code="CHK402", name="skill-not-exported"):
    """Running skills that the skills file does not have."""

    title = "the rules do not know the running skills {skills}"
    label = "this file has no such skill"
    help = "run `ezskiros export` with all skills of the robot, and rebuild the rules"
    skills: str


class SilentContext(Error, code="CHK403", name="silent-context"):
    """No message about running skills."""

    title = "no message on {topic} for {seconds:.3g} s: the running skills are unknown"
    label = "the timeout of these rules is {timeout:g} s"
    note = "exemptions have ended, and `while` is true"
    help = "check that the skill manager runs and uses this file as its context"
    topic: str
    seconds: float
    timeout: float


class SilentNode(Error, code="CHK404", name="silent-node"):
    """No message from the node of the rules."""

    title = "no message from {node} for {seconds:.3g} s"
    label = "these rules may not be monitored"
    help = "start the node, or give its namespace: `--namespace NS`"
    node: str
    seconds: float


class OtherRules(Error, code="CHK405", name="node-of-other-rules"):
    """A node that reports rules that this file does not have."""

    title = "{node} was built from other rules: it reports {rules}"
    label = "this file has no such rule"
    help = "rebuild the node from these rules, and restart it"
    node: str
    rules: str


ALL: tuple[type[Template], ...] = (
    UnusableContext,
    NotExported,
    SilentContext,
    SilentNode,
    OtherRules,
)
