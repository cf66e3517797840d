"""`crosscheck live`."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path

import typer

from crosscheck.cli.loading import loaded
from crosscheck.cli.output import output
from crosscheck.live.facts import facts_of
from crosscheck.live.model import LiveChange
from crosscheck.live.ros import Ears, NotObservedError, listen
from crosscheck.live.watch import Reported, Watch
from dslkit import signals
from dslkit.diagnostics import Diagnostic
from dslkit.diagnostics.render_json import finding
from dslkit.options import ReportFormat

_LOOK = 0.1
"""The seconds between two checks for silence."""
_ABSENCE = 1.0
"""If more seconds pass between two checks, the process was suspended."""


Print = Callable[[Reported], None]


def run_live(
    rules: Path,
    namespace: str,
    duration_s: float | None,
    form: ReportFormat,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Report the events on a robot until a signal comes, or until the time in seconds is over."""
    facts = facts_of(loaded(rules, systems, message_folders), namespace)
    has_to_end = signals.ask_to_end()
    try:
        ears = listen(facts)
    except NotObservedError as problem:
        output.fail(str(problem), exit_code=2)
    watch = Watch(facts, time.monotonic())
    is_json = form is ReportFormat.JSON
    tell = _tell_json if is_json else _tell_text
    until = None if duration_s is None else watch.start + duration_s
    try:
        _listen(ears, watch, lambda: has_to_end() or _is_over(until), tell)
        _tell_all(watch.end(time.monotonic()), tell)
        typer.echo(json.dumps(_json_of(watch)) if is_json else "\n".join(_summary(watch)))
    finally:
        ears.end()
    raise typer.Exit(1 if watch.has_errors else 0)


def _is_over(until: float | None) -> bool:
    return until is not None and time.monotonic() >= until


def _listen(ears: Ears, watch: Watch, has_to_end: Callable[[], bool], tell: Print) -> None:
    looked = time.monotonic()
    while not has_to_end():
        heard = ears.next(_LOOK)
        now = time.monotonic()
        if now - looked > _ABSENCE:
            watch.pause(now - looked)
        looked = now
        _tell_all(watch.take(*heard) if heard else watch.pass_time(now), tell)


def _tell_all(found: Sequence[Reported], tell: Print) -> None:
    for each in found:
        tell(each)


def _now() -> datetime:
    return datetime.now().astimezone()


# --- text ----------------------------------------------------------------------------------------


def _tell_text(reported: Reported) -> None:
    at = f"{_now():%H:%M:%S.%f}"[:-3]
    if isinstance(reported, Diagnostic):
        typer.echo(f"{at}  {reported.code}:")
        output.print_findings([reported])
    else:
        typer.echo(f"{at}  {reported.text}")


def _summary(watch: Watch) -> list[str]:
    """The lines at the end."""
    plural = "" if watch.findings == 1 else "s"
    lines = [f"watched for {watch.now - watch.start:.1f} s, {watch.findings} finding{plural}"]
    for skill, count in sorted(watch.skills.counts.items()):
        lines.append(f"skill {skill}: ran {_times(count.times)}, {count.seconds:.1f} s in all")
    for rule, count in sorted(watch.rules.counts.items()):
        lines.append(f"rule {rule}: active {_times(count.times)}, {count.seconds:.1f} s in all")
    for (rule, resource, skill), times in sorted(watch.takings.items()):
        lines.append(f"rule {rule}: took {resource} from {skill} {_times(times)}")
    return lines


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


# --- JSON ----------------------------------------------------------------------------------------


def _tell_json(reported: Reported) -> None:
    line = {"time": _now().isoformat(timespec="milliseconds")}
    if isinstance(reported, LiveChange):
        typer.echo(
            json.dumps(
                {**line, "change": reported.kind.value, "text": reported.text, **reported.names}
            )
        )
    else:
        typer.echo(json.dumps({**line, "finding": finding(reported)}))


def _json_of(watch: Watch) -> object:
    """The last line."""
    return {
        "summary": {
            "seconds": round(watch.now - watch.start, 3),
            "findings": watch.findings,
            "skills": {
                name: {"times": each.times, "seconds": round(each.seconds, 3)}
                for name, each in sorted(watch.skills.counts.items())
            },
            "rules": {
                name: {"times": each.times, "seconds": round(each.seconds, 3)}
                for name, each in sorted(watch.rules.counts.items())
            },
            "takings": [
                {"rule": rule, "resource": resource, "skill": skill, "times": times}
                for (rule, resource, skill), times in sorted(watch.takings.items())
            ],
        }
    }
