"""Small files that stand for gigabytes or minutes: each gets a located finding, within limits.

The limits of the product are on the page docs/reference/limits.md; those of these tests are wider,
because other programs run beside them.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from pathlib import Path

import pytest

from support.ontologies import HALL

MEMORY = 3 << 30
"""Address space of a command, most of which libraries reserve and do not use."""
SECONDS = 60.0


def run(program: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """An installed program in a process of its own that may take so much memory and time."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

    return subprocess.run(
        [Path(sys.executable).with_name(program), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=SECONDS,
        check=False,
        preexec_fn=limit,
    )


# --- ontologies and scenes -------------------------------------------------------------------

RDF = '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:e="http://e#">'
NESTED = 300_000


def laughs(before: str = "", after: str = "") -> str:
    """Nine entities, each of which is ten of the one before: 10 GB of text."""
    values = ["haha haha ", *(f"&a{i};" * 10 for i in range(9))]
    declared = "\n".join(f'<!ENTITY a{i} "{value}">' for i, value in enumerate(values))
    head = f"<!DOCTYPE rdf:RDF [{before}\n{declared}\n{after}]>"
    return f'{head}\n{RDF}<e:A e:b="&a9;"/></rdf:RDF>'


def repeated() -> str:
    """A long entity that is used often; 20 GB of text."""
    entity = f'<!ENTITY a "{"a" * 100_000}">'
    return f"<!DOCTYPE r [\n{entity}]>\n{RDF}\n" + '<e:A e:b="&a;"/>' * 200_000 + "</rdf:RDF>"


def namespaces() -> str:
    declared = " ".join(f'xmlns:e{i}="http://e#"' for i in range(50_000))
    nothing = "<rdf:Description rdf:about='http://x'/>" * 100_000
    return f"{RDF.replace('>', ' ' + declared + '>')}{nothing}</rdf:RDF>"


ONTOLOGIES = {
    "entities in entities.owl": (laughs(), 3),
    "entities in a comment.owl": (laughs("<!--", "-->"), 3),
    "an entity from elsewhere.owl": ('<!DOCTYPE r [<!ENTITY a SYSTEM "/etc/passwd">]>' + RDF, 1),
    "a long entity.owl": (repeated(), 4),
    "deep elements.owl": (f"{RDF}\n" + "<rdf:Description><e:a>" * NESTED, 2),
    "many namespaces.owl": (namespaces(), 1),
    "deep objects.jsonld": ('\n{"http://b":' * NESTED + "1" + "}" * NESTED, 202),
    "deep lists.jsonld": ('{"http://b":\n' + "[" * NESTED + "]" * NESTED + "}", 2),
    "deep terms.ttl": ("<a:a> <a:b>\n" + "<<( <a:a> <a:b> " * NESTED + "1" + " )>>" * NESTED, 2),
    "deep terms.nt": ("<a:a> <a:b> " + "<<( <a:a> <a:b> " * NESTED + "1" + " )>>" * NESTED, 1),
    "a long subject.ttl": (f"<http://x/{'a' * 1_000_000}> <http://p> {'1,' * 20_000}1.", 1),
    "a long prefix.ttl": (
        f"@prefix a: <http://x/{'a' * 1_000_000}> ." + "a:a a:b a:c . " * 9_999,
        1,
    ),
}


def check_ontology(path: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """A check of a module that loads an ontology, and nothing else."""
    module = path.with_name("skills.py")
    module.write_text("from ezskiros.ontology import load\n\nload()\n")
    return run("ezskiros", "check", "--ontology", path, module, *options)


@pytest.mark.parametrize("name", ONTOLOGIES)
def test_ontologies_beyond_a_limit_are_told_at_their_place(name: str, tmp_path: Path) -> None:
    text, line = ONTOLOGIES[name]
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    done = check_ontology(path, "--format", "json")
    found = {each["code"]: each["primary"] for each in json.loads(done.stdout)["diagnostics"]}
    assert found["EZS107"]["file"] == str(path)
    assert found["EZS107"]["start"]["line"] == line
    assert done.returncode == 1, done.stderr


def test_a_file_larger_than_an_ontology_may_be_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.ttl"
    with path.open("wb") as file:
        file.truncate(8 << 30)  # without a block on the disk
    done = check_ontology(path)
    assert "EZS107" in done.stdout, done.stderr
    assert done.returncode == 1


@pytest.mark.parametrize("name", ["deep terms.ttl", "a long subject.ttl"])
def test_scenes_beyond_a_limit_are_told(name: str, tmp_path: Path) -> None:
    scene = tmp_path / "scene.turtle"
    scene.write_text(ONTOLOGIES[name][0], encoding="utf-8")
    done = run("ezskiros", "check", scene, "--ontology", HALL)
    assert "EZS107" in done.stdout, done.stderr
