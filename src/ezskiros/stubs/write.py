"""Conversion of an ontology to the text of a stub (`.pyi`).

The stub replaces a module that loads the ontology and names its namespaces. Type checkers do not
know classes that are created at run time, so the stub has a class for each class, and one for each
namespace around them. All other names in it begin with `_`, so that no name of an ontology hides
them.
"""

from __future__ import annotations

from collections.abc import Iterator
from textwrap import indent

from ezskiros.ontology import Ontology
from ezskiros.ontology.model import Union
from ezskiros.ontology.symbols import OntologyClass, Thing
from ezskiros.stubs.members import AMBIGUOUS, MemberMeaning, OntologyClasses, members
from ezskiros.stubs.places import ELSEWHERE, alias, namespaces, qualified
from ezskiros.stubs.values import value_type

_HEAD = '''\
# Written by `ezskiros stubs`. Change the ontology instead.
# ruff: noqa
# fmt: off
# mypy: disable-error-code="assignment, misc, override"
# pyright: reportIncompatibleMethodOverride=false, reportIncompatibleVariableOverride=false
"""The ontology, for type checkers."""

from builtins import bool as _bool, float as _float, int as _int, str as _str
from typing import Generic as _Generic, Literal as _Literal, NoReturn as _Nothing
from typing import TypeAlias as _TypeAlias, TypeVar as _TypeVar

from ezskiros.ontology.model import Individual as _Individual
from ezskiros.ontology.symbols import Condition as _Condition

_T = _TypeVar("_T")
_N = _TypeVar("_N")

class _Value(_Condition, _Generic[_T]):
    """A data property. Alone, it is the condition that a value exists."""
    def __eq__(self, value: _T, /) -> _Condition: ...
    def __ne__(self, value: _T, /) -> _Condition: ...
    def __lt__(self, value: _Nothing, /) -> _Condition: ...
    def __le__(self, value: _Nothing, /) -> _Condition: ...
    def __gt__(self, value: _Nothing, /) -> _Condition: ...
    def __ge__(self, value: _Nothing, /) -> _Condition: ...

class _Ordered(_Value[_T], _Generic[_T, _N]):
    """A data property with numbers."""
    def __lt__(self, value: _N, /) -> _Condition: ...
    def __le__(self, value: _N, /) -> _Condition: ...
    def __gt__(self, value: _N, /) -> _Condition: ...
    def __ge__(self, value: _N, /) -> _Condition: ...

class _Number(_Ordered[_float, _float]): ...
class _Whole(_Ordered[_int, _int]): ...
class _Text(_Value[_str]): ...
class _Truth(_Value[_bool]): ...
class _Anything(_Ordered[_float | _str | _bool, _float]): ...

class _Ambiguous:
    """Several namespaces have this name: write `namespace.name(Subject, ...)`."""
'''


def write_stub(ontology: Ontology) -> str:
    """The stub of a module with the name `world` for the ontology, and with the names of its
    namespaces.
    """
    return _Writer(ontology).text()


class _Writer:
    """The text of one ontology."""

    def __init__(self, ontology: Ontology) -> None:
        self._ontology, self._model = ontology, ontology.model
        self._classes = OntologyClasses(ontology)
        self._members = members(ontology, self._classes)
        self._namespaces = namespaces(ontology, self._classes.known)
        self._spelled: dict[OntologyClass, str] = {Thing: "_Thing"}
        own = {each.iri: each for each in self._classes.known if each is not Thing}
        for namespace, inside in self._namespaces.items():
            for name, iri in inside.items():
                if iri in own:
                    self._spelled[own[iri]] = qualified(namespace, name)
        self._types: dict[tuple[Union, ...], str] = {}

    def text(self) -> str:
        """The whole text."""
        doc = _doc("An individual of the world model.")
        top = _block("class _Thing:", doc, *self._attributes(Thing))
        bodies = [_block(f"class {name}:", *self._inside(name)) for name in self._namespaces]
        public = [name for name in self._namespaces if name != ELSEWHERE]
        aliases = "".join(f"{alias(name)}: _TypeAlias = {name}\n" for name in public)
        again = [f"{name}: _TypeAlias = {alias(name)}" for name in public]
        world = _block("class world:", _doc("All namespaces of the ontology."), *again)
        return "\n".join([_HEAD, top, *bodies, aliases, *([] if "world" in public else [world])])

    def _inside(self, namespace: str) -> list[str]:
        """The content of a namespace: classes, then relations and data properties, then
        individuals.
        """
        model = self._model
        owl_classes, functions, individuals = [], [], []
        for name, iri in self._namespaces[namespace].items():
            if iri in model.classes or namespace == ELSEWHERE:
                owl_classes.append(self._class(qualified(namespace, name), name, iri))
            elif model.property(iri) is not None:
                functions.append(self._function(name, iri))
            else:
                individuals.append(_attribute(name, "_Individual", model.individuals[iri].comment))
        return [*owl_classes, *functions, *individuals]

    def _class(self, place: str, name: str, iri: str) -> str:
        """A class, or an alias for an equivalent class."""
        found = self._ontology.class_of(iri)
        if self._spelled[found] != place:
            return f"{name}: _TypeAlias = {self._spelled[found]}"
        bases = [self._spelled[each] for each in found.__bases__ if isinstance(each, OntologyClass)]
        known = self._model.classes.get(iri)
        head = f"class {name}({', '.join(bases)}):"
        return _block(head, _doc(known.comment if known else ""), *self._attributes(found))

    def _attributes(self, owl_class: OntologyClass) -> Iterator[str]:
        """The relations and data properties that this class adds."""
        for name, meaning in sorted(self._members[owl_class].items()):
            yield self._member(name, meaning)

    def _member(self, name: str, meaning: MemberMeaning) -> str:
        if meaning == AMBIGUOUS:
            return _attribute(name, "_Ambiguous", "")
        found = self._model.property(meaning.iri)
        comment = found.comment if found else ""
        if meaning.iri in self._model.values:
            return _attribute(name, value_type(self._model, meaning.iri), comment)
        wanted = self._type(meaning.wanted)
        return _block(f"def {name}(self, other: {wanted}, /) -> _Condition:", _doc(comment))

    def _function(self, name: str, iri: str) -> str:
        """A relation or data property by itself, with its subject as the first argument."""
        model = self._model
        found = model.property(iri)
        subject = f"subject: {self._type(model.domain(iri))}"
        if iri in model.relations:
            taken = f"{subject}, other: {self._type(model.range(iri))}, /"
            result = "_Condition"
        else:
            taken, result = f"{subject}, /", value_type(model, iri)
        doc = _doc(found.comment if found else "")
        return "@staticmethod\n" + _block(f"def {name}({taken}) -> {result}:", doc)

    def _type(self, wanted: tuple[Union, ...]) -> str:
        """The type for objects that are in all of these unions."""
        if wanted not in self._types:
            names = sorted(self._spelled[each] for each in self._classes.widest(wanted))
            self._types[wanted] = " | ".join(names) or "_Nothing"
        return self._types[wanted]


def _block(head: str, *body: str) -> str:
    """A class or function with its body, without empty lines."""
    lines = [each for each in body if each]
    if not lines:
        return f"{head} ...\n"
    return f"{head}\n{indent(''.join(_ended(each) for each in lines), '    ')}"


def _ended(text: str) -> str:
    return text if text.endswith("\n") else f"{text}\n"


def _attribute(name: str, kind: str, comment: str) -> str:
    return "\n".join(filter(None, (f"{name}: {kind}", _doc(comment))))


def _doc(comment: str) -> str:
    """A comment of the ontology as a Python docstring."""
    quoted = comment.replace("\\", "\\\\").replace('"', '\\"')
    return f'"""{quoted}"""' if comment else ""
