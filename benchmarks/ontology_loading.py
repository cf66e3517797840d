"""Load an ontology with one library, in a separate process: `ontology_loading.py LIBRARY FILE...`.

The program prints a line of JSON: the CPU times to import the library, to load the ontology, and to
find all classes and all their superclasses (s); the numbers of classes and superclasses; and the
peak memory of the process (MiB).
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterable
from itertools import pairwise
from pathlib import Path

Classes = dict[str, Iterable[str]]
"""The classes with the names of their superclasses; each class includes itself."""
Load = Callable[[], Callable[[], Classes]]
"""A function that loads the files. Its result is a function that finds the classes."""


def ezskiros(files: list[Path]) -> Load:
    """EzSkiROS, including its knowledge of SkiROS2's relations."""
    from ezskiros.ontology import load

    def run() -> Callable[[], Classes]:
        model = load(*files).model
        return lambda: {iri: model.above(iri) for iri in model.classes}

    return run


def rdflib(files: list[Path]) -> Load:
    """One graph of rdflib, in which superclasses are followed."""
    from rdflib import OWL, RDF, RDFS, Graph, URIRef

    def run() -> Callable[[], Classes]:
        graph = Graph()
        for file in files:
            graph.parse(file, format="xml")

        def classes() -> Classes:
            found = set(graph.subjects(RDF.type, OWL.Class))
            return {
                str(each): [
                    str(above)
                    for above in graph.transitive_objects(each, RDFS.subClassOf)
                    if isinstance(above, URIRef)
                ]
                for each in found
                if isinstance(each, URIRef)
            }

        return classes

    return run


def owlready2(files: list[Path]) -> Load:
    """One world of owlready2. It follows imports by file name, so some files are already loaded."""
    import owlready2 as library

    library.onto_path += sorted({str(file.parent) for file in files})

    def run() -> Callable[[], Classes]:
        world = library.World()
        for file in files:
            if file.stem not in {each.name for each in world.ontologies.values() if each.loaded}:
                world.get_ontology(file.as_uri()).load(only_local=True)
        return lambda: {
            each.iri: [above.iri for above in each.ancestors()] for each in world.classes()
        }

    return run


LIBRARIES = {"ezskiros": ezskiros, "rdflib": rdflib, "owlready2": owlready2}
THING = "http://www.w3.org/2002/07/owl#Thing"


def most_memory() -> float:
    """The peak memory of this process in MiB, from Linux (`getrusage` would include the parent
    process).
    """
    lines = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
    (most,) = (line for line in lines if line.startswith("VmHWM:"))
    return int(most.split()[1]) / 1024


def main() -> None:
    """Measure and print."""
    library, *names = sys.argv[1:]
    files = [Path(name).resolve() for name in names]
    instants = [time.process_time()]
    load = LIBRARIES[library](files)
    instants.append(time.process_time())
    ask = load()
    instants.append(time.process_time())
    classes = ask()
    instants.append(time.process_time())
    imported, loaded, asked = (b - a for a, b in pairwise(instants))
    above = sum(len({*each} - {THING}) for each in classes.values())
    print(
        json.dumps(
            {
                "import": imported,
                "load": loaded,
                "ask": asked,
                "classes": len(classes),
                "above": above,
                "mebibytes": most_memory(),
            }
        )
    )


if __name__ == "__main__":
    main()
