"""Goals in the syntax of SkiROS2's task manager: `(skiros:at cora:Robot-1 skiros:Location-2)`.

Commas separate several goals; `(not (...))` negates a goal. The value of a data property comes
last: `(skiros:ContainerState skiros:Gripper-1 Empty)`. Individuals are given by IRI, as in a scene,
or by label; relations by name, with or without prefix.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic, DidYouMean, Remark
from dslkit.source import SourceFile, Span
from ezskiros.ontology.iris import split
from ezskiros.ontology.model import Model
from ezskiros.planning import errors
from ezskiros.planning.facts import About, Fluent, FluentLiteral

_TOKEN = re.compile(r'[(),]|"[^"]*"|[^\s(),"]+|"')


@dataclass(frozen=True)
class Goal:
    """A requested fact, and its place in the text."""

    literal: FluentLiteral
    span: Span


class GoalError(Exception):
    """An invalid goal. `diagnostic` gives the reason."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.title)
        self.diagnostic = diagnostic


def goals(text: str, model: Model, individuals: Mapping[str, str]) -> list[Goal]:
    """The goals in a text. `individuals` maps the names of individuals to IRIs. Raises
    `GoalError`.
    """
    return list(_Reader(text, model, individuals).goals())


class _Reader:
    def __init__(self, text: str, model: Model, individuals: Mapping[str, str]) -> None:
        self._file = SourceFile("the goal", text)
        self._model, self._individuals = model, individuals
        self._tokens = [(each[0], each.start(), each.end()) for each in _TOKEN.finditer(text)]
        self._at = 0

    def goals(self) -> Iterator[Goal]:
        if all(token == "," for token, _, _ in self._tokens):
            raise self._wrong("it is empty", 0, 0)
        while self._at < len(self._tokens):
            if self._peek() == ",":
                self._at += 1
                continue
            start = self._tokens[self._at][1]
            found = self._goal()
            yield Goal(found, self._span(start, self._tokens[self._at - 1][2]))

    def _goal(self) -> FluentLiteral:
        self._take("(")
        if self._peek() == "not":
            self._at += 1
            found = self._goal().negated()
            self._take(")")
            return found
        words: list[tuple[str, int, int]] = []
        while self._peek() not in (")", "(", ",", None):
            words.append(self._tokens[self._at])
            self._at += 1
        self._take(")")
        if len(words) not in (2, 3):
            end = self._tokens[self._at - 1][2]
            start = words[0][1] if words else end - 1
            raise self._wrong("brackets must contain a relation and two individuals", start, end)
        return self._fact(*words)

    def _fact(self, name: tuple[str, int, int], *rest: tuple[str, int, int]) -> FluentLiteral:
        iri = self._property(*name)
        subject = self._individual(*rest[0])
        if iri in self._model.relations:
            if len(rest) < 2:
                raise self._wrong("a relation needs two individuals", name[1], rest[0][2])
            return FluentLiteral(Fluent(About.RELATION, iri), (subject, self._individual(*rest[1])))
        if len(rest) < 2:
            return FluentLiteral(Fluent(About.PROPERTY, iri), (subject,))
        return FluentLiteral(Fluent(About.COMPARISON, iri, "=", _value(rest[1][0])), (subject,))

    def _property(self, word: str, start: int, end: int) -> str:
        """The IRI of a relation or data property, by its name with or without the prefix."""
        known: dict[str, str] = {}
        for iri in (*self._model.values, *self._model.relations):
            known.setdefault(split(iri)[1], iri)
        for iri in (*self._model.values, *self._model.relations):
            known[self._model.short(iri)] = iri
        if word in known:
            return known[word]
        found = errors.UnknownProperty(spelled=word)
        help = _near(word, known) or found.WithPrefix()
        raise GoalError(found.at(self._span(start, end), help=help))

    def _individual(self, word: str, start: int, end: int) -> str:
        name = word.strip('"')
        if name in self._individuals:
            return self._individuals[name]
        found = errors.UnknownIndividual(spelled=name)
        help = _near(name, self._individuals) or found.Known(known=_some(self._individuals))
        raise GoalError(found.at(self._span(start, end), help=help))

    # --- tokens -----------------------------------------------------------------------------------

    def _peek(self) -> str | None:
        return self._tokens[self._at][0] if self._at < len(self._tokens) else None

    def _take(self, wanted: str) -> None:
        if self._peek() != wanted:
            at = self._at
            end = len(self._file.text)
            place = self._tokens[at][1:] if at < len(self._tokens) else (max(end - 1, 0), end)
            raise self._wrong(f"`{wanted}` is missing here", *place)
        self._at += 1

    def _span(self, start: int, end: int) -> Span:
        return Span(self._file, start, end)

    def _wrong(self, why: str, start: int, end: int) -> GoalError:
        return GoalError(errors.NoGoal(why=why).at(self._span(start, end)))


def _value(word: str) -> str | int | float | bool:
    """A value from its text: a boolean or a number for texts such as `true`, `3` and `2.5`,
    otherwise a text.
    """
    if word in ("true", "false"):
        return word == "true"
    if re.fullmatch(r"[-+]?\d+", word):
        return int(word)
    if re.fullmatch(r"[-+]?(\d+\.\d*|\.\d+)([eE][-+]?\d+)?", word):
        return float(word)
    return word.strip('"')


def _near(word: str, known: Mapping[str, str]) -> Remark | None:
    near = difflib.get_close_matches(word, known, n=1, cutoff=0.5)
    return DidYouMean(near=near[0]) if near else None


def _some(individuals: Mapping[str, str]) -> str:
    shown = sorted(name for name in individuals if ":" in name)[:5]
    return ", ".join(shown) + (", ..." if len(individuals) > len(shown) else "") or "nothing"
