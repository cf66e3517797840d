"""Reports that go into a safety file: verification and coverage.

The module converts text (JSON) to `Evidence` and back. This is the smallest layout of both reports;
other members are ignored:

    {"format": "rossmarie-verification", "version": 1, "tools": {"cbmc": "6.6.0"},
     "sources": [{"path": "rules.ross", "sha256": "..."}], "outputs": [...],
     "bound": "3 events",
     "results": [{"name": "no overflow", "status": "proved", "detail": "..."}]}

A coverage report may contain the margins of thresholds; null means no limit:

     "margins": [{"name": "maxtilt", "unit": "deg", "value": 10, "same": [8.5, null],
                  "as_often": [8, null]}]
"""

from __future__ import annotations

import enum
import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from rossmarie.report.safety.errors import EvidenceError, NotEvidence, at_file
from rossmarie.report.spare import Spare, read_spare

VERSION = 1


class EvidenceKind(enum.Enum):
    """The subject of a report. The value is its usual name."""

    VERIFICATION = "verification"
    COVERAGE = "coverage"

    @property
    def statuses(self) -> tuple[str, ...]:
        """The possible statuses of a result, the good status first."""
        match self:
            case EvidenceKind.VERIFICATION:
                return ("proved", "refuted", "undecided", "not proved")
            case EvidenceKind.COVERAGE:
                return ("covered", "not covered")


@dataclass(frozen=True)
class Hashed:
    """A file with its SHA-256, in hexadecimal."""

    path: str
    sha256: str

    @classmethod
    def of(cls, path: str, content: bytes) -> Hashed:
        """A file with this content."""
        return cls(path, hashlib.sha256(content).hexdigest())


@dataclass(frozen=True)
class AnsweredQuery:
    """One query of a report and its answer."""

    name: str
    status: str
    detail: str = ""


@dataclass(frozen=True)
class Evidence:
    """A report. `sha256` is the hash of the report's own text; `bound` describes its limits."""

    kind: EvidenceKind
    path: str
    sha256: str
    tools: tuple[tuple[str, str], ...]
    sources: tuple[Hashed, ...]
    outputs: tuple[Hashed, ...]
    bound: str
    results: tuple[AnsweredQuery, ...]
    margins: tuple[Spare, ...] = ()

    @property
    def open_results(self) -> tuple[AnsweredQuery, ...]:
        """The results with a bad status."""
        return tuple(each for each in self.results if each.status != self.kind.statuses[0])

    def missing(self, sources: Iterable[Hashed]) -> tuple[str, ...]:
        """The paths of sources whose hash is not in the report."""
        known = {each.sha256.lower() for each in self.sources}
        return tuple(each.path for each in sources if each.sha256 not in known)

    def others(self, sources: Iterable[Hashed]) -> tuple[Hashed, ...]:
        """The subjects of the report besides these sources, usually recordings."""
        known = {each.sha256 for each in sources}
        return tuple(each for each in self.sources if each.sha256.lower() not in known)


def evidence_text(
    kind: EvidenceKind,
    *,
    tools: Mapping[str, str],
    sources: Sequence[Hashed],
    outputs: Sequence[Hashed] = (),
    bound: str,
    results: Sequence[AnsweredQuery],
    margins: Sequence[Spare] = (),
) -> str:
    """A report of a kind: the versions of the tools by name, the covered files, the files generated
    from them, its limits, and the queries with their answers.
    """
    strange = {each.status for each in results} - set(kind.statuses)
    assert not strange, f"{strange} is no status of {kind.value}"
    whole: dict[str, object] = {
        "format": _format(kind),
        "version": VERSION,
        "tools": dict(tools),
        "sources": [asdict(each) for each in sources],
        "outputs": [asdict(each) for each in outputs],
        "bound": bound,
        "results": [asdict(each) for each in results],
    }
    if margins:
        whole["margins"] = [asdict(each) for each in margins]
    return json.dumps(whole, indent=2) + "\n"


def _format(kind: EvidenceKind) -> str:
    return f"rossmarie-{kind.value}"


def parse_evidence(content: bytes, kind: EvidenceKind, path: Path) -> Evidence:
    """The report in a file. Raises `EvidenceError` with ROSS781 if the file contains no report of
    this kind.
    """
    try:
        return _evidence(content, kind, path)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        finding = NotEvidence(kind=kind.value, reason=_reason(error))
        raise EvidenceError(at_file(finding, path)) from None


def _evidence(content: bytes, kind: EvidenceKind, path: Path) -> Evidence:
    whole = json.loads(content)
    _require(isinstance(whole, dict), "it holds no object")
    wanted = _format(kind)
    _require(whole.get("format") == wanted, f"its `format` is not `{wanted}`")
    _require(whole.get("version") == VERSION, f"its `version` is not {VERSION}")
    return Evidence(
        kind=kind,
        path=path.name,
        sha256=hashlib.sha256(content).hexdigest(),
        tools=tuple((_text(name), _text(its)) for name, its in whole["tools"].items()),
        sources=_hashed(whole["sources"]),
        outputs=_hashed(whole.get("outputs", [])),
        bound=_text(whole.get("bound", "")),
        results=tuple(_result(each, kind) for each in whole["results"]),
        margins=tuple(read_spare(each) for each in whole.get("margins", [])),
    )


def _hashed(found: list[dict[str, object]]) -> tuple[Hashed, ...]:
    return tuple(Hashed(_text(each["path"]), _text(each["sha256"])) for each in found)


def _result(found: dict[str, object], kind: EvidenceKind) -> AnsweredQuery:
    status = _text(found["status"])
    _require(status in kind.statuses, f"`{status}` is none of {', '.join(kind.statuses)}")
    return AnsweredQuery(_text(found["name"]), status, _text(found.get("detail", "")))


def _text(value: object) -> str:
    _require(isinstance(value, str), f"{json.dumps(value)[:40]} stands where a string should")
    assert isinstance(value, str)
    return value


def _require(is_so: bool, reason: str) -> None:
    if not is_so:
        raise ValueError(reason)


def _reason(error: Exception) -> str:
    match error:
        case json.JSONDecodeError(msg=message, lineno=line):
            return f"line {line}: {message.lower()}"
        case UnicodeDecodeError():
            return "it is not text in UTF-8"
        case KeyError(args=(name, *_)):
            return f"it has no `{name}`"
        case ValueError():
            return str(error)
        case _:  # open: any other exception
            return "a member is not of the kind that it should be"
