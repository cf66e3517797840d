"""The effect of a placement: the placeholders for the package of a node, and its package.xml."""

from __future__ import annotations

from rossmarie import ir
from rossmarie.naming import node_name
from rossmarie.targets import comments
from rossmarie.targets.manifest import Maintainer, Manifest, Placement

_VERSION = "0.1.0"
_LICENSE = "to be chosen"
_MAIL = "nobody@example.org"


def blanks(machine: ir.Machine, placement: Placement) -> dict[str, str]:
    """The package with the messages, launch file, settings and policy of the node, and their names.

    Several nodes may be parts of one package, so the files of a node there have the node's name.
    """
    node = node_name(machine)
    if placement.part_of is None:
        return {
            "home": node,
            "executable": "safety_node",
            "settings": "parameters.yaml",
            "policy": "policy.xml",
        }
    return {
        "home": placement.part_of,
        "executable": node,
        "settings": f"{node}.yaml",
        "policy": f"{node}.xml",
    }


def manifest_fields(manifest: Manifest, files: str) -> dict[str, str]:
    """The fields of package.xml from the manifest, as XML. `files` are the rules files."""
    nobody = Maintainer(f"Maintainer of {files}", _MAIL)
    maintainers = manifest.maintainers or (nobody,)
    licenses = manifest.licenses or (_LICENSE,)
    return {
        "version": manifest.version or _VERSION,
        "maintainers": "\n".join(map(_maintainer, maintainers)),
        "licenses": "\n".join(f"  <license>{comments.in_xml(each)}</license>" for each in licenses),
    }


def _maintainer(person: Maintainer) -> str:
    mail, name = comments.in_xml(person.mail), comments.in_xml(person.name)
    return f'  <maintainer email="{mail}">{name}</maintainer>'
