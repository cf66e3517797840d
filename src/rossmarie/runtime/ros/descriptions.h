// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The tables of the generated rules.cpp: names of rules, inputs and tasks, and their requirements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// The format of a value in a verdict: value * scale + offset, in `unit`.
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

// The texts of a rule from the rules file, and the values and inputs of its verdicts. An operator
// cannot exempt a rule with `always`.
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

// The texts that the rules compare. The monitor represents a text of a message by its index here.
extern const std::vector<std::string> TEXTS;

// An input of the rules, and its topic.
struct InputText {
    const char *name;
    const char *topic;
};
extern const std::vector<InputText> INPUTS;

// The longest timeout, 1e9 s. A transform on /tf_static has this timeout. Rules give it to an input
// that is necessary but published only once.
constexpr int64_t FOREVER_NS = 1'000'000'000'000'000'000;

// Returns true if a message expires. A message that does not expire may arrive only once.
inline bool expires(int64_t timeout_ns) { return timeout_ns != 0 && timeout_ns != FOREVER_NS; }

// A topic that the node subscribes to. A message expires at the age `timeout_ns`. 0 means that the
// node also runs without a message.
struct ChannelText {
    const char *topic;
    int64_t timeout_ns;
    bool has_stamp;
};
extern const std::vector<ChannelText> CHANNELS;

// A parameter of the rules, in SI units, with its default and its strictest value.
struct RuleParameter {
    const char *name;
    double usual;
    double farthest;
    const char *about;
};
extern const std::vector<RuleParameter> RULE_PARAMETERS;

// The source topics of the commands.
extern const std::vector<std::string> SOURCES;

struct TaskText {
    int rule;
    const char *action;
    const char *effect;
    const char *place;
};
extern const std::vector<TaskText> TASKS;

// A requirement on another node: a service, or a topic that shows the presence of the node.
struct OtherText {
    const char *title;
    const char *name;
    bool is_service;
};
extern const std::vector<OtherText> OTHERS;

// A key for the set of names of the latched rules. Another set has another key.
extern const char *const LATCHED_RULES_KEY;

// Returns the number of rows of a table. The index of a row identifies the row.
template <class Row> int count(const std::vector<Row> &table)
{
    return static_cast<int>(table.size());
}

// Returns the row of a rule from its description in the generated C.
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
