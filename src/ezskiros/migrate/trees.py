"""The method `expand` in, the method `expandBT` out: the same tree, with skills by their names."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import libcst as cst
import libcst.matchers as m

from ezskiros.migrate import errors, processors
from ezskiros.migrate.calls import Arguments, last_name, literal_text, method
from ezskiros.migrate.comments import inner_comments
from ezskiros.migrate.description import LENGTH
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.imports import used_names
from ezskiros.migrate.names import is_name
from ezskiros.migrate.parameter_uses import ParameterUses, parameter_key
from ezskiros.migrate.skills import Skill, Skills

OLD, NEW = "expand", "expandBT"
_MAKERS = {"skill", "getSkill", "getNode"}


@dataclass(frozen=True)
class Place:
    """Where something stands in its file: the column, and the space that its line begins with."""

    column: int
    indent: str


@dataclass
class Wanted:
    """The skills that a file names, by how it calls them.

    `spell` finds out how a skill is called in the file.
    """

    spell: Callable[[Skill], str]
    found: dict[str, Skill] = field(default_factory=dict)

    def name(self, skill: Skill) -> str:
        """How a skill is called, which is needed from now on."""
        name = self.spell(skill)
        self.found[name] = skill
        return name


@dataclass(frozen=True)
class Context:
    """What is known where a tree is translated.

    `path` is the file, `skills` all that are described, `helpers` the methods of the class, `place`
    says where a node is, `step` is the space by which the file indents. `late` gives the import
    of a skill that cannot be imported before, None for others.
    """

    path: str
    skills: Skills
    wanted: Wanted
    helpers: Mapping[str, cst.FunctionDef]
    place: Callable[[cst.CSTNode], Place]
    step: str
    late: Callable[[str, Skill], str | None]


class TreeUses(ParameterUses):
    """Translates the method `expand` of an implementation of `skill`.

    `used` are the methods of the class that became part of the tree.
    """

    def __init__(self, skill: Skill, code: Callable[[cst.CSTNode], str], context: Context) -> None:
        super().__init__(skill, code)
        self._context = context
        self._argument, self._new_argument = "", "params"
        self._chosen: dict[int, cst.BaseExpression] = {}
        self._dropped: set[int] = set()
        self._gone: set[int] = set()
        self._done: set[int] = set()
        self._things: set[str] = set()
        self._where: Place | None = None
        self._filled: list[cst.CSTNode] = []  # what is remembered by its identity has to live on
        self._imports: dict[str, None] = {}
        self.used: set[str] = set()

    def params(self) -> cst.BaseExpression:
        """The argument of `expandBT`."""
        return cst.Name(self._new_argument)

    def of_skiros2(self, node: cst.Attribute) -> None:
        """A tree is known before the robot runs."""
        self.leave(errors.NoTree(found=self.shown()), node)

    # --- the method ---------------------------------------------------------------------------

    def visit_FunctionDef(self, node: cst.FunctionDef) -> bool | None:  # noqa: D102, N802
        if node.name.value != OLD or self._argument:
            return None
        plain = node.params.params
        if len(plain) != 2 or node.decorators or not isinstance(node.body, cst.IndentedBlock):
            self.leave(errors.NoTree(found=f"`def {node.name.value}`"), node.name)
            return False
        self._argument = plain[1].name.value
        while self._new_argument in used_names(node) - {self._argument}:
            self._new_argument += "_"
        self._done.add(id(plain[1].name))
        self._plan(node.body.body, _Flow(processors.DEFAULT))
        return None

    def leave_FunctionDef(  # noqa: D102, N802
        self, original_node: cst.FunctionDef, updated_node: cst.FunctionDef
    ) -> cst.FunctionDef:
        if original_node.name.value != OLD or self.findings:
            return updated_node
        first, *rest = updated_node.params.params
        rest = [each.with_changes(name=cst.Name(self._new_argument)) for each in rest]
        parameters = updated_node.params.with_changes(params=[first, *rest])
        imports = [cst.parse_statement(line) for line in self._imports]
        body = updated_node.body.with_changes(body=[*imports, *updated_node.body.body])
        return updated_node.with_changes(name=cst.Name(NEW), params=parameters, body=body)

    def _plan(self, statements: Sequence[cst.CSTNode], flow: _Flow) -> _Flow:
        """Which processor each call of `skill(...)` has, in some statements."""
        for statement in statements:
            match statement:
                case cst.SimpleStatementLine(body=[cst.Expr(value=cst.Call() as call)]):
                    self._plan_call(statement, call, flow)
                case cst.If():
                    flow = self._plan_branches(statement, flow)
        return flow

    def _plan_call(self, line: cst.CSTNode, call: cst.Call, flow: _Flow) -> None:
        for owner in (self._argument, "self"):
            if method(call, owner) == "setProcessor" and len(call.args) == 1:
                self._dropped.add(id(line))
                self._done |= {id(each) for each in m.findall(call, m.Name(self._argument))}
                if owner == "self":
                    flow.own = call
                else:
                    flow.chosen = call.args[0].value
        if isinstance(call.func, cst.Name) and call.func.value == self._argument:
            self._plan_tree(call, flow)

    def _plan_tree(self, call: cst.Call, flow: _Flow) -> None:
        self._done.add(id(call.func))
        self._chosen[id(call)] = flow.chosen
        self._statements.append(call)
        if flow.is_built:
            self.leave(errors.SeveralTrees(), call)
        is_chosen = flow.chosen is not processors.DEFAULT
        if flow.own and not is_chosen and not _is_same(flow.own.args[0].value, flow.chosen):
            found = last_name(getattr(flow.own.args[0].value, "func", flow.own)) or "it"
            self.leave(errors.OwnProcessor(found=found), flow.own)
        self._statements.pop()
        flow.is_built = True

    def _plan_branches(self, statement: cst.If, flow: _Flow) -> _Flow:
        ends: list[_Flow] = []
        branch: cst.If | cst.Else | None = statement
        while branch is not None:
            found = self._plan(branch.body.body, flow.copy())
            if not _leaves(branch.body.body):
                ends.append(found)
            if isinstance(branch, cst.Else):
                return _joined(ends, flow)
            branch = branch.orelse
        return _joined([*ends, flow], flow)

    # --- statements ---------------------------------------------------------------------------

    def leave_SimpleStatementLine(  # noqa: D102, N802
        self, original_node: cst.SimpleStatementLine, updated_node: cst.SimpleStatementLine
    ) -> cst.BaseStatement | cst.FlattenSentinel[cst.BaseStatement]:
        if id(original_node) in self._dropped:
            self._gone.add(id(updated_node))
            return updated_node
        return super().leave_SimpleStatementLine(original_node, updated_node)

    def leave_IndentedBlock(  # noqa: N802
        self,
        original_node: cst.IndentedBlock,  # noqa: ARG002
        updated_node: cst.IndentedBlock,
    ) -> cst.IndentedBlock:
        """Without the statements that choose a processor; their comments are those of the next."""
        waiting: list[cst.EmptyLine] = []
        body: list[cst.BaseStatement] = []
        for new in updated_node.body:
            if id(new) in self._gone:
                waiting += _comments_of(new)
            else:
                lines = [*waiting, *new.leading_lines] if waiting else new.leading_lines  # type: ignore[attr-defined]
                body.append(new.with_changes(leading_lines=lines))
                waiting = []
        if not body:
            body = [cst.SimpleStatementLine([cst.Pass()])]
        return updated_node.with_changes(body=body, footer=[*waiting, *updated_node.footer])

    def visit_Assign(self, node: cst.Assign) -> None:  # noqa: D102, N802
        key = parameter_key(node.value)
        for each in node.targets:
            if parameter_key(each.target) is not None:
                self.leave(errors.NoTree(found=self.shown()), node)
            if key is not None and isinstance(each.target, cst.Name) and self._is_thing(key):
                self._things.add(each.target.value)

    def visit_Name(self, node: cst.Name) -> None:  # noqa: D102, N802
        if node.value == self._argument and id(node) not in self._done:
            self.leave(errors.NoTree(found=self.shown()), node)

    def visit_Arg(self, node: cst.Arg) -> None:  # noqa: D102, N802
        self._done.add(id(node.keyword))  # it is no variable

    def visit_Attribute(self, node: cst.Attribute) -> None:  # noqa: D102, N802
        super().visit_Attribute(node)
        self._done.add(id(node.attr))
        key = parameter_key(node.value)
        is_thing = isinstance(node.value, cst.Name) and node.value.value in self._things
        if is_thing or (key is not None and self._is_thing(key)):
            self.leave(errors.AskedThing(found=self.shown()), node)

    def _is_thing(self, key: cst.BaseExpression) -> bool:
        return self._skill.names.get(literal_text(key) or "") in self._skill.things

    # --- children -----------------------------------------------------------------------------

    def visit_Call(self, node: cst.Call) -> bool | None:  # noqa: D102, N802
        super().visit_Call(node)
        if _is_group(node):
            self._done.add(id(node.func))
        name = method(node)
        is_dropped = name == "setProcessor" and id(self._statements[-1]) in self._dropped
        if name is None or name in _MAKERS or is_dropped:
            return None
        helper = self._context.helpers.get(name)
        if helper is not None and _made(helper) is not None:
            return False  # it is what it returns
        if helper is None or _knows_robot(helper):
            self.leave(errors.NoTree(found=f"`self.{name}(...)`"), node)
        return None

    def leave_Call(  # noqa: D102, N802
        self, original_node: cst.Call, updated_node: cst.Call
    ) -> cst.BaseExpression:
        try:
            return self._call(original_node, updated_node)
        except LeftError as left:
            self.leave(left.template, left.node)
            return updated_node

    def _call(self, original: cst.Call, updated: cst.Call) -> cst.BaseExpression:
        """Raises `LeftError`."""
        if id(original) in self._chosen:
            return processors.wrapper(self._chosen[id(original)])(updated)
        if _is_group(original) and isinstance(original.func, cst.Call):
            return processors.wrapper(original.func.args[0].value)(updated)
        name = method(original)
        helper = self._context.helpers.get(name or "")
        if helper is not None and _made(helper) is not None:
            return self._inlined(original, helper)
        if name == "skill" and id(original) not in self._done:
            return self._child(original, updated)
        if name in _MAKERS and id(original) not in self._done:
            raise LeftError(errors.NoTree(found=self.shown()), original)
        return super().leave_Call(original, updated)

    def _inlined(self, call: cst.Call, helper: cst.FunctionDef) -> cst.BaseExpression:
        """What a method returns for some arguments, instead of its call. Raises `LeftError`."""
        made, given = _made(helper), _bound(helper, call)
        if made is None or given is None or inner_comments(helper):
            raise LeftError(errors.NoTree(found=f"`{self._code(call)}`"), call)
        self.used.add(helper.name.value)
        place, where = self._place, self._where
        self._place, self._where = place or call, where or self._context.place(call)
        filled = made.visit(_Filled(given))
        assert isinstance(filled, cst.BaseExpression)
        self._filled.append(filled)
        found = filled.visit(self)
        self._place, self._where = place, where
        assert isinstance(found, cst.BaseExpression)
        return found

    def _child(self, original: cst.Call, updated: cst.Call) -> cst.BaseExpression:
        """`Pick.pick_fast(Object=params.Object)`. Raises `LeftError`."""
        old, new = Arguments(original, "skill"), Arguments(updated, "skill")
        if literal_text(old["stype"]) is None:
            raise LeftError(errors.NoTree(found=self.shown()), original)
        if old.get("preconditions") is not None:
            raise LeftError(errors.NoTree(found="pre-conditions of a child"), original)
        child = self._skill_called(old.text("stype").rpartition(":")[2], old["stype"])
        label = old.text("slabel") if old.get("slabel") is not None else ""
        label = self._context.skills.labels.get(label, label)
        if label and (not is_name(label) or label.startswith("_")):
            raise LeftError(errors.NoName(found=label), old["slabel"])
        remaps = list(_entries(old, "remap"))
        given = [*self._remapped(child, remaps), *self._specified(child, old, new, remaps)]
        given += self._same_keys(child, {name for name, _ in given}, remaps)
        name = self._context.wanted.name(child)
        if line := self._context.late(name, child):
            self._imports[line] = None
        name += f".{label}" if label else ""
        place = self._inside(self._where or self._context.place(original))
        values = [value for _, value in _entries(new, "specify")]
        said = [each for value in values for each in inner_comments(value)]
        comments = [each for each in inner_comments(original) if each not in said]
        return _written(name, given, comments, place, self._context.step)

    def _inside(self, place: Place) -> Place:
        """A place with the space behind that which its statement begins with."""
        before = self._context.place(self._statements[-1]).indent
        return Place(place.column, place.indent.removeprefix(before))

    def _skill_called(self, name: str, node: cst.CSTNode) -> Skill:
        """Raises `LeftError` if there is none, if it is left, or if there are several."""
        found = self._context.skills.called(name, self._context.path)
        if len(found) != 1 or found[0].is_left:
            said = "described in several of these files"
            if not found:
                said = "described in none of these files"
            elif len(found) == 1:
                said = "left as it is"
            raise LeftError(errors.UnusableChild(skill=name, found=said), node)
        return found[0]

    def _remapped(
        self, child: Skill, remaps: Sequence[tuple[cst.BaseExpression, cst.BaseExpression]]
    ) -> Iterator[tuple[str, str]]:
        """The arguments that a dictionary of remaps stands for. Raises `LeftError`."""
        for key, target in remaps:
            text = _text(target, "remap")
            own_name = self._skill.names.get(text)
            if own_name is None and text != _text(key, "remap"):
                shared = errors.SharedName(skill=self._skill.name, key=text, child=child.name)
                raise LeftError(shared, target)
            if own_name is not None:
                yield _name_of(child, key), f"{self._new_argument}.{own_name}"

    def _specified(
        self,
        child: Skill,
        old: Arguments,
        new: Arguments,
        remaps: Sequence[tuple[cst.BaseExpression, cst.BaseExpression]],
    ) -> Iterator[tuple[str, str]]:
        """The arguments that a dictionary of values stands for. Raises `LeftError`."""
        renamed = {literal_text(each) for pair in remaps for each in pair}
        for (key, _), (_, value) in zip(
            _entries(old, "specify"), _entries(new, "specify"), strict=True
        ):
            if _text(key, "specify") in renamed:
                raise LeftError(errors.TwiceGiven(key=_text(key, "specify")), key)
            yield _name_of(child, key), self._code(value)

    def _same_keys(
        self,
        child: Skill,
        given: set[str],
        remaps: Sequence[tuple[cst.BaseExpression, cst.BaseExpression]],
    ) -> Iterator[tuple[str, str]]:
        """What is shared because the keys are the same, where the names for them are not."""
        renamed = {literal_text(key) for key, _ in remaps}
        for key, name in child.names.items():
            own_name = self._skill.names.get(key)
            if own_name not in (None, name) and name not in given and key not in renamed:
                yield name, f"{self._new_argument}.{own_name}"


@dataclass
class _Flow:
    """What is known at one place of a method: the processor, and whether there is a tree."""

    chosen: cst.BaseExpression
    own: cst.Call | None = None
    is_built: bool = False

    def copy(self) -> _Flow:
        """The same, for one branch."""
        return _Flow(self.chosen, self.own, self.is_built)


def _joined(ends: Sequence[_Flow], before: _Flow) -> _Flow:
    """After some branches. Where they choose different processors none is known."""
    if not ends:
        return before
    first = ends[0]
    is_same = all(_is_same(each.chosen, first.chosen) for each in ends)
    chosen = first.chosen if is_same else cst.Name("None")
    return _Flow(chosen, first.own, any(each.is_built for each in ends))


def _is_same(one: cst.BaseExpression, other: cst.BaseExpression) -> bool:
    """Whether two processors are the same; one has two names."""
    names = [last_name(each.func) if isinstance(each, cst.Call) else None for each in (one, other)]
    methods = [processors.METHODS.get(name or "") for name in names]
    return methods[0] == methods[1] is not None or one.deep_equals(other)


def _leaves(statements: Sequence[cst.CSTNode]) -> bool:
    """Whether what comes after some statements is never reached."""
    match statements[-1] if statements else None:
        case cst.SimpleStatementLine(body=[*_, cst.Return() | cst.Raise()]):
            return True
    return False


def _is_group(call: cst.Call) -> bool:
    """Whether it is `self.skill(Serial())(...)`."""
    inner = call.func
    if not isinstance(inner, cst.Call) or method(inner) != "skill" or len(inner.args) != 1:
        return False
    return literal_text(inner.args[0].value) is None


def _comments_of(line: cst.CSTNode) -> list[cst.EmptyLine]:
    """The comments of a statement that goes."""
    assert isinstance(line, cst.SimpleStatementLine)
    behind = line.trailing_whitespace.comment
    lines = [each for each in line.leading_lines if each.comment]
    return [*lines, *([cst.EmptyLine(comment=behind)] if behind else [])]


def _entries(given: Arguments, key: str) -> Iterator[tuple[cst.BaseExpression, cst.BaseExpression]]:
    """What is in a dictionary; an empty text is one without anything. Raises `LeftError`."""
    value = given.get(key)
    if value is None or literal_text(value) == "":
        return
    if not isinstance(value, cst.Dict):
        computed = errors.ComputedArgument(argument=key, call="skill", wanted="the dictionary")
        raise LeftError(computed, value)
    for each in value.elements:
        if not isinstance(each, cst.DictElement):
            computed = errors.ComputedArgument(argument=key, call="skill", wanted="its keys")
            raise LeftError(computed, each.value)
        yield each.key, each.value


def _text(node: cst.BaseExpression, argument: str) -> str:
    """A key that is written out. Raises `LeftError`."""
    found = literal_text(node)
    if found is None:
        computed = errors.ComputedArgument(argument=argument, call="skill", wanted="the texts")
        raise LeftError(computed, node)
    return found


def _name_of(child: Skill, key: cst.BaseExpression) -> str:
    """The name of a parameter of a child; what it does not have, a check finds, if it is a name.

    Raises `LeftError`.
    """
    text = _text(key, "remap")
    if text not in child.names and not is_name(text):
        raise LeftError(errors.UnknownKey(skill=child.name, key=text), key)
    return child.names.get(text, text)


def _made(helper: cst.FunctionDef) -> cst.BaseExpression | None:
    """The child that a method returns, if that is all it does."""
    match helper.body:
        case cst.IndentedBlock(
            body=[*_, cst.SimpleStatementLine(body=[cst.Return(value=cst.Call() as made)])] as body
        ) if len(body) == 1:
            names = {method(each) for each in m.findall(made, m.Call())}  # type: ignore[arg-type]
            return made if names & _MAKERS else None
    return None


def _knows_robot(helper: cst.FunctionDef) -> bool:
    """Whether a method uses what only a skill that runs has."""
    own_names = m.findall(helper, m.Attribute(value=m.Name("self")))
    return bool(own_names)


def _bound(helper: cst.FunctionDef, call: cst.Call) -> dict[str, cst.BaseExpression] | None:
    """The arguments of a call by the names of the parameters; None if they do not fit."""
    parameters = helper.params.params[1:]
    names = [each.name.value for each in parameters]
    given = {each.name.value: each.default for each in parameters if each.default is not None}
    for position, argument in enumerate(call.args):
        keyword = argument.keyword.value if argument.keyword else None
        name = keyword or (names[position] if position < len(names) else "")
        if argument.star or name not in names:
            return None
        given[name] = argument.value
    return given if {*given} == {*names} and not helper.decorators else None


class _Filled(cst.CSTTransformer):
    """Puts arguments in the places of the parameters of a method."""

    def __init__(self, given: Mapping[str, cst.BaseExpression]) -> None:
        self._given = given

    def leave_Attribute(  # noqa: N802
        self, original_node: cst.Attribute, updated_node: cst.Attribute
    ) -> cst.BaseExpression:
        return updated_node.with_changes(attr=original_node.attr)

    def leave_Arg(self, original_node: cst.Arg, updated_node: cst.Arg) -> cst.Arg:  # noqa: N802
        return updated_node.with_changes(keyword=original_node.keyword)

    def leave_Name(  # noqa: N802
        self, original_node: cst.Name, updated_node: cst.Name
    ) -> cst.BaseExpression:
        found = self._given.get(original_node.value)
        return found.deep_clone() if found is not None else updated_node


def _written(
    name: str,
    given: Sequence[tuple[str, str]],
    comments: Sequence[str],
    place: Place,
    step: str,
) -> cst.BaseExpression:
    """The call of a skill, in one line if it fits."""
    arguments = [f"{key}={value}" for key, value in given]
    one = f"{name}({', '.join(arguments)})"
    if comments or (arguments and place.column + len(one) >= LENGTH):
        inside = [
            f"{place.indent}{step}{each}" for each in (*comments, *(f"{a}," for a in arguments))
        ]
        one = "\n".join([f"{name}(", *inside, f"{place.indent})"])
    return cst.parse_expression(one)
