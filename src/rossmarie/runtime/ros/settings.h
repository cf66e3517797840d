// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The parameters of the node, as config/parameters.yaml describes them.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

// The error for a parameter with an invalid name or value. The node does not start.
struct BadParameter : std::runtime_error {
    BadParameter(const std::string &name, const std::string &what)
        : std::runtime_error("parameter " + name + ": " + what)
    {
    }
};

// A parameter: a number in [low, high], a text, or a list of texts. The default of a text or of a
// list is empty.
struct ParameterText {
    const char *name;
    enum Kind { NUMBER, TEXT, TEXTS } kind;
    double usual;
    double low;
    double high;
    const char *about;
};
const std::vector<ParameterText> &parameter_texts();

// The source of parameters. `read` returns false and keeps the value if the parameter is not set.
// `read` throws BadParameter if the parameter has another type. `names` includes all parameters
// that are set.
class ParameterSource {
public:
    virtual ~ParameterSource() = default;
    virtual std::vector<std::string> names() const = 0;
    virtual bool read(const std::string &name, double &value) const = 0;
    virtual bool read(const std::string &name, std::string &value) const = 0;
    virtual bool read(const std::string &name, std::vector<std::string> &value) const = 0;
};

struct Settings {
    int64_t command_timeout_ns;
    int64_t filter_period_ns;
    int64_t patience_ns;
    int64_t grace_ns;         // 0: no command passes before all inputs have arrived
    int64_t clock_timeout_ns; // 0: the shortest timeout of an input
    std::string state_file;   // empty: the default path
    std::vector<std::string> header_stamps;
    std::vector<double> given; // by parameter of the rules
};

// Reads the parameters. Throws BadParameter for an invalid name or value.
Settings settings(const ParameterSource &source);
