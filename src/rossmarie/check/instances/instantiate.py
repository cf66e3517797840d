"""Turns the parsed files of a program into modules in which each name has one meaning.

Files that are imported under a name get a name space of their own. Each parameter becomes a
constant, or the topic that it stands for.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dslkit.diagnostics import Collector, DidYouMean, listed
from dslkit.source import SourceFile
from rossmarie.check.instances.elements import with_elements
from rossmarie.check.instances.errors import (
    MissingParameter,
    ParameterMismatch,
    UnknownParameter,
    ValuesTwice,
)
from rossmarie.check.instances.rewrite import Rewriter
from rossmarie.check.instances.spaces import Imported, Instances, Path, Space
from rossmarie.check.scopes.declarations import report_second
from rossmarie.check.scopes.errors import DuplicateName
from rossmarie.check.wording.suggestions import MOST_COMPARISONS, near_name, rename
from rossmarie.syntax import ast


def instantiate(
    files: Sequence[Imported], collector: Collector
) -> tuple[list[ast.Module], Instances]:
    """The modules of `files`, in their order. The main module is last."""
    if any(_concerns(item) for each in files for item in each.module.items):
        modules, instances = _Program(files, collector).modules()
    else:
        modules, instances = [each.module for each in files], Instances()
    return with_elements(modules, collector), instances


def _concerns(item: ast.Item) -> bool:
    if isinstance(item, ast.Import):
        return bool(item.given) or item.alias is not None
    return isinstance(item, ast.Parameter)


class _Program:
    def __init__(self, files: Sequence[Imported], collector: Collector) -> None:
        self._files = files
        self._collector = collector
        self._instances = Instances()
        self._spaces: dict[Path, Space] = {(): Space(())}
        self._rewriters: dict[Imported, Rewriter] = {}
        self._hazards: dict[tuple[SourceFile, str], Imported] = {}

    def modules(self) -> tuple[list[ast.Module], Instances]:
        for each in self._files:
            space = self._spaces.setdefault(each.space, Space(each.space))
            for item in each.module.items:
                space.take(item)
                if isinstance(item, ast.Skills):
                    self._instances.guesses.take(MOST_COMPARISONS + 1)
                self._instances.frames.update(_frames(item))
        self._open_rewriters()
        for each in self._files:
            self._take_imports(each)
        parameters = {each: dict(self._parameters(each)) for each in self._importers_first()}
        modules = []
        for each in self._files:
            items = tuple(self._items(each, parameters[each]))
            source = self._rewriters[each].file
            modules.append(ast.Module(source, items, each.module.is_whole))
        return modules, self._instances

    def _open_rewriters(self) -> None:
        """Give each file of an instance a source of its own, so that places in the source identify
        the file.
        """
        seen: set[SourceFile] = set()
        for each in self._files:
            source = each.module.file
            if source in seen:
                source = SourceFile(source.path, source.text, source.mark)
            seen.add(source)
            space = self._spaces[each.space]
            self._rewriters[each] = Rewriter(source, space, self._spaces, self._instances)
        for each, rewriter in self._rewriters.items():
            imports = tuple(
                self._rewriters[importer].node(written) for importer, written in each.chain()
            )
            self._instances.files[rewriter.file] = each.space, imports

    def _take_imports(self, imported: Imported) -> None:
        """Record the names after `as`. A second use of a name, or a name with another meaning, is
        reported.
        """
        space, rewriter = self._spaces[imported.space], self._rewriters[imported]
        for item in imported.module.items:
            if not isinstance(item, ast.Import) or item.alias is None:
                continue
            alias = rewriter.node(item.alias)
            first = space.inner.setdefault(alias.text, alias)
            if first is not alias:
                reason = (
                    "each name after `as` stands for one file; import each file under a different"
                    " name"
                )
                report_second(alias, first, "import", reason, self._collector)
            declared = space.names.get(alias.text)
            if declared is not None:
                reason = f"`{alias.text}.NAME` could refer to either"
                finding = DuplicateName(
                    identifier=alias.text, kind="import", other="something else", reason=reason
                )
                place = finding.First().at(declared.span)
                self._collector.add(finding.at(alias.span, place))

    def _importers_first(self) -> list[Imported]:
        """The files in an order in which topics are known before they are passed on."""
        return sorted(self._files, key=lambda each: sum(1 for _ in each.chain()))

    # --- parameters --------------------------------------------------------------------------

    def _parameters(self, imported: Imported) -> Iterator[tuple[str, ast.Constant]]:
        """The constants for the parameters of a file, with their names. Topics for parameters are
        recorded.
        """
        declared = self._declared(imported)
        given = self._given(imported, declared)
        rewriter, space = self._rewriters[imported], self._spaces[imported.space]
        for name, parameter in declared.items():
            value = given.get(name)
            if isinstance(parameter.default, ast.Name):
                is_topic = parameter.meaning is ast.Meaning.TOPIC
                named = rewriter.topic if is_topic else rewriter.frame
                known = space.topics if is_topic else space.frames
                default = named(parameter.default)
                known[name] = value if isinstance(value, ast.Name) else default
                continue
            if value is None and parameter.default is None:
                self._report_missing(imported, parameter)
            kept = rewriter.node(parameter)
            chosen = value or kept.default or ast.Broken(kept.name.span)
            assert not isinstance(chosen, ast.Name)
            behind = kept.documentation, kept.span, kept
            yield name, ast.Constant(kept.name, chosen, *behind)

    def _declared(self, imported: Imported) -> dict[str, ast.Parameter]:
        found: dict[str, ast.Parameter] = {}
        for item in imported.module.items:
            if isinstance(item, ast.Parameter):
                first = found.setdefault(item.name.text, item)
                if first is not item:
                    reason = "an import could not distinguish them"
                    report_second(item.name, first.name, "parameter", reason, self._collector)
        return found

    def _given(
        self, imported: Imported, declared: dict[str, ast.Parameter]
    ) -> dict[str, ast.Expression | ast.Name]:
        """The values of an import by parameter name, as the program contains them."""
        found: dict[str, ast.Expression | ast.Name] = {}
        first: dict[str, ast.Given] = {}
        if imported.written is None or imported.importer is None:
            return found
        importing = self._rewriters[imported.importer]
        for written in imported.written.given:
            name = importing.node(written.name)
            earlier = first.setdefault(name.text, written)
            parameter = declared.get(name.text)
            if earlier is not written:
                subject = f"parameter `{name.text}`"
                twice = ValuesTwice(subject=subject, advice="remove one of the two")
                place = twice.First().at(importing.span(earlier.span))
                self._collector.add(twice.at(importing.span(written.span), place))
            elif parameter is not None:
                value = self._fitting(imported, parameter, written, importing)
                found.update({} if value is None else {name.text: value})
            elif imported.module.is_whole:
                self._report_unknown(imported, name, declared)
        return found

    def _fitting(
        self,
        imported: Imported,
        parameter: ast.Parameter,
        written: ast.Given,
        importing: Rewriter,
    ) -> ast.Expression | ast.Name | None:
        """A value of the kind that its parameter requires; None after reporting another kind."""
        value, meaning = written.value, parameter.meaning
        meant = _meant(meaning, value, importing)
        if meant is not None:
            return meant
        is_topic = isinstance(value, ast.Name)
        expected = meaning.value
        found = (ast.Meaning.TOPIC if is_topic else ast.Meaning.VALUE).value
        name = parameter.name
        mismatch = ParameterMismatch(identifier=name.text, expected=expected, found=found)
        place = mismatch.Declared(expected=expected).at(self._rewriters[imported].span(name.span))
        self._collector.add(mismatch.at(importing.span(value.span), place))
        is_value = meaning is ast.Meaning.VALUE
        return ast.Broken(importing.span(value.span)) if is_value else None

    def _report_unknown(
        self, imported: Imported, name: ast.Name, declared: dict[str, ast.Parameter]
    ) -> None:
        assert imported.written is not None
        finding = UnknownParameter(path=imported.written.path.value, identifier=name.text)
        near = near_name(name.text, declared)
        if near is not None:
            help = DidYouMean(near=near)
            self._collector.add(finding.at(name.span, help=help, fix=rename(name, near)))
            return
        known = finding.Known(known=listed(tuple(declared))) if declared else finding.NoneThere()
        self._collector.add(finding.at(name.span, help=known))

    def _report_missing(self, imported: Imported, parameter: ast.Parameter) -> None:
        name, unit = parameter.name, parameter.unit
        example = "1" if unit is None else f"1 {unit.text}"
        declared = self._rewriters[imported].span(name.span)
        if imported.written is None or imported.importer is None:
            finding = MissingParameter(
                identifier=name.text,
                reason="declared without a default",
                place="write a default here, or import this file with a value",
                example=example,
            )
            self._collector.add(finding.at(declared))
            return
        finding = MissingParameter(
            identifier=name.text,
            reason="this import gives no value",
            place="write a value after the path",
            example=example,
        )
        path = self._rewriters[imported.importer].span(imported.written.path.span)
        self._collector.add(finding.at(path, finding.Declared().at(declared)))

    # --- items -------------------------------------------------------------------------------

    def _items(self, imported: Imported, constants: dict[str, ast.Constant]) -> Iterator[ast.Item]:
        """The items of a module. Tests of a file assume its default values, so instances with other
        values or with a name have no tests. Hazards apply to the whole program: hazards of a file
        with several instances count once.
        """
        rewriter = self._rewriters[imported]
        for item in imported.module.items:
            if isinstance(item, ast.Parameter):
                constant = constants.pop(item.name.text, None)
                if constant is not None:
                    yield constant if item.tightens is None else _setting(constant)
            elif not self._is_left_out(imported, item):
                yield rewriter.node(item)

    def _is_left_out(self, imported: Imported, item: ast.Item) -> bool:
        if isinstance(item, ast.Hazard):
            key = imported.module.file, item.name.text
            return self._hazards.setdefault(key, imported) is not imported
        return isinstance(item, ast.Test) and imported.written is not None


def _meant(
    meaning: ast.Meaning, value: ast.Expression | ast.Name, importing: Rewriter
) -> ast.Expression | ast.Name | None:
    """A value of an import in the form that a parameter of this kind takes; None if the value is of
    another kind.
    """
    if meaning is ast.Meaning.VALUE:
        return None if isinstance(value, ast.Name) else importing.node(value)
    if meaning is ast.Meaning.FRAME and isinstance(value, ast.Text):
        return importing.frame(ast.Name(value.value, value.span))
    if isinstance(value, ast.Reference):
        is_topic = meaning is ast.Meaning.TOPIC
        return importing.topic(value.name) if is_topic else importing.frame(value.name)
    if meaning is ast.Meaning.TOPIC and isinstance(value, ast.Name):
        return importing.topic(value)
    return None


def _frames(item: ast.Item) -> Iterator[str]:
    """All names that an item declares for frames."""
    for each in item.members if isinstance(item, ast.System) else ():
        if isinstance(each, ast.FrameDeclaration):
            names = (each.alias, each.frame, each.parent)
            yield from (name.text for name in names if name is not None)


def _setting(constant: ast.Constant) -> ast.Input:
    """A parameter that the running node may set, as an input: its number arrives like a message."""
    name, documentation, span = constant.name, constant.documentation, constant.span
    behind = None, None, None, documentation, span
    return ast.Input(name, name, None, (), *behind, setting=constant)
