"""Calls of SkiROS2's description methods: the method, and its arguments by name."""

from __future__ import annotations

import libcst as cst
from libcst.helpers import get_full_name_for_node

from ezskiros.migrate import errors
from ezskiros.migrate.errors import LeftError

PARAMETERS = {
    "addParam": ("key", "value", "param_type", "options", "description"),
    "addPreCondition": ("condition",),
    "addHoldCondition": ("condition",),
    "addPostCondition": ("condition",),
    "addCondition": ("condition",),
    "getRelationCond": ("clabel", "olabel", "subj", "obj", "desired_state"),
    "getAbstractRelationCond": ("clabel", "olabel", "subj", "obj", "desired_state"),
    "getPropCond": ("clabel", "olabel", "subj", "operator", "value", "desired_state"),
    "getHasPropCond": ("clabel", "olabel", "subj", "desired_state"),
    "getOnTypeCond": ("clabel", "subj", "value"),
    "getIsSpecifiedCond": ("clabel", "subj", "desired_state"),
    "getGenerateCond": ("clabel", "subj", "desired_state"),
    "getOrCond": ("desired_state",),
    "skill": ("stype", "slabel", "remap", "specify", "preconditions"),
    "setDescription": ("description", "label"),
}
"""The parameters of the methods of SkiROS2's descriptions, conditions and skills, in order."""

CONDITION_CLASSES = {
    "ConditionRelation": "getRelationCond",
    "AbstractConditionRelation": "getAbstractRelationCond",
    "ConditionProperty": "getPropCond",
    "ConditionHasProperty": "getHasPropCond",
    "ConditionOnType": "getOnTypeCond",
    "ConditionIsSpecified": "getIsSpecifiedCond",
    "ConditionGenerate": "getGenerateCond",
    "ConditionOr": "getOrCond",
}
"""The classes of conditions, and the methods that make them with the same arguments."""

_MAY_MISS = {
    "addParam": {"options", "description"},
    "skill": {"slabel", "remap", "specify", "preconditions"},
    "setDescription": {"label"},
}


def method(expression: cst.BaseExpression, owner: str = "self") -> str | None:
    """The method in a call `owner.method(...)`; None for anything else."""
    match expression:
        case cst.Call(func=cst.Attribute(value=cst.Name(value=name), attr=attr)) if name == owner:
            return attr.value
        case _:  # open: any other node
            pass
    return None


def condition_maker(expression: cst.BaseExpression) -> str | None:
    """The method that makes a condition, also if the code calls the class of the condition
    instead.
    """
    if isinstance(expression, cst.Call) and method(expression) is None:
        return CONDITION_CLASSES.get(last_name(expression.func) or "")
    return method(expression)


class Arguments:
    """The arguments of one call. Raises `LeftError` if they do not fit the method."""

    def __init__(self, call: cst.Call, name: str) -> None:
        self.call, self.name = call, name
        wanted = PARAMETERS[name]
        self._found: dict[str, cst.BaseExpression] = {}
        for position, argument in enumerate(call.args):
            keyword = argument.keyword.value if argument.keyword else None
            key = keyword or (wanted[position] if position < len(wanted) else "")
            if argument.star or key not in wanted or key in self._found:
                raise self._wrong()
            self._found[key] = argument.value
        if set(wanted) - set(self._found) - _MAY_MISS.get(name, set()):
            raise self._wrong()

    def _wrong(self) -> LeftError:
        wanted = ", ".join(PARAMETERS[self.name])
        return LeftError(errors.WrongArguments(call=self.name, wanted=wanted), self.call)

    def __getitem__(self, key: str) -> cst.BaseExpression:
        return self._found[key]

    def get(self, key: str) -> cst.BaseExpression | None:
        """An optional argument."""
        return self._found.get(key)

    def text(self, key: str) -> str:
        """A literal text. Raises `LeftError` if it is computed."""
        found = literal_text(self[key])
        if found is None:
            raise self._computed(key, "the text")
        return found

    def truth(self, key: str) -> bool:
        """A literal True or False. Raises `LeftError` if it is computed."""
        match self[key]:
            case cst.Name(value="True" | "False" as found):
                return found == "True"
            case _:
                raise self._computed(key, "True or False")

    def _computed(self, key: str, wanted: str) -> LeftError:
        found = errors.ComputedArgument(argument=key, call=self.name, wanted=wanted)
        return LeftError(found, self[key])


def literal_text(expression: cst.BaseExpression) -> str | None:
    """The text of a literal; None for anything else."""
    if isinstance(expression, (cst.SimpleString, cst.ConcatenatedString)):
        found = expression.evaluated_value
        return found if isinstance(found, str) else None
    return None


def last_name(node: cst.CSTNode) -> str | None:
    """The last part of a name, such as `Element` of `Element` and of `world_element.Element`; None
    for other expressions.
    """
    full = get_full_name_for_node(node) if isinstance(node, (cst.Name, cst.Attribute)) else None
    return full.rpartition(".")[2] if full else None
