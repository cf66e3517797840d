"""All declarations of all modules. Names that are declared twice are reported.

The first declaration of a name counts; later declarations are still checked.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from dslkit.diagnostics import Collector
from rossmarie.check.scopes.errors import DuplicateName, RepeatedAction, SeveralContracts
from rossmarie.check.scopes.exemptions import with_exemptions
from rossmarie.syntax import ast
from rossmarie.syntax.walk import expressions

Named = ast.Action | ast.Constant | ast.Input | ast.Entity | ast.Motion | ast.Zone

KINDS: Mapping[type[object], str] = {
    ast.Action: "action",
    ast.Constant: "constant",
    ast.Input: "input",
    ast.Entity: "entity",
    ast.Motion: "motion",
    ast.Zone: "zone",
}
ARTICLES: Mapping[str, str] = {
    "action": "an action",
    "constant": "a constant",
    "parameter": "a parameter",
    "input": "an input",
    "entity": "an entity",
    "motion": "a motion",
    "zone": "a zone",
}


def kind_of(item: Named) -> str:
    """The kind of an item: `constant` for a constant."""
    constant = item.setting if isinstance(item, ast.Input) else item
    is_parameter = isinstance(constant, ast.Constant) and constant.parameter is not None
    return "parameter" if is_parameter else KINDS[type(item)]


@dataclass(frozen=True)
class ProgramDeclarations:
    """The declarations. `names` is the single name space of constants, inputs, entities, motions,
    zones and actions. `conditions` contains the conditions of each entity. `items` contains every
    item, including repeated declarations. `rules` are all rules, imported files first, each before
    the rules made from its exemptions. `is_whole` is False if a file could not be read, so that
    undeclared names may be declared there.
    """

    items: tuple[ast.Item, ...]
    main: ast.Module
    names: Mapping[str, Named]
    conditions: Mapping[str, Mapping[str, ast.Condition]]
    is_whole: bool
    rules: tuple[ast.Rule, ...]

    @property
    def entities(self) -> tuple[ast.Entity, ...]:
        """All entities."""
        return tuple(item for item in self.items if isinstance(item, ast.Entity))

    @property
    def constants(self) -> tuple[ast.Constant, ...]:
        """All constants."""
        return tuple(item for item in self.items if isinstance(item, ast.Constant))

    @property
    def inputs(self) -> tuple[ast.Input, ...]:
        """All inputs."""
        return tuple(item for item in self.items if isinstance(item, ast.Input))

    @property
    def systems(self) -> tuple[ast.System, ...]:
        """All system models."""
        return tuple(item for item in self.items if isinstance(item, ast.System))

    def expressions(self) -> Iterator[ast.Expression]:
        """The outermost expressions of all items."""
        for item in self.items:
            yield from expressions(item)


def collect(modules: Sequence[ast.Module], collector: Collector) -> ProgramDeclarations:
    """Collect the declarations of `modules`, main module last."""
    items = tuple(item for module in modules for item in module.items)
    names: dict[str, Named] = {}
    conditions: dict[str, Mapping[str, ast.Condition]] = {}
    for item in items:
        if not isinstance(item, Named):
            continue
        first = names.setdefault(item.name.text, item)
        if first is not item:
            _report_second(item, first, collector)
        elif isinstance(item, ast.Entity):
            conditions[item.name.text] = _conditions(item, collector)
    is_whole = all(module.is_whole for module in modules)
    rules = with_exemptions([item for item in items if isinstance(item, ast.Rule)])
    declarations = ProgramDeclarations(items, modules[-1], names, conditions, is_whole, rules)
    _check_hidden_names(declarations, collector)
    _check_structure(declarations, collector)
    return declarations


def _report_second(item: Named, first: Named, collector: Collector) -> None:
    finding = DuplicateName(
        identifier=item.name.text,
        kind=kind_of(item),
        other=ARTICLES[kind_of(first)],
        reason="constants, inputs, entities, motions, zones and actions share one set of names",
    )
    collector.add(finding.at(item.name.span, finding.First().at(first.name.span)))


def report_second(
    name: ast.Name | ast.Text, first: ast.Name | ast.Text, kind: str, reason: str,
    collector: Collector
) -> None:  # fmt: skip
    """Report the second declaration of a kind and name."""
    text = name.text if isinstance(name, ast.Name) else name.value
    article = "an" if kind[0] in "aeiou" else "a"
    finding = DuplicateName(identifier=text, kind=kind, other=f"{article} {kind}", reason=reason)
    collector.add(finding.at(name.span, finding.First().at(first.span)))


def _conditions(entity: ast.Entity, collector: Collector) -> dict[str, ast.Condition]:
    found: dict[str, ast.Condition] = {}
    for condition in entity.conditions:
        first = found.setdefault(condition.name.text, condition)
        if first is not condition:
            reason = "each condition of an entity needs its own name"
            report_second(condition.name, first.name, "condition", reason, collector)
    return found


def _check_hidden_names(declarations: ProgramDeclarations, collector: Collector) -> None:
    """Report conditions with the name of a value: inside its entity, such a condition would hide
    the value.
    """
    for entity in declarations.entities:
        for condition in entity.conditions:
            value = declarations.names.get(condition.name.text)
            if isinstance(value, ast.Constant | ast.Input):
                finding = DuplicateName(
                    identifier=condition.name.text,
                    kind="condition",
                    other=ARTICLES[kind_of(value)],
                    reason=f"inside `{entity.name.text}` the bare name could refer to either",
                )
                place = finding.First().at(value.name.span)
                collector.add(finding.at(condition.name.span, place))


def _check_structure(declarations: ProgramDeclarations, collector: Collector) -> None:
    rule_names: dict[str, ast.Name] = {}
    for rule in declarations.rules:
        _check_rule(rule, rule_names, collector)


def _check_rule(rule: ast.Rule, names: dict[str, ast.Name], collector: Collector) -> None:
    if rule.name is not None:
        first = names.setdefault(rule.name.text, rule.name)
        if first is not rule.name:
            reason = "a verdict names its rule; two rules of one name could not be distinguished"
            report_second(rule.name, first, "rule", reason, collector)
    for contract in rule.contracts[1:]:
        place = SeveralContracts.First().at(rule.contracts[0].span)
        collector.add(SeveralContracts().at(contract.span, place))
    for name, first in _repeated(rule.actions):
        repeated = RepeatedAction(identifier=name.text)
        collector.add(repeated.at(name.span, repeated.First().at(first.span)))


def _repeated(names: Sequence[ast.Name]) -> Iterator[tuple[ast.Name, ast.Name]]:
    seen: dict[str, ast.Name] = {}
    for name in names:
        first = seen.setdefault(name.text, name)
        if first is not name:
            yield name, first
