"""The results of each stage of the compiler, as readable text or as JSON."""

from __future__ import annotations

import dataclasses
import enum
import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from dslkit.source import SourceFile, Span
from rossmarie.check import CheckedProgram
from rossmarie.driver.build import generate, own_code
from rossmarie.driver.pipeline import RulesError, check_file, compile_checked
from rossmarie.ir import dump_text, machine_to_json


class CompilerStage(str, enum.Enum):
    """A stage of the compiler, by its verb."""

    PARSE = "parse"
    CHECK = "check"
    LOWER = "lower"
    GENERATE = "generate"


JSON_STAGES = (CompilerStage.PARSE, CompilerStage.LOWER)
"""The stages whose result has a JSON form."""


def dump(
    rules: Path,
    after: CompilerStage,
    *,
    as_json: bool = False,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
) -> str:
    """The result of stage `after` for a rules file; JSON only for `JSON_STAGES`.

    The result of `parse` exists even if the file has errors. Other stages then raise `RulesError`.
    """
    assert after in JSON_STAGES or not as_json
    result = check_file(rules, systems=systems, message_folders=message_folders)
    if after is CompilerStage.PARSE:
        if as_json:
            files = [{"path": module.file.path, "items": module.items} for module in result.modules]
            return json.dumps({"files": files}, indent=1, default=_json) + "\n"
        trees = [tree for module in result.modules for tree in (module.file.path, *module.items)]
        return "\n".join(line for tree in trees for line in _tree(tree)) + "\n"
    if result.program is None:
        raise RulesError(result.diagnostics)
    if after is CompilerStage.CHECK:
        return "\n".join(_symbols(result.program)) + "\n"
    compiled = compile_checked(result, message_folders)
    match after:
        case CompilerStage.LOWER:
            machine = compiled.with_margins
            return machine_to_json(machine) if as_json else dump_text(machine)
        case CompilerStage.GENERATE:
            return "\n".join(own_code(generate(compiled.machine, "c99")).values())


def _symbols(program: CheckedProgram) -> Iterator[str]:
    yield f"program {program.name}"
    for name, value in program.symbols.constants.items():
        content = value.text if value.text is not None else value.boolean
        yield f"const {name} = {list(value.numbers) or content} : {_one_line(value.type)}"
    for name, found in program.symbols.inputs.items():
        path = "".join(f".{part}" for part in found.path)
        timeout = "none" if found.timeout_ns is None else f"{found.timeout_ns} ns"
        source = f"{found.topic} : {found.message_type} {path}".rstrip()
        yield f"input {name} = {source} : {_one_line(found.type)}, timeout {timeout}"
    for (entity, name), condition in program.symbols.conditions.items():
        yield f"condition {entity}.{name} : {condition.expression.span.text}"
    for rule in program.rules:
        yield f"rule {rule.name.text if rule.name else '(unnamed)'} : {rule.condition.span.text}"


def _one_line(value: object) -> str:
    name = type(value).__name__.lower()
    unit = getattr(getattr(value, "unit", None), "symbol", None)
    element = getattr(value, "element", None)
    detail = unit if unit is not None else element and _one_line(element)
    return f"{name}[{detail}]" if detail else name


def _json(node: object) -> object:
    """A node of a syntax tree as an object. A span becomes the offsets of its start and end."""
    if isinstance(node, Span):
        return [node.start, node.end]
    assert dataclasses.is_dataclass(node)
    members = {field.name: getattr(node, field.name) for field in dataclasses.fields(node)}
    return {"class": type(node).__name__, **members}


def _tree(node: object, indent: str = "", label: str = "") -> Iterator[str]:
    """The tree with one node per line, children indented, and spans as line:column ranges."""
    lead = f"{indent}{label}"
    if isinstance(node, tuple):
        yield f"{lead}({len(node)})"
        for child in node:
            yield from _tree(child, indent + "  ")
    elif dataclasses.is_dataclass(node) and not isinstance(node, (type, SourceFile, Span)):
        fields: Mapping[str, object] = {
            field.name: getattr(node, field.name) for field in dataclasses.fields(node)
        }
        span = fields.get("span")
        place = f" @{span.begin.line}:{span.begin.column}" if isinstance(span, Span) else ""
        yield f"{lead}{type(node).__name__}{place}"
        for name, value in fields.items():
            if name != "span" and value is not None and value != ():
                yield from _tree(value, indent + "  ", f"{name} = ")
    else:
        shown = node.value if isinstance(node, enum.Enum) else node
        yield f"{lead}{shown!r}" if label else f"{lead}{shown}"
