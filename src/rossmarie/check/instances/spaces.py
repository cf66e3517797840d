"""Name spaces: one for the whole program, and one for each name after `as`.

A file that is imported as `front` has the name space `front`: outside, `front.near` is the name
that the file calls `near`. After this stage, the name is `front_near`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from dslkit.source import SourceFile
from rossmarie.check.wording.suggestions import Suggestions
from rossmarie.syntax import ast

Path = tuple[str, ...]
"""The names after `as` that lead to a name space; empty for the whole program."""

_DECLARING = (
    ast.Action | ast.Constant | ast.Parameter | ast.Input | ast.Entity | ast.Motion | ast.Zone
)


@dataclass(eq=False)
class Imported:
    """One file as one import creates it. `written` is the import in the file of `importer`. Both
    are None for a file that is imported without values and name, because several files may import
    it.
    """

    module: ast.Module
    space: Path
    written: ast.Import | None = None
    importer: Imported | None = None

    def chain(self) -> Iterator[tuple[Imported, ast.Import]]:
        """The importing files with their imports, the nearest first."""
        at, seen = self, {self}
        while at.importer is not None and at.written is not None:
            yield at.importer, at.written
            at = at.importer
            if at in seen:
                return
            seen.add(at)


@dataclass
class Space:
    """The names that the files of a name space declare: `names` of constants, inputs, entities,
    motions, zones and actions (`values` are the constants and inputs), `rules`, `aliases` and
    parameters (`topics`) of topics, and parameters of `frames`. `inner` contains the name spaces
    inside it, by the names after `as`.
    """

    path: Path
    names: dict[str, ast.Name] = field(default_factory=dict)
    values: set[str] = field(default_factory=set)
    rules: set[str] = field(default_factory=set)
    aliases: set[str] = field(default_factory=set)
    topics: dict[str, ast.Name] = field(default_factory=dict)
    frames: dict[str, ast.Name] = field(default_factory=dict)
    inner: dict[str, ast.Name] = field(default_factory=dict)

    def take(self, item: ast.Item) -> None:
        """Record the declarations of an item."""
        if isinstance(item, ast.Parameter) and item.meaning is not ast.Meaning.VALUE:
            return
        if isinstance(item, _DECLARING):
            self.names.setdefault(item.name.text, item.name)
            if isinstance(item, ast.Constant | ast.Parameter | ast.Input):
                self.values.add(item.name.text)
        elif isinstance(item, ast.Rule) and item.name is not None:
            self.rules.add(item.name.text)
        elif isinstance(item, ast.System):
            declared = (each for each in item.members if isinstance(each, ast.TopicDeclaration))
            self.aliases.update(each.alias.text for each in declared if each.alias is not None)


Spaces = Mapping[Path, Space]


def flat(path: Path, name: str) -> str:
    """The name, after this stage, of a name in a name space."""
    return "_".join((*path, name))


@dataclass
class Instances:
    """The data that messages need.

    `names` are the names that this stage has created, each with its name space and the name there.
    For each file of an instance there are its name space, and the imports that lead to it.
    `guesses` is the remaining effort for suggestions about misspelt names. `frames` are the names
    of frames.
    """

    names: dict[str, tuple[Path, str]] = field(default_factory=dict)
    files: dict[SourceFile, tuple[Path, tuple[ast.Import, ...]]] = field(default_factory=dict)
    guesses: Suggestions = field(default_factory=Suggestions)
    frames: set[str] = field(default_factory=set)
