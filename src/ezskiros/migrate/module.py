"""Translation of one file to EzSkiROS, with the parts that stay unchanged."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

import libcst as cst

from dslkit.diagnostics import Diagnostic, listed
from dslkit.source import SourceFile, Span
from dslkit.source.python_file import refusal, too_deep
from ezskiros.migrate import errors, implementation_errors
from ezskiros.migrate.bases import Bases
from ezskiros.migrate.built import built_in
from ezskiros.migrate.calls import last_name
from ezskiros.migrate.class_bodies import with_marks
from ezskiros.migrate.classes import classes_of, with_classes
from ezskiros.migrate.consequences import (
    Follower,
    LeftSkill,
    consequences,
    follows,
    is_about_base,
    is_about_skill,
)
from ezskiros.migrate.description import UntranslatedPart, translate
from ezskiros.migrate.descriptions import Description, Descriptions
from ezskiros.migrate.foreign_skills import ForeignSkills
from ezskiros.migrate.implementation_errors import OtherBase
from ezskiros.migrate.implementations import (
    Implementation,
    described_by,
    helpers_of,
    labels_in,
    translate_implementation,
)
from ezskiros.migrate.imports import (
    WantedNames,
    bound_names,
    imported,
    imported_names,
    sources,
    used_names,
    with_imports,
)
from ezskiros.migrate.migrated import Migrated
from ezskiros.migrate.mixins import translate_mixin
from ezskiros.migrate.names import FileNames
from ezskiros.migrate.positions import Positions
from ezskiros.migrate.robots import robots_in, with_robots
from ezskiros.migrate.settle import until_settled
from ezskiros.migrate.skills import KnownSkills, SkillId, new_skills
from ezskiros.migrate.states import states_in, with_states
from ezskiros.migrate.tree_context import TreeContext, WantedSkills
from ezskiros.migrate.values import BASIC, known_of

_TOO_DEEP = errors.UnreadableSource(said="it is nested too deeply")


def migrate_text(
    path: str,
    text: str,
    world: str = "world",
    inherited: Collection[str] = (),
    ambiguous: Collection[str] = (),
    skills: KnownSkills | None = None,
    late: Collection[str] = (),
) -> Migrated:
    """Translate the skills of a file. `world` is the module with its ontology.

    Classes in `inherited` stay unchanged, because classes elsewhere are derived from them.
    Properties in `ambiguous` are written with their namespace. `skills` are the skills that trees
    can name; by default those of the file itself. The skills of the files `late` are imported
    inside the trees that need them.
    """
    file = SourceFile(path, text)
    deep = too_deep(text)
    if deep is not None:
        return Migrated(file, text, diagnostics=[_TOO_DEEP.at(Span(file, deep, deep + 1))])
    try:
        module = cst.parse_module(text)
    except cst.ParserSyntaxError as problem:
        return Migrated(file, text, diagnostics=[_unreadable(file, problem)])
    except (RecursionError, ValueError, cst.CSTLogicError) as problem:
        said = str(problem).partition("\n")[0] or type(problem).__name__
        said, span = refusal(file) or (said, Span(file, 0, 0))
        return Migrated(file, text, diagnostics=[errors.UnreadableSource(said=said).at(span)])
    refused = refusal(file)
    if refused is not None:
        said, span = refused
        return Migrated(file, text, diagnostics=[errors.UnreadableSource(said=said).at(span)])
    try:
        return _translated(file, module, world, inherited, ambiguous, skills, late)
    except RecursionError:  # hundreds of nested attributes
        return Migrated(file, text, diagnostics=[_TOO_DEEP.at(Span(file, 0, 0))])


def _translated(
    file: SourceFile,
    module: cst.Module,
    world: str,
    inherited: Collection[str],
    ambiguous: Collection[str],
    skills: KnownSkills | None,
    late: Collection[str],
) -> Migrated:
    if skills is None:
        own = _File(file, module, world, inherited, ambiguous, KnownSkills(), ()).migrated()
        bases = Bases(own.built)
        names = with_robots([own.robots], own.skills) | bases.robots()
        robots = _File(file, module, world, inherited, ambiguous, KnownSkills((), names), ())
        skills = KnownSkills(robots.migrated().skills, names, own.labels, bases=bases)

        def again(known: KnownSkills) -> list[Migrated]:
            return [_File(file, module, world, inherited, ambiguous, known, ()).migrated()]

        (migrated,) = until_settled(skills, again)
        more = consequences(migrated.followers, migrated.left_skills)
        return replace(migrated, diagnostics=[*migrated.diagnostics, *more])
    return _File(file, module, world, inherited, ambiguous, skills, late).migrated()


def _unreadable(file: SourceFile, problem: cst.ParserSyntaxError) -> Diagnostic:
    line = min(max(problem.raw_line, 1), len(file.line_starts))
    start = min(file.line_starts[line - 1] + max(problem.raw_column, 0), len(file.text))
    end = max(start, file.line_starts[line - 1] + len(file.line_text(line)))
    said = problem.message.partition("\n")[0].rstrip(".")
    return errors.UnreadableSource(said=said).at(Span(file, start, end))


class _File:
    def __init__(
        self,
        file: SourceFile,
        module: cst.Module,
        world: str,
        inherited: Collection[str],
        ambiguous: Collection[str],
        skills: KnownSkills,
        late: Collection[str],
    ) -> None:
        self._file, self._world, self._inherited = file, world, inherited
        self._ambiguous, self._skills = ambiguous, skills
        self._positions = Positions(file, module)
        self._module = module
        self._known = known_of(module)
        self._before = used_names(module)
        self._states = states_in(module)
        self._descriptions = Descriptions(module, inherited)
        self._foreign = ForeignSkills(file.path, module, late)

    def migrated(self) -> Migrated:
        classes = classes_of(self._module)
        found = self._descriptions.of(classes)
        names = self._named(found)
        implementing = self._implementations(classes, names)
        mixins = self._mixins(classes)
        result = self._replaced(found, names, [*implementing, *mixins])
        result, state = with_states(result, self._states)
        obstacles = self._obstacles(mixins, implementing)
        translated = [each.name for each in found if not each.findings]
        implemented = [each.node.name.value for each in implementing if not each.findings]
        if translated or implemented or any(not each.findings for each in mixins):
            wanted = self._wanted(names if translated else FileNames(), state)
            result = with_imports(result, [*wanted, *self._foreign.imports()], self._before)
        return Migrated(
            self._file,
            result.code,
            translated=translated,
            left=[each.name for each in found if each.findings],
            implemented=implemented,
            unimplemented=[each.node.name.value for each in implementing if each.findings],
            bases={last_name(base.value) or "" for node in classes for base in node.bases},
            built=list(built_in(classes, self._file.path, imported_names(self._module))),
            obstacles={key: left.codes for key, left in obstacles.items()},
            skills=[
                *(each.skill(self._file.path) for each in found),
                *new_skills(self._module, self._file.path),
            ],
            robots=robots_in(classes),
            labels=labels_in(classes),
            sources=sources(self._module),
            wanted=self._foreign.files(),
            trees=[tree for each in implementing if (tree := each.sharing())],
            followers=[
                follower for each in (*mixins, *implementing) for follower in self._followers(each)
            ],
            left_skills={
                **{
                    (self._file.path, each.name): LeftSkill(
                        self._positions.span(each.node.name),
                        [finding.template.code for finding in each.findings],
                    )
                    for each in found
                    if each.findings
                },
                **obstacles,
            },
            diagnostics=[
                self._diagnostic(each)
                for each in (
                    *_all_findings(found),
                    *_implementation_findings([*mixins, *implementing]),
                )
                if not follows(each.template)
            ],
        )

    def _named(self, found: list[Description]) -> FileNames:
        """Translate the descriptions with names that have no other meaning in the file."""
        # With qualified EzSkiROS names, the other meanings in the file become visible.
        names = self._translate(found, FileNames(is_qualified=True))
        spelling = self._spelled(self._replaced(found, names), names)
        names = self._translate(found, spelling)
        if names.clashes:  # the namespaces that only ambiguous properties need
            names = self._translate(found, spelling.without(names.clashes))
        return names

    def _obstacles(
        self, mixins: Sequence[Implementation], implementing: Sequence[Implementation]
    ) -> dict[SkillId, LeftSkill]:
        """The classes because of which related classes stay unchanged: unchanged bases, and
        implementations that still work in SkiROS2, because their description stays unchanged.
        """
        found = {}
        for each in (*mixins, *implementing):
            own = [one.template for one in each.findings if not is_about_base(one.template)]
            if own and (each in mixins or any(map(is_about_skill, own))):
                codes = list(dict.fromkeys(one.code for one in own))
                span = self._positions.span(each.node.name)
                found[self._file.path, each.node.name.value] = LeftSkill(
                    span, codes, is_skill=False
                )
        return found

    def _diagnostic(self, finding: UntranslatedPart) -> Diagnostic:
        return finding.template.at(self._positions.span(finding.node))

    def _followers(self, each: Implementation) -> Iterator[Follower]:
        """The skills and bases because of which an implementation stays unchanged, besides its own
        findings.
        """
        name = each.node.name.value
        for finding in each.findings:
            match finding.template:
                case OtherBase(base=base, path=path) if base:
                    reported = self._diagnostic(finding)
                    yield Follower(name, base, path, reported, reason=OtherBase.code)
                case template if follows(template):
                    skill = getattr(template, "skill", "")
                    known = self._skills.called(skill, self._file.path)
                    path = known[0].path if len(known) == 1 else ""
                    yield Follower(name, skill, path, self._diagnostic(finding))
                case _:  # open: any other diagnostic
                    pass

    # --- implementations --------------------------------------------------------------------------

    def _implementations(
        self, classes: Sequence[cst.ClassDef], names_of_file: FileNames
    ) -> list[Implementation]:
        """Translate the classes that implement skills. The file gets the names that they use."""
        names = imported_names(self._module)
        found = []
        for node in classes:
            if described_by(node) is None:
                continue
            wanted = self._foreign.wanted()
            own = names_of_file.like()
            context = self._context(node, wanted, own)
            each = translate_implementation(node, context, self._code, names)
            self._leave_inherited(each, classes)
            if not each.findings:
                self._foreign.add(wanted)
                names_of_file.add(own)
            found.append(each)
        return found

    def _mixins(self, classes: Sequence[cst.ClassDef]) -> list[Implementation]:
        """The translations of the base classes of implementations."""
        names = imported_names(self._module)
        return [
            translate_mixin(
                node, self._context(node, self._foreign.wanted(), FileNames()), self._code, names
            )
            for node in classes
            if self._skills.bases.is_mixin((self._file.path, node.name.value))
        ]

    def _context(self, node: cst.ClassDef, wanted: WantedSkills, names: FileNames) -> TreeContext:
        return TreeContext(
            self._file.path, self._skills, wanted, helpers_of(node), self._positions.place,
            self._module.default_indent, self._foreign.late_import,
            names, self._known, self._states,
        )  # fmt: skip

    def _leave_inherited(self, each: Implementation, classes: Sequence[cst.ClassDef]) -> None:
        """Keep a base class of other classes unchanged."""
        name = each.node.name.value
        below = [
            node.name.value
            for node in classes
            if any(last_name(base.value) == name for base in node.bases)
        ]
        if below or name in self._inherited:
            said = f"`{below[0]}`" if below else "a class elsewhere"
            template = implementation_errors.OtherBase(
                implementation=name, found=f"is the base of {said}"
            )
            each.findings.append(UntranslatedPart(template, each.node.name, each.node))
            each.new = with_marks(each.node, each.findings)

    def _translate(self, found: Sequence[Description], spelling: FileNames) -> FileNames:
        """Translate all descriptions, and return the names that the translated ones use."""
        for each in found:
            each.names = spelling.like()
            each.names.our("SkillDescription")
            each.translation = translate(
                each.method,
                each.names,
                self._known,
                self._code,
                self._positions.indents(each.method),
                has_robot=each.name in self._skills.robots,
                added=self._skills.keys.added.get((self._file.path, each.name), {}),
            )
            self._tell_added(each)
        self._descriptions.leave_related(found)
        used = spelling.like()
        for each in found:
            if not each.findings:
                used.add(each.names)
        return used

    def _tell_added(self, each: Description) -> None:
        """Report the added parameters of a description, with the implementations that need them."""
        keys, skill = self._skills.keys, (self._file.path, each.name)
        for key, kind in keys.added.get(skill, {}).items():
            value = kind if kind in BASIC else f'Element("{kind}")'
            template = implementation_errors.AddedParameter(
                skill=each.name, key=key, value=value, sharing=listed(keys.sharing[skill][key])
            )
            each.translation.warnings.append(UntranslatedPart(template, each.node.name, each.node))

    def _spelled(self, first: cst.Module, names: FileNames) -> FileNames:
        """Spell the names, after their other meanings are known."""
        ours, world = imported(first, "ezskiros"), imported(first, self._world)
        others = bound_names(first, ("skiros2", "ezskiros", self._world))
        own = {name for name, what in ours.items() if name == what}
        annotated = {name for name, what in imported(first, "typing").items() if name == what}
        other_meanings = (used_names(first) - own) | (others - annotated)
        is_qualified = bool((names.ours | names.typing) & other_meanings)
        free = {name for name, what in world.items() if name == what}
        unclear = names.unclear() | {*self._ambiguous}
        taken = ((self._before | others) - free) | names.clashes
        return FileNames(is_qualified, taken, unclear)

    def _replaced(
        self,
        found: Sequence[Description],
        names: FileNames,
        implementing: Sequence[Implementation] = (),
    ) -> cst.Module:
        """The module with new classes, and with marks in unchanged ones."""
        base = "ezskiros.SkillDescription" if names.is_qualified else "SkillDescription"
        changed = {id(each.node): self._descriptions.new_class(each, base) for each in found}
        changed |= {id(each.node): each.new for each in implementing}
        return with_classes(self._module, changed)

    def _wanted(self, names: FileNames, state: str) -> list[WantedNames]:
        """The imports that the file needs. `state` is the local name of EzSkiROS's `State`, if it
        is used.
        """

        def named(found: Collection[str]) -> dict[str, str]:
            return {} if names.is_qualified else {name: name for name in found}

        typing = [WantedNames("typing", named(names.typing))] if names.typing else []
        world = [WantedNames(self._world, names.namespaces)] if names.namespaces else []
        ours = {**named(names.ours), **({"State": state} if state else {})}
        whole = [WantedNames("ezskiros", {})] if names.is_qualified and names.ours else []
        return [*typing, *whole, *([WantedNames("ezskiros", ours)] if ours else []), *world]

    def _code(self, node: cst.CSTNode) -> str:
        return self._module.code_for_node(node)


def _all_findings(found: Sequence[Description]) -> list[UntranslatedPart]:
    """The findings that prevent translations, and the warnings about the other descriptions."""
    return [finding for each in found for finding in (each.findings or each.translation.warnings)]


def _implementation_findings(found: Sequence[Implementation]) -> list[UntranslatedPart]:
    return [finding for each in found for finding in (each.findings or each.warnings)]
