"""Translation of calls such as `getRelationCond` to EzSkiROS expressions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import libcst as cst
import libcst.matchers as m

from ezskiros.migrate import errors
from ezskiros.migrate.calls import Arguments, condition_maker, literal_text
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.labels import says_more
from ezskiros.migrate.names import FileNames
from ezskiros.migrate.values import BASIC, KnownValues

_OPERATORS = {"=": "==", "<": "<", ">": ">", "<=": "<=", ">=": ">="}


@dataclass(frozen=True)
class Expression:
    """A condition in source form. `labels` are the labels that add information to the condition."""

    text: str
    labels: tuple[str, ...] = ()
    is_atom: bool = True

    def without_labels(self) -> Expression:
        """The same condition without labels, if they are written elsewhere."""
        return Expression(self.text, (), self.is_atom)

    @property
    def part(self) -> str:
        """The text for use inside a larger expression."""
        return self.text if self.is_atom else f"({self.text})"


@dataclass
class OrBuilder:
    """An `or` under construction."""

    is_true: bool
    node: cst.CSTNode
    statement: cst.CSTNode
    parts: list[Expression] = field(default_factory=list)
    is_used: bool = False


@dataclass
class ConditionReader:
    """Reads the conditions of one description.

    `individuals` are its parameters for individuals, `others` its other parameters: names by key.
    `mentioned` are the names of parameters in conditions.
    """

    names: FileNames
    known: KnownValues
    code: Callable[[cst.CSTNode], str]
    individuals: Mapping[str, str]
    others: Mapping[str, str]
    variables: dict[str, Expression | OrBuilder] = field(default_factory=dict)
    mentioned: set[str] = field(default_factory=set)

    def read(self, node: cst.BaseExpression) -> Expression:
        """Read an argument of the methods that add conditions: a call, or a variable. Raises
        `LeftError`.
        """
        if isinstance(node, cst.Name) and node.value in self.variables:
            found = self.variables[node.value]
            if isinstance(found, OrBuilder):
                return self._any_of(found, node)
            return Expression(node.value)
        name = condition_maker(node)
        maker = _MAKERS.get(name or "")
        if maker is None or name is None or not isinstance(node, cst.Call):
            shown = f"the condition `{' '.join(self.code(node).split())}`"
            raise LeftError(errors.UnknownStatement(found=shown), node)
        return maker(self, Arguments(node, name))

    def part(self, node: cst.BaseExpression) -> Expression:
        """Read a part of an `or`, which may be used after a variable has changed."""
        if isinstance(node, cst.Name):
            found = self.variables.get(node.value)
            if isinstance(found, Expression):
                return found.without_labels()
        return self.read(node)

    def _any_of(self, builder: OrBuilder, node: cst.CSTNode) -> Expression:
        if len(builder.parts) < 2:
            count = "no condition" if not builder.parts else "only one condition"
            raise LeftError(errors.UnusableOr(found=f"has {count}"), node)
        builder.is_used = True
        text = " | ".join(part.part for part in builder.parts)
        labels = tuple(label for part in builder.parts for label in part.labels)
        return _stated(Expression(text, labels, is_atom=False), is_true=builder.is_true)

    def relation(self, given: Arguments) -> Expression:
        """A relation, such as `Robot.at(Location)`."""
        subject, other = self._individual(given, "subj"), self._individual(given, "obj")
        light, node = given.text("olabel"), given["olabel"]
        attribute = self.names.attribute(subject, light, node)
        text = f"{attribute}({other})"
        if attribute is None:
            text = f"{self.names.entity(light, node)}({subject}, {other})"
        is_true = given.truth("desired_state")
        labels = self._labels(given, (light, subject, other), is_true=is_true)
        return _stated(Expression(text, labels), is_true=is_true)

    def abstract_relation(self, given: Arguments) -> Expression:
        """An abstract relation, such as `abstract(Container.partReference(Object))`."""
        found = self.relation(given)
        is_true = given.truth("desired_state")
        inner = found.text.removeprefix("~")
        text = f"{self.names.our('abstract')}({inner})"
        return _stated(Expression(text, found.labels), is_true=is_true)

    def comparison(self, given: Arguments) -> Expression:
        """A comparison, such as `Gripper.ContainerState == "Empty"`."""
        operator = given.text("operator")
        if operator not in _OPERATORS:
            raise LeftError(errors.NoOperator(found=operator), given["operator"])
        value, is_true = given["value"], given.truth("desired_state")
        spelled, said = self._property(given), self._value(value)
        labels = self._labels(given, (*self._said(given), said), is_true=is_true)
        if operator == "=":
            text = f"{spelled} {'==' if is_true else '!='} {said}"
            return Expression(text, labels, is_atom=False)
        compared = Expression(f"{spelled} {_OPERATORS[operator]} {said}", labels, is_atom=False)
        return _stated(compared, is_true=is_true)

    def has_property(self, given: Arguments) -> Expression:
        """A property with any value, such as `Object.Position`."""
        is_true = given.truth("desired_state")
        labels = self._labels(given, self._said(given), is_true=is_true)
        return _stated(Expression(self._property(given), labels), is_true=is_true)

    def of_type(self, given: Arguments) -> Expression:
        """A class, such as `of_type(Object, skiros.Product)`."""
        subject, light = self._individual(given, "subj"), given.text("value")
        text = f"{self.names.our('of_type')}({subject}, {self.names.entity(light, given['value'])})"
        return Expression(text, self._labels(given, (subject, light, "type"), is_true=True))

    def specified(self, given: Arguments) -> Expression:
        """A required value, such as `specified(Object)`."""
        return self._about(given, "specified", ("specified", "set", "unset"))

    def generated(self, given: Arguments) -> Expression:
        """A new individual, such as `generated(Object)`."""
        return self._about(given, "generated", ("generated", "generate", "consume"))

    def _about(self, given: Arguments, function: str, words: tuple[str, ...]) -> Expression:
        subject, is_true = self._individual(given, "subj"), given.truth("desired_state")
        labels = self._labels(given, (subject, *words), is_true=is_true)
        text = f"{self.names.our(function)}({subject})"
        return _stated(Expression(text, labels), is_true=is_true)

    def _property(self, given: Arguments) -> str:
        subject, light, node = (
            self._individual(given, "subj"),
            given.text("olabel"),
            given["olabel"],
        )
        attribute = self.names.attribute(subject, light, node)
        return attribute or f"{self.names.entity(light, node)}({subject})"

    def _said(self, given: Arguments) -> tuple[str, str]:
        return given.text("subj"), given.text("olabel")

    def _value(self, value: cst.BaseExpression) -> str:
        """A compared value. Raises `LeftError` if it may not be a value."""
        code = self.code(value)
        hidden = {*self.individuals.values(), *self.others.values(), *self.variables}
        names = {each.value for each in m.findall(value, m.Name()) if isinstance(each, cst.Name)}
        if self.known.type_of(value) not in BASIC or names & hidden:
            raise LeftError(errors.UntypedValue(found=f"`{' '.join(code.split())}`"), value)
        is_plain = isinstance(value, (cst.SimpleString, cst.Integer, cst.Float, cst.Name))
        is_plain = is_plain or isinstance(value, (cst.UnaryOperation, cst.Attribute, cst.Call))
        return code if is_plain and not value.lpar else f"({code})"

    def _individual(self, given: Arguments, key: str) -> str:
        """The parameter in a condition. Raises `LeftError` if it does not stand for an
        individual.
        """
        wanted = given.text(key)
        if name := self.individuals.get(wanted):
            self.mentioned.add(name)
            return name
        found = (
            "does not stand for an individual" if wanted in self.others else "is not a parameter"
        )
        raise LeftError(errors.NotAnIndividual(key=wanted, found=found), given[key])

    def _labels(self, given: Arguments, said: tuple[str, ...], *, is_true: bool) -> tuple[str, ...]:
        """The label, if it adds information; the code of a computed label."""
        label = literal_text(given["clabel"])
        if label is None:
            return (" ".join(self.code(given["clabel"]).split()),)
        text = " ".join(label.split())
        return (text,) if says_more(text, said, is_true=is_true) else ()


def _stated(found: Expression, *, is_true: bool) -> Expression:
    """The condition, or its negation."""
    return found if is_true else Expression(f"~{found.part}", found.labels)


_MAKERS: Mapping[str, Callable[[ConditionReader, Arguments], Expression]] = {
    "getRelationCond": ConditionReader.relation,
    "getAbstractRelationCond": ConditionReader.abstract_relation,
    "getPropCond": ConditionReader.comparison,
    "getHasPropCond": ConditionReader.has_property,
    "getOnTypeCond": ConditionReader.of_type,
    "getIsSpecifiedCond": ConditionReader.specified,
    "getGenerateCond": ConditionReader.generated,
}
