"""Constants of message definitions: `GoalStatus.ABORTED`."""

from __future__ import annotations

from collections.abc import Mapping

from dslkit.diagnostics import DidYouMean, listed
from rossmarie.check.model import Value
from rossmarie.check.names.errors import AmbiguousMessage, UnknownMessageConstant
from rossmarie.check.scopes.context import Context
from rossmarie.check.wording.suggestions import near_name, rename
from rossmarie.syntax import ast
from rossmarie.types import MessageDefinitionError, Quantity, Text, Type, Unknown
from rossmarie.types.definitions import Constant
from rossmarie.units import DIMENSIONLESS

_MOST_SHOWN = 12


def names_a_message(name: str, context: Context) -> bool:
    """Say whether a name is the name of a message with constants, without its package."""
    return bool(_messages(name, context))


def type_of_message_constant(node: ast.Member, message: ast.Name, context: Context) -> Type:
    """The type of a constant of a message. Its value is recorded."""
    found = _messages(message.text, context)
    name = node.member.text
    values = {constants[name] for constants in found.values() if name in constants}
    if len(values) > 1:
        return _report_ambiguous(message, found, context)
    if not values:
        return _report_unknown(node.member, message.text, found, context)
    (value,) = values
    if isinstance(value, str):
        context.values[node] = Value(Text(), text=value)
        return Text()
    context.values[node] = Value(Quantity(DIMENSIONLESS), (value,))
    return Quantity(DIMENSIONLESS)


def _messages(name: str, context: Context) -> Mapping[str, Mapping[str, Constant]]:
    """The messages with this name, and their constants: messages in inputs, or else all known
    messages.
    """
    catalog = context.messages
    if catalog is None:
        return {}
    try:
        types = dict.fromkeys(each.message_type for each in context.inputs.values())
        used = dict.fromkeys(part for type_ in types for part in catalog.parts(type_))
        near = [each for each in used if each.rpartition("/")[2] == name]
        found = {each: catalog.constants(each) for each in near or catalog.called(name)}
    except MessageDefinitionError:
        return {}  # reported at the place where the message is read
    return {each: constants for each, constants in found.items() if constants}


def _report_ambiguous(
    message: ast.Name, found: Mapping[str, Mapping[str, Constant]], context: Context
) -> Type:
    finding = AmbiguousMessage(identifier=message.text, messages=listed(tuple(found)))
    context.collector.add(finding.at(message.span))
    return Unknown()


def _report_unknown(
    name: ast.Name, message: str, found: Mapping[str, Mapping[str, Constant]], context: Context
) -> Type:
    known = tuple(dict.fromkeys(each for constants in found.values() for each in constants))
    finding = UnknownMessageConstant(identifier=name.text, message=message)
    near = near_name(name.text, known)
    if near is not None:
        help = DidYouMean(near=near)
        context.collector.add(finding.at(name.span, help=help, fix=rename(name, near)))
    else:
        shown = finding.Known(known=listed(known[:_MOST_SHOWN]))
        context.collector.add(finding.at(name.span, help=shown))
    return Unknown()
