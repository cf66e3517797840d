// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// Tables of the generated rules.cpp: the names of rules, inputs and tasks, and their needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// The display of a value in a verdict: value * scale + offset in `unit`.
struct ValueText {
    enum Kind { NUMBER, FLAG, TEXT } kind;
    const char *unit;
    double scale;
    double offset;
    const char *name = "";
};

struct RuleInput {
    int input;
    bool has_timeout;
};

// The texts of a rule, in the words of its author, and the terms of its verdicts. A rule that is
// always applied cannot be exempted.
struct RuleText {
    const char *name;
    const char *condition;
    const char *contract;
    bool is_latched;
    std::vector<ValueText> values;
    std::vector<RuleInput> inputs;
    std::vector<std::string> categories = {};
    bool is_always = false;
};
extern const std::vector<RuleText> RULES;

// Texts that the rules know; a text of a message is the index of one of them.
extern const std::vector<std::string> TEXTS;

// An input of the rules, and the topic that it comes from.
struct InputText {
    const char *name;
    const char *topic;
};
extern const std::vector<InputText> INPUTS;

// A topic that the node listens to. Its messages are too old at an age of `timeout_ns`; 0: never.
struct ChannelText {
    const char *topic;
    int64_t timeout_ns;
    bool has_stamp;
};
extern const std::vector<ChannelText> CHANNELS;

// A parameter of the rules, in SI units: from what the rules say to the last value that counts.
struct RuleParameter {
    const char *name;
    double usual;
    double farthest;
    const char *about;
};
extern const std::vector<RuleParameter> RULE_PARAMETERS;

// The source of commands.
extern const std::vector<std::string> SOURCES;

struct TaskText {
    int rule;
    const char *action;
    const char *effect;
    const char *place;
};
extern const std::vector<TaskText> TASKS;

// A requirement on another node: a service, or a topic that shows its presence.
struct OtherText {
    const char *title;
    const char *name;
    bool is_service;
};
extern const std::vector<OtherText> OTHERS;

// The key of the names of the latched rules: another set of them has another key.
extern const char *const LATCHED_RULES_KEY;

// The number of rows of a table; the index identifies a row.
template <class Row> int count(const std::vector<Row> &table)
{
    return static_cast<int>(table.size());
}

// The row of a rule that the C describes.
template <class Description>
RuleText rule_text(const Description &rule, bool is_latched, std::vector<ValueText> values,
                   std::vector<RuleInput> inputs, std::vector<std::string> categories = {},
                   bool is_always = false)
{
    for (std::size_t value = 0; value < values.size(); value++)
        values[value].name = rule.values[value];
    return {rule.name,         rule.condition,    rule.contract,         is_latched,
            std::move(values), std::move(inputs), std::move(categories), is_always};
}
