"""EZS866 to EZS871: records of runs, and findings learnt from them."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoRecord(Error, code="EZS866", name="no-record"):
    """A file that is neither verdicts nor a trace, or is incomplete."""

    title = "cannot learn from `{path}`: {reason}"
    help = "give complete files from `rossmarie replay` and `ezskiros run --trace`"
    path: str
    reason: str

    class WithoutStamp(Remark):
        says = "run it again: traces of earlier versions have no time stamps, which verdicts need"

    class JumpsBack(Remark):
        says = "replay the recording in parts without a jump in time"


class RunAlone(Error, code="EZS867", name="run-alone"):
    """A trace without verdicts of the same time, or verdicts without a trace."""

    title = "no {others} cover the time of `{path}`"
    label = "`{path}` covers {start} to {end}"
    note = "learning counts runs, and each run needs its trace and its verdicts"
    help = "add the {others} of this run, or leave out `{path}`"
    path: str
    others: str
    start: str
    end: str

    class OtherClock(Remark):
        says = (
            "the nearest {others} cover {start} to {end}: if they belong to this run, another "
            "clock stamped them"
        )
        others: str
        start: str
        end: str


class RunTwice(Error, code="EZS868", name="run-twice"):
    """Two files of the same kind that cover the same time."""

    title = "`{path}` and `{other}` are {kind} of the same time"
    note = "counting a run twice would make the results wrong"
    help = "give only one of them"
    path: str
    other: str
    kind: str


class NoKnowledge(Error, code="EZS869", name="no-knowledge"):
    """A file that is not learnt knowledge, or has another version."""

    title = "`{path}` is not knowledge learnt from runs"
    label = "{reason}"
    help = "create the file with `ezskiros learn`"
    path: str
    reason: str


class RuleTripped(Warning, code="EZS870", name="rule-tripped"):
    """A skill during which a rule became active."""

    title = "`{rule}` became active during `{skill}` in {share}"
    note = "the first evidence of the rule: {evidence}"
    help = "add a condition to `{skill}` that prevents this, or make a rule act earlier"
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
        says = "its hold-conditions did not end the skill before"


class SkillFailed(Warning, code="EZS871", name="skill-failed"):
    """A skill that failed in some runs."""

    title = "`{skill}` failed in {share}"
    note = "the most frequent reason: {reason}"
    help = "add a pre-condition, so that `{skill}` is planned and started only when it can succeed"
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
