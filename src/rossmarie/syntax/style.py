"""The layout data of a module that the formatter cannot compute from tokens alone.

The data determine which tokens form one word (a unit, a topic), which tokens touch, and where a
line may be broken, all as offsets into the text.
"""

from __future__ import annotations

import sys
from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from rossmarie.syntax import ast
from rossmarie.syntax.layout import Break
from rossmarie.syntax.scan import ScannedFile
from rossmarie.syntax.walk import expressions, walk

_PART = Break(1, 1)
_OPERATOR = Break(2, 2)
_ACTION = Break(2, 2)
_VALUE = Break(2, 2, fills=True)
_REST = Break(1, 2, fills=True)
_JUNCTION = Break(sys.maxsize - 2, None)
_OPERAND = Break(sys.maxsize - 1, None, fills=True)
_LISTED = Break(sys.maxsize, None, fills=True)
"""Before an `and` or `or` of an argument, before another operator, and after a comma: if all other
breaks are not enough.
"""


@dataclass
class Style:
    """Layout data, which `add` collects item by item."""

    source: ScannedFile
    words: dict[int, int] = field(default_factory=dict)
    """Start and end of the units, topics and types."""
    tight_behind: set[int] = field(default_factory=set)
    """Ends of tokens without a space after them: a sign, the name of a function."""
    spaced: set[int] = field(default_factory=set)
    """Starts of dots with a space before them."""
    tight: set[int] = field(default_factory=set)
    """Starts of colons without a space before them."""
    breaks: dict[int, Break] = field(default_factory=dict)
    """The starts of tokens before which a line may be broken."""

    def __post_init__(self) -> None:
        tokens = self.source.tokens
        self._starts = [token.start for token in tokens]
        after_commas = (after.start for each, after in pairwise(tokens) if each.text == ",")
        self.breaks.update(dict.fromkeys(after_commas, _LISTED))

    def index(self, offset: int) -> int:
        """The index of the first token that does not begin before an offset."""
        return bisect_left(self._starts, offset)

    def add(self, item: ast.Item) -> None:
        """Process one item."""
        self._item(item)
        for root in expressions(item):
            self._expression(root)

    def _item(self, item: ast.Item) -> None:
        match item:
            case ast.Input():
                self._input(item)
            case ast.System() | ast.Action() | ast.Test():
                self._inside(item)
            case ast.Entity(conditions=conditions) | ast.Motion(parts=conditions):
                for condition in conditions:
                    self._operators(condition.expression)
            case ast.Zone():
                self._zone(item)
            case ast.Rule():
                self._rule(item)
            case ast.Import() | ast.Parameter():
                self._parameters(item)
            case ast.Priority(rules=rules):
                self.breaks.update((self._start(each.span.end), _LISTED) for each in rules[:-1])
            case ast.Skills() | ast.Constant() | ast.Hazard():
                pass

    def _inside(self, item: ast.System | ast.Action | ast.Test) -> None:
        """The parts of an item with braces, one by one."""
        match item:
            case ast.System(members=members):
                for member in members:
                    self._member(member)
            case ast.Action(effects=effects):
                self._effects(effects)
            case ast.Test(statements=statements):
                for statement in statements:
                    self._statement(statement)

    def _word(self, *words: ast.Name | ast.Unit | None) -> None:
        self.words.update((word.span.start, word.span.end) for word in words if word is not None)

    def _parameters(self, item: ast.Import | ast.Parameter) -> None:
        """Break an import before `with`, each value and `as`."""
        if isinstance(item, ast.Parameter):
            self._word(item.unit, item.default if isinstance(item.default, ast.Name) else None)
            return
        self._word(*(each.value for each in item.given if isinstance(each.value, ast.Name)))
        for each in item.given[1:]:
            self.breaks[each.span.start] = _VALUE
        for name in (*item.given[:1], *(() if item.alias is None else (item.alias,))):
            word = self.source.tokens[self.index(name.span.start) - 1]
            self.breaks[word.start] = _PART

    def _input(self, item: ast.Input) -> None:
        self._word(item.topic, item.message_type, item.unit)
        if item.message_type is not None and item.path:
            self.spaced.add(self._start(item.message_type.span.end))
        if item.names is not None:
            self.breaks[item.names.span.start] = _PART
            self.breaks.update((text.span.start, _OPERATOR) for text in item.names.texts[1:])
        if item.timeout is not None:
            timeout = self.source.tokens[self.index(item.timeout.span.start) - 1]
            self.breaks[timeout.start] = _PART

    def _zone(self, zone: ast.Zone) -> None:
        """Break polygons before their corners."""
        corners = (each for shape in zone.shapes for each in shape.brackets[1:])
        self.breaks.update((each.span.start, _PART) for each in corners)

    def _member(self, member: ast.SystemMember) -> None:
        match member:
            case ast.TopicDeclaration(topic=topic, message_type=message_type, unit=unit):
                self._word(topic, message_type, unit)
                self._continued(topic.span.end, member.source, member.rate)
            case ast.UnitDeclaration(message_type=message_type, unit=unit):
                self._word(message_type, unit)
            case (
                ast.ServiceDeclaration(name=name, service_type=kind)
                | ast.ServerDeclaration(name=name, action_type=kind)
            ):
                self._word(name, kind)
                self._continued(name.span.end)
            case ast.ResourceDeclaration(targets=targets):
                self._word(*targets)
            case ast.NodeDeclaration():
                self._word(*member.publishes, *member.subscribes)
                self._node(member)
            case ast.FrameDeclaration(parent=parent):
                self._continued(parent.span.end, member.turned, member.timeout)
            case ast.MessagesDeclaration():
                pass

    def _continued(self, end: int, *parts: ast.Name | ast.Expression | None) -> None:
        """Break a declaration at an offset, and before the word before each part."""
        self.breaks[self._start(end)] = _REST
        for part in parts:
            if part is not None:
                word = self.index(part.span.start) - 1
                self.breaks[self.source.tokens[word].start] = _REST

    def _effects(self, effects: Sequence[ast.Effect]) -> None:
        for effect in effects:
            self._effect(effect)

    def _effect(self, effect: ast.Effect) -> None:
        match effect:
            case ast.Limit(target=target, bounds=bounds):
                self._word(target.name, target.type)
                self._fields(bounds)
            case ast.Scale(target=target) | ast.Block(target=target):
                self._word(target.name, target.type)
            case ast.Publish() | ast.Retrace() | ast.CallService() | ast.SendGoal():
                self._word(effect.target.name, effect.target.type)
                self._fields(effect.assignments)
            case ast.SetParameter(node=name, unit=unit):
                self._word(name, unit)
            case ast.SwitchControllers(manager=name) | ast.CancelGoal(server=name):
                self._word(name)
            case ast.RunTree():
                self._tree(effect)
            case ast.Log() | ast.Diagnose() | ast.Hook() | ast.Reset():
                pass

    def _tree(self, tree: ast.RunTree) -> None:
        """Break before each argument of a tree."""
        if not tree.arguments:
            return
        self.tight_behind.add(tree.skill.span.end)
        for each in tree.arguments:
            self.tight.add(self._start(each.parameter.span.end))
            self.breaks[each.span.start] = _PART
        self.breaks[self._start(tree.arguments[-1].span.end)] = Break(1, 0)

    def _fields(self, inner: Sequence[ast.FieldBound | ast.FieldAssignment]) -> None:
        """Break before each line in the braces of an effect."""
        for part in inner:
            self.breaks[part.span.start] = _PART
            self._index_sticks(part.path)
        if inner:
            semicolon = self.index(inner[-1].span.end)
            self.breaks[self.source.tokens[semicolon + 1].start] = Break(1, 0)

    def _statement(self, statement: ast.Statement) -> None:
        """Allow a break before each setting of a message."""
        if isinstance(statement, ast.CommandExpectation):
            self._word(statement.topic)
            self._index_sticks(statement.path)
        settings = statement.settings if isinstance(statement, ast.Arrival) else ()
        for setting in settings:
            self.breaks[setting.span.start] = _PART
            if isinstance(setting, ast.Setting):
                self._index_sticks(setting.path)

    def _index_sticks(self, path: ast.FieldPath | ast.SettingPath) -> None:
        self.tight_behind.update(
            before.span.end
            for before, step in zip(path.steps, path.steps[1:], strict=False)
            if isinstance(step, ast.Position | ast.Arc)
        )

    def _node(self, node: ast.NodeDeclaration) -> None:
        tokens = self.source.tokens
        last = self.index(node.span.end) - 1
        for index in range(self.index(node.name.span.end) + 1, last):
            if tokens[index - 1].text in ("{", ";"):
                self.breaks[tokens[index].start] = _PART
        self.breaks[tokens[last].start] = Break(1, 0)

    def _rule(self, rule: ast.Rule) -> None:
        if rule.name is not None:
            self.tight.add(self._start(rule.name.span.end))
        self._operators(rule.condition)
        self.breaks[self._start(rule.condition.span.end)] = _PART
        if rule.scope:
            self.breaks[self._start(rule.scope[-1].span.end)] = _PART
        if rule.unless:
            self.breaks[self._start(rule.unless[-1].span.end)] = _PART
        self._steps(rule.steps)
        for exemption in rule.exemptions:
            self._exemption(exemption)
        if rule.keeps is not None:
            self.breaks[rule.keeps.span.start] = _PART
        for name in (rule.category, rule.task):
            if name is not None:
                word = self.index(name.span.start) - 1
                self.breaks[self.source.tokens[word].start] = _PART
        if rule.feedback:
            word = self.index(rule.feedback[0].span.start) - 1
            self.breaks[self.source.tokens[word].start] = _PART
        if rule.mitigates:
            word = self.index(rule.mitigates[0].span.start) - 1
            self.breaks[self.source.tokens[word].start] = _PART
        for contract in rule.contracts:
            self.breaks[contract.span.start] = _PART
            if isinstance(contract, ast.ClearWhen):
                self._operators(contract.condition)

    def _exemption(self, exemption: ast.Exemption) -> None:
        self.breaks[exemption.span.start] = _PART
        if exemption.condition is not None:
            self._operators(exemption.condition)
            self.breaks[self._start(exemption.condition.span.end)] = _ACTION
        self._steps(exemption.steps or ())

    def _steps(self, steps: Sequence[ast.Step]) -> None:
        """Break before each action, and before the brace after the last action."""
        for step in steps:
            self.breaks[step.span.start] = _ACTION
        if steps:
            semicolon = self.index(steps[-1].span.end)
            self.breaks[self.source.tokens[semicolon + 1].start] = Break(2, 1)

    def _operators(self, root: ast.Expression) -> None:
        """Break before the outermost `and`s and `or`s, also inside `(...) for 2 sec`, before `and`s
        and `or`s between conditions on the elements of a list, and before the answer of an `after`;
        then before the `and`s and `or`s in parentheses, from the outermost to the innermost.
        """
        pending = [(_peeled(root), _OPERATOR.level)]
        while pending:
            node, level = pending.pop()
            if isinstance(node, ast.Binary) and node.operator in ast.JUNCTIONS:
                self.breaks[self._start(node.left.span.end)] = Break(level, level)
                for side in (node.left, node.right):
                    inner = _peeled(side)
                    pending.append((inner, level + (inner is not side)))
            elif isinstance(node, ast.Response):
                self.breaks[node.answer.span.start] = _OPERATOR
            elif isinstance(node, ast.ListFold):
                pending.append((_peeled(node.body), level))

    def _expression(self, root: ast.Expression) -> None:
        for node in walk(root):
            self._operand(node)
            match node:
                case ast.Number(unit=unit, span=span):
                    self._word(unit)
                    self._sign(span.start)
                case ast.Bracket(unit=unit):
                    self._word(unit)
                case ast.Unary(operator=ast.UnaryOperator.NEGATE, span=span):
                    self._sign(span.start)
                case ast.Call(function=function):
                    self.tight_behind.add(function.span.end)
                case ast.ListFold(function=function, list=its_list):
                    self.tight_behind.add(function.span.end)
                    self.tight.add(self._start(its_list.span.end))
                case ast.Oscillates(value=value, span=span):
                    is_method = value.span.start == span.start
                    dot = self.index(value.span.end)
                    start = self.source.tokens[dot + 1].start if is_method else span.start
                    self.tight_behind.add(start + len("oscillates"))
                case ast.Doing():
                    self._doing(node)
                case ast.Index(value=value) | ast.Sector(value=value):
                    self.tight_behind.add(value.span.end)
                case (
                    ast.Boolean() | ast.Text() | ast.Reference() | ast.Member() | ast.Edges()
                    | ast.Unary() | ast.Binary() | ast.Membership() | ast.Held() | ast.Since()
                    | ast.Once() | ast.Response() | ast.Parenthesized() | ast.Broken()
                ):  # fmt: skip
                    pass

    def _operand(self, node: ast.Expression) -> None:
        """Allow a break before an operator."""
        if isinstance(node, ast.Binary):
            found = _JUNCTION if node.operator in ast.JUNCTIONS else _OPERAND
            self.breaks.setdefault(self._start(node.left.span.end), found)
        elif isinstance(node, ast.Membership):
            self.breaks.setdefault(self._start(node.value.span.end), _OPERAND)
        elif isinstance(node, ast.Held):
            self.breaks.setdefault(self._start(node.condition.span.end), _OPERAND)

    def _doing(self, node: ast.Doing) -> None:
        if node.arguments:
            self.tight_behind.add(node.skill.span.end)
        for each in node.arguments:
            self._word(each.kind)
            self.tight.add(self._start(each.parameter.span.end))

    def _sign(self, start: int) -> None:
        if self.source.file.text[start] == "-":
            self.tight_behind.add(start + 1)

    def _start(self, offset: int) -> int:
        """The start of the first token at or after an offset."""
        return self.source.tokens[self.index(offset)].start


def _peeled(node: ast.Expression) -> ast.Expression:
    """The expression inside parentheses, `not` and `for`."""
    while True:
        match node:
            case ast.Parenthesized(inner=node) | ast.Held(condition=node) | ast.Unary(operand=node):
                continue
            case (
                ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
                | ast.Member() | ast.Index() | ast.Sector() | ast.Call() | ast.Edges()
                | ast.Oscillates() | ast.Binary() | ast.Membership() | ast.Since() | ast.Once()
                | ast.Response() | ast.Doing() | ast.ListFold() | ast.Broken()
            ):  # fmt: skip
                return node


def collect_style(source: ScannedFile, items: Iterable[ast.Item]) -> Style:
    """The style of a whole module."""
    style = Style(source)
    for item in items:
        style.add(item)
    return style
