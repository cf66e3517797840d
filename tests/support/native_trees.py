# mypy: ignore-errors
"""Trees that EzSkiROS writes, as SkiROS2's own API writes them: `Push(Force=params.Mine)` is
`self.skill("Push", "push", remap={"Force": "Mine"})` there, `Push(Force=7.0)` has `specify`.

Nothing of our host is in it: with these trees SkiROS2 shows what its values are.
"""

from __future__ import annotations


class _Passed:
    """A parameter of the compound. What is computed with it is a value."""

    def __init__(self, key, value):
        self.key, self.value = key, value

    def __mul__(self, other):
        return self.value * other


class _Parameters:
    """`params` of `expandBT`."""

    def __init__(self, compound):
        self._compound = compound

    def __getattr__(self, name):
        return _Passed(name, self._compound.params[name].value)


class _Processors:
    """`self` of `expandBT`."""

    def __init__(self, compound):
        self._compound = compound

    def __getattr__(self, name):
        from skiros2_skill.core import processors

        known = {each.lower(): each for each in dir(processors) if each[0].isupper()}

        def made(*children):
            if name == "nofail":
                processor = processors.NoFail(processors.SerialStar())
            else:
                processor = getattr(processors, known[name])()
            return self._compound.skill(processor)(*children)

        return made


class _Names(dict):
    """The names of a tree: any that is not known is that of a skill."""

    def __init__(self, compound):
        super().__init__(self=_Processors(compound), params=_Parameters(compound))
        self._compound = compound

    def __missing__(self, name):
        def child(**arguments):
            passed = {key: each for key, each in arguments.items() if isinstance(each, _Passed)}
            return self._compound.skill(
                name,
                name.lower(),
                remap={key: each.key for key, each in passed.items()},
                specify={key: each for key, each in arguments.items() if key not in passed},
            )

        return child


def expand(compound, skill, tree: str) -> None:
    """The call in `SkillBase.expand` for the children of a `self.serialstar`."""
    from skiros2_skill.core.processors import SerialStar

    skill.setProcessor(SerialStar())
    skill(*eval(f"[{tree}]", {"__builtins__": {}}, _Names(compound)))


def renamed(skills):
    """The keys on the blackboard of the last one of some skills, each with its renamings and its
    own keys, below those before it; and the keys that its implementation has for its own ones.
    """
    from skiros2_common.core.params import ParamTypes
    from skiros2_skill.core.skill import SkillInterface, SkillWrapper

    skill = SkillInterface()
    for renamings, keys in skills:
        above, skill = skill, SkillInterface()
        for key in {*keys, "Robot"}:
            skill.params.addParam(key, key, ParamTypes.Optional)
        for key, other in renamings.items():
            skill.remap(key, other)
        above.addChild(skill)
    back = SkillWrapper.getParamsNoRemaps(skill)
    return (
        {each.value: key for key, each in skill.params.items()},
        {each.value: key for key, each in back.items()},
    )
