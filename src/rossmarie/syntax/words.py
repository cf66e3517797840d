"""The words of the language, as data."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

_LIKENESS = (
    0.7  # the share of common letters from which a word counts as a misspelling of another word
)

ITEM_WORDS = {
    "import": "import_item",
    "system": "system",
    "action": "action",
    "const": "constant",
    "input": "input",
    "entity": "entity",
    "rule": "rule",
    "if": "rule",
}
"""The words that begin an item, and the grammar's rule for that item."""

CONTEXTUAL_ITEM_WORDS = {
    "priority": "priority",
    "hazard": "hazard",
    "motion": "motion",
    "zone": "zone",
    "test": "test",
    "skills": "skills",
    "parameter": "parameter",
    "always": "rule",
}
"""The words that begin an item but may be names elsewhere, and the grammar's rule for the item."""

STATEMENT_WORDS = {"at": "at_instant", "every": "repeated", "expect": "expectation"}
"""The words that begin a statement of a test, and the grammar's rule for it."""

EFFECT_WORDS = {
    "limit": "limit",
    "scale": "scale",
    "block": "block",
    "publish": "publish",
    "retrace": "retrace",
    "call": "call_service",
    "set": "set_parameter",
    "switch": "switch_controllers",
    "send": "send_goal",
    "tree": "run_tree",
    "cancel": "cancel_goal",
    "log": "log",
    "diagnose": "diagnose",
    "hook": "hook",
    "reset": "reset_rules",
}
"""The words that begin an effect in the body of an action, and the grammar's rule for it."""

MEMBER_WORDS = {
    "topic": "topic_declaration",
    "service": "service_declaration",
    "server": "server_declaration",
    "resource": "resource_declaration",
    "unit": "unit_declaration",
    "messages": "messages_declaration",
    "frame": "frame_declaration",
    "node": "node",
}
"""The words that begin a declaration inside a system."""

PART_WORDS = frozenset(
    {"timeout", "clear", "when", "latched", "until", "reset", "times", "within", "by", "of"}
    | {"names", "from", "turned"}
    | {"unless", "category", "task", "feedback", "per", "activation", "margin", "mitigates"}
    | {"keeps", "below"}
    | {"box", "circle", "polygon", "radius"}
    | {"publishes", "subscribes", "on", "apart"}
    | {"since", "once", "after"}
    | {"doing", "ahead", "while", "always"}
    | {"with", "as", "tightens"}
)
"""The words that are keywords inside other items, and names elsewhere."""

MEANT = {"when": "if", "whenever": "if", "include": "import"}
"""Words with which users wrongly begin an item, and the correct word for each."""

OPERATOR_WORDS = frozenset({"and", "or", "not", "in", "for"})

RESERVED = OPERATOR_WORDS | ITEM_WORDS.keys() | {"topic", "then", "true", "false"}
"""Words that are never the name of a constant, input, entity, condition, action or rule."""

FOREIGN = {
    "&&": "and",
    "&": "and",
    "||": "or",
    "|": "or",
    "!": "not",
    "=": "==",
    "===": "==",
    "!==": "!=",
    "<>": "!=",
    "≠": "!=",
    "=<": "<=",
    "≤": "<=",
    "=>": ">=",
    "≥": ">=",
}
"""Operators in the notation of other languages, and the correct operator for each."""

COMPARISONS = frozenset({"==", "!=", "<", "<=", ">", ">="})


def nearest(word: str, words: Iterable[str]) -> str | None:
    """The word of `words` that equals `word` up to a small misspelling; None if there is none."""
    near = difflib.get_close_matches(word, words, n=1, cutoff=_LIKENESS)
    return near[0] if near else None


FORMS = {
    "module": "a file consists of imports, systems, actions, constants, inputs, entities and rules",
    "actions": "actions are written `{ ACTION; ACTION; }`",
    "step": "actions are written `{ ACTION; also ACTION else ACTION; }`",
    "import_item": 'an import is written `import "FILE.ross";` or '
    '`import "FILE.ross" with PARAMETER = VALUE, PARAMETER = VALUE as NAME;`',
    "parameter": "a parameter is written `parameter NAME = 0.5 m;`, `parameter NAME in m;`, "
    "`parameter NAME = topic /TOPIC;` or `parameter NAME = 0.5 m tightens up;`",
    "system": "a system is written `system NAME { topic /TOPIC : PACKAGE/TYPE; }`",
    "action": "an action is written `action NAME;` or `action NAME { EFFECT; EFFECT; }`",
    "skills": 'the skills are named by `skills "skills.json";`',
    "constant": "a constant is written `const NAME = 0.5 m/s;`",
    "input": "an input is written "
    "`input NAME = topic /TOPIC : PACKAGE/TYPE .FIELD timeout 0.2 sec;`",
    "skill_number": "a number of a skill that runs is written "
    "`input NAME = doing SKILL.PARAMETER in UNIT;`, "
    "a property of its individual `doing SKILL.PARAMETER.PROPERTY`",
    "element_names": "names of elements are written "
    '`.FIELD names ["NAME", "NAME"]`, in front of `in` and `timeout`',
    "entity": "an entity is written `entity NAME { CONDITION : EXPRESSION; }`",
    "condition": "a condition is written `NAME : EXPRESSION;`",
    "rule": "a rule is written `rule NAME: if CONDITION then { ACTION; };`",
    "unless": "rules that come first are written `if CONDITION unless RULE, RULE then ...`",
    "scope": "the scope of a rule is written "
    "`if CONDITION while doing SKILL, doing SKILL then ...`",
    "exemption": "an exemption is written after the actions: `unless doing SKILL;`, "
    "`unless doing SKILL then { ACTION; }` or "
    "`unless doing SKILL then if CONDITION then { ACTION; }`",
    "contract": "a resume contract is `clear when CONDITION`, `clear for 2 sec` or "
    "`latched until reset`",
    "expression": "a condition is built of names, comparisons, `and`, `or`, `not`, "
    "`for DURATION`, `since`, `once` and `after`",
    "doing": "a running skill is queried by `doing SKILL` or `doing SKILL(PARAMETER: CLASS)`",
    "ahead": "a skill that can start next is queried by `ahead SKILL` or "
    "`ahead SKILL(PARAMETER: CLASS)`",
    "over_time": "`once` and `after` end with a time: `once CONDITION within 2 sec`, "
    "`after CONDITION, CONDITION within 2 sec`; write `once (A and B) within 2 sec`",
    "topic_declaration": "a topic is declared as `topic /TOPIC : PACKAGE/TYPE;`",
    "service_declaration": "a service is declared as `service /SERVICE : PACKAGE/TYPE;`",
    "server_declaration": "an action server is declared as `server /SERVER : PACKAGE/TYPE;`",
    "resource_declaration": "a resource is declared as `resource NAME : /TOPIC, /SERVER;`",
    "unit_declaration": "the unit of a field is declared as `unit PACKAGE/TYPE.FIELD = rad/s;`",
    "messages_declaration": 'a folder of message definitions is declared as `messages "FOLDER";`',
    "frame_declaration": "a frame is declared as `frame NAME in PARENT timeout 0.2 sec;`, or as "
    "`frame NAME in PARENT at [0.3, 0, 0.5] m turned [0, 20, 180] deg;` if it is fixed",
    "node": "a node is declared as `node NAME { publishes /TOPIC; subscribes /TOPIC; }`",
    "hazard": 'a hazard is written `hazard NAME "WHAT MAY HAPPEN";`',
    "motion": "a motion is written "
    "`motion NAME { position : INPUT; speed : INPUT; brake : 0.6 m/s^2; "
    "acceleration : 0.5 m/s^2; fastest : 1.5 m/s; latency : 0.2 sec; }`",
    "part": "a part of a motion is written `NAME : EXPRESSION;`",
    "zone": "a zone is written "
    "`zone NAME in FRAME { box [0.2, 0.9, -0.4, 0.4] m; circle [0.9, 0] m radius 0.4 m; "
    "polygon [0, 1], [1, 1], [1, 2] m; }`",
    "shape": "a shape is written `box [XMIN, XMAX, YMIN, YMAX] m;`, "
    "`circle [X, Y] m radius 0.4 m;` or `polygon [X, Y], [X, Y], [X, Y] m;`",
    "keeps": "the guarantee of a rule is written after the resume contract: "
    "`keeps MOTION below 0.3 m/s in CLASS`",
    "category": "the category of a rule is written after the resume contract: "
    "`category operation`, `category human` or `category environment`",
    "task": "the task of a rule is written after the category: "
    "`task dependent` or `task independent`",
    "feedback": "the feedback for a learner is written after the resume contract: "
    "`feedback 1.0 per activation, 0.5 per sec, margin in N`",
    "mitigates": "the hazards of a rule are written after the resume contract: "
    "`mitigates HAZARD, HAZARD`",
    "priority": "the order of rules is written `priority RULE over RULE;`",
    "test": "a test is written "
    '`test "NAME" { at 0 sec INPUT = VALUE; expect RULE active at 1 sec; }`',
    "statement": "a statement of a test begins with `at`, `every` or `expect`",
    "at_instant": "a message is written `at 1 sec INPUT.FIELD = VALUE, INPUT;`, "
    "a reset `at 1 sec reset;`",
    "repeated": "messages are repeated by `every 0.1 sec from 0 sec to 5 sec INPUT.FIELD = VALUE;`",
    "expectation": "an expectation is written `expect RULE active at 1 sec;` or "
    "`expect RULE inactive from 0 sec until 1 sec;`; of a command "
    "`expect /TOPIC.FIELD in [-0.2, 0.2] m/s at 1 sec;`",
    "effect": "an effect begins with a keyword, such as `limit` or `publish`",
    "limit": "a limit is written `limit /TOPIC { FIELD in [-0.2, 0.2] m/s; } ramp 0.3 m/s^2;`",
    "scale": "a command is scaled by `scale /TOPIC by 50 % ramp 20 %/s;`",
    "block": "a command is held at zero by `block /TOPIC;`",
    "publish": "a message is published by "
    "`publish /TOPIC : PACKAGE/TYPE { FIELD = VALUE; } at 2 Hz;`",
    "retrace": "poses are sent back by "
    "`retrace INPUT on /TOPIC : PACKAGE/TYPE up to 100 apart 1 cm at 5 Hz;`",
    "call_service": "a service is called by "
    "`call /SERVICE : PACKAGE/TYPE { FIELD = VALUE; } within 1 sec else ACTION;`",
    "set_parameter": "a parameter is set by `set /NODE.PARAMETER to VALUE;`",
    "switch_controllers": "controllers are switched by "
    "`switch /controller_manager { stop NAME; start NAME; };`",
    "run_tree": "a behavior tree is run by "
    "`tree SKILL(PARAMETER: VALUE) within 20 sec then resume else ACTION;`; "
    "`then retry` and `then replan` start the task again",
    "send_goal": "a goal is sent by "
    "`send PACKAGE/TYPE { FIELD = VALUE; } to /SERVER within 10 sec then resend;`",
    "cancel_goal": "a goal is cancelled by "
    "`cancel /SERVER confirm by CONDITION within 0.5 sec then drop else ACTION;`",
    "log": 'a line is logged by `log warning "TEXT";`',
    "diagnose": 'a diagnostic status is given by `diagnose error "TEXT";`',
    "hook": "a function of your own is called by `hook NAME;`",
    "reset_rules": "all latched rules are reset by `reset;`",
}
"""The words for each part of a file, in messages."""
