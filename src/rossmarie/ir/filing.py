"""The purpose of rules: the categories that they are filed under, the hazards that they mitigate,
and the exemptions that they stand for.

No monitor heeds any of it. A selection of categories makes a machine of the rules that fit.
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

    Several subjects are alternatives, and so are both relations to the task; a subject and a
    relation have to fit both. A rule without a category is selected by none.
    """
    return all(
        not wanted or any(category in wanted for category in categories)
        for wanted in ([each for each in kind if each in only] for kind in (SUBJECTS, TASKS))
    )


@dataclass(frozen=True)
class LeftOut:
    """A selection: the categories that rules had to fit, and the names of those that did not."""

    only: tuple[Category, ...]
    rules: tuple[str, ...]


@dataclass(frozen=True)
class Hazard:
    """A hazard, in words, that rules are there to mitigate (ISO 12100, 3.6)."""

    name: str
    text: str
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Exemption:
    """A rule that is active while another one is not applied: `rule` is the name of that one,
    `doing` the skill that runs meanwhile, as in `doing Push(Object: Fragile)`, and `permits` what
    the description of the skill permits, in words.
    """

    rule: str
    doing: str
    permits: tuple[str, ...]
