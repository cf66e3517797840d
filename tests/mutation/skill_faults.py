"""Faults of rules that know skills: where the compiler asks, and where messages are answered.

`COMPILER` are those of Python, by the files that have them, below `src/rossmarie`; `NODE` are those
of the C++ of nodes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mutation.past_faults import Damage

COMPILER: Mapping[str, Sequence[Damage]] = {
    "check/skills/doing.py": (
        Damage("a class is itself alone", "skills.classes.below(class_name)", "(class_name,)"),
        Damage("a class is all above it", "classes.below(class_name)", "classes.above(class_name)"),
        Damage("a skill is itself alone", "skills.skills.below(skill.name)", "(skill.name,)"),
        Damage(
            "one limit of several counts",
            "sorted(arguments.items())",
            "sorted(arguments.items())[:1]",
        ),
    ),
    "skills/closed.py": (
        Damage(
            "derived is what is derived at once",
            "                found.add(each)\n                waiting.append(each)",
            "                found.add(each)",
        ),
        Damage(
            "of several parents the first counts",
            "for parent in above:",
            "for parent in above[:1]:",
        ),
    ),
    "check/system/skill_numbers.py": (
        Damage("a number of the skill alone", "skills.skills.below(skill.name)", "(skill.name,)"),
        Damage(
            "a number of another argument",
            "all_skills, parameter.name, None, text",
            "all_skills, next(iter(skill.parameters)), None, text",
        ),
        Damage(
            "any number is a boolean",
            'is_boolean = parameter.type == "bool"',
            "is_boolean = False",
        ),
    ),
    "ir/skills.py": (
        Damage(
            "the digest is not compared", 'if _text(context, "digest") != step.export:', "if False:"
        ),
        Damage("65 skills are not too many", "MOST_RUNNING = 64", "MOST_RUNNING = 65"),
        Damage("64 skills are too many", "MOST_RUNNING = 64", "MOST_RUNNING = 63"),
        Damage("65 arguments are not too many", "MOST_ARGUMENTS = 64", "MOST_ARGUMENTS = 65"),
        Damage("64 arguments are too many", "MOST_ARGUMENTS = 64", "MOST_ARGUMENTS = 63"),
        Damage("65 properties are not too many", "MOST_PROPERTIES = 64", "MOST_PROPERTIES = 65"),
        Damage("64 properties are too many", "MOST_PROPERTIES = 64", "MOST_PROPERTIES = 63"),
        Damage(
            "one limit that fits is enough",
            "running.skill in step.skills and all(",
            "running.skill in step.skills and (any if step.arguments else all)(",
        ),
        Damage(
            "an individual is of its first class",
            "any(each.type in classes for each in _called(running, parameter))",
            "[each.type in classes for each in _called(running, parameter)][:1] == [True]",
        ),
        Damage(
            "a class is that of any argument",
            "return (each for each in running.arguments if each.parameter == parameter)",
            "return iter(running.arguments)",
        ),
        Damage(
            "nobody knows what is ahead, so nothing is",
            "float(is_yes) if _is_ahead_known(context) else math.nan",
            "float(is_yes and _is_ahead_known(context))",
        ),
        Damage(
            "what runs is ahead",
            "any(_may_do(step, each) for each in ahead)",
            "any(_may_do(step, each) for each in running)",
        ),
        Damage(
            "what is not known yet fits nothing",
            "tuple(limit for limit in step.arguments if limit[0] in known)",
            "step.arguments",
        ),
        Damage("of several skills the first is asked", "if len(asked) != 1:", "if not asked:"),
        Damage(
            "of several numbers the first is taken",
            "bool(numbers) and all(each == numbers[0] for each in numbers[1:])",
            "bool(numbers)",
        ),
        Damage("a boolean is any number", "step.is_boolean and numbers", "False and numbers"),
        Damage("a number of another property", "if p.property == step.property", "if p.property"),
    ),
    "lowering/skills.py": (
        Damage(
            "what rules ask is never late",
            "self._context(CONTEXT, self._skills.timeout_ns)",
            "self._context(CONTEXT, None)",
        ),
        Damage(
            "an exemption outlasts the context",
            "return self._nodes.conjunction((self._flag(node, used), fresh), text)",
            "return self._flag(node, used)",
        ),
        Damage(
            "what an exemption rests on is stale",
            'self._context(f"{CONTEXT}_kept", None)',
            'self._context(f"{CONTEXT}_kept", self._skills.timeout_ns)',
        ),
        Damage(
            "an exemption outlasts the context for a while",
            "ir.AgeReaches(self._inputs.input(used), timeout_ns)",
            "ir.AgeReaches(self._inputs.input(used), 2 * timeout_ns)",
        ),
        Damage("a query without its limits", "found.skills, found.arguments", "found.skills, ()"),
        Damage("a query of another file", "self._skills.file.digest", '"0" * 64'),
    ),
    "lowering/contracts.py": (
        Damage(
            "a scope is the first skill",
            "skills.asked, rule.scope))",
            "skills.asked, rule.scope[:1]))",
        ),
        Damage("a scope is all its skills", "nodes.disjunction(asked", "nodes.conjunction(asked"),
        Damage(
            "a scope ends with the context",
            "map(skills.asked, rule.scope)",
            "map(skills.kept, rule.scope)",
        ),
        Damage("a scope says nothing", "if rule.scope:", "if False:"),
        Damage(
            "a scope is turned round",
            "nodes.disjunction(asked, Shown(scope, rule.scope[0].span))",
            "nodes.negation(nodes.disjunction(asked, Shown(scope, rule.scope[0].span)),"
            " Shown(scope, rule.scope[0].span))",
        ),
        Damage("the first exemption counts", "in rule.exemptions:", "in rule.exemptions[:1]:"),
        Damage("the last exemption counts", "in rule.exemptions:", "in rule.exemptions[-1:]:"),
        Damage(
            "who is exempted is asked without a timeout",
            "asked_for = skills.asked(",
            "asked_for = skills.kept(",
        ),
        Damage(
            "an exemption is used where nobody knows",
            "parts.append(skills.kept(doing))",
            "parts.append(skills.asked(doing))",
        ),
        Damage("an exemption is used whatever runs", "parts.append(skills.kept(doing))", "pass"),
    ),
    "check/scopes/exemptions.py": (
        Damage(
            "another condition is dropped",
            "exemption.condition, steps)",
            "rule.condition, steps)",
        ),
        Damage(
            "an exemption has no scope", "        contracts=(),", "        contracts=(), scope=(),"
        ),
        Damage("an exemption has the contract", "        contracts=(),\n", ""),
        Damage(
            "the use of an exemption is not reported",
            'yield _made(rule, exemption, f"{name}_doing_{suffix}", rule.condition, ())',
            "pass",
        ),
        Damage(
            "what is done instead is dropped",
            'f"{name}_doing_{suffix}", rule.condition, steps)',
            'f"{name}_doing_{suffix}", rule.condition, ())',
        ),
        Damage("an exemption is turned into a rule", "        made_from=exemption,\n", ""),
    ),
    "check/rules/exemptions.py": (
        Damage("`always` is ignored", "if rule.always is not None:", "if False:"),
        Damage(
            "`always` allows a scope",
            'parts = [(scope, "scope") for scope in rule.scope]',
            "parts = []",
        ),
        Damage("a hazard is left alone", "if not exemption.steps and rule.mitigates:", "if False:"),
        Damage("an exemption stands twice", "if first is not exemption:", "if False:"),
    ),
    "lowering/calls.py": (
        Damage(
            "every parameter has a value",
            "    found.setdefault((False,) * len(asked), NO_VALUE)\n",
            "",
        ),
        Damage(
            "an individual has one class",
            "for other, beside in others.items():",
            "for other, beside in ():",
        ),
        Damage(
            "skills run as they are declared",
            "    own = _distinguished(",
            "    return [(individual.type,)]\n    own = _distinguished(",
        ),
        Damage(
            "calls of one skill are left out",
            "in skills.file.skills.values():",
            "in [*skills.file.skills.values()][:-1]:",
        ),
    ),
    "ir/calls.py": (
        Damage("calls that answer too much", "if yes <= left]", "if yes & left]"),
        Damage(
            "an individual is of no class",
            "SkillArgument(parameter, type=kind)",
            "SkillArgument(parameter)",
        ),
    ),
}

NODE: Sequence[Damage] = (
    Damage("the digest is not compared", "context.digest == digest && ", ""),
    Damage("65 are not too many", "MOST = 64;", "MOST = 65;"),
    Damage("64 are too many", "MOST = 64;", "MOST = 63;"),
    Damage("skills are not counted", "skills.size() > MOST", "false"),
    Damage("nobody knows what is ahead, so nothing is", " || !context.is_ahead_known", ""),
    Damage("what runs is ahead", "skill : context.ahead)", "skill : context.running)"),
    Damage("what is not known yet fits nothing", "(is_open(skill, limits) || ", "("),
    Damage("what is ahead is not counted", "are_readable(context.ahead)", "true"),
    Damage("arguments are not counted", "skill.arguments.size() > MOST", "false"),
    Damage("properties are not counted", "argument.properties.size() > MOST", "false"),
    Damage(
        "the first name counts",
        "        if (wanted == name)\n            return true;\n    return false;",
        "        return wanted == name;\n    return false;",
    ),
    Damage("a class is that of any argument", "argument.parameter == limit.parameter && ", ""),
    Damage(
        "an individual is of its first class",
        "if (argument.parameter == limit.parameter && has(limit.classes, argument.type))\n"
        "            return true;",
        "if (argument.parameter == limit.parameter)\n"
        "            return has(limit.classes, argument.type);",
    ),
    Damage(
        "one limit that fits is enough",
        "(is_within(skill, limits) && ...)",
        "(sizeof...(limits) == 0 || (is_within(skill, limits) || ...))",
    ),
    Damage("limits say nothing", " && (is_within(skill, limits) && ...)", ""),
    Damage(
        "no skill is not known",
        "    return 0.0;\n}\n\n// Returns true if a skill",
        "    return NAN;\n}\n\n// Returns true if a skill",
    ),
    Damage(
        "of several skills the first is asked",
        "            return;\n        found = &skill;",
        "            break;\n        found = &skill;",
    ),
    Damage(
        "of several skills the last is asked",
        "        if (found != nullptr)\n            return;\n",
        "",
    ),
    Damage("of several numbers the first is taken", "number == number_", "true"),
    Damage(
        "of several numbers the last is taken",
        "is_one_ = is_one_ && (!is_there_ || number == number_);\n"
        "        number_ = is_there_ ? number_ : number;",
        "number_ = number;",
    ),
    Damage("a number of another argument", "        if (argument.parameter == parameter)\n", ""),
    Damage("a number of another property", "            if (each.property == property)\n", ""),
    Damage("a boolean is any number", "number == 0.0 || number == 1.0 ? number : NAN", "number"),
)
