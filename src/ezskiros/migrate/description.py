"""Translation of the method `createDescription` to the method `description`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from types import MappingProxyType

import libcst as cst

from dslkit.diagnostics import Template
from ezskiros.migrate import errors
from ezskiros.migrate.calls import Arguments, condition_maker, method
from ezskiros.migrate.comments import inner_comments, texts
from ezskiros.migrate.conditions import ConditionReader, Expression, OrBuilder
from ezskiros.migrate.docstrings import Text, docstring_of, with_arguments
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.keys import ROBOT, more_names, parameter_names
from ezskiros.migrate.names import FileNames
from ezskiros.migrate.parameters import (
    ParameterReader,
    SourceParameter,
    implicit_robot,
    optional_parameter,
)
from ezskiros.migrate.steps import DescriptionStatement, keys_of, statements_of, steps_of
from ezskiros.migrate.values import KnownValues

LENGTH = 100
"""The longest line, as far as possible."""
_CONDITIONS = {
    "addPreCondition": "pre_conditions",
    "addHoldCondition": "hold_conditions",
    "addPostCondition": "post_conditions",
}


@dataclass(frozen=True)
class UntranslatedPart:
    """The untranslated part of a statement, and the reason. `statement` gets the mark."""

    template: Template
    node: cst.CSTNode
    statement: cst.CSTNode


@dataclass
class Translation:
    """The new method, line by line, and its parameters. If there are `findings`, there is no
    method.
    """

    lines: list[str] = field(default_factory=list)
    parameters: list[SourceParameter] = field(default_factory=list)
    findings: list[UntranslatedPart] = field(default_factory=list)
    warnings: list[UntranslatedPart] = field(default_factory=list)


def translate(
    function: cst.FunctionDef,
    names: FileNames,
    known: KnownValues,
    code: Callable[[cst.CSTNode], str],
    indents: tuple[str, str],
    *,
    has_robot: bool = False,
    added: Mapping[str, str] = MappingProxyType({}),
) -> Translation:
    """The method `description` for a method `createDescription`.

    `code` gives the text of an expression. `indents` are the indentation of the method, and the
    additional indentation of its body. With `has_robot`, the robot that SkiROS2 adds is written as
    a parameter. `added` are the classes and types of parameters that children share, by key.
    """
    return _Translator(function, names, known, code, indents, has_robot, added).translated()


class _Translator:
    def __init__(
        self,
        function: cst.FunctionDef,
        names: FileNames,
        known: KnownValues,
        code: Callable[[cst.CSTNode], str],
        indents: tuple[str, str],
        has_robot: bool,
        added: Mapping[str, str],
    ) -> None:
        self._function, self._names, self._known = function, names, known
        self._has_robot, self._added = has_robot, added
        self._code, (self._outer, self._step) = code, indents
        self._parameters: list[tuple[DescriptionStatement, SourceParameter]] = []
        self._body: list[str] = []
        self._waiting: list[str] = []
        self._last: DescriptionStatement | None = None
        self._found = Translation()

    def translated(self) -> Translation:
        self._check_method()
        statements = list(statements_of(self._function))
        doc = docstring_of(statements[0]) if statements else None
        steps = list(steps_of(statements, self._function))
        above_doc = []
        if doc is not None:
            first = steps.pop(0)
            above_doc = [*first.above, *([first.behind] if first.behind else [])]
        self._last = steps[-1] if steps else None
        called = parameter_names(keys_of(steps))
        more = more_names(called, self._added)
        self._read_parameters(steps, called)
        self._read_conditions(steps, {*more.values()})
        self._add(
            [optional_parameter(self._names, *each, self._added[each[0]]) for each in more.items()]
        )
        if not self._found.findings:
            self._found.lines = self._written(doc, above_doc)
            self._found.parameters = [each for _, each in self._parameters]
        return self._found

    def _check_method(self) -> None:
        parameters = self._function.params
        is_plain = len(parameters.params) == 1 and parameters.params[0].name.value == "self"
        others = (parameters.kwonly_params, parameters.posonly_params, parameters.star_kwarg)
        odd = self._function.decorators or self._function.asynchronous or any(others)
        if odd or not is_plain or isinstance(parameters.star_arg, cst.Param):
            template = errors.UnknownStatement(found="a method with decorators or parameters")
            self._leave(LeftError(template, self._function.name), self._function)

    def _leave(self, left: LeftError, statement: cst.CSTNode) -> None:
        self._found.findings.append(UntranslatedPart(left.template, left.node, statement))

    def _add(self, parameters: Iterable[SourceParameter]) -> None:
        """Add parameters that no statement declares."""
        self._parameters += [
            (DescriptionStatement(cst.Pass(), self._function, []), each) for each in parameters
        ]

    def _read_parameters(
        self, steps: Sequence[DescriptionStatement], called: Mapping[str, str]
    ) -> None:
        reader = ParameterReader(self._names, self._known, self._code, called)
        for step in steps:
            call = step.call
            if call is None or method(call) != "addParam":
                continue

            def warn(
                template: Template, node: cst.CSTNode, step: DescriptionStatement = step
            ) -> None:
                self._found.warnings.append(UntranslatedPart(template, node, step.statement))

            try:
                found = reader.read(call, warn)
                if any(found.key == each.key for _, each in self._parameters):
                    raise LeftError(errors.RepeatedParameter(key=found.key), call)
                self._parameters.append((step, found))
            except LeftError as left:
                self._leave(left, step.statement)

    def _read_conditions(self, steps: Sequence[DescriptionStatement], added: Set[str]) -> None:
        declared = [each for _, each in self._parameters]
        individuals = {each.key: each.name for each in declared if each.is_individual}
        others = {each.key: each.name for each in declared if not each.is_individual}
        unclear = keys_of(steps) - {*individuals, *others}
        robot = {ROBOT} - {*individuals, *others} - unclear
        individuals |= {key: key for key in robot}
        self._names.hidden = self._hidden = {*individuals.values(), *others.values(), *added, ROBOT}
        reader = ConditionReader(self._names, self._known, self._code, individuals, others)
        for step in steps:
            if step.call is not None and method(step.call) == "addParam":
                continue
            try:
                self._read_step(step, reader)
            except LeftError as left:
                # A statement about an untranslated parameter is not wrong because of that.
                about = getattr(left.template, "key", None)
                if not (isinstance(left.template, errors.NotAnIndividual) and about in unclear):
                    self._leave(left, step.statement)
        if robot and (self._has_robot or robot & reader.mentioned):
            self._add([implicit_robot(self._names)])
        for name, builder in reader.variables.items():
            is_unused = isinstance(builder, OrBuilder) and not builder.is_used
            if isinstance(builder, OrBuilder) and is_unused and not self._found.findings:
                self._leave(_unused(name, builder), builder.statement)

    def _read_step(self, step: DescriptionStatement, reader: ConditionReader) -> None:
        """Read a statement that is not a parameter. Raises `LeftError`."""
        match step.node:
            case cst.Pass():
                self._wait(step)
            case cst.Return(value=None) if step is self._last:
                self._wait(step)
            case cst.Expr(value=cst.SimpleString() | cst.ConcatenatedString() as text):
                self._emit(step, self._code(text))
            case cst.Expr(value=cst.Call() as call):
                self._read_call(step, call, reader)
            case cst.Assign(
                targets=[cst.AssignTarget(target=cst.Name(value=name))], value=cst.Call() as value
            ) if name not in self._hidden:
                self._read_variable(step, name, value, reader)
            case _:
                raise _unknown(step.node, self._code)

    def _read_call(
        self, step: DescriptionStatement, call: cst.Call, reader: ConditionReader
    ) -> None:
        name = method(call)
        if name in _CONDITIONS:
            found = reader.read(Arguments(call, name)["condition"])
            self._emit(step, f"self.{_CONDITIONS[name]} += {found.text}", found.labels)
            return
        for variable, builder in reader.variables.items():
            if isinstance(builder, OrBuilder) and method(call, variable) == "addCondition":
                if builder.is_used:
                    found_or = errors.UnusableOr(found="is changed after it is added")
                    raise LeftError(found_or, call)
                builder.parts.append(Expression("..."))  # counts even if it cannot be read
                builder.parts[-1] = reader.part(Arguments(call, "addCondition")["condition"])
                self._wait(step)
                return
        raise _unknown(step.node, self._code)

    def _read_variable(
        self, step: DescriptionStatement, name: str, value: cst.Call, reader: ConditionReader
    ) -> None:
        before = reader.variables.get(name)
        if isinstance(before, OrBuilder) and not before.is_used:
            raise _unused(name, before)
        if condition_maker(value) == "getOrCond":
            is_true = Arguments(value, "getOrCond").truth("desired_state")
            reader.variables[name] = OrBuilder(is_true, value, step.statement)
            self._wait(step)
            return
        found = reader.read(value)
        reader.variables[name] = found
        self._emit(step, f"{name} = {found.text}", found.labels)

    def _wait(self, step: DescriptionStatement) -> None:
        """Keep the comments of a removed statement for the next one."""
        behind = [step.behind] if step.behind else []
        self._waiting += [*step.above, *inner_comments(step.node), *behind]

    def _emit(self, step: DescriptionStatement, line: str, labels: Sequence[str] = ()) -> None:
        said = f"# {'; '.join(labels)}" if labels else ""
        above = [*self._waiting, *step.above, *inner_comments(step.node)]
        self._waiting = []
        fits = len(self._outer + self._step) + len(line) + 2 + len(said) <= LENGTH
        if said and (step.behind or not fits):
            above, said = [*above, said], ""
        self._body += above
        self._body.append("  ".join(filter(None, [line, step.behind or said])))

    def _written(self, doc: Text | None, above_doc: list[str]) -> list[str]:
        body = []
        docs = [(each.name, each.doc) for _, each in self._parameters if each.doc]
        if doc is not None or docs:
            code = self._code(doc) if doc is not None else ""
            text = with_arguments(doc, code, docs, (self._outer + self._step, self._step))
            body += [*above_doc, text]
        below = texts(getattr(self._function.body, "footer", ()))
        rest = _single_blanks([*self._body, *self._waiting, *below])
        if not any(line and not line.startswith("#") for line in [*body, *rest]):
            rest = [*rest, "pass"]
        inside = [self._step + line if line else "" for line in [*body, *rest]]
        return [*self._signature(), *inside]

    def _signature(self) -> list[str]:
        """The signature, in one line if it fits and has no comments."""
        parameters = [each for _, each in self._parameters]
        star = ["*"] if _needs_star(parameters) else []
        one = f"def description({', '.join(['self', *star, *map(str, parameters)])}):"
        comments = any(
            any(step.above) or step.behind or inner_comments(step.node)
            for step, _ in self._parameters
        )
        block = self._function.body
        header = inner_comments(block.header) if isinstance(block, cst.IndentedBlock) else []
        if not comments and len(self._outer) + len(one) <= LENGTH:
            return ["  ".join([one, *header])]
        lines = [f"{each}," for each in ("self", *star)]
        for step, parameter in self._parameters:
            lines += [line for line in [*step.above, *inner_comments(step.node)] if line]
            lines.append("  ".join(filter(None, [f"{parameter},", step.behind])))
        indented = [self._step + line for line in lines]
        return ["def description(", *indented, "  ".join(["):", *header])]


def _needs_star(parameters: Sequence[SourceParameter]) -> bool:
    """Say whether parameters need a `*`, because a parameter without a default follows one with a
    default.
    """
    seen = False
    for each in parameters:
        if seen and each.default is None:
            return True
        seen = seen or each.default is not None
    return False


def _single_blanks(lines: Sequence[str]) -> list[str]:
    """The lines without blank lines at both ends, and without repeated blank lines."""
    found: list[str] = []
    for line in lines:
        if line or (found and found[-1]):
            found.append(line)
    while found and not found[-1]:
        found.pop()
    return found


def _unused(name: str, builder: OrBuilder) -> LeftError:
    template = errors.UnusableOr(found=f"is not added to a condition, as `{name}`")
    return LeftError(template, builder.node)


def _unknown(node: cst.CSTNode, code: Callable[[cst.CSTNode], str]) -> LeftError:
    bare = node.with_changes(leading_lines=()) if hasattr(node, "leading_lines") else node
    first = code(bare).strip().partition("\n")[0]
    shown = first if len(first) <= 50 else f"{first[:47]}..."
    return LeftError(errors.UnknownStatement(found=f"`{shown}`"), node)
