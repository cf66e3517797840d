// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// Sets a parameter of another node through dynamic_reconfigure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "change_task.h"
#include "middleware.h"
#include "reconfigure.h"

class Parameter {
public:
    using Change = std::variant<bool, double, std::string>;
    using Config = reconfigure::Config;

    Parameter(Middleware &middleware, const std::string &owner, std::string name)
        : name_(std::move(name)), owner_(owner),
          client_(middleware.node().serviceClient<Config, Config>(owner + "/set_parameters"))
    {
    }

    bool apply(const Change &value)
    {
        const Config old = is_empty(kept_) ? present() : kept_;
        if (is_empty(old))
            return refuse("the node does not report this parameter");
        Config wanted = old, answer;
        if (!std::visit([&wanted](const auto &given) { return assign(wanted, given); }, value))
            return refuse(std::string("its type is ") + type_of(old) +
                          ", which does not allow this value");
        kept_ = old;
        if (!client_.call(wanted, answer))
            return refuse("the node does not answer");
        return are_equal(only_this(answer), wanted) || refuse("the node has set another value");
    }

    void restore()
    {
        Config answer;
        Config kept = std::exchange(kept_, Config());
        if (!is_empty(kept) && !client_.call(kept, answer))
            refuse("the node does not answer; the old value is not restored");
    }

private:
    // Returns the present value. A node answers each request, even an empty one, with its complete
    // configuration.
    Config present()
    {
        Config nothing, answer;
        client_.call(nothing, answer);
        return only_this(answer);
    }

    bool refuse(const std::string &reason) const
    {
        say::error("parameter " + name_ + " of " + owner_ + ": " + reason);
        return false;
    }

    // Returns a configuration with only this parameter.
    Config only_this(const Config &all) const
    {
        Config found;
        copy(all.bools, found.bools);
        copy(all.ints, found.ints);
        copy(all.strs, found.strs);
        copy(all.doubles, found.doubles);
        return found;
    }

    template <class Parameters> void copy(const Parameters &all, Parameters &found) const
    {
        for (const auto &each : all)
            if (each.name == name_)
                found.push_back(each);
    }

    static bool is_empty(const Config &one)
    {
        return one.bools.empty() && one.ints.empty() && one.strs.empty() && one.doubles.empty();
    }

    static const char *type_of(const Config &one)
    {
        return !one.bools.empty()  ? "bool"
               : !one.ints.empty() ? "int"
               : !one.strs.empty() ? "str"
                                   : "double";
    }

    static bool are_equal(const Config &one, const Config &other)
    {
        return are_equal(one.bools, other.bools) && are_equal(one.ints, other.ints) &&
               are_equal(one.strs, other.strs) && are_equal(one.doubles, other.doubles);
    }

    template <class Parameters>
    static bool are_equal(const Parameters &one, const Parameters &other)
    {
        return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                          [](const auto &a, const auto &b) { return a.value == b.value; });
    }

    // Sets the only parameter of a configuration. Returns false if its type does not allow this
    // value.
    static bool assign(Config &one, bool value)
    {
        for (auto &each : one.bools)
            each.value = value;
        return !one.bools.empty();
    }

    static bool assign(Config &one, double value)
    {
        const bool is_int = std::trunc(value) == value && std::abs(value) <= INT32_MAX;
        for (auto &each : one.ints)
            each.value = is_int ? static_cast<int32_t>(value) : each.value;
        for (auto &each : one.doubles)
            each.value = value;
        return !one.doubles.empty() || (!one.ints.empty() && is_int);
    }

    static bool assign(Config &one, const std::string &value)
    {
        for (auto &each : one.strs)
            each.value = value;
        return !one.strs.empty();
    }

    std::string name_;
    std::string owner_;
    ros::ServiceClient client_;
    Config kept_; // the value before the first change
};

using SetTask = ChangeTask<Parameter>;
