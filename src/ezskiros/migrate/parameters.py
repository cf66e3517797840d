"""`addParam` in, a parameter of a method out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import libcst as cst

from dslkit.diagnostics import Template
from ezskiros.migrate import errors
from ezskiros.migrate.calls import Arguments, last_name, literal_text
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.names import Names, parameter_name
from ezskiros.migrate.values import BASIC, Known
from ezskiros.skills.markers import Kind, Option

_KINDS = {kind.value: kind for kind in Kind}
_OPTIONS = {option.value: option for option in Option}
ROBOT = "Robot"
_WITHOUT_EFFECT = "Output"
"""An option that SkiROS2 declares and reads nowhere."""


@dataclass(frozen=True)
class Parameter:
    """A parameter as it is written, and what is said of it."""

    name: str
    annotation: str
    default: str | None = None
    doc: str = ""
    is_thing: bool = False

    def __str__(self) -> str:
        return f"{self.name}: {self.annotation}" + (f" = {self.default}" if self.default else "")


def implicit_robot(names: Names) -> Parameter:
    """The parameter that SkiROS2 adds to each skill that has none of this name."""
    agent = names.entity("sumo:Agent", cst.Name(ROBOT))
    return Parameter(ROBOT, f"{names.our('INFERRED')}[{agent}]", is_thing=True)


@dataclass
class ParameterReader:
    """Reads the parameters of the descriptions of one file; `code` is the text of an expression."""

    names: Names
    known: Known
    code: Callable[[cst.CSTNode], str]

    def read(self, call: cst.Call, warn: Callable[[Template, cst.CSTNode], None]) -> Parameter:
        """The parameter of a call of `addParam`. Raises `LeftError`."""
        given = Arguments(call, "addParam")
        key = parameter_name(given.text("key"), given["key"])
        kind, value = _kind(given["param_type"]), given["value"]
        if isinstance(value, cst.Call) and last_name(value.func) == "Element":
            annotation = self.names.entity(*_element_class(key, value))
            for option in _options(given.get("options")):
                annotation = f"{self.names.our(option.name)}[{annotation}]"
            annotation = self._marked(annotation, kind)
            return Parameter(key, annotation, doc=_doc(given), is_thing=True)
        annotation, default = self._basic(key, value)
        if kind is Kind.INFERRED:
            raise LeftError(errors.InferredBasic(key=key), call)
        options = given.get("options")
        if options is not None and _does_something(options):
            warn(errors.IgnoredOptions(key=key), options)
        return Parameter(key, self._marked(annotation, kind), default, _doc(given))

    def _marked(self, annotation: str, kind: Kind) -> str:
        return annotation if kind is Kind.REQUIRED else f"{self.names.our(kind.name)}[{annotation}]"

    def _basic(self, key: str, value: cst.BaseExpression) -> tuple[str, str | None]:
        """The type and the default of a parameter that is no thing. Raises `LeftError`."""
        if isinstance(value, cst.Name) and value.value in (*BASIC, *self.known.enumerations):
            return value.value, None
        found = self.known.type_of(value)
        if found is None:
            raise LeftError(errors.UntypedParameter(key=key, found=self._shown(value)), value)
        return found, self.code(value)

    def _shown(self, value: cst.BaseExpression) -> str:
        match value:
            case cst.List() | cst.ListComp() | cst.Name(value="list"):
                return "a list"
            case cst.Dict() | cst.DictComp() | cst.Name(value="dict"):
                return "a dict"
            case cst.Tuple() | cst.Name(value="tuple"):
                return "a tuple"
        return f"`{' '.join(self.code(value).split())}`"


def _kind(node: cst.BaseExpression) -> Kind:
    """Raises `LeftError` for one that SkiROS2 does not have."""
    found = last_name(node) or "this expression"
    is_one = isinstance(node, cst.Attribute) and last_name(node.value) == "ParamTypes"
    if is_one and found in _KINDS:
        return _KINDS[found]
    raise LeftError(errors.NoKind(found=found), node)


def _element_class(key: str, element: cst.Call) -> tuple[str, cst.BaseExpression]:
    """The class of `Element("skiros:Product")`, and where it is. Raises `LeftError`."""
    if not element.args:
        raise LeftError(errors.ParticularElement(key=key, found="an element of no class"), element)
    first, *others = element.args
    is_class = not first.star and (first.keyword is None or first.keyword.value == "etype")
    if not is_class or any(literal_text(each.value) != "" for each in others):
        found = "a particular element, with a label or an identifier"
        raise LeftError(errors.ParticularElement(key=key, found=found), element)
    text = literal_text(first.value)
    if text is None:
        computed = errors.ComputedArgument(argument="etype", call="Element", wanted="the text")
        raise LeftError(computed, first.value)
    return text, first.value


def _options(node: cst.BaseExpression | None) -> list[Option]:
    """The options that do something. Raises `LeftError` for those that SkiROS2 does not have.

    A text in their place is a description: SkiROS2 goes through its letters, which are no options.
    """
    if node is None or literal_text(node) is not None:
        return []
    if not isinstance(node, (cst.List, cst.Tuple, cst.Set)):
        raise LeftError(errors.NoOption(found=last_name(node) or "this expression"), node)
    found = []
    for element in node.elements:
        name = last_name(element.value) or ""
        if name in _OPTIONS:
            found.append(_OPTIONS[name])
        elif name != _WITHOUT_EFFECT:
            raise LeftError(errors.NoOption(found=name or "this expression"), element.value)
    return found


def _does_something(options: cst.BaseExpression) -> bool:
    """Whether options would do something for a thing."""
    try:
        return bool(_options(options))
    except LeftError:
        return True


def _doc(given: Arguments) -> str:
    """What is said of the parameter, in one line: also where options should be."""
    options = given.get("options")
    text = given.text("description") if given.get("description") is not None else ""
    if not text and options is not None:
        text = literal_text(options) or ""
    return " ".join(text.split())
