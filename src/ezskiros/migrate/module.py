"""One file in, the file with skills of EzSkiROS out, and what is left of the old ones."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import libcst as cst
from libcst.metadata import CodePosition, CodeRange, MetadataWrapper, PositionProvider

from dslkit.diagnostics import Diagnostic, Template
from dslkit.source import SourceFile, Span
from ezskiros.migrate import errors, implementation_errors
from ezskiros.migrate.calls import last_name, method
from ezskiros.migrate.comments import marked, without_marks
from ezskiros.migrate.description import Finding, Translation, statements_of, translate
from ezskiros.migrate.implementations import (
    Implementation,
    described_by,
    helpers_of,
    labels_in,
    robots_in,
    translate_implementation,
    with_marks,
)
from ezskiros.migrate.imports import (
    Wanted,
    bound_names,
    imported,
    imported_names,
    sources,
    used_names,
    with_imports,
)
from ezskiros.migrate.keys import ROBOT
from ezskiros.migrate.modules import import_of
from ezskiros.migrate.names import Names
from ezskiros.migrate.skills import Skill, Skills, new_skills, skill_of
from ezskiros.migrate.tree_context import Context, Place
from ezskiros.migrate.tree_context import Wanted as WantedSkills
from ezskiros.migrate.values import known_of

_OLD, _NEW = "createDescription", "description"


@dataclass(frozen=True)
class Migrated:
    """A file after its migration. `text` is what it was if nothing is changed.

    `translated` and `left` are the classes that describe skills, `implemented` and `unimplemented`
    those that implement them, `bases` those that any class is built on.

    `skills` are what is described, `robots` the names of skills that have to say which robot they
    are of, `labels` what implementations call themselves, with the names of their classes,
    `sources` the modules that are imported, `wanted` the files that trees need besides.
    """

    file: SourceFile
    text: str
    translated: Sequence[str] = ()
    left: Sequence[str] = ()
    implemented: Sequence[str] = ()
    unimplemented: Sequence[str] = ()
    bases: Collection[str] = ()
    skills: Sequence[Skill] = ()
    robots: Collection[str] = ()
    labels: Mapping[str, str] = field(default_factory=dict)
    sources: Collection[str] = ()
    wanted: Collection[str] = ()
    diagnostics: Sequence[Diagnostic] = ()


def migrate_text(
    path: str,
    text: str,
    world: str = "world",
    inherited: Collection[str] = (),
    ambiguous: Collection[str] = (),
    skills: Skills | None = None,
    late: Collection[str] = (),
) -> Migrated:
    """Translate the skills of a file; `world` is the module that has its ontology.

    Classes whose names are in `inherited` are left: others are built on them elsewhere. Of
    properties that are `ambiguous` the namespace is said. `skills` are those that trees can name;
    without them these are the ones of the file itself. What is in the files `late` is imported
    where a tree needs it, and not before.
    """
    file = SourceFile(path, text)
    try:
        module = cst.parse_module(text)
    except cst.ParserSyntaxError as problem:
        return Migrated(file, text, diagnostics=[_unreadable(file, problem)])
    except (RecursionError, ValueError) as problem:
        said = str(problem).partition("\n")[0] or type(problem).__name__
        found = errors.UnreadableSource(said=said).at(Span(file, 0, 0))
        return Migrated(file, text, diagnostics=[found])
    if skills is None:
        own = _File(file, module, world, inherited, ambiguous, Skills(), ()).migrated()
        robots = _File(file, module, world, inherited, ambiguous, Skills((), own.robots), ())
        skills = Skills(robots.migrated().skills, own.robots, own.labels)
    return _File(file, module, world, inherited, ambiguous, skills, late).migrated()


def _unreadable(file: SourceFile, problem: cst.ParserSyntaxError) -> Diagnostic:
    line = min(max(problem.raw_line, 1), len(file.line_starts))
    start = min(file.line_starts[line - 1] + max(problem.raw_column, 0), len(file.text))
    end = max(start, file.line_starts[line - 1] + len(file.line_text(line)))
    said = problem.message.partition("\n")[0].rstrip(".")
    return errors.UnreadableSource(said=said).at(Span(file, start, end))


@dataclass
class _Description:
    """A class that describes a skill, by the node of its class."""

    node: cst.ClassDef
    method: cst.FunctionDef
    names: Names = field(default_factory=Names)
    translation: Translation = field(default_factory=Translation)

    @property
    def findings(self) -> list[Finding]:
        return self.translation.findings


class _File:
    def __init__(
        self,
        file: SourceFile,
        module: cst.Module,
        world: str,
        inherited: Collection[str],
        ambiguous: Collection[str],
        skills: Skills,
        late: Collection[str],
    ) -> None:
        self._file, self._world, self._inherited = file, world, inherited
        self._ambiguous, self._skills, self._late = ambiguous, skills, late
        wrapper = MetadataWrapper(module, unsafe_skip_copy=True)
        self._places: Mapping[cst.CSTNode, CodeRange] = wrapper.resolve(PositionProvider)
        self._module = module
        self._known = known_of(module)
        self._before = used_names(module)
        self._bound = bound_names(module, ())
        self._children = WantedSkills(self._spell)
        self._aliases = {
            name for name, what in imported(module, "skiros2").items() if what == "SkillDescription"
        }

    def migrated(self) -> Migrated:
        classes = _classes(self._module)
        found = [each for node in classes if (each := self._description(node))]
        # With the names of EzSkiROS qualified it shows which other meanings they have here.
        names = self._translate(found, Names(is_qualified=True))
        names = self._translate(found, self._spelled(self._replaced(found, names), names))
        implementing = self._implementations(classes)
        result = self._replaced(found, names, implementing)
        translated = [each.node.name.value for each in found if not each.findings]
        implemented = [each.node.name.value for each in implementing if not each.findings]
        if translated or implemented:
            wanted = self._wanted(names if translated else Names())
            result = with_imports(result, [*wanted, *self._wanted_skills()], self._before)
        return Migrated(
            self._file,
            result.code,
            translated=translated,
            left=[each.node.name.value for each in found if each.findings],
            implemented=implemented,
            unimplemented=[each.node.name.value for each in implementing if each.findings],
            bases={last_name(base.value) or "" for node in classes for base in node.bases},
            skills=[*self._described(found), *new_skills(self._module, self._file.path)],
            robots={name for node in classes for name in robots_in(node, ROBOT)},
            labels=labels_in(classes),
            sources=sources(self._module),
            wanted={each.path for each in self._children.found.values()} - {self._file.path},
            diagnostics=[
                self._diagnostic(each)
                for each in (*_all_findings(found), *_implementation_findings(implementing))
            ],
        )

    def _described(self, found: Sequence[_Description]) -> Iterator[Skill]:
        """The skills of the descriptions that are translated, and of those that are left."""
        for each in found:
            name, path = each.node.name.value, self._file.path
            if each.findings:
                yield Skill(name, path, is_left=True)
            else:
                yield skill_of(name, path, each.translation.parameters)

    # --- implementations --------------------------------------------------------------------------

    def _implementations(self, classes: Sequence[cst.ClassDef]) -> list[Implementation]:
        """What becomes of the classes that implement skills."""
        names = imported_names(self._module)
        found = []
        for node in classes:
            if described_by(node) is None:
                continue
            wanted = WantedSkills(self._spell)
            each = translate_implementation(node, self._context(node, wanted), self._code, names)
            self._leave_inherited(each, classes)
            self._children.found |= {} if each.findings else wanted.found
            found.append(each)
        return found

    def _context(self, node: cst.ClassDef, wanted: WantedSkills) -> Context:
        return Context(
            self._file.path, self._skills, wanted, helpers_of(node), self._place,
            self._module.default_indent, self._late_import,
        )  # fmt: skip

    def _leave_inherited(self, each: Implementation, classes: Sequence[cst.ClassDef]) -> None:
        """A class that others are derived from is left."""
        name = each.node.name.value
        below = [
            node.name.value
            for node in classes
            if any(last_name(base.value) == name for base in node.bases)
        ]
        if below or name in self._inherited:
            said = f"`{below[0]}` is" if below else "a class elsewhere is"
            template = implementation_errors.OtherBase(
                implementation=name, found=f"is what {said} derived from"
            )
            each.findings.append(Finding(template, each.node.name, each.node))
            each.new = with_marks(each.node, each.findings)

    def _spell(self, skill: Skill) -> str:
        """How a skill is called here: as it is imported, or by its name if that is free."""
        if skill.path == self._file.path:
            return skill.name
        for name, original in imported_names(self._module).items():
            if original == skill.name:
                return name
        for name, other in self._children.found.items():
            if other == skill:
                return name
        name = skill.name
        while name in self._before or name in self._bound or name in self._children.found:
            name += "_"
        return name

    def _late_import(self, name: str, skill: Skill) -> str | None:
        """The import of a skill that has to wait until a tree needs it; None for others."""
        if skill.path not in self._late or skill.path == self._file.path:
            return None
        return Wanted(import_of(self._file.path, skill.path), {skill.name: name}).text()[0]

    def _wanted_skills(self) -> list[Wanted]:
        """The skills of other files that trees name, by their modules."""
        known = imported_names(self._module)
        by_module: dict[str, dict[str, str]] = {}
        for name, skill in self._children.found.items():
            is_there = skill.path in (self._file.path, *self._late)
            if not is_there and known.get(name) != skill.name:
                source = import_of(self._file.path, skill.path)
                by_module.setdefault(source, {})[skill.name] = name
        return [Wanted(source, names) for source, names in sorted(by_module.items())]

    def _description(self, node: cst.ClassDef) -> _Description | None:
        """A class with a method that describes a skill; None for implementations and others."""
        function = _method(node)
        if function is None:
            return None
        calls = _self_calls(function)
        if "setDescription" in calls:
            return None
        bases = [last_name(each.value) or "" for each in node.bases]
        if any(base == "SkillDescription" or base in self._aliases for base in bases):
            return _Description(node, function)
        is_one = any(each.startswith("add") for each in calls)
        return _Description(node, function) if is_one else None

    def _translate(self, found: Sequence[_Description], spelling: Names) -> Names:
        """Translate all; the names that the translated ones use."""
        for each in found:
            each.names = spelling.like()
            each.names.our("SkillDescription")
            each.translation = translate(
                each.method, each.names, self._known, self._code, self._indents(each.method),
                has_robot=each.node.name.value in self._skills.robots,
            )  # fmt: skip
        self._leave_related(found)
        used = spelling.like()
        for each in found:
            if not each.findings:
                used.add(each.names)
        return used

    def _spelled(self, first: cst.Module, names: Names) -> Names:
        """How names are written, now that it is known which of them mean something else."""
        ours, world = imported(first, "ezskiros"), imported(first, self._world)
        others = bound_names(first, ("skiros2", "ezskiros", self._world))
        own = {name for name, what in ours.items() if name == what}
        annotated = {name for name, what in imported(first, "typing").items() if name == what}
        other_meanings = (used_names(first) - own) | (others - annotated)
        is_qualified = bool((names.ours | names.typing) & other_meanings)
        free = {name for name, what in world.items() if name == what}
        unclear = names.unclear() | {*self._ambiguous}
        taken = ((self._before | others) - free) | names.clashes
        return Names(is_qualified, taken, unclear)

    def _leave_related(self, found: Sequence[_Description]) -> None:
        """Descriptions that are built on others are left, and those that they are built on."""
        by_name = {each.node.name.value: each for each in found}
        for each in found:
            for base, node in self._bases(each):
                self._derived(each, f"is built on `{base}`", node)
                if base in by_name:
                    below = by_name[base]
                    said = f"is what `{each.node.name.value}` is built on"
                    self._derived(below, said, below.node.name)
            if each.node.name.value in self._inherited:
                self._derived(each, "is what a description elsewhere is built on", each.node.name)

    def _bases(self, each: _Description) -> list[tuple[str, cst.BaseExpression]]:
        """The classes that a description is built on, besides SkiROS2's own."""
        return [
            (last_name(argument.value) or "another class", argument.value)
            for argument in each.node.bases
            if not self._is_base(argument) and last_name(argument.value) != "object"
        ]

    def _derived(self, each: _Description, said: str, node: cst.CSTNode) -> None:
        template = errors.DerivedDescription(skill=each.node.name.value, found=said)
        each.translation.findings.append(Finding(template, node, each.node))

    def _replaced(
        self,
        found: Sequence[_Description],
        names: Names,
        implementing: Sequence[Implementation] = (),
    ) -> cst.Module:
        """The module with new classes, and marks where old ones are left."""
        base = "ezskiros.SkillDescription" if names.is_qualified else "SkillDescription"
        changed = {id(each.node): self._class(each, base) for each in found}
        changed |= {id(each.node): each.new for each in implementing}
        result = self._module.visit(_Replacer(changed))
        assert isinstance(result, cst.Module)
        return result

    def _class(self, each: _Description, base: str) -> cst.ClassDef:
        if each.findings:
            return self._marked(each)
        newline = self._module.default_newline
        text = newline.join([*each.translation.lines, ""])
        new = cst.parse_statement(text, config=self._module.config_for_parsing)
        assert isinstance(new, cst.FunctionDef)
        lines = without_marks(each.method.leading_lines)
        new = new.with_changes(leading_lines=lines)
        body = [new if part is each.method else part for part in each.node.body.body]
        bases = [
            argument.with_changes(value=cst.parse_expression(base))
            if self._is_base(argument)
            else argument
            for argument in each.node.bases
        ]
        return each.node.with_changes(
            body=each.node.body.with_changes(body=body),
            bases=bases,
            leading_lines=without_marks(each.node.leading_lines),
        )

    def _is_base(self, argument: cst.Arg) -> bool:
        name = last_name(argument.value)
        return name == "SkillDescription" or name in self._aliases

    def _marked(self, each: _Description) -> cst.ClassDef:
        """The old class, with a comment above each part that has no translation."""
        templates: dict[int, list[Template]] = {}
        for finding in each.findings:
            templates.setdefault(id(finding.statement), []).append(finding.template)
        inside = isinstance(each.method.body, cst.IndentedBlock)
        statements = statements_of(each.method)
        above = list(templates.get(id(each.method), ()))
        if inside:
            body = [
                part.with_changes(
                    leading_lines=marked(part.leading_lines, templates.get(id(part), ()))  # type: ignore[attr-defined]
                )
                for part in statements
            ]
            block = each.method.body.with_changes(body=body)
        else:
            block = each.method.body
            above += [t for part in statements for t in templates.get(id(part), ())]
        new = each.method.with_changes(
            body=block, leading_lines=marked(each.method.leading_lines, above)
        )
        parts = [new if part is each.method else part for part in each.node.body.body]
        return each.node.with_changes(
            body=each.node.body.with_changes(body=parts),
            leading_lines=marked(each.node.leading_lines, templates.get(id(each.node), ())),
        )

    def _wanted(self, names: Names) -> list[Wanted]:
        def named(found: Collection[str]) -> dict[str, str]:
            return {} if names.is_qualified else {name: name for name in found}

        typing = [Wanted("typing", named(names.typing))] if names.typing else []
        world = [Wanted(self._world, names.namespaces)] if names.namespaces else []
        return [*typing, Wanted("ezskiros", named(names.ours)), *world]

    def _diagnostic(self, finding: Finding) -> Diagnostic:
        return finding.template.at(self._span(finding.node))

    def _span(self, node: cst.CSTNode) -> Span:
        place = self._places[node]
        return Span(self._file, self._offset(place.start), self._offset(place.end))

    def _offset(self, place: CodePosition) -> int:
        line, column = place.line, place.column
        return min(self._file.line_starts[line - 1] + column, len(self._file.text))

    def _code(self, node: cst.CSTNode) -> str:
        return self._module.code_for_node(node)

    def _place(self, node: cst.CSTNode) -> Place:
        start = self._places[node].start
        line = self._file.line_text(start.line)
        return Place(start.column, line[: len(line) - len(line.lstrip())])

    def _indents(self, function: cst.FunctionDef) -> tuple[str, str]:
        """The space before a method, and the space by which the file indents."""
        line = self._file.line_text(self._places[function.name].start.line)
        return line[: len(line) - len(line.lstrip())], self._module.default_indent


def _all_findings(found: Sequence[_Description]) -> list[Finding]:
    """Why descriptions are left, and what is to be known of the others."""
    return [finding for each in found for finding in (each.findings or each.translation.warnings)]


def _implementation_findings(found: Sequence[Implementation]) -> list[Finding]:
    return [finding for each in found for finding in (each.findings or each.warnings)]


class _Classes(cst.CSTVisitor):
    def __init__(self) -> None:
        self.found: list[cst.ClassDef] = []

    def visit_ClassDef(self, node: cst.ClassDef) -> bool:  # noqa: N802
        self.found.append(node)
        return _method(node) is None


def _classes(module: cst.Module) -> list[cst.ClassDef]:
    """All classes, also those inside others that describe nothing."""
    visitor = _Classes()
    module.visit(visitor)
    return visitor.found


def _method(node: cst.ClassDef) -> cst.FunctionDef | None:
    for part in node.body.body:
        if isinstance(part, cst.FunctionDef) and part.name.value == _OLD:
            return part
    return None


class _Calls(cst.CSTVisitor):
    def __init__(self) -> None:
        self.found: set[str] = set()

    def visit_Call(self, node: cst.Call) -> None:  # noqa: N802
        self.found.add(method(node) or "")


def _self_calls(function: cst.FunctionDef) -> set[str]:
    """The methods of itself that a method calls."""
    visitor = _Calls()
    function.visit(visitor)
    return visitor.found


class _Replacer(cst.CSTTransformer):
    """Puts new classes in the places of old ones."""

    def __init__(self, changed: Mapping[int, cst.ClassDef]) -> None:
        self._changed = changed

    def leave_ClassDef(  # noqa: N802
        self, original_node: cst.ClassDef, updated_node: cst.ClassDef
    ) -> cst.ClassDef:
        return self._changed.get(id(original_node), updated_node)
