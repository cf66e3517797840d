"""Random compound skills of SkiROS2, as text."""

from __future__ import annotations

from hypothesis import strategies as st

HEAD = """\
from skiros2_skill.core.skill import SkillDescription, SkillBase
from skiros2_skill.core.skill import NoFail, ParallelFf, ParallelFs
from skiros2_skill.core.skill import RetryOnFail, Selector, SelectorStar
from skiros2_skill.core.skill import Sequential, Serial, SerialStar
from skiros2_common.core.primitive import PrimitiveBase
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.world_element import Element


class Go(SkillDescription):
    def createDescription(self):
        self.addParam("Target", Element("skiros:Location"), ParamTypes.Required)
        self.addParam("Max Speed", 0.5, ParamTypes.Required)


class Do(SkillDescription):
    def createDescription(self):
        self.addParam("Goal", Element("skiros:Location"), ParamTypes.Required)
        self.addParam("Start (m)", Element("skiros:Location"), ParamTypes.Required)
        self.addParam("Speed", 0.5, ParamTypes.Required)
        self.addParam("Careful", False, ParamTypes.Required)


class go(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Go(), self.__class__.__name__)

    def execute(self):
        return self.success("done")


class do(SkillBase):
    def createDescription(self):
        self.setDescription(Do(), "Does something")

    def expand(self, skill):
"""

_SIMPLE = (
    "Serial",
    "SerialStar",
    "Sequential",
    "Selector",
    "SelectorStar",
    "ParallelFf",
    "ParallelFs",
)
_PLAIN = st.sampled_from(_SIMPLE).map("{}()".format)
PROCESSORS = st.one_of(
    _PLAIN, _PLAIN.map("NoFail({})".format), st.integers(0, 9).map("RetryOnFail({})".format)
)
_REMAPS = st.sampled_from(["", '"Target": "Goal"', "'Target': \"Start (m)\""])
_SPEEDS = st.sampled_from(
    ["1.5", "-2.0", 'self.params["Speed"].value', "-self.params['Speed'].value / 2", "speed"]
)


@st.composite
def _children(draw: st.DrawFn) -> str:
    name = draw(st.sampled_from(['"Go"', "'skiros:Go'"]))
    label = draw(st.sampled_from(["", ', ""', ', "go"', ', slabel="go"']))
    parts = []
    remap = draw(_REMAPS)
    if remap:
        parts.append(f"remap={{{remap}}}")
    if draw(st.booleans()):
        comment = draw(st.sampled_from(["", "  # slowly\n", "\n"]))
        parts.append(f'specify={{{comment} "Max Speed": {draw(_SPEEDS)}}}')
    return (
        f"self.skill({name}{label}{''.join(f', {each}' for each in draw(st.permutations(parts)))})"
    )


@st.composite
def _groups(draw: st.DrawFn, inner: st.SearchStrategy[str]) -> str:
    children = draw(st.lists(inner, min_size=1, max_size=3))
    return f"self.skill({draw(PROCESSORS)})({_listed(draw, children)})"


def _listed(draw: st.DrawFn, children: list[str]) -> str:
    between = draw(st.sampled_from([", ", ",\n            ", ",  # next\n            "]))
    before = draw(st.sampled_from(["", "\n            ", "\n            # first\n            "]))
    return before + between.join(children) + draw(st.sampled_from(["", ","]))


TREES = st.recursive(_children(), _groups, max_leaves=6)


@st.composite
def compounds(draw: st.DrawFn) -> str:
    """A module with a compound skill; its tree may depend on a parameter."""

    def branch(indent: str) -> str:
        lines = []
        if draw(st.booleans()):
            lines.append(f"skill.setProcessor({draw(PROCESSORS)})  # chosen")
        lines.append(f"skill({_listed(draw, draw(st.lists(TREES, min_size=1, max_size=3)))})")
        return "".join(f"{indent}{line}\n" for line in lines)

    body = '        # how fast\n        speed = self.params["Speed"].value\n'
    if draw(st.booleans()):
        body += f"        if self.params['Careful'].value:\n{branch(' ' * 12)}"
        body += f"        else:\n{branch(' ' * 12)}"
    else:
        body += branch(" " * 8)
    return HEAD + body
