"""Small machines whose generated C is kept as golden files, each for one thing to look at."""

from __future__ import annotations

from dataclasses import replace

from dslkit.source import SourceFile, Span
from rossmarie import ir
from rossmarie.ir import Comparison, Function, reactions
from support.drafts import SECOND, Draft

_TEXT = """\
drive.fast: speed > 0.5 m/s for 2.0 sec
drive.slow: speed in [0.1, 0.2] m/s
rule slow_down: if drive.fast and not docked then { brake; };
"""
_FILE = SourceFile("rules/drive.ross", _TEXT)


def _line(number: int) -> Span:
    lines = _TEXT.splitlines(keepends=True)
    start = sum(len(line) for line in lines[: number - 1])
    return Span(_FILE, start, start + len(lines[number - 1]) - 1)


def _placed(draft: Draft, propositions: dict[int, int], rules: dict[int, int]) -> None:
    """Give propositions and rules their lines and the words that stand there."""
    for index, number in propositions.items():
        span = _line(number)
        draft.propositions[index] = replace(draft.propositions[index], span=span, text=span.text)
    for index, number in rules.items():
        draft.rules[index] = replace(draft.rules[index], span=_line(number))


def thresholds() -> ir.Machine:
    """Comparisons with fixed limits, a duration, a rule that clears at once and a latched one."""
    draft = Draft()
    channel = draft.channel()
    speed = draft.signal(ir.Read(draft.slot(draft.input(channel))), "speed", "m/s")
    docked = draft.signal(ir.Read(draft.slot(draft.input(channel), ir.FieldKind.FLAG)), "docked")
    fast = draft.proposition(ir.Held(draft.above(speed, 0.5), 2 * SECOND), "drive.fast")
    away = draft.proposition(ir.Not(draft.proposition(ir.Flag(docked))))
    slow = draft.proposition(
        ir.Between(speed, draft.constant(0.1), draft.constant(0.2)), "drive.slow"
    )
    draft.rule(draft.proposition(ir.And((fast, away))))
    draft.rule(slow, latched=True)
    _placed(draft, {fast: 1, slow: 2}, {0: 3, 1: 3})
    return draft.machine("thresholds")


def timeouts() -> ir.Machine:
    """Two topics with timeouts, an age, a clearing condition that must hold."""
    draft = Draft()
    speed = draft.read(SECOND // 5)
    battery = draft.read(SECOND)
    low = draft.proposition(ir.Compare(Comparison.LESS, battery, draft.constant(11.5)))
    stale = draft.proposition(ir.AgeReaches(1, 3 * SECOND), "battery.stale")
    calm = draft.proposition(ir.Held(draft.proposition(ir.Not(draft.above(speed, 1.0))), SECOND))
    draft.rule(draft.proposition(ir.Or((low, stale))), calm)
    return draft.machine("timeouts")


def arrays() -> ir.Machine:
    """One pass over the elements of an array for a minimum, a count and two quantifiers."""
    draft = Draft()
    ranges = draft.elements(SECOND)
    near = draft.above(ranges, 0.5)
    nearest = draft.signal(ir.Fold(ir.Folding.MINIMUM, ranges), "min(ranges)", "m")
    crowd = draft.above(draft.signal(ir.Count(near), "count(ranges > 0.5 m)"), 3.0)
    some = draft.proposition(ir.Quantified(ir.Quantifier.ANY, near))
    every = draft.proposition(ir.Quantified(ir.Quantifier.ALL, near))
    close = draft.proposition(ir.Compare(Comparison.LESS, nearest, draft.constant(0.3)))
    draft.rule(draft.proposition(ir.Or((close, crowd, draft.proposition(ir.And((some, every)))))))
    return draft.machine("arrays")


def memories() -> ir.Machine:
    """All that remembers samples or edges, a quaternion, numbers compared with each other."""
    draft = Draft(texts=("docked",))
    channel = draft.channel()
    used = draft.input(channel, SECOND)
    x, y, z, w = (draft.signal(ir.Read(draft.slot(used))) for _ in range(4))
    pitch = draft.apply(Function.PITCH, x, y, z, w)
    rate = draft.signal(ir.Sampled(ir.Sampling.RATE, pitch), "rate(orientation.pitch())", "rad/s")
    before = draft.signal(
        ir.Sampled(ir.Sampling.PREVIOUS, pitch), "previous(orientation.pitch())", "rad"
    )
    rising = draft.proposition(ir.Compare(Comparison.GREATER, pitch, before))
    median = draft.signal(
        ir.Sampled(ir.Sampling.MEDIAN, pitch, SECOND), "median(orientation.pitch(), 1 sec)", "rad"
    )
    draft.rule(draft.above(median, 0.2))
    jolt = draft.proposition(ir.Oscillates(x, 3, SECOND // 4, 0.1))
    draft.rule(draft.proposition(ir.And((rising, draft.above(rate, 0.5)))))
    draft.rule(jolt)
    mean = draft.signal(ir.Sampled(ir.Sampling.MEAN, x, SECOND), "mean(x, 1 sec)")
    smooth = draft.signal(ir.Sampled(ir.Sampling.LOW_PASS, x, SECOND // 5), "low_pass(x, 0.2 sec)")
    draft.rule(draft.proposition(ir.And((draft.above(mean, 0.3), draft.above(smooth, 0.4)))))
    draft.rule(draft.proposition(ir.Recurs(jolt, 2, 10 * SECOND)))
    return draft.machine("memories")


_ACTIONS = """\
action slow_down {
  limit /cmd_vel { linear.x in [-0.2, 0.5] m/s ramp 0.5 m/s^2; } else { log error "*/ no"; }
  scale /cmd_vel by 50 %;
} then { set /planner.speed to 0.2 within 2 sec; }
action stop {
  cancel /move_base confirm by standing within 2 sec;
} otherwise { call /relay/off : std_srvs/Trigger within 1 sec; }
"""
_ACTIONS_FILE = SourceFile("rules/actions.ross", _ACTIONS)


def _words(words: str) -> Span:
    start = _ACTIONS.index(words)
    return Span(_ACTIONS_FILE, start, start + len(words))


def reacting() -> ir.Machine:
    """Two rules that do something: limits, stages, escalations, one resource that both need."""
    draft = Draft()
    channel = draft.channel()
    speed = draft.signal(ir.Read(draft.slot(draft.input(channel, SECOND))), "speed", "m/s")
    fast, standing = draft.above(speed, 0.5), draft.proposition(ir.Not(draft.above(speed, 0.0)))
    draft.rule(fast)
    draft.rule(fast, latched=True)
    return replace(
        draft.machine("reacting"), watches=(standing,), reactions=_reactions("/cmd_vel", "act")
    )


def _reactions(topic: str, action: str) -> ir.Reactions:
    fields = tuple(
        reactions.CommandField((part, axis), False, unit)
        for part, axis, unit in (("linear", "x", "m/s"), ("angular", "z", "rad/s"))
    )
    kind = reactions.Interrupted.RESEND
    effects = (
        (reactions.Limit(0, (reactions.Bound(0, -0.2, 0.5, 0.5),)), None, (), "limit /cmd_vel"),
        (reactions.Scale(0, 0.5, None), None, (), "scale /cmd_vel by 50 %"),
        (reactions.SetParameter("/planner", "speed", 0.2, 2 * SECOND), 0, (), "set /planner.speed"),
        (
            reactions.CancelGoal("/move_base", None, 0, 2 * SECOND, kind),
            1,
            (4,),
            "cancel /move_base",
        ),
        (reactions.Call("/relay/off", "std_srvs/Trigger", (), SECOND), 2, (5,), "call /relay/off"),
        (reactions.Log(reactions.Level.ERROR, "no"), None, (), 'log error "*/ no"'),
        (reactions.SetParameter("/planner", "speed", 0.0, SECOND), 0, (), "set /planner.speed"),
    )
    return ir.Reactions(
        commands=(reactions.CommandTopic(topic, "geometry_msgs/Twist", fields, _words("limit")),),
        actions=(reactions.Action(action, None, _words("action slow_down")),),
        resources=(f"parameter {topic}", "server /move_base", "service /relay/off"),
        tasks=tuple(
            reactions.Task(0, effect, resource, otherwise, _words(words))
            for effect, resource, otherwise, words in effects
        ),
        plans=(
            reactions.RecoveryPlan(((0, 1), (2,)), (0, 1, 2)),
            reactions.RecoveryPlan(((3, 6),), (3, 4, 5, 6)),
        ),
        order=(1, 0),
    )


CASES = {make.__name__: make for make in (thresholds, timeouts, arrays, memories, reacting)}
