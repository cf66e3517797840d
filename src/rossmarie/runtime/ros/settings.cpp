// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
#include "settings.h"

#include "descriptions.h"

#include <algorithm>
#include <string>

static const std::vector<ParameterText> OF_ALL_RULES = {
    {"command_timeout", ParameterText::NUMBER, 0.5, 0.0, 1e6,
     "A command older than this (s) is not sent again when its bounds change."},
    {"filter_rate", ParameterText::NUMBER, 20.0, 0.1, 1000.0,
     "How often (Hz) the node sends commands of its own: 0 while nothing may pass, and "
     "along ramps."},
    {"patience", ParameterText::NUMBER, 5.0, 0.0, 1e6,
     "Until all inputs with a timeout have arrived, rules are not looked at and no command "
     "passes; after this (s) those that are missing count as stale."},
    {"grace_period", ParameterText::NUMBER, 0.0, 0.0, 1e6,
     "After this (s) commands pass even if inputs have never arrived; 0 is never."},
    {"clock_timeout", ParameterText::NUMBER, 0.0, 0.0, 1e6,
     "No command passes while ROS time stands still for longer than this (s) by the wall "
     "clock; 0 is the shortest timeout of an input. A simulation that waits for the node, "
     "or for the machine, needs more."},
    {"state_file", ParameterText::TEXT, 0.0, 0.0, 0.0,
     "The file that keeps latched rules over a restart, of this node alone; empty for a "
     "file in ~/.ros with the names of the node and of its latched rules."},
    {"header_stamps", ParameterText::TEXTS, 0.0, 0.0, 0.0,
     "The input topics of which the stamps in the headers count, not the arrival: a "
     "message whose stamp is old, in the future, or not later than the one before is "
     "refused."},
};

// The parameters of these rules: from the value in the rules to the tightest value, whichever of
// the two is greater.
static std::vector<ParameterText> with_own()
{
    std::vector<ParameterText> all = OF_ALL_RULES;
    for (const RuleParameter &each : RULE_PARAMETERS)
        all.push_back({each.name, ParameterText::NUMBER, each.usual,
                       std::min(each.usual, each.farthest), std::max(each.usual, each.farthest),
                       each.about});
    return all;
}

const std::vector<ParameterText> &parameter_texts()
{
    static const std::vector<ParameterText> all = with_own();
    return all;
}

static int64_t nanoseconds(double seconds) { return static_cast<int64_t>(seconds * 1e9); }

static const ParameterText *parameter_called(const std::string &name)
{
    const std::vector<ParameterText> &all = parameter_texts();
    const auto found = std::find_if(
        all.begin(), all.end(), [&name](const ParameterText &each) { return each.name == name; });
    return found == all.end() ? nullptr : &*found;
}

// A number within the limits of its parameter; NaN is not.
static double number(const ParameterSource &source, const char *name)
{
    const ParameterText &about = *parameter_called(name);
    double value = about.usual;
    source.read(name, value);
    if (!(about.low <= value && value <= about.high))
        throw BadParameter(name, "it must be from " + std::to_string(about.low) + " to " +
                                     std::to_string(about.high) + ", and is " +
                                     std::to_string(value));
    return value;
}

// A misspelt name would leave a safety setting at its default.
static void refuse_unknown(const ParameterSource &source)
{
    for (const std::string &name : source.names())
        if (parameter_called(name) == nullptr) {
            std::string known;
            for (const ParameterText &each : parameter_texts())
                known += std::string(known.empty() ? "" : ", ") + each.name;
            throw BadParameter(name, "there is no such parameter; there are " + known);
        }
}

Settings settings(const ParameterSource &source)
{
    refuse_unknown(source);
    Settings settings;
    settings.command_timeout_ns = nanoseconds(number(source, "command_timeout"));
    settings.filter_period_ns = nanoseconds(1.0 / number(source, "filter_rate"));
    settings.patience_ns = nanoseconds(number(source, "patience"));
    settings.grace_ns = nanoseconds(number(source, "grace_period"));
    settings.clock_timeout_ns = nanoseconds(number(source, "clock_timeout"));
    source.read("state_file", settings.state_file);
    source.read("header_stamps", settings.header_stamps);
    for (const RuleParameter &each : RULE_PARAMETERS)
        settings.given.push_back(number(source, each.name));
    return settings;
}
