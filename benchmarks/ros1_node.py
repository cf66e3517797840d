"""The generated ROS 1 node: how late commands and actions come out of it, and what it costs."""

from __future__ import annotations

import os
import shutil
import signal
import statistics
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from rossmarie.driver import compile_file
from rossmarie.ir import Machine
from support import ros1_live as live
from support.live_cases import sensors

HERE = Path(__file__).parent
RELAY = Path("/usr/lib/topic_tools/relay")
ROUNDS = 6
TALKER = (10, 200)  # topics, and Hz on each
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

Paths = Mapping[str, tuple[str, str]]
"""What is measured, and the topics on which a command enters and leaves it."""

PATHS: Paths = {
    "relay of topic_tools": ("/relay_in", "/relay_out"),
    "hand-written relay": ("/plain_in", "/plain_out"),
    "**generated node**": ("/unfil_cmd_vel", "/cmd_vel"),
}


@dataclass(frozen=True)
class Lateness:
    """Microseconds, how many messages there were, and when the last one came."""

    p50: float
    p99: float
    most: float
    count: int
    last_s: float


def lines(folder: Path) -> Iterator[str]:
    """The section on the node; one sentence where ROS 1 is not installed."""
    lacking = live.missing() or (None if RELAY.exists() else f"there is no {RELAY}")
    yield "## The ROS 1 node"
    yield ""
    if lacking:
        yield f"Not measured: {lacking}."
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    variables = live.environment(folder.resolve(), live.free_port())
    variables["CFLAGS"] = "-Wno-stringop-overflow"  # gcc 12 has one of monitors without timeouts
    probe = live.build_package(HERE / "ros1_probe", variables)
    talker = live.build_package(Path(live.__file__).parent / "ros1_talker", variables) / "talker"
    node = live.build(_machine(folder, "latency", RULES), variables)
    watching = live.build(_machine(folder, "sensors", sensors(TALKER[0])), variables)
    master = live.Master(variables, folder / "master.log")
    try:
        live.set_parameters(variables, {}, use_sim_time=False)
        yield from _commands(variables, probe, node)
        yield from _figures(variables, probe, talker, node, watching)
    finally:
        master.end()


def _machine(folder: Path, name: str, rules: str) -> Machine:
    path = folder / f"{name}.ross"
    path.write_text(rules, encoding="utf-8")
    return compile_file(path).machine


def _commands(variables: Mapping[str, str], probe: Path, node: Path) -> Iterator[str]:
    """The table of commands: all paths are measured in turn, command by command."""
    yield "Command in to command out, over the loopback. Commands go along the three paths in turn,"
    yield f"from one process; medians of {ROUNDS} rounds, the maximum of all. The hand-written"
    yield "relay knows the type and asks for TCP_NODELAY, as the node does."
    yield ""
    yield "| | Hz | p50, us | p99, us | max, us | p99 against topic_tools |"
    yield "|---|---|---|---|---|---|"
    for rate, count in ((100, 1000), (1000, 5000)):
        rounds = [_command_round(variables, probe, node, rate, count) for _ in range(ROUNDS)]
        found = {name: _median([round_[name] for round_ in rounds]) for name in PATHS}
        base = found["relay of topic_tools"].p99
        for name, late in found.items():
            figures = f"{late.p50:.0f} | {late.p99:.0f} | {late.most:.0f}"
            yield f"| {name} | {rate} | {figures} | {late.p99 / base:.2f} |"
    yield ""
    yield "To reach: p99 of the node at most 1.2 times that of topic_tools."
    yield ""


def _command_round(
    variables: Mapping[str, str], probe: Path, node: Path, rate: int, count: int
) -> dict[str, Lateness]:
    topics = [topic for path in PATHS.values() for topic in path]
    with ExitStack() as stack:
        stack.enter_context(_running(variables, RELAY, "/relay_in", "/relay_out"))
        stack.enter_context(_running(variables, probe / "plain_relay", "/plain_in", "/plain_out"))
        stack.enter_context(_running(variables, node))
        found = _measured(variables, probe / "commands", rate, count, *topics)
    for name, late in zip(PATHS, found, strict=True):
        assert late.count == count, f"{name}: {late.count} of {count} commands came"
    return dict(zip(PATHS, found, strict=True))


def _figures(
    variables: Mapping[str, str], probe: Path, talker: Path, node: Path, watching: Path
) -> Iterator[str]:
    """The table of everything else."""
    acting = _median([_violation_round(variables, probe, node) for _ in range(ROUNDS)])
    stops_ms = max(_kill_round(variables, probe, node) for _ in range(ROUNDS))
    topics, rate = TALKER
    share = _cpu_share(variables, talker, watching)
    yield "| | measured |"
    yield "|---|---|"
    yield f"| violation in, action out, p50 | {acting.p50:.0f} us |"
    yield f"| violation in, action out, p99 | {acting.p99:.0f} us |"
    yield f"| node killed to last command, at 100 Hz, the longest of {ROUNDS} | {stops_ms:.1f} ms |"
    yield f"| CPU of a core, {topics} topics of {rate} Hz, {topics} rules | {100 * share:.1f} % |"
    yield f"| program of that node, stripped | {_stripped_kib(watching):.0f} KiB |"


def _violation_round(variables: Mapping[str, str], probe: Path, node: Path) -> Lateness:
    with _running(variables, node):
        (found,) = _measured(variables, probe / "violations", 100, 1000)
    return found


def _kill_round(variables: Mapping[str, str], probe: Path, node: Path) -> float:
    """How long after a SIGKILL the last command came, in ms; 0 if none did."""
    topics = PATHS["**generated node**"]
    with _running(variables, node) as running:
        command = [str(probe / "commands"), "100", "400", *topics]
        measuring = subprocess.Popen(command, env=variables, stdout=subprocess.PIPE, text=True)
        time.sleep(4.0)
        killed_s = time.monotonic()  # the clock of the probe, too
        os.kill(running.running.pid, signal.SIGKILL)
        output, _ = measuring.communicate(timeout=60)
    (late,) = map(_parsed, output.splitlines())
    assert 0 < late.count < 400, "the node was killed on the way"
    return max(0.0, 1e3 * (late.last_s - killed_s))


def _cpu_share(variables: Mapping[str, str], talker: Path, watching: Path) -> float:
    """The part of a core that a node uses while messages come."""
    topics, rate = TALKER
    with _running(variables, watching) as node:
        command = list(map(str, (talker, topics, rate, CPU_SECONDS + 10.0)))
        talking = subprocess.Popen(command, env=variables, stdout=subprocess.DEVNULL)
        time.sleep(5.0)
        begin, used = time.monotonic(), _cpu_seconds(node.running.pid)
        time.sleep(CPU_SECONDS)
        share = (_cpu_seconds(node.running.pid) - used) / (time.monotonic() - begin)
        talking.wait(60)
    return share


def _cpu_seconds(process: int) -> float:
    """The CPU time of a process so far; the name before the fields may hold blanks."""
    fields = Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _stripped_kib(program: Path) -> float:
    stripped = program.with_suffix(".stripped")
    subprocess.run(["strip", program, "-o", stripped], check=True)
    return stripped.stat().st_size / 1024


@contextmanager
def _running(
    variables: Mapping[str, str], program: Path, *arguments: str
) -> Iterator[live.Process]:
    log = Path(variables["HOME"]) / f"{program.name}.log"
    process = live.Process([str(program), *arguments], variables, log)
    try:
        yield process
    finally:
        process.end()


def _measured(variables: Mapping[str, str], program: Path, *arguments: object) -> list[Lateness]:
    """What a program says, a line for each path."""
    command = [str(program), *map(str, arguments)]
    done = subprocess.run(
        command, env=variables, capture_output=True, text=True, timeout=300, check=True
    )
    return list(map(_parsed, done.stdout.splitlines()))


def _parsed(line: str) -> Lateness:
    _, p50, p99, most, count, last = line.split()
    return Lateness(float(p50), float(p99), float(most), int(count), float(last))


def _median(rounds: Sequence[Lateness]) -> Lateness:
    """The medians of the percentiles, the maximum of the maxima."""
    return Lateness(
        statistics.median(late.p50 for late in rounds),
        statistics.median(late.p99 for late in rounds),
        max(late.most for late in rounds),
        sum(late.count for late in rounds),
        rounds[-1].last_s,
    )
