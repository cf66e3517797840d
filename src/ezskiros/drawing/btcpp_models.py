"""The models of nodes for BehaviorTree.CPP: their ports with types, and their conditions."""

from __future__ import annotations

import enum
import xml.etree.ElementTree as ET

from ezskiros.check.spelled import spelled
from ezskiros.ontology import Ontology
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind

TYPES = {float: "double", int: "int", bool: "bool", str: "std::string"}
# fmt: off
BUILT_IN = frozenset((
    "Action", "AlwaysFailure", "AlwaysSuccess", "AsyncFallback", "AsyncSequence", "BehaviorTree",
    "Condition", "Control", "Decorator", "Delay", "EntryUpdated", "Fallback", "ForceFailure",
    "ForceSuccess", "IfThenElse", "Inverter", "KeepRunningUntilFailure", "LoopBool", "LoopDouble",
    "LoopInt", "LoopString", "ManualSelector", "Parallel", "ParallelAll", "Precondition",
    "ReactiveFallback", "ReactiveSequence", "Repeat", "RetryUntilSuccesful",
    "RetryUntilSuccessful", "Root", "RunOnce", "Script", "ScriptCondition", "Sequence",
    "SequenceWithMemory", "SetBlackboard", "SkipUnlessUpdated", "Sleep", "SubTree", "Switch2",
    "Switch3", "Switch4", "Switch5", "Switch6", "Timeout", "TryCatch", "UnsetBlackboard",
    "WaitValueUpdate", "WasEntryUpdated", "WhileDoElse", "root",
))
# fmt: on
"""Names of nodes that version 4 registers itself, and words of its XML."""


def model_of(kind: str, name: str, skill: SkillInterface, ontology: Ontology | None) -> ET.Element:
    """The model of a node. The notes of an action are its conditions, which the action has to check
    itself.

    Individuals are texts there: their names in the world model.
    """
    found = ET.Element(kind, ID=name)
    for parameter in skill.parameters:
        port = ET.SubElement(found, _direction(parameter), name=parameter.name)
        port.set("type", _type(parameter))
        if parameter.default is not None:
            port.set("default", literal(parameter.default, parameter, is_inside=False)[0])
        if parameter.iri is not None and ontology is not None:
            port.text = ontology.model.short(parameter.iri)
    notes = ET.Element("MetadataFields")
    for role, clauses in (("pre", skill.pre), ("hold", skill.hold), ("post", skill.post)):
        for number, clause in enumerate(clauses, 1):
            text = spelled(clause.statement, ontology.model) if ontology else clause.span.text
            ET.SubElement(notes, "Metadata", {f"{role}_{number}": text})
    if len(notes) and kind == "Action":
        found.append(notes)
    return found


def _direction(parameter: Parameter) -> str:
    """The direction of a port: output, possible output, or input."""
    if parameter.is_output:
        return "output_port"
    may_be_found = parameter.kind is not ParameterKind.REQUIRED and parameter.default is None
    return "inout_port" if may_be_found else "input_port"


def _type(parameter: Parameter) -> str:
    if issubclass(parameter.type, enum.Enum):
        kinds = {type(each.value) for each in parameter.type}
        return TYPES.get(kinds.pop(), "std::string") if len(kinds) == 1 else "std::string"
    return TYPES.get(parameter.type, "std::string")


def literal(given: object, parameter: Parameter, *, is_inside: bool) -> tuple[str, str | None]:
    """A value as the text of a port, and the reason why BehaviorTree.CPP would read another value.

    With `is_inside`, a subtree gets the value, and texts that look like numbers are read as
    numbers.
    """
    value = given.value if isinstance(given, enum.Enum) else given
    if isinstance(value, bool):
        return str(value).lower(), None
    if parameter.type is float and isinstance(value, (int, float)):
        return str(float(value)), None
    if isinstance(value, int) and not -(2**31) <= value < 2**31:
        return str(value), "BehaviorTree.CPP stores integers in 32 bits"
    return str(value), _why_not(value, is_inside=is_inside) if isinstance(value, str) else None


def _why_not(text: str, *, is_inside: bool) -> str | None:
    """The reason why BehaviorTree.CPP cannot read a text literally; None if it can."""
    if text.startswith("{") and text.endswith("}"):
        return "in XML, a text in braces names an entry of the blackboard"
    if any(ord(each) < 32 and each not in "\t\n\r" for each in text):
        return "XML does not allow these characters"
    if is_inside and _is_number(text):
        return "a subtree reads a text that looks like a number as a number"
    return None


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
