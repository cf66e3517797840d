"""The context of skills that SkiROS2 runs, by stand-ins of SkiROS2 and of what publishes."""

from __future__ import annotations

import importlib
import json
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from dslkit.diagnostics import Collector
from ezskiros import session
from ezskiros.context.ros import NoRosError
from ezskiros.context.snapshot import Snapshot
from ezskiros.context.voice import PATIENCE, Publish
from ezskiros.export.write import PERIOD
from ezskiros.hosts import skiros2_context as context
from ezskiros.hosts.skiros2_api import api
from ezskiros.hosts.skiros2_library import check_library
from ezskiros.hosts.skiros2_skills import host_of, hosted_skill, implementation_class
from ezskiros.ontology import Ontology
from ezskiros.skills.interface import SkillInterface
from support import skiros2_api
from support.engine import Clock
from support.exports import export

SKILL = SkillInterface("Push", session.NOWHERE, (), (), (), ())
OTHER = SkillInterface("Wait", session.NOWHERE, (), (), (), ())


@pytest.fixture(autouse=True)
def alone(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Each test is a process of SkiROS2 of its own."""
    monkeypatch.setattr(context, "_contexts", [])
    monkeypatch.setattr(context, "_refused", [])
    with skiros2_api.installed():
        api.cache_clear()
        monkeypatch.setattr(api().log, "error", lambda *_: None)
        yield
        api.cache_clear()
    for each in context._contexts:
        each.voice.end()


class Reported:
    """A context whose thread is not started: the test speaks for it."""

    def __init__(self) -> None:
        self.clock, self.heard = Clock(), list[Snapshot]()
        self.context = context.HostedContext("digest", self.heard.append, self.clock)
        context._contexts.append(self.context)

    def running(self) -> list[str] | None:
        """The skills in the current message; None if no message is published."""
        if not self.context.voice.speak():
            return None
        return [each.skill for each in self.heard[-1].running]


def no_values() -> dict[str, Any]:
    return {}


def test_where_no_skill_runs_that_is_reported_for_ever() -> None:
    reported = Reported()
    assert reported.running() == []
    reported.clock.wait(1e9)
    assert reported.running() == []


def test_each_skill_that_runs_has_to_live() -> None:
    reported = Reported()
    context.start(1, SKILL, no_values)
    context.start(2, OTHER, no_values)
    assert reported.running() == ["Push", "Wait"]
    for _ in range(2 * PATIENCE):
        reported.clock.wait(PERIOD * 0.4)
        context.live(1)
        context.live(2)
        assert reported.running() == ["Push", "Wait"]
    for _ in range(2 * PATIENCE):
        reported.clock.wait(PERIOD * 0.6)
        context.live(1)
    assert reported.running() is None, "nobody ticks the second"
    context.live(2)
    assert reported.running() == ["Push", "Wait"]
    context.end(2)
    assert reported.running() == ["Push"]
    reported.clock.wait(PERIOD * (PATIENCE + 1))
    assert reported.running() is None
    context.end(1)
    assert reported.running() == []


def test_what_does_not_run_gives_no_sign_of_life() -> None:
    reported = Reported()
    context.start(1, SKILL, no_values)
    reported.clock.wait(PERIOD * (PATIENCE + 1))
    context.live(2)
    context.end(2)
    assert reported.running() is None


def test_a_fault_silences_it_and_no_skill(monkeypatch: pytest.MonkeyPatch) -> None:
    reported = Reported()
    logged = list[str]()
    monkeypatch.setattr(api().log, "error", lambda _who, text: logged.append(text))

    def values() -> dict[str, Any]:
        raise RuntimeError("the world model is gone")

    context.start(1, SKILL, values)
    assert reported.running() is None
    assert logged == ["the context is unknown: RuntimeError('the world model is gone')"]
    reported.clock.wait(PERIOD)
    context.end(1)
    assert reported.running() == []


def test_a_processor_is_watched() -> None:
    class Processor:
        def printType(self) -> str:  # noqa: N802
            return "->"

        def reset(self) -> None:
            done.append("reset")

        def processChildren(self, children: Any, visitor: Any) -> Any:  # noqa: N802
            done.append((children, visitor))
            return "state"

    done = list[Any]()
    plain = Processor()
    assert context.watched(plain, 1) is plain, "without a context all is as it was"
    reported = Reported()
    watched = context.watched(plain, 1)
    context.start(1, SKILL, no_values)
    reported.clock.wait(PERIOD * (PATIENCE + 1))
    assert reported.running() is None
    assert watched.printType() == "->"
    watched.reset()
    assert reported.running() is None
    assert watched.processChildren([2], 3) == "state"
    assert done == ["reset", ([2], 3)]
    assert reported.running() == ["Push"]
    assert type(deepcopy(watched)) is Processor


# --- hosted classes ---------------------------------------------------------------------------

SKILLS = """
class Wait(SkillDescription):
    def description(self, Duration: float, Willing: bool):
        self.permits += speed("0.1 m/s")


class wait(Wait.SkillBase):
    def onStart(self):
        return self.params.Willing

    def execute(self):
        return self.step("waits")

    def onEnd(self):
        return True
"""


def hosted(package: Any, name: str, **values: Any) -> Any:
    """An implementation as SkiROS2 has it, with values for its parameters."""
    module = importlib.import_module(f"{package(name, SPEED + SKILLS, '')}.skills")
    library = check_library([module], Collector())
    (description,) = library.described
    skill = hosted_skill(library.described[description].interface, Ontology(()), name)
    made = implementation_class(host_of(module.wait, skill, library.library))()
    params = SimpleNamespace(getParamValue=values.get, specify=lambda *_: None)
    # Where SkiROS2 is installed these are properties.
    vars(made).update(wmi=None, _wmi=None, params=params, _params=params)
    made._setProgress = lambda *_: None
    made._hold_conditions = []
    return made


SPEED = "from ezskiros import speed\n"


def test_a_hosted_skill_runs_from_its_start_to_its_end(package: Any) -> None:
    reported = Reported()
    skill = hosted(package, "hosted_one", Duration=1.5, Willing=True)
    assert skill.onStart()
    assert reported.running() == ["Wait"]
    (running,) = reported.heard[-1].running
    assert [(each.parameter, each.value) for each in running.arguments] == [
        ("Duration", "1.5"),
        ("Willing", "true"),
    ]
    assert [(each.kind, each.limit) for each in running.permits] == [("speed", 0.1)]
    reported.clock.wait(PERIOD * (PATIENCE + 1))
    assert reported.running() is None
    skill.execute()
    assert reported.running() == ["Wait"]
    assert skill.onEnd()
    assert reported.running() == []


def test_what_does_not_start_does_not_run(package: Any) -> None:
    reported = Reported()
    assert not hosted(package, "hosted_two", Duration=1.5, Willing=False).onStart()
    assert reported.running() == []


def test_a_value_that_is_missing_is_reported_as_none(package: Any) -> None:
    reported = Reported()
    skill = hosted(package, "hosted_three", Willing=True)
    skill.onStart()
    started = [each for each in reported.heard if each.running]
    assert reported.running() == [], "without it SkiROS2's own start fails"
    assert started == [] or started[-1].running[0].arguments[0].value == ""


# --- how it begins ----------------------------------------------------------------------------


def exported(folder: Path, name: str = "a") -> tuple[Path, Path]:
    """An export, and its source."""
    source = folder / f"{name}.py"
    source.write_text(
        "from ezskiros import SkillDescription\n\n\nclass A(SkillDescription):\n"
        "    def description(self):\n        pass\n"
    )
    out = folder / f"{name}.json"
    export(source, out=out)
    return out, source


def quiet() -> Publish:
    return lambda _snapshot: None


def test_an_export_is_reported_by_several_libraries(tmp_path: Path) -> None:
    path, source = exported(tmp_path)
    assert context.begin(path, [source], quiet) is None
    assert context.begin(path, [source], quiet) is None
    (only,) = context._contexts
    assert only.digest == json.loads(path.read_text())["digest"]
    assert only.voice._thread.is_alive()


def test_another_export_silences_all(tmp_path: Path) -> None:
    (path, source), (other, _) = exported(tmp_path), exported(tmp_path, "b")
    context.begin(path, [source], quiet)
    (only,) = context._contexts
    problem = context.begin(other, [], quiet)
    assert (
        problem == f"{other} is the export of another library: export both libraries into one file"
    )
    assert not only.voice._thread.is_alive()
    assert context.begin(path, [source], quiet) == problem, "it stays so"


def test_a_stale_export_is_refused(tmp_path: Path) -> None:
    path, source = exported(tmp_path)
    assert "does not include" in str(context.begin(path, [tmp_path / "b.py"], quiet))
    context._refused.clear()
    source.write_text("")
    assert "`a.py` has changed" in str(context.begin(path, [source], quiet))
    assert context._contexts == []


def test_what_is_no_export_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "skills.json"
    assert context.begin(path, [], quiet) == f"cannot read {path}: no such file or directory"
    context._refused.clear()
    path.write_text("{}")
    assert "is not an export of skills" in str(context.begin(path, [], quiet))


def test_without_ros_there_is_none(tmp_path: Path) -> None:
    path, source = exported(tmp_path)

    def connect() -> Publish:
        raise NoRosError("no ROS master answers")

    assert context.begin(path, [source], connect) == "no ROS master answers"
    assert context._contexts == []
