"""The content of a safety file: a machine and all other facts about its rules."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import SourceFile, Span
from rossmarie import ir
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.loss import Loss
from rossmarie.report.safety.evidence import Evidence


@dataclass(frozen=True)
class RulesFile:
    """A file of the rules; `name` is its name on the page, `sha256` is in hexadecimal."""

    name: str
    file: SourceFile
    sha256: str


@dataclass(frozen=True)
class DeclaredItem:
    """A declaration of the rules, in the rules' own words, with its place."""

    name: str
    text: str
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class SafetyFile:
    """The whole content of a safety file.

    `rules_file` is the name of the main file, `tool` the program with its version, `date` the date
    of the report. Missing reports of other commands are None. `is_thorough` is True if all queries
    about the rules were asked.
    """

    machine: ir.Machine
    rules_file: str
    sources: tuple[RulesFile, ...]
    constants: tuple[DeclaredItem, ...]
    priorities: tuple[DeclaredItem, ...]
    findings: tuple[Finding, ...]
    is_thorough: bool
    losses: tuple[Loss, ...]
    requirements: tuple[ir.Requirement, ...]
    proved: frozenset[Span]
    tool: str
    date: str
    verification: Evidence | None
    coverage: Evidence | None
