"""Translation of `addParam` to a method parameter."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import libcst as cst

from dslkit.diagnostics import Template
from ezskiros.migrate import errors
from ezskiros.migrate.calls import Arguments, last_name, literal_text
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.keys import ROBOT
from ezskiros.migrate.names import FileNames, split
from ezskiros.migrate.values import BASIC, KnownValues
from ezskiros.skills.markers import Option, ParameterKind

_KINDS = {kind.value: kind for kind in ParameterKind}
_OPTIONS = {option.value: option for option in Option}


@dataclass(frozen=True)
class SourceParameter:
    """A parameter in source form, and its documentation. `key` is its SkiROS2 key. If
    `is_required`, the caller must set it. `kind` is a class or type such as `skiros:Product` or
    `float`, if known.
    """

    key: str
    name: str
    annotation: str
    default: str | None = None
    doc: str = ""
    is_individual: bool = False
    is_required: bool = False
    kind: str = ""

    def __str__(self) -> str:
        return f"{self.name}: {self.annotation}" + (f" = {self.default}" if self.default else "")


def implicit_robot(names: FileNames) -> SourceParameter:
    """The parameter that SkiROS2 adds to each skill without a parameter of this name."""
    agent = names.entity("sumo:Agent", cst.Name(ROBOT))
    inferred = f"{names.our('INFERRED')}[{agent}]"
    return SourceParameter(ROBOT, ROBOT, inferred, is_individual=True, kind="sumo:Agent")


def optional_parameter(names: FileNames, key: str, name: str, kind: str) -> SourceParameter:
    """A parameter that children share, and that the description does not declare."""
    is_individual = kind not in BASIC
    annotation = names.entity(kind, cst.Name(name)) if is_individual else kind
    annotation = f"{names.our(ParameterKind.OPTIONAL.name)}[{annotation}]"
    annotation = annotation if key == name else names.with_key(annotation, key)
    return SourceParameter(key, name, annotation, is_individual=is_individual, kind=kind)


@dataclass
class ParameterReader:
    """Reads the parameters of one description. `code` gives the text of an expression, `called` the
    names of the parameters by key.
    """

    names: FileNames
    known: KnownValues
    code: Callable[[cst.CSTNode], str]
    called: Mapping[str, str]

    def read(
        self, call: cst.Call, warn: Callable[[Template, cst.CSTNode], None]
    ) -> SourceParameter:
        """The parameter of a call of `addParam`. Raises `LeftError`."""
        given = Arguments(call, "addParam")
        key = given.text("key")
        if not key:
            raise LeftError(errors.EmptyKey(), given["key"])
        kind, written = _kind(given["param_type"]), given.get("options")
        match given["value"]:
            case cst.Call() as element if last_name(element.func) == "Element":
                light, node = _element_class(key, element)
                annotation, default = self.names.entity(light, node), None
                options, is_individual, of_kind = (
                    _options(written),
                    True,
                    ":".join(split(light, node)),
                )
            case value:
                annotation, default = self._basic(key, value)
                if kind is ParameterKind.INFERRED:
                    raise LeftError(errors.InferredBasic(key=key), call)
                options, is_individual = _output_alone(written), False
                of_kind = annotation if annotation in BASIC else ""
                if written is not None and not options and _does_something(written):
                    warn(errors.IgnoredOptions(key=key), written)
        can_be_output = (
            kind is ParameterKind.OPTIONAL and default is None and {*options} == {Option.OUTPUT}
        )
        if written is not None and Option.OUTPUT in options and not can_be_output:
            options = [each for each in options if each is not Option.OUTPUT]
            warn(errors.LeftOutput(key=key), written)
        marks: list[ParameterKind | Option] = [Option.OUTPUT] if can_be_output else [*options, kind]
        annotation = self._marked(key, annotation, marks)
        is_required = kind is ParameterKind.REQUIRED and default is None
        name, doc = self.called[key], _doc(given)
        return SourceParameter(
            key, name, annotation, default, doc, is_individual, is_required, of_kind
        )

    def _marked(self, key: str, annotation: str, marks: Sequence[ParameterKind | Option]) -> str:
        """A class or basic type with all its markers."""
        for mark in marks:
            if mark is not ParameterKind.REQUIRED:
                annotation = f"{self.names.our(mark.name)}[{annotation}]"
        return annotation if self.called[key] == key else self.names.with_key(annotation, key)

    def _basic(self, key: str, value: cst.BaseExpression) -> tuple[str, str | None]:
        """The type and the default of a parameter that is not an individual. Raises `LeftError`."""
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
            case _:  # open: any other expression
                return f"`{' '.join(self.code(value).split())}`"


def _kind(node: cst.BaseExpression) -> ParameterKind:
    """The kind of a parameter. Raises `LeftError` for a kind that SkiROS2 does not have."""
    found = last_name(node) or "this expression"
    is_one = isinstance(node, cst.Attribute) and last_name(node.value) == "ParamTypes"
    if is_one and found in _KINDS:
        return _KINDS[found]
    raise LeftError(errors.NoKind(found=found), node)


def _element_class(key: str, element: cst.Call) -> tuple[str, cst.BaseExpression]:
    """The class in an expression such as `Element("skiros:Product")`, and its place. Raises
    `LeftError`.
    """
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
    """The options. Raises `LeftError` for options that SkiROS2 does not have.

    A text instead of options is a description: SkiROS2 goes through its letters, which are not
    options.
    """
    if node is None or literal_text(node) is not None:
        return []
    if not isinstance(node, (cst.List, cst.Tuple, cst.Set)):
        raise LeftError(errors.NoOption(found=last_name(node) or "this expression"), node)
    found = []
    for element in node.elements:
        name = last_name(element.value) or ""
        if name not in _OPTIONS:
            raise LeftError(errors.NoOption(found=name or "this expression"), element.value)
        found.append(_OPTIONS[name])
    return found


def _output_alone(node: cst.BaseExpression | None) -> list[Option]:
    """The option Output, if it is the only one; otherwise no option. For parameters that are not
    individuals.
    """
    try:
        found = _options(node)
    except LeftError:
        return []
    return found if {*found} == {Option.OUTPUT} else []


def _does_something(options: cst.BaseExpression) -> bool:
    """Say whether options would have an effect on an individual."""
    try:
        return bool(_options(options))
    except LeftError:
        return True


def _doc(given: Arguments) -> str:
    """The documentation of the parameter, in one line, even if it is at the place of the
    options.
    """
    options = given.get("options")
    text = given.text("description") if given.get("description") is not None else ""
    if not text and options is not None:
        text = literal_text(options) or ""
    return " ".join(text.split())
