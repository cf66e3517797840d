// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
#include "settings.h"

#include "descriptions.h"

#include <algorithm>
#include <string>

static const std::vector<ParameterText> OF_ALL_RULES = {
    {"command_timeout", ParameterText::NUMBER, 0.5, 0.0, 1e6,
     "The maximum age of a command (s). The filter does not send an older command again when the "
     "bounds change."},
    {"filter_rate", ParameterText::NUMBER, 20.0, 0.1, 1000.0,
     "The rate (Hz) at which the node itself sends commands: 0 while the bounds allow only 0, and "
     "the last command while a bound follows its ramp."},
    {"patience", ParameterText::NUMBER, 5.0, 0.0, 1e6,
     "The time (s) for which the node waits for the first message of each input with a timeout. "
     "Until then the node evaluates no rule and passes no command. After this time a missing "
     "input is stale."},
    {"grace_period", ParameterText::NUMBER, 0.0, 0.0, 1e6,
     "The time (s) after which commands pass even if some inputs have never arrived. 0 means "
     "never."},
    {"clock_timeout", ParameterText::NUMBER, 0.0, 0.0, 1e6,
     "The time (s, wall clock) for which ROS time may stand still. If ROS time stands still for "
     "longer, no command passes. 0 means the shortest timeout of an input. Increase the value "
     "for a simulation that waits for the node or runs on a slow machine."},
    {"state_file", ParameterText::TEXT, 0.0, 0.0, 0.0,
     "The file that keeps the latched rules over a restart. Each node needs its own file. Empty "
     "means a file in ~/.ros with a name made from the node and its latched rules."},
    {"header_stamps", ParameterText::TEXTS, 0.0, 0.0, 0.0,
     "The input topics whose header stamps, not arrival times, give the time of a message. The "
     "node refuses a message whose stamp is too old, in the future, or not later than the "
     "previous stamp."},
};

// Returns all parameters. A parameter of the rules ranges from its default to its strictest value,
// in either order.
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

// Returns a number that lies within the limits of its parameter. NaN does not.
static double number(const ParameterSource &source, const char *name)
{
    const ParameterText &about = *parameter_called(name);
    double value = about.usual;
    source.read(name, value);
    if (!(about.low <= value && value <= about.high))
        throw BadParameter(name, "the value must be between " + std::to_string(about.low) +
                                     " and " + std::to_string(about.high) + ", but is " +
                                     std::to_string(value));
    return value;
}

// Refuses unknown names: a misspelt name would leave a safety parameter at its default.
static void refuse_unknown(const ParameterSource &source)
{
    for (const std::string &name : source.names())
        if (parameter_called(name) == nullptr) {
            std::string known;
            for (const ParameterText &each : parameter_texts())
                known += std::string(known.empty() ? "" : ", ") + each.name;
            throw BadParameter(name, "the node has no such parameter; it has " + known);
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
