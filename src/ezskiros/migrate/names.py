"""The names of ontology entities and of EzSkiROS in a translated file."""

from __future__ import annotations

import keyword
import re
import unicodedata
from collections.abc import Collection
from dataclasses import dataclass, field

import libcst as cst

from ezskiros.migrate import errors
from ezskiros.migrate.errors import LeftError

DEFAULT_PREFIX = "skiros"
"""The prefix of names without a prefix, which SkiROS2 looks up in its own ontology."""
_RESERVED = {"rdf", "rdfs", "owl", "xsd", "xml"}
_NO_ATTRIBUTES = {"iri", "vocabulary"}
"""The attributes of entity classes that are not properties of the ontology."""


@dataclass
class FileNames:
    """The names of EzSkiROS and of the ontology that a file uses.

    `taken` are names with another meaning in the file, `ambiguous` properties of several
    namespaces, and `hidden` the parameters of the description whose conditions are read. `clashes`
    are namespaces with the name of such a parameter. With `is_qualified`, the names of EzSkiROS are
    written as `ezskiros.INFERRED`.
    """

    is_qualified: bool = False
    taken: Collection[str] = frozenset()
    ambiguous: Collection[str] = frozenset()
    ours: set[str] = field(default_factory=set)
    typing: set[str] = field(default_factory=set)
    hidden: Collection[str] = frozenset()
    clashes: set[str] = field(default_factory=set)
    namespaces: dict[str, str] = field(default_factory=dict)
    properties: set[tuple[str, str]] = field(default_factory=set)

    def like(self) -> FileNames:
        """The same spelling, without any used names."""
        return FileNames(self.is_qualified, self.taken, self.ambiguous)

    def without(self, names: Collection[str]) -> FileNames:
        """The same spelling, with more names that have another meaning."""
        return FileNames(self.is_qualified, {*self.taken, *names}, self.ambiguous)

    def add(self, other: FileNames) -> None:
        """Add the names that other files use."""
        self.ours |= other.ours
        self.typing |= other.typing
        self.clashes |= other.clashes
        self.namespaces |= other.namespaces
        self.properties |= other.properties

    def unclear(self) -> set[str]:
        """The names of properties that are used from several namespaces."""
        names = [name for _, name in self.properties]
        return {name for name in names if names.count(name) > 1}

    def our(self, name: str) -> str:
        """Spell a name of EzSkiROS."""
        self.ours.add(name)
        return f"ezskiros.{name}" if self.is_qualified else name

    def with_key(self, annotation: str, key: str) -> str:
        """The type of a parameter whose key differs from its name."""
        self.typing.add("Annotated")
        annotated = "typing.Annotated" if self.is_qualified else "Annotated"
        return f"{annotated}[{annotation}, {self.our('Key')}({_quoted(key)})]"

    def entity(self, light: str, node: cst.CSTNode) -> str:
        """The Python name of a class or property, such as `skiros.Product` for `skiros:Product`.

        Raises `LeftError` for names that no robot ontology has.
        """
        prefix, name = split(light, node)
        namespace = self.namespaces.setdefault(prefix, self._free(prefix))
        self.clashes |= {namespace} & {*self.hidden}
        is_attribute = is_name(name) and not name.startswith("_")  # also used by namespaces
        return f"{namespace}.{name}" if is_attribute else f'{namespace}["{name}"]'

    def attribute(self, subject: str, light: str, node: cst.CSTNode) -> str | None:
        """A property as an attribute, such as `Robot.at` for `skiros:at`.

        None if the property needs its namespace: other ontologies may have names of SkiROS2's own
        ontology as well. Raises `LeftError`.
        """
        prefix, name = split(light, node)
        self.properties.add((prefix, name))
        is_plain = is_name(name) and not name.startswith("_") and name not in _NO_ATTRIBUTES
        is_clear = prefix == DEFAULT_PREFIX and name not in self.ambiguous
        return f"{subject}.{name}" if is_plain and is_clear else None

    def _free(self, prefix: str) -> str:
        name = prefix
        while name in self.taken:
            name += "_"
        return name


def _quoted(text: str) -> str:
    """A text as a Python literal, in double quotes if it contains none."""
    return repr(text) if '"' in text else f'"{repr(text)[1:-1]}"'


def split(light: str, node: cst.CSTNode) -> tuple[str, str]:
    """The prefix and the name in a text such as `skiros:Product`. Raises `LeftError`."""
    prefix, colon, name = light.rpartition(":")
    prefix = prefix if colon and prefix else DEFAULT_PREFIX
    is_odd = prefix in _RESERVED or not is_name(prefix) or re.search(r'["\\#/\s]', name)
    if is_odd or not name:
        raise LeftError(errors.NoNamespace(found=light), node)
    return prefix, name


def is_name(text: str) -> bool:
    """Say whether a text is a Python name that Python does not change."""
    is_plain = text.isidentifier() and not keyword.iskeyword(text)
    return is_plain and unicodedata.normalize("NFKC", text) == text
