// Parameters that cannot be meant are refused.
#include "settings.h"
#include "descriptions.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "check.h"

const std::vector<RuleParameter> RULE_PARAMETERS = {
    {"gap", 0.5, 500.0, "m"},
    {"braking", 1.2, 0.0012, "m/s^2"},
};

class Given : public ParameterSource {
public:
    std::map<std::string, double> numbers;
    std::map<std::string, std::string> texts;

    std::vector<std::string> names() const override
    {
        std::vector<std::string> found;
        for (const auto &each : numbers)
            found.push_back(each.first);
        for (const auto &each : texts)
            found.push_back(each.first);
        return found;
    }

    bool read(const std::string &name, double &value) const override
    {
        return read_from(numbers, name, value);
    }
    bool read(const std::string &name, std::string &value) const override
    {
        return read_from(texts, name, value);
    }
    bool read(const std::string &, std::vector<std::string> &) const override { return false; }

private:
    template <class Value>
    static bool read_from(const std::map<std::string, Value> &all, const std::string &name,
                          Value &value)
    {
        const auto found = all.find(name);
        if (found == all.end())
            return false;
        value = found->second;
        return true;
    }
};

static std::string refusal(const Given &given)
{
    try {
        settings(given);
    } catch (const BadParameter &problem) {
        return problem.what();
    }
    return "";
}

static std::string refusal(const std::string &name, double value)
{
    Given given;
    given.numbers[name] = value;
    return refusal(given);
}

int main()
{
    const Settings usual = settings(Given());
    CHECK(usual.command_timeout_ns == 500'000'000);
    CHECK(usual.filter_period_ns == 50'000'000);
    CHECK(usual.patience_ns == 5'000'000'000);
    CHECK(usual.grace_ns == 0 && usual.clock_timeout_ns == 0);
    CHECK(usual.state_file.empty() && usual.header_stamps.empty());

    Given given;
    given.numbers["filter_rate"] = 100.0;
    given.texts["state_file"] = "/tmp/latched";
    CHECK(settings(given).filter_period_ns == 10'000'000);
    CHECK(settings(given).state_file == "/tmp/latched");

    CHECK(refusal("patience", 0.0).empty());
    CHECK(refusal("patience", -0.1).find("parameter patience: the value must be between") == 0);
    CHECK(refusal("filter_rate", 0.0).find("but is 0.0") != std::string::npos);
    CHECK(!refusal("grace_period", NAN).empty());
    CHECK(!refusal("clock_timeout", INFINITY).empty());
    CHECK(refusal("patients", 1.0).find("the node has no such parameter; it has command_timeout") !=
          std::string::npos);

    CHECK(usual.given == std::vector<double>({0.5, 1.2}));
    given.numbers["gap"] = 0.8;
    given.numbers["braking"] = 0.6;
    CHECK(settings(given).given == std::vector<double>({0.8, 0.6}));
    CHECK(refusal("gap", 0.4).find("parameter gap: the value must be between 0.500000 and 500") ==
          0);
    CHECK(refusal("gap", 500.0).empty() && !refusal("gap", 501.0).empty());
    CHECK(refusal("braking", 0.0012).empty() && !refusal("braking", 0.001).empty());
    CHECK(!refusal("braking", 1.3).empty() && !refusal("braking", -0.6).empty());
    CHECK(!refusal("gap", NAN).empty() && !refusal("braking", NAN).empty());
    return result();
}
