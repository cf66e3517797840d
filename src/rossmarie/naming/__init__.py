"""Names of the parts of a guard, for its users, other nodes and reports."""

from rossmarie.naming.effects import effect_target, effect_words
from rossmarie.naming.identifiers import c_identifier, public_prefix
from rossmarie.naming.node import node_name, relayed_servers, unfiltered

__all__ = [
    "c_identifier",
    "effect_target",
    "effect_words",
    "node_name",
    "public_prefix",
    "relayed_servers",
    "unfiltered",
]
