"""The files of the library, and the page that is made from their texts."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Collector
from dslkit.source import SourceFile, Span
from rossmarie.driver.workspace import LIBRARY, SYSTEM_MODEL
from rossmarie.syntax import ast, parse

BOUNDARIES = ".boundaries.ross"
"""The suffix of generated tests, which the tests beside the rules import."""

TESTS = ".tests.ross"

LABELS = ("Hazard", "Limit", "Derivation", "Source")
"""The labels of the documentation of a rule, in this order. The source is optional."""


def library_files() -> list[Path]:
    """The files that rules import, by their names."""
    return [
        path
        for path in sorted(LIBRARY.rglob("*.ross"))
        if path.name != SYSTEM_MODEL and not path.name.endswith((BOUNDARIES, TESTS))
    ]


def name_of(path: Path) -> str:
    """The name of a file of the library, as `base/tilt.ross`."""
    return path.relative_to(LIBRARY).as_posix()


def module_of(path: Path) -> ast.Module:
    """The syntax tree of a file, without its imports."""
    collector = Collector()
    return parse(SourceFile(str(path), path.read_text(encoding="utf-8")), collector)


def rules_of(path: Path) -> list[ast.Rule]:
    """The rules of a file, without the rules of its imports."""
    return [item for item in module_of(path).items if isinstance(item, ast.Rule)]


def paragraphs(documentation: str) -> dict[str, str]:
    """The text after each label of the documentation of a rule, each in one line."""
    words = "|".join(LABELS)
    parts = re.split(rf"(?:^|\n)\s*({words}): ", documentation)
    pairs = zip(parts[1::2], parts[2::2], strict=True)
    return {label: " ".join(text.split()) for label, text in pairs}


def parameters_of(path: Path, rule: ast.Rule) -> list[str]:
    """The parameters on which a rule depends, directly or by conditions that the rule names."""
    file = _File(path, module_of(path))
    inputs = {item.name.text: item for item in file.module.items if isinstance(item, ast.Input)}
    text = _text(rule.condition.span)
    texts = [text, *(_text(each.span) for each in rule.contracts)]
    found = _used(file, " ".join(texts))
    words = set(
        re.findall(
            r"\w+",
            " ".join([*texts, *(_inner(file, each) for each in found if each in file.named)]),
        )
    )
    for name in sorted(words & inputs.keys()):
        found += _used(file, _text(inputs[name].span))
    return [each for each in dict.fromkeys(found) if each in file.parameters]


# --- the page --------------------------------------------------------------------------------

_HEAD = """\
# The library

Written from `src/rossmarie/library` by `pytest --bless tests/docs/test_library.py`; do not edit.

**Nothing in the library is certified.** The rules are software in addition to the control of a
robot. They are not a safety function of any standard. The numbers are examples for the derivation
of a limit: derive the numbers for your own robot. The texts of the standards were not read.
Formulas and clause numbers are quoted from these public pages:

- ISO 13855, S = (K * T) + C: [GT Engineering, EN ISO 13855, clause 5][gt-13855]. That page has
  S = (K * T) + D_DS + Z since July 2025, with the distance D_DS that belongs to the protective
  device. S = 1600 mm/s * T + 850 mm: [SICK, nanoScan3 (8027909), 4.3.9.2][sick-nano].
- The stopping distance of vehicles, S_L = S_A + TZ + Z_R + Z_F + Z_B and
  S_A = S_Br + S_AnF + S_AnS: [SICK, microScan3 Core I/O][sick-micro].
- The reduced speed of 250 mm/s: [GT Engineering, ISO 10218-1, 5.5.3][gt-10218].

[gt-13855]: https://www.gt-engineering.it/en/technical-standards/en-iso-standards/en-iso-13855/5-general-equations-for-the-calculation-of-the-overall-system-stopping-performance-and-minimum-distances/
[gt-10218]: https://www.gt-engineering.it/en/?p=34076
[sick-nano]: https://www.easymanua.ls/sick/nanoscan3/manual?p=34
[sick-micro]: https://www.easymanua.ls/sick/microscan3-core-i-o/manual?p=49

For the use of the library see [the language](language.md#the-library). Each file has two files of
tests: hand-written tests of its rules, `NAME.tests.ross`, and generated tests of all boundaries,
`NAME.boundaries.ross`. Together they reach 100 % MC/DC. A separate page lists the
[proofs of the generated C](library-proofs.md).

A latched rule also latches if an input is missing when the monitor starts. Reset it after all
sensors have sent a message.
"""


@dataclass(frozen=True)
class _File:
    """A file, and the lookup of its texts by name."""

    path: Path
    module: ast.Module

    @property
    def parameters(self) -> dict[str, ast.Parameter | ast.Constant]:
        kinds = ast.Parameter | ast.Constant
        return {item.name.text: item for item in self.module.items if isinstance(item, kinds)}

    @property
    def named(self) -> dict[str, Span]:
        """The text of each named condition, motion and zone, by the name that conditions use."""
        found = {}
        for item in self.module.items:
            if isinstance(item, ast.Motion | ast.Zone):
                found[item.name.text] = item.span
            if isinstance(item, ast.Entity):
                for one in item.conditions:
                    found[f"{item.name.text}.{one.name.text}"] = one.expression.span
        return found


def page() -> str:
    """The text of the page."""
    files = [_File(path, module_of(path)) for path in library_files()]
    with_rules = [file for file in files if rules_of(file.path)]
    lines = [_HEAD, *_overview(with_rules), "", *_actions(files)]
    for file in with_rules:
        lines += ["", *_section(file)]
    return "\n".join(lines) + "\n"


def _overview(files: Sequence[_File]) -> Iterator[str]:
    yield "| File | Rules | About |"
    yield "|---|---|---|"
    total = 0
    for file in files:
        count = len(rules_of(file.path))
        total += count
        yield f"| [{name_of(file.path)}](#{_anchor(file)}) | {count} | {_about(file)} |"
    yield f"| {len(files)} files | {total} | |"


def _about(file: _File) -> str:
    """The second comment of a file, without the import line."""
    second = file.module.file.text.splitlines()[1].removeprefix("// ")
    return re.split(r"[:;] import|: import", second)[0]


def _anchor(file: _File) -> str:
    return name_of(file.path).removesuffix(".ross").replace("/", "")


def _actions(files: Sequence[_File]) -> Iterator[str]:
    yield "## Actions"
    yield ""
    yield "| File | Action | Effect |"
    yield "|---|---|---|"
    for file in files:
        for item in file.module.items:
            if isinstance(item, ast.Action):
                does = " ".join((item.documentation or "").split())
                yield f"| {name_of(file.path)} | `{item.name.text}` | {does} |"


def _section(file: _File) -> Iterator[str]:
    yield f"## {name_of(file.path).removesuffix('.ross')}"
    yield ""
    yield _about(file) + "."
    yield ""
    yield "```ross"
    yield from _model(file)
    yield f'import "rossmarie/{name_of(file.path)}" as {file.path.stem};'
    yield "```"
    yield ""
    yield "| Parameter | Default | Meaning |"
    yield "|---|---|---|"
    for name, parameter in file.parameters.items():
        yield f"| `{name}` | {_default(parameter)} | {_comment(parameter)} |"
    yield ""
    yield "| Input | Topic | Timeout |"
    yield "|---|---|---|"
    for item in file.module.items:
        if isinstance(item, ast.Input):
            type_ = item.message_type.text if item.message_type else ""
            timeout = "" if item.timeout is None else _text(item.timeout.span)
            yield f"| `{item.name.text}` | `{item.topic.text}` : {type_} | {timeout} |"
    for rule in rules_of(file.path):
        yield ""
        yield from _rule(file, rule)


def _model(file: _File) -> Iterator[str]:
    """The lines of the system model that the file needs."""
    beside = file.path.with_name(SYSTEM_MODEL)
    if beside.exists():
        text = beside.read_text(encoding="utf-8").partition("\n")[2].strip()
        yield text.replace("system checked", "system robot")
        yield ""


def _default(item: ast.Parameter | ast.Constant) -> str:
    """The default value of a parameter; a topic as its name."""
    value = item.value if isinstance(item, ast.Constant) else item.default
    return "" if value is None else _text(value.span)


def _comment(item: ast.Parameter | ast.Constant) -> str:
    """The comment behind a constant on its line."""
    rest = item.span.file.text[item.span.end :].partition("\n")[0]
    return rest.partition("// ")[2].strip()


def _rule(file: _File, rule: ast.Rule) -> Iterator[str]:
    assert rule.name is not None
    says = paragraphs(rule.documentation or "")
    condition = _text(rule.condition.span)
    yield f"### {rule.name.text}"
    yield ""
    for label in LABELS:
        if label in says:
            yield f"- **{label}**: {says[label]}"
    yield f"- **If** `{condition}`"
    used = _used(file, condition)
    for name in used:
        if name in file.named:
            yield f"    - `{name}`: `{_text(file.named[name])}`"
    yield f"- **Then** {', '.join(f'`{action.text}`' for action in rule.actions)}{_contract(rule)}"
    parameters = [f"`{name}`" for name in used if name in file.parameters]
    if parameters:
        yield f"- **Parameters**: {', '.join(parameters)}"


def _contract(rule: ast.Rule) -> str:
    return "".join(f", {_text(contract.span)}" for contract in rule.contracts)


def _used(file: _File, text: str) -> list[str]:
    """The names in a text and in the definitions of these names, each once."""
    found: list[str] = []
    waiting = [text]
    while waiting:
        for word in re.findall(r"\b[a-zA-Z_]\w*(?:\.\w+)*", waiting.pop(0)):
            for name in (word, word.partition(".")[0]):
                if name in found or not (name in file.named or name in file.parameters):
                    continue
                found.append(name)
                if name in file.named:
                    waiting.append(_inner(file, name))
                else:
                    waiting.append(_default(file.parameters[name]))
    return found


def _inner(file: _File, name: str) -> str:
    """The text of a named condition; names of its own entity are completed."""
    text = _text(file.named[name])
    entity = name.partition(".")[0]
    for other in file.named:
        if other.startswith(f"{entity}.") and other != name:
            text = re.sub(rf"(?<![.\w]){re.escape(other.partition('.')[2])}\b", other, text)
    return text


def _text(span: Span) -> str:
    return " ".join(re.sub(r"//[^\n]*", "", span.text).split())
