"""Run a tree of primitives that do nothing, in a separate process.

Usage: `ezskiros_engine.py ENGINE TREE NODES`. ENGINE is `ezskiros` or `py_trees`. `py_trees` runs
behaviors that do nothing, in composites of py_trees, without skills, parameters and conditions.
TREE is a key of `TREES`. The program prints a line of JSON: the CPU time of the first tick,
including the construction of the tree, and the median of the later ticks (s). The check has already
run `expandBT`.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
from collections.abc import Callable

TICKS = 50
TREES = {
    "parallel": ("parallelff", "step"),
    "serial": ("serial", "success"),
    "serialstar": ("serialstar", "step"),
    "nested": ("serial", "step"),
}
"""The processor, and the method that its children call: to go on running, or to succeed."""


def with_ezskiros(tree: str, nodes: int) -> Callable[[], object]:
    """The function that makes a tick; the first call also constructs the tree."""
    from ezskiros import SkillDescription
    from ezskiros.engine.execution_context import ExecutionContext
    from ezskiros.engine.expansion import Expansions
    from ezskiros.engine.task import Task
    from ezskiros.engine.world import World
    from ezskiros.ontology import Ontology
    from ezskiros.session import NOWHERE
    from ezskiros.skills.calls import SkillCall
    from ezskiros.trees.expand import expand
    from ezskiros.trees.library import Library

    processor, said = TREES[tree]

    class Leaf(SkillDescription):
        def description(self, Number: int) -> None:  # noqa: N803
            """Declare no conditions."""

    class leaf(Leaf.SkillBase):  # noqa: N801
        def execute(self) -> object:
            return getattr(self, said)("at it")

    class Whole(SkillDescription):
        def description(self) -> None:
            """Declare no conditions."""

    class whole(Whole.SkillBase):  # noqa: N801
        def expandBT(self, _params: object) -> None:  # noqa: N802
            grow = getattr(self, processor)
            if tree != "nested":
                grow(*[Leaf(Number=number) for number in range(nodes)])
                return
            node = Leaf(Number=1)
            for _ in range(nodes):
                node = grow(node)

    # The classes have to be in the module, as in skills files.
    globals().update({each.__name__: each for each in (leaf, whole)})
    library = Library({})
    trees = list(expand(whole, library.skill(Whole)))  # `ezskiros run` checks before it runs
    execution = ExecutionContext(library, World(Ontology(())), expansions=Expansions(trees))
    call = SkillCall(Whole, None, {}, NOWHERE)
    made: list[Task] = []

    def tick() -> object:
        if not made:
            made.append(Task(call, execution))
        return made[0].tick()

    return tick


def with_py_trees(tree: str, nodes: int) -> Callable[[], object]:
    """The function that makes a tick; the first call also constructs the tree."""
    from py_trees import composites
    from py_trees.behaviour import Behaviour
    from py_trees.common import ParallelPolicy, Status

    processor, said = TREES[tree]
    result = Status.RUNNING if said == "step" else Status.SUCCESS

    class Leaf(Behaviour):
        def update(self) -> Status:
            return result

    def composite(children: list[Behaviour]) -> Behaviour:
        if processor == "parallelff":
            policy = ParallelPolicy.SuccessOnAll(synchronise=False)
            return composites.Parallel("parallel", policy=policy, children=children)
        return composites.Sequence("serial", memory=processor == "serialstar", children=children)

    def built() -> Behaviour:
        if tree != "nested":
            return composite([Leaf(f"leaf {number}") for number in range(nodes)])
        node: Behaviour = Leaf("leaf")
        for _ in range(nodes):
            node = composite([node])
        return node

    made: list[Behaviour] = []

    def tick() -> object:
        if not made:
            made.append(built())
        made[0].tick_once()
        return made[0].status

    return tick


def main() -> None:
    """Measure and print."""
    engine, tree, nodes = sys.argv[1], sys.argv[2], int(sys.argv[3])
    make = with_ezskiros if engine == "ezskiros" else with_py_trees
    tick = make(tree, nodes)
    if engine != "ezskiros":
        sys.setrecursionlimit(20_000)  # EzSkiROS raises the limit itself
    times = []
    for _ in range(TICKS):
        # This is the time of the thread. Descriptions have a limit on the time of the process, and
        # for a while the limit makes the clock of the process as coarse as the scheduler.
        start = time.thread_time()
        state = tick()
        times.append(time.thread_time() - start)
    assert getattr(state, "name", "") == ("RUNNING" if TREES[tree][1] == "step" else "SUCCESS")
    print(json.dumps({"start": times[0], "tick": statistics.median(times[1:])}))


if __name__ == "__main__":
    main()
