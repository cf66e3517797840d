"""The known facts about a robot before it runs: names, and the relations between rules and
skills.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from crosscheck.exemptions import exemptions_of
from crosscheck.kinds import KINDS, permissions_of, signals_of
from crosscheck.robot import Robot
from dslkit.source import Span
from rossmarie.ir import Rule
from rossmarie.ir.taking import Taking, takings
from rossmarie.naming import node_name
from rossmarie.skills import Permission, Skill


@dataclass(frozen=True)
class Facts:
    """A robot in a ROS namespace, such as `/robot1`; empty for the global namespace. `takings` has
    the takings of each skill, `rests` the permissions behind each exemption, with their skills.
    """

    robot: Robot
    namespace: str
    rules: Mapping[str, Rule]
    takings: Mapping[str, Sequence[Taking]]
    rests: Mapping[str, Sequence[tuple[Skill, Permission]]]

    @property
    def package(self) -> str:
        """The package of the node of the rules. The node has the same name."""
        return node_name(self.robot.machine)

    @property
    def node(self) -> str:
        """The full name of the node of the rules."""
        return f"{self.namespace}/{self.package}"

    @property
    def topic(self) -> str:
        """The full name of the topic that reports the running skills."""
        return f"{self.namespace}{self.robot.skills.topic}"

    @property
    def timeout(self) -> float:
        """The seconds for which the rules wait for the context."""
        assert self.robot.program.skills is not None, "a robot has skills"
        return self.robot.program.skills.timeout_ns / 1e9

    @property
    def declaration(self) -> Span:
        """The place where the rules name their skills file."""
        assert self.robot.program.skills is not None, "a robot has skills"
        return self.robot.program.skills.declaration.span

    def permitted(self, exemption: str, running: Iterable[str]) -> str:
        """The permissions of running skills behind an exemption, in words. If no running skill is
        known, all permissions behind the exemption.
        """
        found, names = self.rests[exemption], {*running}
        known = [each for each in found if each[0].name in names] or found
        words = (
            f"`{skill.name}` permits {permission} ({self.robot.span_of(permission.place)})"
            for skill, permission in known
        )
        return ", ".join(dict.fromkeys(words)) or "no permission"


def facts_of(robot: Robot, namespace: str) -> Facts:
    """The facts about a robot."""
    return Facts(
        robot=robot,
        namespace=namespace,
        rules={rule.name: rule for rule in robot.machine.rules},
        takings={
            name: tuple(takings(robot.machine, skill.uses))
            for name, skill in robot.skills.skills.items()
        },
        rests={name: tuple(found) for name, found in _rests(robot)},
    )


def _rests(robot: Robot) -> Iterator[tuple[str, Iterator[tuple[Skill, Permission]]]]:
    """Each rule that reports an exemption, with the permissions of its skills for the signals of
    the exempted rule. If none of these signals can be permitted, all permissions of the skills.
    """
    exempted = {id(each.written): each for each in exemptions_of(robot)}
    for number, rule in enumerate(robot.machine.rules):
        written = robot.program.rules[number].made_from
        if rule.exempts is None or written is None:
            continue
        found = exempted[id(written)]
        kinds = [kind for kind in KINDS if signals_of(robot.machine, found.rule, kind)]
        yield (
            rule.name,
            (
                (skill, permission)
                for skill in found.skills
                for permission in skill.permits
                if not kinds or any(permission in permissions_of(skill, kind) for kind in kinds)
            ),
        )
