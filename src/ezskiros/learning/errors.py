"""EZS866 to EZS871: records of runs, and what was learnt from them."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoRecord(Error, code="EZS866", name="no-record"):
    """A file that is neither verdicts nor a trace, or not a whole one."""

    title = "`{path}` cannot be learnt from: {reason}"
    help = "name whole files, as `rossmarie replay` and `ezskiros run --trace` write them"
    path: str
    reason: str

    class WithoutStamp(Remark):
        says = "run it again: traces had no stamps in earlier versions, and verdicts need them"

    class JumpsBack(Remark):
        says = "replay the recording in parts, each without a jump"


class RunAlone(Error, code="EZS867", name="run-alone"):
    """A trace that no verdicts are of the same time, or verdicts without a trace."""

    title = "no {others} are of the time of `{path}`"
    label = "it goes from {start} to {end}"
    note = "what is learnt counts runs, so each needs its trace and its verdicts"
    help = "name the {others} of this run, or leave it out"
    path: str
    others: str
    start: str
    end: str

    class OtherClock(Remark):
        says = (
            "the nearest {others} go from {start} to {end}: if they are of this run, they were "
            "stamped by another clock"
        )
        others: str
        start: str
        end: str


class RunTwice(Error, code="EZS868", name="run-twice"):
    """Two files of the same kind that are of the same time."""

    title = "`{path}` and `{other}` are {kind} of the same time"
    note = "a run that is counted twice makes what is learnt wrong"
    help = "name one of them"
    path: str
    other: str
    kind: str


class NoKnowledge(Error, code="EZS869", name="no-knowledge"):
    """A file that is no knowledge of runs, or of another version."""

    title = "`{path}` is no knowledge of runs"
    label = "{reason}"
    help = "write it with `ezskiros learn`"
    path: str
    reason: str


class RuleTripped(Warning, code="EZS870", name="rule-tripped"):
    """A skill during which a rule became active."""

    title = "`{skill}` tripped `{rule}` in {share}"
    note = "the rule found this, first: {evidence}"
    help = "let a condition of `{skill}` say what has to be so, or let a rule act earlier"
    skill: str
    rule: str
    share: str
    evidence: str

    class Place(Remark):
        says = "with {places} in {share}"
        places: str
        share: str

    class WithoutHold(Remark):
        says = "its description has no hold-condition"

    class WithHold(Remark):
        says = "its hold-conditions did not end it before"


class SkillFailed(Warning, code="EZS871", name="skill-failed"):
    """A skill that failed in some runs."""

    title = "`{skill}` failed in {share}"
    note = "most often because of this: {reason}"
    help = "let a pre-condition say what it needs, so that it is planned and started only then"
    skill: str
    share: str
    reason: str


ALL: tuple[type[Template], ...] = (
    NoRecord,
    RunAlone,
    RunTwice,
    NoKnowledge,
    RuleTripped,
    SkillFailed,
)
