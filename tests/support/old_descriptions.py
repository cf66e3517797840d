"""Random descriptions of SkiROS2, as source."""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st

KEYS = ["Robot", "Box", "Place", "Arm", "Speed", "Mode", "Count", "x", "größe"]
KEYS += ["Start Pose", "StartPose", "object-1", "object 1", "class", "self", "ezskiros", "__x"]
KEYS += ["Max (m)", "\ufb01x", "2nd", "-", 'it\'s "so"', "robot!", "specified", "skiros", "Key"]
CLASSES = ["skiros:Product", "cora:Robot", ":Location", "Thing", "rparts:Arm-Device", "sumo:Object"]
RELATIONS = [
    "skiros:at",
    "skiros:hasA",
    "contain",
    ":spatially-related",
    "store:keeps",
    "skiros:in",
]
PROPERTIES = [
    "skiros:Weight",
    "store:Weight",
    "Open",
    "skiros:class",
    "skiros:_name",
    "skiros:iri",
]
KINDS = ["Required", "Optional", "Inferred"]
OPTIONS = ["Consume", "Output", "Unspecify", "Lock", "RespectType"]
LABELS = st.sampled_from(["", "RobotAt", "EmptyHanded", 'say "so"', "two\\nlines", "# hash"])
COMMENTS = st.sampled_from(["", "", "# why", "#====Params====", "# 100 % {braces}"])
DOCS = st.text("abc xyz:,.\"'\\{}()é", max_size=12)
VALUES = st.one_of(
    st.text(max_size=6),
    st.integers(),
    st.floats(allow_nan=False, allow_infinity=False),
    st.booleans(),
)
TRUTHS = st.booleans()


@dataclass(frozen=True)
class Line:
    """A statement, and what is around it."""

    code: str
    above: str = ""
    behind: str = ""


@st.composite
def descriptions(draw: st.DrawFn) -> str:
    """A module with one description that can be translated."""
    keys = draw(st.lists(st.sampled_from(KEYS), unique=True, max_size=6))
    is_individual = {key: key == "Robot" or draw(st.booleans()) for key in keys}
    parameters = [draw(_individuals(key) if is_individual[key] else _basics(key)) for key in keys]
    individuals = [key for key in keys if is_individual[key]]
    if "Robot" not in individuals:  # SkiROS2 adds it
        individuals.append("Robot")
    conditions = draw(st.lists(_added(individuals), max_size=6)) if individuals else []
    lines = [*parameters, *(line for each in conditions for line in each)]
    if draw(st.booleans()):  # in whatever order
        lines = [*(line for each in conditions for line in each), *parameters]
    decorated = [Line(code, draw(COMMENTS), draw(COMMENTS)) for code in lines]
    doc = draw(st.sampled_from(["", '"""What it does."""', "'''Two\n\n        lines.'''", "'one'"]))
    return _module(decorated, doc)


def _module(lines: list[Line], doc: str) -> str:
    body = [doc] if doc else []
    for line in lines:
        body += [line.above] if line.above else []
        body.append(line.code + (f"  {line.behind}" if line.behind else ""))
    inside = "\n".join(f"        {line}" for line in body or ["pass"])
    return (
        "from skiros2_skill.core.skill import SkillDescription, ParamOptions\n"
        "from skiros2_common.core.params import ParamTypes\n"
        "from skiros2_common.core.world_element import Element\n\n\n"
        "class Skill(SkillDescription):\n"
        "    def createDescription(self):\n"
        f"{inside}\n"
    )


@st.composite
def _individuals(draw: st.DrawFn, key: str) -> str:
    kind, owl_class = draw(st.sampled_from(KINDS)), draw(st.sampled_from(CLASSES))
    options = draw(st.lists(st.sampled_from(OPTIONS), max_size=3))
    written = f", [{', '.join(f'ParamOptions.{each}' for each in options)}]" if options else ""
    return (
        f"self.addParam({key!r}, Element({owl_class!r}), ParamTypes.{kind}{written}{draw(_doc())})"
    )


@st.composite
def _basics(draw: st.DrawFn, key: str) -> str:
    kind = draw(st.sampled_from(KINDS[:2]))
    value = draw(st.one_of(st.sampled_from(["str", "int", "float", "bool"]), VALUES.map(repr)))
    options = draw(st.lists(st.sampled_from(OPTIONS), max_size=2))
    written = f", [{', '.join(f'ParamOptions.{each}' for each in options)}]" if options else ""
    return f"self.addParam({key!r}, {value}, ParamTypes.{kind}{written}{draw(_doc())})"


@st.composite
def _doc(draw: st.DrawFn) -> str:
    text = draw(DOCS)
    return f", description={text!r}" if text else ""


@st.composite
def _added(draw: st.DrawFn, individuals: list[str]) -> list[str]:
    """The statements that add one condition."""
    place = draw(st.sampled_from(["Pre", "Hold", "Post"]))
    if draw(st.integers(0, 3)):
        return [f"self.add{place}Condition({draw(_conditions(individuals))})"]
    name = draw(st.sampled_from(["either", "other"]))
    parts = draw(st.lists(_conditions(individuals), min_size=2, max_size=4))
    return [
        f"{name} = self.getOrCond({draw(TRUTHS)})",
        *(f"{name}.addCondition({part})" for part in parts),
        f"self.add{place}Condition({name})",
    ]


@st.composite
def _conditions(draw: st.DrawFn, individuals: list[str]) -> str:
    """The call that makes a condition."""
    subject, other = (repr(draw(st.sampled_from(individuals))) for _ in range(2))
    label, wanted = f'"{draw(LABELS)}"'.replace('say "so"', "say so"), draw(TRUTHS)
    relation, name = (repr(draw(st.sampled_from(each))) for each in (RELATIONS, PROPERTIES))
    operator, value = repr(draw(st.sampled_from(["=", "<", ">", "<=", ">="]))), draw(VALUES)
    return draw(
        st.sampled_from(
            [
                f"self.getRelationCond({label}, {relation}, {subject}, {other}, {wanted})",
                f"self.getAbstractRelationCond({label}, {relation}, {subject}, {other}, {wanted})",
                f"self.getPropCond({label}, {name}, {subject}, {operator}, {value!r}, {wanted})",
                f"self.getHasPropCond({label}, {name}, {subject}, {wanted})",
                f"self.getOnTypeCond({label}, {subject}, {draw(st.sampled_from(CLASSES))!r})",
                f"self.getIsSpecifiedCond({label}, {subject}, {wanted})",
                f"self.getGenerateCond({label}, {subject}, {wanted})",
            ]
        )
    )
