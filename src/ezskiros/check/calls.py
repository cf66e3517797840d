"""Checks of the children of behavior trees against the descriptions of the called skills."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from dataclasses import dataclass

from dslkit.diagnostics import DeclaredHere, Diagnostic, DidYouMean, Label, NamedHere, Remark
from dslkit.source import Span
from ezskiros.check import tree_errors as errors
from ezskiros.check.errors import DoesNotFit
from ezskiros.check.relations import misfit, wanted
from ezskiros.ontology import Ontology
from ezskiros.ontology.model import Model, Union
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    ValueComparison,
)
from ezskiros.ontology.symbols import UnknownValue, described
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.nodes import calls
from ezskiros.skills.syntax import argument_places, class_span
from ezskiros.skills.values import SymbolicValue
from ezskiros.trees.library import Implementations, Library
from ezskiros.trees.names import all_shared
from ezskiros.trees.native import native_implementations
from ezskiros.trees.tree import IndividualReference, Tree, ValueReference


def check_calls(tree: Tree, library: Library) -> Iterator[Diagnostic]:
    """Report the mismatches, child by child."""
    for call in calls(tree.root):
        skill = library.skill(call.skill)
        if skill is not None:
            yield from _Checker(tree, call, skill, library, library.ontology()).check()


@dataclass(frozen=True)
class _Checker:
    """The checks of one child."""

    tree: Tree
    call: SkillCall
    skill: SkillInterface
    library: Library
    ontology: Ontology | None

    def check(self) -> Iterator[Diagnostic]:
        """Report the mismatches in source order."""
        yield from self._implementation()
        places = argument_places(self.call.span)
        for name, value in self.call.arguments.items():
            name_span, value_span = places.get(name, (self.call.span, self.call.span))
            parameter = self.skill.parameter(name)
            if parameter is not None:
                yield from self._argument(parameter, value, value_span)
            elif name not in self.skill.unclear:
                yield self._unknown(name, name_span)
        for shared in all_shared(self.call, self.library):
            if not shared.is_passed:
                yield from self._inherited(shared.parameter)

    # --- which implementation ---------------------------------------------------------------------

    def _implementation(self) -> Iterator[Diagnostic]:
        wanted = self.call.implementation
        known = self.library.implementations(self.call.skill)
        if wanted not in known and (wanted or not known):
            native = native_implementations(self.call.skill)
            left = [each for name, each in native.items() if wanted in (None, name)]
            yield from (self._native(each) for each in left)
            if left:
                return
        if wanted is None and not known:
            found = errors.NotImplementedAnywhere(skill=self.skill.name)
            yield found.at(self.call.span, self._declaration())
        if wanted is None or wanted in known:
            return
        owner = self.library.owner(wanted)
        if owner is not None:
            other = errors.OtherSkillsImplementation(
                spelled=wanted, skill=self.skill.name, owner=owner.name
            )
            yield other.at(self._named_implementation())
            return
        near = difflib.get_close_matches(wanted, known, n=1)
        missing = errors.UnknownImplementation(spelled=wanted, skill=self.skill.name)
        labels = [missing.Near().at(class_span(known[near[0]]))] if near else []
        help = DidYouMean(near=near[0]) if near else self._known_ones(known)
        yield missing.at(self._named_implementation(), *labels, help=help)

    def _native(self, left: type) -> Diagnostic:
        """The finding is at the implementation, so it is the same for all trees that need it."""
        found = errors.NativeImplementation(implementation=left.__name__, skill=self.skill.name)
        return found.at(class_span(left))

    def _known_ones(self, known: Implementations) -> Remark | None:
        if not known:
            return None
        names = ", ".join(known)
        return errors.UnknownImplementation.Known(skill=self.skill.name, known=names)

    def _named_implementation(self) -> Span:
        """The name in `Skill.name(...)`."""
        spelled = f".{self.call.implementation}"
        start = self.call.span.text.find(spelled)
        if start < 0:
            return self.call.span
        start += self.call.span.start + 1
        return Span(self.call.span.file, start, start + len(spelled) - 1)

    # --- values of parameters ---------------------------------------------------------------------

    def _unknown(self, name: str, span: Span) -> Diagnostic:
        names = [each.name for each in self.skill.parameters]
        near = difflib.get_close_matches(name, names, n=1)
        found = errors.UnknownArgument(skill=self.skill.name, spelled=name)
        known = found.Known(known=", ".join(names) or "none")
        help = DidYouMean(near=near[0]) if near else known
        return found.at(span, self._declaration(), help=help)

    def _argument(self, parameter: Parameter, value: object, span: Span) -> Iterator[Diagnostic]:
        match value:
            case UnknownValue():
                return
            case IndividualReference(parameter=given) | ValueReference(parameter=given):
                yield from self._passed(parameter, given, span)
            case SymbolicValue() if not parameter.is_individual:
                return  # its value is known when the robot runs
            case _ if parameter.is_individual:
                found = errors.NoIndividualGiven(
                    parameter=parameter.name,
                    wanted=self._spelled(parameter),
                    found=described(value),
                )
                yield found.at(span, _declared(parameter))
            case _ if not parameter.takes(value):
                wrong = errors.WrongArgument(
                    parameter=parameter.name,
                    wanted=parameter.type.__name__,
                    found=described(value),
                )
                yield wrong.at(span, _declared(parameter))
            case _:  # open: a value of its type
                return

    def _inherited(self, parameter: Parameter) -> Iterator[Diagnostic]:
        """Check a parameter without an argument, which takes the value of the compound's parameter
        of the same name.
        """
        given = self.tree.skill.parameter(parameter.name)
        if given is not None:
            yield from self._passed(parameter, given, self.call.span)

    def _passed(self, parameter: Parameter, given: Parameter, span: Span) -> Iterator[Diagnostic]:
        """Check that a parameter of the child accepts the class of the compound's parameter."""
        labels = [_declared(parameter), _declared(given)]
        if parameter.iri is None or given.iri is None:
            if parameter.type is not given.type:
                wrong = errors.PassedMisfit(
                    given=given.name,
                    found=self._spelled(given),
                    parameter=parameter.name,
                    wanted=self._spelled(parameter),
                )
                yield wrong.at(span, *labels)
            return
        model = self.ontology.model if self.ontology else None
        if model is None:
            return
        if model.is_a(given.iri, parameter.iri):
            yield from self._never_holds(parameter, given, span, model)
            return
        is_wider = model.is_a(parameter.iri, given.iri)
        if is_wider and parameter.kind is ParameterKind.OPTIONAL:
            return  # the compound queries the outputs of the child
        kind = errors.PassedMayNotFit if is_wider else errors.PassedMisfit
        found = kind(
            given=given.name,
            found=self._spelled(given),
            parameter=parameter.name,
            wanted=self._spelled(parameter),
        )
        yield found.at(span, *labels)

    def _never_holds(
        self, parameter: Parameter, given: Parameter, span: Span, model: Model
    ) -> Iterator[Diagnostic]:
        """A pre-condition of the child that is false for every individual of the class of the
        compound's parameter, because the ontology does not allow the property for this class.
        """
        if given.iri == parameter.iri:
            return
        skill = self.library.called(self.call) or self.skill
        for clause in skill.pre:
            for iri, union in _needed(clause.statement, parameter.name, self.skill, model):
                if misfit(model, given.iri or "", union) is DoesNotFit:
                    found = errors.PassedLacksProperty(
                        given=given.name,
                        found=self._spelled(given),
                        skill=self.skill.name,
                        condition=" ".join(clause.span.text.split()),
                        property=_python(iri, model),
                        wanted=" or ".join(_python(each, model) for each in sorted(union)),
                    )
                    yield found.at(span, found.Condition().at(clause.span), _declared(given))
                    return

    def _spelled(self, parameter: Parameter) -> str:
        if parameter.iri is not None and self.ontology is not None:
            return _python(parameter.iri, self.ontology.model)
        return parameter.type.__name__

    def _declaration(self) -> Label:
        return DeclaredHere().at(self.skill.span)


def _needed(
    statement: Statement, name: str, skill: SkillInterface, model: Model
) -> Iterator[tuple[str, Union]]:
    """The properties that a condition requires of a parameter, with the classes that can have them.
    A negated condition and one of several alternatives require none.
    """
    match statement:
        case Relation(subject, iri, other, is_true, is_abstract):
            is_asked = is_true and not is_abstract
            if is_asked and subject == name:
                yield from ((iri, union) for union in model.domain(iri))
            if is_asked and other == name:
                yield from ((iri, union) for union in wanted(skill, model, subject, iri))
        case HasProperty(subject, iri, is_true) | ValueComparison(subject, iri, _, _, is_true):
            if is_true and subject == name:
                yield from ((iri, union) for union in model.domain(iri))
        case AnyOf() | OfType() | Specified() | Generated():
            return


def _python(iri: str, model: Model) -> str:
    return model.short(iri).replace(":", ".")


def _declared(parameter: Parameter) -> Label:
    return NamedHere(name=parameter.name).at(parameter.span)
