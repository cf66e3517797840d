"""The variants of the experiments. The module needs no simulation."""

from __future__ import annotations

import enum
from collections.abc import Mapping


class ExperimentArm(str, enum.Enum):
    """The guard of the robot in an experiment."""

    NONE = "none"
    COLLISION_MONITOR = "collision_monitor"  # zones of a range scan slow it down and stop it
    DEROS = "deros"  # rules stop it until an operator comes
    ROSSMARIE = "rossmarie"  # by rules, it recovers
    SKILL_AWARE = "skill_aware"  # the same, by rules that know which skills run
    PROACTIVE = "proactive"  # the same, by rules that look ahead
    TREES = "trees"  # the same, by rules that let it run behavior trees
    LEARNED = "learned"  # the same, with plans that use knowledge from earlier runs


class Terrain(str, enum.Enum):
    """The obstacle on the path of the base."""

    FLAT = "flat"  # neither bump nor ramps: whatever a monitor restricts here is without need
    GENTLE = "gentle"  # a bump, and a ramp of 12 degrees into the room
    STEEP = "steep"  # a bump, and a ramp of 25 degrees straight on


class Table(str, enum.Enum):
    """The placing of the arm: the table, and the speed of the arm."""

    EXPECTED = "expected"  # where the arm believes it
    HIGH = "high"  # some centimeters higher
    HURRIED = "hurried"  # where the arm believes it; but the motion planner wants too much


class Person(str, enum.Enum):
    """The area in which a person walks while the arm works."""

    OUTSIDE = "outside"  # past the open door: whatever a monitor restricts here is without need
    INSIDE = "inside"  # into the room, close to the arm, and out again


class Encounter(str, enum.Enum):
    """Contact of the arm, apart from that with the box and the board."""

    COLLISION = "collision"  # while it moves freely, a forearm that should not be there
    JAMMED = "jammed"  # while it pushes a box, this meets something that is fixed
    MEANT = "meant"  # nothing: whatever a monitor restricts here is without need


class Passage(str, enum.Enum):
    """The person in the corridor of a school, if there is one."""

    CHILD = "child"  # a child runs out of a door, in front of the base
    EMPTY = "empty"  # no person


class Blockage(str, enum.Enum):
    """The obstacles across the paths to a hall."""

    PALLET = "pallet"  # a pallet on the first path, permanently
    TROLLEY = "trolley"  # a trolley on the first path, which is soon removed
    BOTH = "both"  # a pallet on the first path, and a trolley on the second


class Trouble(str, enum.Enum):
    """The obstacle across the short path to a hall in most runs."""

    LASTING = "lasting"  # a pallet, permanently
    PASSING = "passing"  # a trolley, which is soon removed
    NONE = "none"  # no obstacle in any run: knowledge must cost nothing here


class Formulation(str, enum.Enum):
    """The numbers that are learned for the insertion of a peg."""

    STEPS = "steps"  # a policy: velocities and a push, in each step
    MOVES = "moves"  # a policy: one of 14 moves, in each step
    TREE = "tree"  # the numbers of a behavior tree, for each episode


class LearningArm(str, enum.Enum):
    """The part of the rules in a training."""

    UNGUARDED = "unguarded"  # they only count
    ENDED = "ended"  # an episode ends as soon as something is violated
    PENALTY = "penalty"  # their feedback is taken from the reward
    GUARD = "guard"  # they bound the executed action
    GUARD_FEEDBACK = "guard_feedback"  # both
    EXECUTED = "executed"  # as `guard`; the learner learns from what was executed


VARIANTS: Mapping[str, tuple[enum.Enum, ...]] = {
    "nav": (Terrain.GENTLE, Terrain.STEEP, Terrain.FLAT),
    "place": (Table.HIGH, Table.HURRIED, Table.EXPECTED),
    "human": (Person.INSIDE, Person.OUTSIDE),
    "contact": (Encounter.COLLISION, Encounter.JAMMED, Encounter.MEANT),
    "corridor": (Passage.CHILD, Passage.EMPTY),
    "blocked": (Blockage.PALLET, Blockage.TROLLEY, Blockage.BOTH),
    "second": (Trouble.LASTING, Trouble.PASSING, Trouble.NONE),
}
"""The variants of each experiment, by its name. The first variant is the default."""

_THESIS = (
    ExperimentArm.NONE,
    ExperimentArm.COLLISION_MONITOR,
    ExperimentArm.DEROS,
    ExperimentArm.ROSSMARIE,
)
ARMS: Mapping[str, tuple[ExperimentArm, ...]] = {
    "nav": _THESIS,
    "place": (
        ExperimentArm.NONE,
        ExperimentArm.DEROS,
        ExperimentArm.ROSSMARIE,
    ),  # no zone says anything of a table
    "human": _THESIS,
    "contact": (ExperimentArm.NONE, ExperimentArm.ROSSMARIE, ExperimentArm.SKILL_AWARE),
    "corridor": (
        ExperimentArm.NONE,
        ExperimentArm.ROSSMARIE,
        ExperimentArm.SKILL_AWARE,
        ExperimentArm.PROACTIVE,
    ),
    "blocked": (ExperimentArm.NONE, ExperimentArm.ROSSMARIE, ExperimentArm.TREES),
    "second": (ExperimentArm.TREES, ExperimentArm.LEARNED),
}
"""The guards of each experiment, by its name, in the order in which they are shown."""

ALGORITHMS: Mapping[Formulation, tuple[str, ...]] = {
    Formulation.STEPS: ("ppo", "sac"),
    Formulation.MOVES: ("ppo",),
    Formulation.TREE: ("cma-es",),
}
"""The algorithms of each formulation. The first one is the usual one."""

LEARNING_ARMS: Mapping[Formulation, tuple[LearningArm, ...]] = {
    Formulation.STEPS: tuple(LearningArm),
    Formulation.MOVES: tuple(LearningArm),
    # An optimizer sees no actions, so it cannot learn from those that were executed.
    Formulation.TREE: tuple(arm for arm in LearningArm if arm is not LearningArm.EXECUTED),
}
"""The arms of each formulation."""

BUDGETS: Mapping[Formulation, int] = {
    Formulation.STEPS: 150_000,
    Formulation.MOVES: 150_000,
    Formulation.TREE: 80_000,
}
"""The usual number of steps of a training, of all of its environments."""

LEAST_BUDGETS: Mapping[Formulation, int] = {
    Formulation.STEPS: 9_600,
    Formulation.MOVES: 9_600,
    Formulation.TREE: 1,
}
"""After so many steps there is an episode that has ended: 32 environments learn side by side, and
an episode has 300 steps at most.
"""
