"""Checks of the memories of poses (R16, R17), and the contracts that replace them elsewhere.

The input is a machine; the result is C functions. The numbers come from the reactions, not from the
tables that the generator makes. In other queries, memories of poses do nothing: they change only
their own members, and the queries allow any values of these members. The check proves that the list
has space for the one task command that each retracing task gets.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.ir import model as ir
from rossmarie.verification.check import Check, Parts, Passes, WrittenCheck
from rossmarie.verification.formulas import literal
from rossmarie.verification.invariants import Sentence
from rossmarie.verification.places import name_of
from rossmarie.verification.pose_contracts import (
    COMPARISON,
    COMPARISON_WITH_POSES,
    CONTRACTS,
    PARTS,
)
from rossmarie.verification.pose_memories import Memory, memories_of, retraces_of
from rossmarie.verification.program import assertions, assumptions, obligation

_IS_NEW: Parts = (("is_new_pose", "any_new_pose"),)
_IS_APART: Parts = (("is_apart", "note_compared"),)
_NOTE: Parts = (("decide", "note_sent"),)

_RECORDED = ("poses", "pose_recorded_ns", "poses_oldest", "poses_kept", "poses_known")
_SENT = ("poses_sent", "pose_sent_ns", "poses_kept")
_TIMES = ("pose_sent_ns", "pose_recorded_ns")


class PoseChecks:
    """Writes these checks for one reactor."""

    def __init__(self, machine: ir.Machine) -> None:
        found = machine.reactions
        self._name = name_of(machine)
        self._readings = len(machine.readings)
        self._retraces = retraces_of(found)
        self._memories = tuple(memories_of(found))

    def parts(self) -> Parts:
        """The contracts that replace the memories in checks of other functions."""
        return PARTS if self._memories else ()

    def comparison(self) -> str:
        """The comparison of two reactors at an arbitrary place."""
        return COMPARISON_WITH_POSES if self._memories else COMPARISON

    def text(self) -> str:
        """The contracts, and the invariants of memories."""
        if not self._memories:
            return ""
        room = "\n".join(
            obligation(
                f"r->state[{task}] != HOLDING || reported.count[{task}] <= 1",
                "there is room for the task command to send a pose (R17)",
            )
            for task, _ in self._retraces
        )
        fits = list(self._fits())
        return CONTRACTS.format(
            name=self._name,
            readings=self._readings,
            room=room,
            suppose=assumptions(fits),
            must=assertions(fits),
        )

    def _fits(self) -> Iterator[Sentence]:
        yield Sentence("the clock is in range", "r->now_ns >= EARLIEST && r->now_ns < LATEST")
        for each in self._memories:
            kept, most = f"r->poses_kept[{each.index}]", each.memory.most
            yield Sentence("a memory keeps at most its limit of poses (R16)", f"{kept} <= {most}")
            oldest = f"r->poses_oldest[{each.index}]"
            yield Sentence("the oldest pose lies in the memory", f"{oldest} < {most}")
            recorded = f"r->pose_recorded_ns[{each.index}]"
            yield Sentence("the newest pose was recorded in the past", _is_past(recorded))
            yield Sentence("a memory with poses has the newest instant",
                           f"{kept} == 0 || {recorded} != NEVER")  # fmt: skip
        for index in range(len(self._retraces)):
            sent = f"r->pose_sent_ns[{index}]"
            yield Sentence("the last pose was sent in the past", _is_past(sent))

    # --- the checks --------------------------------------------------------------------------

    def written(self) -> Iterator[WrittenCheck]:
        """All checks of memories; none if the machine has no memories."""
        if not self._memories:
            return
        for each in self._memories:
            about = f"poses of memory {each.index} are apart"
            check = Check(f"poses_apart_{each.index}", about, is_arithmetic=True)
            yield WrittenCheck(check, self._apart(each))
            about = f"a pose is new to memory {each.index}"
            yield self._check(f"new_{each.index}", about, self._new(each), _IS_APART)
            about = f"memory {each.index} records poses"
            yield self._check(f"record_{each.index}", about, self._record(each), _IS_NEW)
        lines = [_ANY_POSES, _RECORDS, "    must_be_poses(r);", _unchanged(*_RECORDED)]
        about = "recording changes only the recorded poses"
        yield self._check("look", about, "\n".join(lines), _IS_NEW)
        yield self._check("due", "the instant of the next pose of a task", self._due())
        yield self._check("wake", "the instant of the next pose of the reactor", self._wake())
        about = "tasks send the newest poses"
        yield self._check("send", about, self._send(), _NOTE)
        lines = [_ANY_POSES, "    pose_send(&s);\n    must_be_poses(r);", _unchanged(*_SENT)]
        about = "sending changes only the sent poses"
        yield self._check("sent", about, "\n".join(lines), _NOTE)
        yield self._check("begin", "a task that starts sends at once", self._begin())
        yield self._check("set_back", "poses keep their age", self._set_back())
        yield self._check("forget", "memories begin empty", self._forget())
        yield self._check("retraced", "the pose that is sent is reported", self._retraced())

    def _check(self, name: str, about: str, body: str, parts: Parts = ()) -> WrittenCheck:
        return WrittenCheck(Check(f"poses_{name}", about, parts, self._loops()), body)

    def _loops(self) -> Passes:
        """The limits of loops: memories, their users, the numbers of a pose, and tasks that
        retrace.
        """
        most = max(len(each.numbers) for each in self._memories)
        memories, tasks = len(self._memories), len(self._retraces)
        used = max(len(each.rules) for each in self._memories)
        return (
            ("is_known_pose.0", most + 1),
            ("is_new_pose.0", most + 1),
            ("pose_record.0", used + 1),
            ("pose_record.1", most + 1),
            ("pose_record.2", most + 1),
            ("pose_record.3", memories + 1),
            ("pose_wake.0", tasks + 1),
            ("pose_send.0", most + 1),
            ("pose_send.1", tasks + 1),
            ("pose_begin.0", tasks + 1),
            ("pose_set_back.0", tasks + 1),
            ("pose_set_back.1", memories + 1),
            ("pose_forget.0", tasks + 1),
            ("pose_forget.1", memories + 1),
            (f"{self._name}_retraced.0", tasks + 1),
        )

    def _apart(self, each: Memory) -> str:
        """R16: the required distance of a pose from the pose before it."""
        any_pose = ", ".join("nondet_double()" for _ in each.numbers)
        differs = " || ".join(f"pose[{n}] != last[{n}]" for n in each.numbers)
        square = " + ".join(f"(pose[{n}] - last[{n}]) * (pose[{n}] - last[{n}])" for n in range(3))
        apart = literal(each.memory.apart)
        far = f"{square} >= {apart} * {apart}"
        late = f"age_ns >= INT64_C({each.memory.apart_ns})"
        about = "a pose is apart from the pose before it in space and time (R16)"
        return "\n".join(
            [
                f"    const double pose[] = {{{any_pose}}}, last[] = {{{any_pose}}};",
                "    const int64_t age_ns = nondet_instant();",
                f"    const bool is_far = ({differs}) && {far} && {late};",
                obligation(f"is_apart({each.index}, pose, last, age_ns) == is_far", about),
            ]
        )

    def _new(self, each: Memory) -> str:
        """R16: a pose is compared with the newest stored pose."""
        index = each.index
        newest = each.pose("r->", f"(r->poses_kept[{index}] - 1u)")
        lines = [_ANY_POSES, f"    const double pose[{len(each.numbers)}];"]
        lines += [f"    const unsigned newest = {newest};", "    compared_ns = NEVER;"]
        lines.append(f"    is_new[{index}] = nondet_bool();")
        lines.append(f"    const bool found = is_new_pose(r, {index}, pose);")
        meant = f"r->poses_kept[{index}] == 0 || is_new[{index}]"
        about = "a pose is new if it is the first pose, or apart from the newest (R16)"
        lines.append(obligation(f"found == ({meant})", about))
        lines.append(f"    if (r->poses_kept[{index}] == 0)\n        return;")
        same = [_same(f"compared[{n}]", f"r->poses[newest + {n}]") for n in each.numbers]
        about = "a pose is compared with the newest pose (R16)"
        lines.append(obligation(" && ".join(["compared_to == pose", *same]), about))
        age = f"r->now_ns - r->pose_recorded_ns[{index}]"
        lines.append(obligation(f"compared_ns == {age}", "the age of the newest pose counts (R16)"))
        return "\n".join(lines)

    def _record(self, each: Memory) -> str:
        """R16: the stored poses, if a pose is new."""
        index, most = each.index, each.memory.most
        reading = [f"read[{place}]" for place in each.memory.readings]
        used = " || ".join(f"old.engaged[{rule}]" for rule in each.rules)
        known = " && ".join(f"isfinite({number})" for number in reading)
        lines = [
            _ANY_POSES,
            _RECORDS,
            f"    const bool is_used = {used}, is_known = {known};",
            f"    const bool is_recorded = !is_used && is_known && is_new[{index}];",
            f"    const bool is_full = old.poses_kept[{index}] == {most};",
            obligation(f"r->poses_known[{index}] == is_known", "a finite pose is known (R16)"),
            obligation(
                f"r->poses_kept[{index}] == old.poses_kept[{index}] + (is_recorded && !is_full)",
                "a new pose is kept; in a full memory it replaces the oldest (R16)",
            ),
        ]
        since = f"is_recorded ? old.now_ns : old.pose_recorded_ns[{index}]"
        lines.append(
            obligation(f"r->pose_recorded_ns[{index}] == ({since})", "the instant is kept (R16)")
        )
        oldest = f"(old.poses_oldest[{index}] + (is_recorded && is_full)) % {most}u"
        lines.append(
            obligation(f"r->poses_oldest[{index}] == {oldest}", "the oldest is dropped (R16)")
        )
        newest = each.pose("r->", f"(r->poses_kept[{index}] - 1u)")
        lines.append(f"    const unsigned newest = {newest};")
        for number, now in enumerate(reading):
            same = _same(f"r->poses[newest + {number}]", now)
            lines.append(obligation(f"!is_recorded || {same}", "the new pose is the newest (R16)"))
        lines.append("    const unsigned i = nondet_number();")
        lines.append(f"    __CPROVER_assume(i >= {each.first}u && i < {each.end}u);")
        inside = f"is_recorded && i >= newest && i < newest + {len(reading)}"
        same = _same("r->poses[i]", "old.poses[i]")
        lines.append(obligation(f"({inside}) || {same}", "other poses are unchanged (R16)"))
        return "\n".join(lines)

    def _due_of(self, index: int, reactor: str, kept: str = "") -> str:
        """R17: the instant at which a task may send its next pose; NEVER if it cannot send.
        `kept` is the number of poses in its memory.
        """
        task, effect = self._retraces[index]
        kept = kept or f"{reactor}poses_kept[{effect.memory}]"
        holds = f"{reactor}state[{task}] == HOLDING"
        sends = f"{holds} && {kept} != 0 && {reactor}poses_known[{effect.memory}]"
        sent = f"{reactor}pose_sent_ns[{index}]"
        later = f"{sent} + INT64_C({effect.period_ns})"
        return f"({sends} ? {sent} == NEVER ? EARLIEST : {later} : NEVER)"

    def _due(self) -> str:
        lines = [_ANY_POSES]
        for index in range(len(self._retraces)):
            same = f"pose_due(r, {index}) == {self._due_of(index, 'r->')}"
            lines.append(obligation(same, "a task that holds sends one pose a period (R17)"))
        lines.append(_unchanged())
        return "\n".join(lines)

    def _wake(self) -> str:
        lines = [_ANY_POSES, "    const int64_t given_ns = nondet_instant();"]
        lines.append("    const int64_t wake_ns = pose_wake(r, given_ns);")
        lines.append(obligation("wake_ns <= given_ns", "no other wake is missed (R13)"))
        ends = ["wake_ns == given_ns"]
        for index in range(len(self._retraces)):
            due = self._due_of(index, "r->")
            missed = f"{due} > r->now_ns && {due} < wake_ns"
            lines.append(obligation(f"!({missed})", "no pose is missed (R13)"))
            ends.append(f"(wake_ns == {due} && {due} > r->now_ns)")
        lines.append(obligation(" || ".join(ends), "something is due at the wake (R13)"))
        lines.append(_unchanged())
        return "\n".join(lines)

    def _send(self) -> str:
        lines = [_ANY_POSES, "    reported = (task_commands){0};", "    pose_send(&s);"]
        lines += [f"    unsigned kept_{each.index} = old.poses_kept[{each.index}];"
                  for each in self._memories]  # fmt: skip
        for index, (task, effect) in enumerate(self._retraces):
            memory, kept = self._memories[effect.memory], f"kept_{effect.memory}"
            lines.append(f"    if ({self._due_of(index, 'old.', kept)} <= old.now_ns) {{")
            lines.append(f"        {kept}--;")
            lines.append(f"        const unsigned newest = {memory.pose('old.', kept)};")
            for n in memory.numbers:
                same = _same(f"r->poses_sent[{index}][{n}]", f"old.poses[newest + {n}]")
                lines.append(obligation(same, "the newest pose is sent first (R17)"))
            since = f"r->pose_sent_ns[{index}]"
            lines.append(obligation(f"{since} == old.now_ns", "the instant is kept (R17)"))
            lines.append(obligation(f"reported.count[{task}] == 1", "the pose is sent (R17)"))
            lines.append("    } else {")
            for number in memory.numbers:
                sent, was = (f"{each}poses_sent[{index}][{number}]" for each in ("r->", "old."))
                lines.append(obligation(_same(sent, was), "the sent pose is unchanged"))
            lines.append(obligation(f"{since} == old.pose_sent_ns[{index}]", "none is sent (R17)"))
            lines.append(obligation(f"reported.count[{task}] == 0", "no pose is early (R17)"))
            lines.append("    }")
        for memory in self._memories:
            same = f"r->poses_kept[{memory.index}] == kept_{memory.index}"
            lines.append(obligation(same, "a sent pose leaves the memory (R17)"))
        return "\n".join(lines)

    def _begin(self) -> str:
        lines = [_ANY_POSES, "    const unsigned task = nondet_number();"]
        lines.append("    pose_begin(&s, task);\n    must_be_poses(r);")
        for index, (task, _) in enumerate(self._retraces):
            meant = f"task == {task} ? NEVER : old.pose_sent_ns[{index}]"
            same = f"r->pose_sent_ns[{index}] == ({meant})"
            lines.append(obligation(same, "a starting task has sent no pose (R17)"))
        lines.append(_unchanged("pose_sent_ns"))
        return "\n".join(lines)

    def _set_back(self) -> str:
        lines = [_ANY_POSES, "    const int64_t t_ns = nondet_instant();"]
        lines.append("    __CPROVER_assume(t_ns > EARLIEST && t_ns < old.now_ns);")
        lines.append("    pose_set_back(&s, t_ns);")
        for member in self._instants():
            age = f"old.now_ns - old.{member}"
            kept = f"r->{member} == t_ns - ({age} < LONGEST ? {age} : LONGEST)"
            never = f"old.{member} == NEVER ? r->{member} == NEVER : {kept}"
            lines.append(obligation(never, "ages are unchanged (R14)"))
        lines.append(_unchanged(*_TIMES))
        lines.append("    s.now_ns = t_ns;\n    must_be_poses(r);")
        return "\n".join(lines)

    def _forget(self) -> str:
        lines = ["    static reactor s;\n    const reactor *const r = &s;\n    pose_forget(&s);"]
        lines += [obligation(f"r->{each} == NEVER", "no pose was sent or recorded (R16)")
                  for each in self._instants()]  # fmt: skip
        lines += [obligation(f"r->poses_kept[{each.index}] == 0", "a memory begins empty (R16)")
                  for each in self._memories]  # fmt: skip
        lines.append("    s.now_ns = EARLIEST;\n    must_be_poses(r);")
        return "\n".join(lines)

    def _instants(self) -> Iterator[str]:
        yield from (f"pose_sent_ns[{index}]" for index in range(len(self._retraces)))
        yield from (f"pose_recorded_ns[{each.index}]" for each in self._memories)

    def _retraced(self) -> str:
        most = max(len(each.numbers) for each in self._memories)
        lines = [_ANY_POSES, f"    double pose[{most}];"]
        lines.append("    const int task = nondet_integer();")
        lines.append(f"    const int count = {self._name}_retraced(r, task, pose);")
        none = []
        for index, (task, effect) in enumerate(self._retraces):
            numbers = self._memories[effect.memory].numbers
            reported = [_same(f"pose[{n}]", f"r->poses_sent[{index}][{n}]") for n in numbers]
            holds = " && ".join([f"count == {len(numbers)}", *reported])
            lines.append(obligation(f"task != {task} || ({holds})", "the sent pose is given (R17)"))
            none.append(f"task == {task}")
        lines.append(obligation(" || ".join([*none, "count == 0"]), "other tasks have none (R17)"))
        lines.append(_unchanged())
        return "\n".join(lines)


def _is_past(instant: str) -> str:
    past = f"({instant} >= EARLIEST - LONGEST && {instant} <= r->now_ns)"
    return f"{instant} == NEVER || {past}"


def _same(one: str, other: str) -> str:
    return f"spec_same({one}, {other})"


def _unchanged(*members: str) -> str:
    """An obligation that nothing outside of these arrays is changed."""
    same = [f"    __CPROVER_array_replace(now.{member}, old.{member});" for member in members]
    return "\n".join(
        [
            "    reactor now = s;",
            *same,
            obligation("is_same(&now, &old)", "nothing else changes"),
        ]
    )


_ANY_POSES = """\
    reactor s = any();
    const reactor *const r = &s;
    any_readings();
    suppose_poses(r);
    const reactor old = s;"""

_RECORDS = """\
    for (unsigned k = 0; k != MEMORIES; k++)
        is_new[k] = nondet_bool();
    pose_record(&s, NULL);"""
