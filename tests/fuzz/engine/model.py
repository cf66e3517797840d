"""The monitor of `monitor.c` as plainly as can be: at every instant everything is evaluated, from
lists of all that happened, by the rules of docs/explanation/semantics.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from fuzz.engine.rules import (
    ACTIVATED,
    ACTIVATED_STALE,
    AGES,
    CLEARED,
    EARLIEST,
    EDGES,
    EXPIRED,
    FALSE,
    FRESH,
    HELD,
    INPUTS,
    LATEST,
    LEAVES,
    LONGEST,
    MOST_SAMPLES,
    NAN,
    NEVER_RECEIVED,
    PROPOSITIONS,
    RESTS_ON,
    RULES,
    SINCES,
    STALE,
    SWINGS,
    TIME_JUMP,
    TRUE,
    UNKNOWN,
    VALUES,
    Event,
    Recent,
    Rule,
    both,
    divided,
    either,
    known,
    mean,
    median,
    opposite,
)


class Monitor:
    """The monitor. Calls give their result and the events, as the C does.

    `initially` is what counts as having been before the start, to `outside_held`.
    """

    def __init__(self, initially: int) -> None:
        self._initially = initially
        self.started = False
        self.now_ns = 0
        self.state = dict.fromkeys(INPUTS, NEVER_RECEIVED)
        self.stamp_ns = dict.fromkeys(INPUTS, 0)
        self.value = dict.fromkeys(VALUES, NAN)
        self.truth = dict.fromkeys(PROPOSITIONS, -1)
        self.since_ns = dict.fromkeys(PROPOSITIONS, 0)
        self.active = [False] * len(RULES)
        self.since = dict.fromkeys(SINCES, FALSE)
        self.events: list[Event] = []
        self._forget(0)

    # --- calls -------------------------------------------------------------------------------

    def latch(self, rule: int) -> int:
        """S42."""
        if not self.started and 0 <= rule < len(RULES) and RULES[rule].release is None:
            self.active[rule] = True
        return 0

    def advance(self, t_ns: int) -> int:
        """S14: wakes up to and including the instant."""
        return self._pass(t_ns, lambda: ())

    def take(self, t_ns: int, arrived: Sequence[int], numbers: Sequence[float]) -> int:
        """S11: messages at one instant; x and z are those of channel 0, y and least of 1."""
        return self._pass(t_ns, lambda: self._arrive(t_ns, arrived, numbers))

    def reset(self, t_ns: int, rule: int) -> int:
        """S38."""
        before = self.advance(t_ns)
        if before < 0:
            return before
        first = len(self.events)
        for index, each in enumerate(RULES):
            is_meant = each.release is None and (rule < 0 or rule == index)
            if is_meant and self.active[index] and self.truth[each.condition] == FALSE:
                self._change(index, CLEARED, t_ns)
        return before + len(self.events) - first

    def next_wake(self) -> int | None:
        """S15; none if nothing can change by itself."""
        return min(self._timers(), default=None) if self.started else None

    def has_all_inputs(self) -> bool:
        """Say whether each input with a timeout has arrived."""
        timed = [name for name, (_, timeout_ns) in INPUTS.items() if timeout_ns is not None]
        return all(self.state[name] != NEVER_RECEIVED for name in timed)

    # --- time --------------------------------------------------------------------------------

    def _pass(self, t_ns: int, bring: Callable[[], Sequence[int]]) -> int:
        if not EARLIEST < t_ns < LATEST:
            return -1
        first = len(self.events)
        if self.started and t_ns < self.now_ns:
            self.events.append(Event(TIME_JUMP, t_ns, self.now_ns))
            self._jump(t_ns)
        while self.started and (wake_ns := self.next_wake()) is not None and wake_ns < t_ns:
            self._evaluate(wake_ns, ())
        if not self.started:
            self._forget(t_ns)
        self._evaluate(t_ns, bring())
        return len(self.events) - first

    def _jump(self, t_ns: int) -> None:
        """S17."""
        for name in INPUTS:
            self.stamp_ns[name] = t_ns - min(self.now_ns - self.stamp_ns[name], LONGEST)
        self._forget(t_ns)
        self.truth = dict.fromkeys(PROPOSITIONS, -1)
        self.now_ns = t_ns

    def _forget(self, t_ns: int) -> None:
        """All that is measured against the clock."""
        before = UNKNOWN if self.started else FALSE
        self.samples: dict[str, list[tuple[int, float]]] = {"x": [], "y": [], "low_pass": []}
        for name in ("rate", "change", "median", "mean", "low_pass"):
            self.value[name] = NAN
        self.held = {
            name: UNKNOWN if self.started else self._initially if name == "outside_held" else FALSE
            for name in HELD
        }
        self.start_ns: dict[str, int | None] = dict.fromkeys(HELD)
        self.recent = {name: Recent([], before, t_ns) for name in (*SWINGS, *EDGES)}
        self.edge = dict.fromkeys(EDGES, before)
        self.extreme = dict.fromkeys(SWINGS, NAN)
        self.heading = dict.fromkeys(SWINGS, 0)

    def _timers(self) -> Iterator[int]:
        for name, (_, timeout_ns) in INPUTS.items():
            if self.state[name] == FRESH and timeout_ns is not None:
                yield self.stamp_ns[name] + timeout_ns
        for name, (used, age_ns) in AGES.items():
            if self.truth[name] == FALSE:
                yield self.stamp_ns[used] + age_ns
        for name, (condition, duration_ns) in HELD.items():
            start_ns = self.start_ns[name]
            if self.truth[condition] == TRUE != self.truth[name] and start_ns is not None:
                yield start_ns + duration_ns
        windows = {**SWINGS, **EDGES}
        for name, recent in self.recent.items():
            count, within_ns = windows[name][-2:]
            if self.truth[name] == TRUE:
                yield recent.instants[-int(count)] + int(within_ns)
            elif self.truth[name] != FALSE and recent.gap_end_ns is not None:
                yield recent.gap_end_ns + int(within_ns)

    # --- messages ----------------------------------------------------------------------------

    def _arrive(self, t_ns: int, arrived: Sequence[int], numbers: Sequence[float]) -> Sequence[int]:
        for name, (channel, _) in INPUTS.items():
            if channel in arrived:
                self.state[name], self.stamp_ns[name] = FRESH, t_ns
        if 0 in arrived:
            self.value["x"], self.value["z"] = known(numbers[0]), known(numbers[1])
        if 1 in arrived:
            self.value["y"], self.value["least"] = known(numbers[2]), numbers[3]
        return arrived

    def _expire(self, t_ns: int) -> None:
        """S10, S21."""
        stale: dict[str, Sequence[str]] = {"x": ("x", "rate", "mean"), "z": ("z",)}
        for name, (_, timeout_ns) in INPUTS.items():
            if self.state[name] != FRESH or timeout_ns is None:
                continue
            if t_ns - self.stamp_ns[name] >= timeout_ns:
                self.state[name] = EXPIRED
                self.value.update(dict.fromkeys(stale[name], NAN))
                if name == "x":
                    self.samples["x"] = []

    def _sample(self, name: str, x: float, t_ns: int) -> None:
        """S18."""
        taken = self.samples[name]
        if taken and taken[-1][0] == t_ns:
            taken.pop()
        taken.append((t_ns, x))

    def _window(self, name: str, within_ns: int) -> list[float]:
        """S43."""
        taken = self.samples[name]
        return [x for t_ns, x in taken if taken[-1][0] - t_ns < within_ns][-MOST_SAMPLES:]

    def _compute(self, t_ns: int, arrived: Sequence[int]) -> None:
        value = self.value
        if 0 in arrived:
            self._sample("x", value["x"], t_ns)
            value["rate"] = self._rate("x")
            value["mean"] = mean(self._window("x", 400))
        if 1 in arrived:
            self._sample("y", value["y"], t_ns)
            last = [x for _, x in self.samples["y"][-2:]]
            value["change"] = (
                NAN if len(last) < 2 or any(map(math.isnan, last)) else float(last[0] != last[1])
            )
            value["median"] = median(self._window("y", 800))
            value["low_pass"] = self._low_pass(value["y"], t_ns)
        value["quotient"] = known(divided(value["x"], value["y"]))
        value["sum"] = known(value["least"] + value["x"])

    def _rate(self, name: str) -> float:
        """S19."""
        if len(self.samples[name]) < 2:
            return NAN
        (t0_ns, x0), (t1_ns, x1) = self.samples[name][-2:]
        return known((x1 - x0) / (float(t1_ns - t0_ns) / 1e9))

    def _low_pass(self, x: float, t_ns: int) -> float:
        """S50."""
        results = self.samples["low_pass"]
        if results and results[-1][0] == t_ns:
            results.pop()
        y = x
        if results and not math.isnan(results[-1][1]):
            before_ns, before = results[-1]
            d = float(t_ns - before_ns) / 1e9
            y = before + (d / (3e-07 + d)) * (x - before)
        results.append((t_ns, known(y)))
        return known(y)

    def _follow(self, name: str, t_ns: int) -> None:
        """S32."""
        used, swing, _, _ = SWINGS[name]
        x, extreme, heading = self.value[used], self.extreme[name], self.heading[name]
        if math.isnan(x):
            return
        turned = 0
        if math.isnan(extreme) or (heading > 0 and x > extreme) or (heading < 0 and x < extreme):
            self.extreme[name] = x
        elif heading <= 0 and x > extreme + swing:
            turned = 1
        elif heading >= 0 and x < extreme - swing:
            turned = -1
        if turned:
            self.extreme[name], self.heading[name] = x, turned
            if heading != 0:
                self.recent[name].instants.append(t_ns)

    def _evaluate(self, t_ns: int, arrived: Sequence[int]) -> None:
        self._expire(t_ns)
        self._compute(t_ns, arrived)
        for name in SWINGS:
            if INPUTS[SWINGS[name][0]][0] in arrived:
                self._follow(name, t_ns)
        self.started, self.now_ns = True, t_ns
        for name in PROPOSITIONS:
            value = self._proposition(name, t_ns)
            if value != self.truth[name]:
                self.truth[name], self.since_ns[name] = value, t_ns
        for index, rule in enumerate(RULES):
            self._judge(index, rule, t_ns)

    def _proposition(self, name: str, t_ns: int) -> int:
        truth = self.truth
        if name in LEAVES:
            return self._leaf(name)
        if name in AGES:
            used, age_ns = AGES[name]
            if self.state[used] == NEVER_RECEIVED:
                return STALE if INPUTS[used][1] is not None else UNKNOWN
            return int(t_ns - self.stamp_ns[used] >= age_ns)
        if name in HELD:
            return self._held(name, t_ns)
        if name in SWINGS:
            return self._swings(name, t_ns)
        if name in EDGES:
            return self._edges(name, t_ns)
        if name in SINCES:
            held, begun = (truth[each] for each in SINCES[name])
            self.since[name] = either(begun, both(held, either(begun, self.since[name])))
            return self.since[name]
        return {
            "always": lambda: TRUE,
            "not_ever": lambda: FALSE,
            "not_inside": lambda: opposite(truth["x_inside"]),
            "once": lambda: opposite(truth["outside_held"]),
            "both": lambda: both(truth["rate_above"], truth["y_above"]),
            "either": lambda: either(truth["quotient_above"], truth["swing_y"]),
            "mixed": lambda: both(truth["either"], truth["changed"]),
        }[name]()

    def _leaf(self, name: str) -> int:
        used = LEAVES[name]
        x = self.value[used]
        if math.isnan(x):
            return self._unknown(used)
        ranges: Mapping[str, bool] = {
            "x_inside": -1.0 < x <= 2.0,
            "x_outside": not 0.0 < x <= 1.0,
            "x_above": x > 0.5,
            "y_huge": x > 1e300,
            "least_huge": x > 1e300,
            "rate_above": x > 1e7,
            "changed": x != 0.0,
            "mean_above": x > 0.5,
            "quotient_above": x > 1.0,
        }
        return int(ranges.get(name, x > 0.0))

    def _unknown(self, used: str) -> int:
        """S30, S54."""
        rests = RESTS_ON[used]
        guarded = [each for each in rests if each in INPUTS and INPUTS[each][1] is not None]
        if any(math.isnan(self.value[each]) for each in guarded):
            return STALE
        missing = [math.isnan(x) or x == math.inf for x in map(self.value.__getitem__, rests)]
        if "least" in rests and math.isinf(self.value["least"]):
            missing.append(True)
        return UNKNOWN if any(missing) or not guarded else STALE

    def _held(self, name: str, t_ns: int) -> int:
        """S33, S45."""
        condition, duration_ns = HELD[name]
        value = self.truth[condition]
        if value != TRUE:
            self.held[name], self.start_ns[name] = value, None
            return value
        start_ns = self.start_ns[name]
        if start_ns is None:
            start_ns = self.start_ns[name] = t_ns
        return TRUE if t_ns - start_ns >= duration_ns else self.held[name]

    def _swings(self, name: str, t_ns: int) -> int:
        used, _, count, within_ns = SWINGS[name]
        if not math.isfinite(self.value[used]):
            self.recent[name].instants.clear()
            self.extreme[name], self.heading[name] = NAN, 0
            return self._within(name, self._unknown(used), count, within_ns, t_ns)
        return self._within(name, TRUE, count, within_ns, t_ns)

    def _edges(self, name: str, t_ns: int) -> int:
        """S48."""
        condition, count, within_ns = EDGES[name]
        value = self.truth[condition]
        if value == TRUE and self.edge[name] == FALSE:
            self.recent[name].instants.append(t_ns)
        self.edge[name] = value
        return self._within(name, value, count, within_ns, t_ns)

    def _within(self, name: str, source: int, count: int, within_ns: int, t_ns: int) -> int:
        """Enough of them within the window, or what a gap leaves of that (S32, S48)."""
        recent = self.recent[name]
        if source >= UNKNOWN:
            recent.gap, recent.gap_end_ns = source, None
        elif recent.gap_end_ns is None:
            recent.gap_end_ns = t_ns
        if len(recent.instants) >= count and t_ns - recent.instants[-count] < within_ns:
            return TRUE
        if recent.gap_end_ns is not None and t_ns - recent.gap_end_ns >= within_ns:
            return FALSE
        return recent.gap

    # --- rules -------------------------------------------------------------------------------

    def _judge(self, index: int, rule: Rule, t_ns: int) -> None:
        """S35 to S37."""
        condition = self.truth[rule.condition]
        if not self.active[index]:
            if condition in (TRUE, STALE):
                self._change(index, ACTIVATED if condition == TRUE else ACTIVATED_STALE, t_ns)
        elif condition == FALSE and rule.release is not None and self.truth[rule.release] == TRUE:
            self._change(index, CLEARED, t_ns)

    def _change(self, index: int, change: int, t_ns: int) -> None:
        """S41."""
        rule = RULES[index]
        self.active[index] = not self.active[index]
        self.events.append(
            Event(
                change,
                t_ns,
                t_ns,
                index,
                tuple(self.truth[each] for each in rule.terms),
                tuple(self.since_ns[each] for each in rule.terms),
                tuple(self.value[each] for each in rule.values),
                self.state[rule.input],
            )
        )
