// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// The parameters of the node, as config/parameters.yaml describes them.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

// A parameter with which the node does not start.
struct BadParameter : std::runtime_error {
    BadParameter(const std::string &name, const std::string &what)
        : std::runtime_error("parameter " + name + ": " + what)
    {
    }
};

// A parameter: a number in [low, high], a text, or a list of texts; these two are empty if not
// given.
struct ParameterText {
    const char *name;
    enum Kind { NUMBER, TEXT, TEXTS } kind;
    double usual;
    double low;
    double high;
    const char *about;
};
const std::vector<ParameterText> &parameter_texts();

// The source of parameters. `read` returns false, and leaves the value, if a parameter is not
// given; it throws BadParameter if it is of another kind. `names` are the given ones, or more.
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
    int64_t grace_ns;         // 0: commands never pass without all inputs
    int64_t clock_timeout_ns; // 0: the shortest timeout of an input
    std::string state_file;   // empty: the usual one
    std::vector<std::string> header_stamps;
    std::vector<double> given; // for each parameter of the rules
};

// Throws BadParameter for invalid values.
Settings settings(const ParameterSource &source);
