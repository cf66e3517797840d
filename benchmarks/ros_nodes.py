"""The generated nodes: the latency of commands and actions, the CPU load and the size."""

from __future__ import annotations

import os
import shutil
import signal
import statistics
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from machine import processor
from written_page import written_page

from rossmarie.ir import Machine
from support import ros1_build, ros1_live, ros2_build, ros2_live
from support.compiled import machine_of
from support.live import Process, Ros, talking
from support.live_cases import sensors

HERE = Path(__file__).parent
SUPPORT = HERE.parent / "tests" / "support"
RELAY = Path("/usr/lib/topic_tools/relay")
ROUNDS = 6
VIOLATIONS = 1000  # a round
TOPICS, RATE = 10, 200  # of the talker, and Hz on each
CPU_SECONDS = 20.0

RULES = """
action slow {
    limit /cmd_vel : geometry_msgs/Twist {
        linear.x in [-0.2, 0.2] m/s;
        angular.z in [-0.3, 0.3] rad/s;
    } ramp 0.5 m/s^2, 1 rad/s^2;
    publish /alarm : std_msgs/Bool { data = true; };
}
input load = topic /load : std_msgs/Float64 .data;
rule overload: if load > 1 then { slow; };
"""

RELAYED = ("/relay_in", "/relay_out")
PLAIN = ("/plain_in", "/plain_out")
FILTERED = ("/unfil_cmd_vel", "/cmd_vel")
TOPIC_TOOLS = "`relay` of topic_tools"
HAND_WRITTEN = "hand-written relay"
NODE = "**generated node**"

PREFACE = """\
The table shows the latency of commands from the input to the output of a path, over the loopback
interface. One process sends the commands to the paths in turn. p50 and p99 are medians of {rounds}
rounds; the maximum and the loss are over all rounds. A command is lost if a process did not run for
so long that a queue overflowed. {about}
All processes have {priority}.
"""


@dataclass(frozen=True)
class Generation:
    """A generation of ROS: its name, and the measured paths."""

    title: str
    name: str
    about: str
    paths: Mapping[str, tuple[str, str]]
    """The topics on which a command enters and leaves each path. Ratios refer to the first path."""


ROS1 = Generation(
    "ROS 1",
    "ros1",
    "The hand-written\nrelay knows the message type and requests TCP_NODELAY, as the node does.",
    {TOPIC_TOOLS: RELAYED, HAND_WRITTEN: PLAIN, NODE: FILTERED},
)
ROS2 = Generation(
    "ROS 2",
    "ros2",
    f"The middleware is {os.environ.get('RMW_IMPLEMENTATION', 'the default')}. The\n"
    "hand-written relay has the same quality of service as the node.",
    {HAND_WRITTEN: PLAIN, NODE: FILTERED},
)


@dataclass(frozen=True)
class Lateness:
    """Latencies (µs), the number of messages, and the instant of the last message (s)."""

    p50: float
    p99: float
    most: float
    count: int
    last_s: float


def lines(folder: Path) -> Iterator[str]:
    """The lines of the page; a generation that is not installed gets one sentence."""
    yield "# Latency of the nodes"
    yield ""
    yield "Written by `benchmarks/ros_nodes.py`; do not edit. Each section is from one run on one"
    yield f"machine ({processor()}). Absolute figures hold for this machine only; ratios carry over"
    yield "to other machines."
    yield ""
    shutil.rmtree(folder, ignore_errors=True)
    lacking = ros1_live.missing() or (None if RELAY.exists() else f"there is no {RELAY}")
    yield from _section(ROS1, lacking, lambda: _ros1(folder.resolve() / "ros1"))
    yield ""
    yield from _section(ROS2, ros2_live.missing(), lambda: _ros2(folder.resolve() / "ros2"))


def main() -> None:
    """Measure, print and write the page."""
    out = written_page(__doc__)
    found: list[str] = []
    for line in lines(HERE.parent / "build" / "bench" / "ros"):
        print(line, flush=True)
        found.append(line)
    out.write_text("\n".join(found) + "\n", encoding="utf-8")


def _section(
    generation: Generation, lacking: str | None, begin: Callable[[], Ros]
) -> Iterator[str]:
    yield f"## Node for {generation.title}"
    yield ""
    if lacking:
        yield f"Not measured: {generation.title} is {lacking}."
        return
    ros = begin()
    try:
        measured = _Node(generation, ros)
        yield from measured.commands()
        yield from measured.figures()
    finally:
        ros.end()


def _ros1(folder: Path) -> ros1_live.Ros1:
    folder.mkdir(parents=True)
    return ros1_live.Ros1(folder, ros1_build.Workspace(folder / "workspace"))


def _ros2(folder: Path) -> ros2_live.Ros2:
    folder.mkdir(parents=True)
    return ros2_live.Ros2(folder, ros2_build.Workspace(folder / "workspace"))


class _Node:
    """The generated nodes and the programs that measure them, built."""

    def __init__(self, generation: Generation, ros: Ros) -> None:
        self._generation = generation
        self._ros = ros
        probe, talker = HERE / f"{generation.name}_probe", SUPPORT / f"{generation.name}_talker"
        machines = (_machine("latency", RULES), _machine("sensors", sensors(TOPICS)))
        self._node, self._watching, self._probe, talkers = ros.prepare([*machines, probe, talker])
        self._talker = talkers / "talker"

    def commands(self) -> Iterator[str]:
        """The table of commands. The paths take turns, command by command."""
        paths = self._generation.paths
        base = next(iter(paths))
        about = self._generation.about
        yield PREFACE.format(rounds=ROUNDS, about=about, priority=_priority())
        yield f"| | Hz | p50, us | p99, us | max, us | lost | p99, ratio to {base} | target |"
        yield "|---|---|---|---|---|---|---|---|"
        for rate, count in ((100, 1000), (1000, 5000)):
            rounds = [self._command_round(rate, count) for _ in range(ROUNDS)]
            found = {name: _median([each[name] for each in rounds]) for name in paths}
            for name, late in found.items():
                lost = _lost(late, ROUNDS * count)
                figures = f"{late.p50:.0f} | {late.p99:.0f} | {late.most:.0f} | {lost}"
                ratio = f"{late.p99 / found[base].p99:.2f}"
                wanted = "at most 1.2" if name == NODE else ""
                yield f"| {name} | {rate} | {figures} | {ratio} | {wanted} |"
        yield ""

    def figures(self) -> Iterator[str]:
        """The table of the other figures."""
        acting = _median([self._violation_round() for _ in range(ROUNDS)])
        stops_ms = max(self._kill_round() for _ in range(ROUNDS))
        yield "| | value |"
        yield "|---|---|"
        yield f"| latency from a violation to the action, p50 | {acting.p50:.0f} us |"
        yield f"| latency from a violation to the action, p99 | {acting.p99:.0f} us |"
        yield f"| violations without an action | {_lost(acting, ROUNDS * VIOLATIONS)} |"
        killed = f"last command after SIGKILL of the node, 100 Hz, maximum of {ROUNDS} rounds"
        yield f"| {killed} | {stops_ms:.1f} ms |"
        load = f"CPU load of one core, {TOPICS} topics at {RATE} Hz, {TOPICS} rules"
        yield f"| {load} | {self._cpu():.1%} |"
        size = f"{_stripped_kib(self._watching):.0f} KiB"
        yield f"| size of the program of this node, stripped | {size} |"

    def _command_round(self, rate: int, count: int) -> dict[str, Lateness]:
        paths = self._generation.paths
        programs = {
            RELAYED: (RELAY, *RELAYED),
            PLAIN: (self._probe / "plain_relay", *PLAIN),
            FILTERED: (self._node,),
        }
        with ExitStack() as stack:
            for path in paths.values():
                stack.enter_context(self._running(*programs[path]))
            ends = [topic for path in paths.values() for topic in path]
            found = self._measured("commands", rate, count, *ends)
        return dict(zip(paths, found, strict=True))

    def _violation_round(self) -> Lateness:
        with self._running(self._node):
            (found,) = self._measured("violations", 100, VIOLATIONS)
        return found

    def _kill_round(self) -> float:
        """The delay of the last command after a SIGKILL, in ms; 0 if there was none."""
        command = [str(self._probe / "commands"), "100", "400", *FILTERED]
        with self._running(self._node) as node:
            probe = subprocess.Popen(
                command, env=self._ros.variables, stdout=subprocess.PIPE, text=True
            )
            time.sleep(4.0)
            killed_s = time.monotonic()  # the probe uses the same clock
            os.kill(node.running.pid, signal.SIGKILL)
            output, _ = probe.communicate(timeout=60)
        self._ros.forget_all()
        late = _lateness(output)
        assert 0 < late.count < 400, "the node was killed between two commands"
        return max(0.0, 1e3 * (late.last_s - killed_s))

    def _cpu(self) -> float:
        """The share of a core that a node uses while it receives messages."""
        with self._running(self._watching) as node:
            talk = f"exec {self._talker} {TOPICS} {RATE} {CPU_SECONDS + 10.0} >/dev/null"
            with self._running(Path("/bin/sh"), "-c", talk):
                time.sleep(5.0)
                begin_s, used_s = time.monotonic(), _cpu_seconds(node.running.pid)
                time.sleep(CPU_SECONDS)
                used_s = _cpu_seconds(node.running.pid) - used_s
                return used_s / (time.monotonic() - begin_s)

    @contextmanager
    def _running(self, program: Path, *arguments: str) -> Iterator[Process]:
        log = Path(self._ros.variables["HOME"]) / f"{program.name}.log"
        process = Process([str(program), *arguments], self._ros.variables, log, talking)
        try:
            yield process
        finally:
            process.end()

    def _measured(self, program: str, *arguments: object) -> list[Lateness]:
        """The figures that a program of the probe prints, one line for each path."""
        command = [str(self._probe / program), *map(str, arguments)]
        done = subprocess.run(
            command, env=self._ros.variables, capture_output=True, text=True, timeout=300
        )
        assert done.returncode == 0, done.stderr
        return list(map(_lateness, done.stdout.splitlines()))


def _machine(name: str, rules: str) -> Machine:
    return replace(machine_of(rules), name=name)


def _lost(late: Lateness, sent: int) -> str:
    return f"{1 - late.count / sent:.2%}"


def _priority() -> str:
    """The scheduling of the processes that this program starts. Run this program with `chrt` to
    change the scheduling.
    """
    if os.sched_getscheduler(0) == os.SCHED_OTHER:
        return "default priority"
    return "real-time priority, so that other load on the machine has less effect"


def _cpu_seconds(process: int) -> float:
    """The CPU time of a process so far (s). The name before the fields may contain blanks."""
    fields = Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _stripped_kib(program: Path) -> float:
    """The size of a program (KiB), including a library that contains the node."""
    library = program.parents[1] / f"lib{program.parent.name}_node.so"
    parts = [program, library] if library.exists() else [program]
    for each in parts:
        subprocess.run(["strip", each, "-o", each.with_suffix(".stripped")], check=True)
    return sum(each.with_suffix(".stripped").stat().st_size for each in parts) / 1024


def _lateness(line: str) -> Lateness:
    _, p50, p99, most, count, last = line.split()
    return Lateness(float(p50), float(p99), float(most), int(count), float(last))


def _median(rounds: Sequence[Lateness]) -> Lateness:
    """The medians of the percentiles, and the maximum of the maxima."""
    return Lateness(
        statistics.median(late.p50 for late in rounds),
        statistics.median(late.p99 for late in rounds),
        max(late.most for late in rounds),
        sum(late.count for late in rounds),
        rounds[-1].last_s,
    )


if __name__ == "__main__":
    main()
