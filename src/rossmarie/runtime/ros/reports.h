// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The texts of verdicts, inputs and tasks for logs and diagnostics.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "descriptions.h"
#include "interfaces.h"
#include "middleware.h"
#include "rules.h"

namespace reports {

inline std::string shown(const ValueText &text, double value)
{
    if (std::isnan(value))
        return "unknown";
    if (text.kind == ValueText::FLAG)
        return value != 0.0 ? "true" : "false";
    if (text.kind == ValueText::TEXT)
        return value < 0.0 ? "another text" : TEXTS[static_cast<std::size_t>(value)];
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value * text.scale + text.offset);
    return *text.unit ? std::string(buffer) + " " + text.unit : buffer;
}

inline std::string of_input(int input, int state)
{
    const InputText &text = INPUTS[input];
    const std::string what = std::string("input ") + text.name + " (" + text.topic + ") ";
    return what + (state == core::NEVER_RECEIVED ? "has never been received"
                                                 : "is older than its timeout");
}

// Returns the stale inputs of a rule. If no input is stale, returns its values and its condition.
inline std::string cause(const core::Event &event)
{
    const RuleText &rule = RULES[event.rule];
    std::string stale;
    for (std::size_t i = 0; i < rule.inputs.size(); i++)
        if (rule.inputs[i].has_timeout && event.inputs[i] != core::FRESH)
            stale += (stale.empty() ? "" : "; ") + of_input(rule.inputs[i].input, event.inputs[i]);
    const bool is_stale = event.change == core::ACTIVATED_STALE;
    if (is_stale && !stale.empty())
        return stale;
    std::string cause = is_stale ? "messages arrive without a usable value: " : "";
    for (std::size_t i = 0; i < rule.values.size(); i++)
        cause += rule.values[i].name + (" = " + shown(rule.values[i], event.values[i])) + "; ";
    return cause + (event.change == core::CLEARED ? "no longer: " : "") + rule.condition;
}

inline Verdict time_jump(int64_t at_ns, const char *direction, int64_t far_ns)
{
    Verdict verdict;
    verdict.at = Middleware::time(at_ns);
    verdict.change = Verdict::TIME_JUMP;
    verdict.cause = std::string("time jumped ") + direction + " by " +
                    std::to_string(static_cast<double>(far_ns) / 1e9) + " s";
    return verdict;
}

inline Verdict verdict(const core::Event &event)
{
    if (event.change == core::TIME_JUMP)
        return time_jump(event.at_ns, "back", event.from_ns - event.at_ns);
    Verdict verdict;
    verdict.at = Middleware::time(event.at_ns);
    verdict.change = static_cast<uint8_t>(event.change);
    const RuleText &rule = RULES[event.rule];
    verdict.rule = rule.name;
    verdict.categories = rule.categories;
    verdict.cause = cause(event);
    verdict.clears = rule.contract;
    for (std::size_t i = 0; i < rule.values.size(); i++) {
        const ValueText &text = rule.values[i];
        Value value;
        value.name = text.name;
        value.value = event.values[i] * text.scale + text.offset;
        value.unit = text.unit;
        verdict.values.push_back(value);
    }
    for (const TaskText &task : TASKS)
        if (task.rule == event.rule)
            verdict.actions.push_back(std::string(task.action) + ": " + task.effect);
    return verdict;
}

// Returns a verdict as a line of the log.
inline std::string line(const Verdict &verdict)
{
    if (verdict.change == Verdict::TIME_JUMP)
        return verdict.cause;
    const bool is_cleared = verdict.change == Verdict::CLEARED;
    std::string filed;
    for (const std::string &category : verdict.categories)
        filed += (filed.empty() ? " (" : ", ") + category;
    filed += filed.empty() ? "" : ")";
    return "rule " + verdict.rule + filed + (is_cleared ? " is cleared: " : " is active: ") +
           verdict.cause;
}

inline std::string of_task(int task)
{
    const TaskText &text = TASKS[task];
    return std::string(text.action) + " (" + text.effect + ", " + text.place + ")";
}

} // namespace reports
