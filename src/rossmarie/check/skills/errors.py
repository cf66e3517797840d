"""Mistakes about skills."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class InSkills(Remark):
    """The label of a place in the source of the skills."""

    says = "{what} here"
    what: str


class Known(Remark):
    """The known names."""

    says = "the skills file has {known}"
    known: str


class UnknownSkill(Error, code="ROSS144", name="unknown-skill"):
    """A skill that the skills file does not have."""

    title = "there is no skill `{identifier}`"
    label = "the skills file has no skill of this name"
    help = "name a skill of {path}; if the skills have changed, run `ezskiros export` again"
    identifier: str
    path: str


class UnknownSkillParameter(Error, code="ROSS145", name="unknown-skill-parameter"):
    """A parameter that a skill does not have."""

    title = "skill `{skill}` has no parameter `{identifier}`"
    label = "not a parameter of this skill"
    help = "{known}"
    skill: str
    identifier: str
    known: str


class UnknownSkillClass(Error, code="ROSS146", name="unknown-skill-class"):
    """A class of individuals that the skills file does not have, or has more than once."""

    title = "there is no class `{identifier}`"
    label = "{reason}"
    help = "name a class of the ontology, as in `skiros.Product`"
    identifier: str
    reason: str

    class Several(Remark):
        says = "write which class is meant: {known}"
        known: str


class UnknownSkillProperty(Error, code="ROSS147", name="unknown-skill-property"):
    """A property that individuals of a class do not have."""

    title = "class {owner} has no property `{identifier}`"
    label = "not a data property of this class or of its base classes"
    help = "{known}"
    identifier: str
    owner: str
    known: str


class NoSkills(Error, code="ROSS148", name="no-skills"):
    """A query about skills in a program without a skills file."""

    title = "the rules query a skill, but name no skills file"
    label = "the skills are not known"
    note = "`ezskiros export` writes the skills file; the rules are checked against this file"
    help = 'name the file: `skills "skills.json";`'


class SeveralSkills(Error, code="ROSS149", name="several-skills"):
    """Two skills files, or two timeouts of one file, in a program."""

    title = "a program has one skills file, with one timeout"
    label = "{found}"
    note = (
        "a robot reports all its skills in one message, which carries the digest of the skills file"
    )
    help = "remove one of the two"
    found: str

    class First(Remark):
        says = "{found} here"
        found: str


class NoIndividual(Error, code="ROSS233", name="no-individual"):
    """A class for a parameter that stands for no individual."""

    title = "parameter `{identifier}` of skill `{skill}` is {found}, and has no class"
    label = "only individuals have classes"
    help = "leave the class out; to read a number, write `input NAME = doing {skill}.{identifier};`"
    identifier: str
    skill: str
    found: str


class ImpossibleClass(Error, code="ROSS245", name="impossible-class"):
    """A class that the parameter of a skill can never have."""

    title = "parameter `{identifier}` of skill `{skill}` can never be {found}"
    label = "the parameter is {expected}, and no individual is both"
    note = "no class in the ontology is derived from both"
    help = "name a class that is derived from {expected}, or leave the parameter out"
    identifier: str
    skill: str
    found: str
    expected: str


class NoSkillNumber(Error, code="ROSS246", name="no-skill-number"):
    """An input that is not a number of a skill."""

    title = "`{field}` is {found}, not a number"
    label = "an input of a skill is a number or a boolean"
    field: str
    found: str

    class Properties(Remark):
        says = "choose a property of the individual: {known}"
        known: str

    class LeaveOut(Remark):
        says = "leave `{extra}` out"
        extra: str

    class Other(Remark):
        says = "name a parameter that is a number, or a property of an individual that is a number"


class RepeatedSkillParameter(Error, code="ROSS247", name="repeated-skill-parameter"):
    """One parameter, twice in one `doing` or in one `tree`."""

    title = "parameter `{identifier}` is named twice"
    label = "an earlier value names this parameter"
    help = "{advice}"
    identifier: str
    advice: str

    class First(Remark):
        says = "first named here"


class SkillsUnreadable(Error, code="ROSS249", name="skills-unreadable"):
    """A skills file that is missing, or violates its format."""

    title = "cannot use the skills file `{path}`"
    label = "{problem}"
    note = (
        "the path is relative to the file that names it; `ezskiros export` writes the right format"
    )
    help = "run `ezskiros export` to write the file"
    path: str
    problem: str

    class Here(Remark):
        says = "this part cannot be read"


class SkillsOutOfDate(Error, code="ROSS257", name="skills-out-of-date"):
    """A skills file whose sources have changed."""

    title = "`{path}` is out of date"
    label = "`{source}` {problem}"
    note = "rules would be checked against skills that the robot no longer has"
    help = "run `ezskiros export` again"
    path: str
    source: str
    problem: str


ALL: tuple[type[Template], ...] = (
    UnknownSkill,
    UnknownSkillParameter,
    UnknownSkillClass,
    UnknownSkillProperty,
    NoSkills,
    SeveralSkills,
    NoIndividual,
    ImpossibleClass,
    NoSkillNumber,
    RepeatedSkillParameter,
    SkillsUnreadable,
    SkillsOutOfDate,
)
