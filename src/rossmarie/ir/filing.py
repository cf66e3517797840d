"""The purpose of rules: their categories, the hazards that they mitigate, and the exemptions that
they stand for.

Monitors ignore all of this. A selection of categories gives a machine with only the matching rules.
"""

from __future__ import annotations

import enum
from collections.abc import Collection
from dataclasses import dataclass

from dslkit.source import Span


class Category(enum.Enum):
    """A category of rules (Rizwan 2024, section 6.3)."""

    OPERATION = "operation"
    HUMAN = "human"
    ENVIRONMENT = "environment"
    TASK_DEPENDENT = "task dependent"
    TASK_INDEPENDENT = "task independent"


SUBJECTS = (Category.OPERATION, Category.HUMAN, Category.ENVIRONMENT)
TASKS = (Category.TASK_DEPENDENT, Category.TASK_INDEPENDENT)


def is_selected(categories: Collection[Category], only: Collection[Category]) -> bool:
    """Say whether a rule with these categories is among those that `only` selects.

    Several subjects are alternatives, and so are the two relations to the task. If `only` has a
    subject and a relation, both have to match. A rule without a category is never selected.
    """
    return all(
        not wanted or any(category in wanted for category in categories)
        for wanted in ([each for each in kind if each in only] for kind in (SUBJECTS, TASKS))
    )


@dataclass(frozen=True)
class LeftOut:
    """A selection: the required categories, and the names of the rules outside the selection."""

    only: tuple[Category, ...]
    rules: tuple[str, ...]


@dataclass(frozen=True)
class Hazard:
    """A hazard, in words, that rules mitigate (ISO 12100, 3.6)."""

    name: str
    text: str
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Exemption:
    """An exemption in the form of a rule, which is active while another rule is not applied. `rule`
    is the name of the other rule. `doing` is the running skill, as in `doing Push(Object:
    Fragile)`. `permits` are the permissions in the description of the skill, in words.
    """

    rule: str
    doing: str
    permits: tuple[str, ...]
