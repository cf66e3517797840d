// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// Sets a parameter of another node.
#pragma once

#include <rcl_interfaces/msg/parameter_type.hpp>
#include <rcl_interfaces/srv/get_parameters.hpp>
#include <rcl_interfaces/srv/set_parameters.hpp>

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "change_task.h"
#include "middleware.h"

class Parameter {
public:
    using Change = std::variant<bool, double, std::string>;
    using Then = std::function<void(bool success)>;

    Parameter(Middleware &middleware, const std::string &owner, std::string name)
        : name_(std::move(name)), owner_(owner), get_(middleware, owner + "/get_parameters"),
          set_(middleware, owner + "/set_parameters")
    {
    }

    void apply(const Change &value, Then then)
    {
        GetParameters::Request wanted;
        wanted.names = {name_};
        using Answer = GetParameters::Response;
        get_.call(wanted, [this, value, then](bool has_answered, const Answer &found) {
            if (!has_answered)
                refuse("the node does not answer", then);
            else if (found.values.size() != 1 || found.values[0].type == Type::PARAMETER_NOT_SET)
                refuse("the node has no such parameter", then);
            else
                change(found.values[0], value, then);
        });
    }

    void restore(Then then)
    {
        if (kept_)
            set(*std::exchange(kept_, std::nullopt), then);
        else
            then(true);
    }

private:
    using GetParameters = rcl_interfaces::srv::GetParameters;
    using SetParameters = rcl_interfaces::srv::SetParameters;
    using Value = rcl_interfaces::msg::ParameterValue;
    using Type = rcl_interfaces::msg::ParameterType;

    void refuse(const std::string &reason, const Then &then) const
    {
        say::error("parameter " + name_ + " of " + owner_ + ": " + reason);
        then(false);
    }

    void change(const Value &present, const Change &value, const Then &then)
    {
        Value changed = present;
        if (!std::visit([&changed](const auto &given) { return assign(changed, given); }, value))
            return refuse("the parameter has another type", then);
        if (!kept_)
            kept_ = present;
        set(changed, then);
    }

    void set(const Value &value, const Then &then)
    {
        SetParameters::Request wanted;
        wanted.parameters.resize(1);
        wanted.parameters[0].name = name_;
        wanted.parameters[0].value = value;
        set_.call(wanted, [this, then](bool has_answered, const SetParameters::Response &answer) {
            if (!has_answered)
                refuse("the node does not answer", then);
            else if (answer.results.size() != 1 || !answer.results[0].successful)
                refuse("the node refuses the value: " +
                           (answer.results.empty() ? std::string() : answer.results[0].reason),
                       then);
            else
                then(true);
        });
    }

    // Sets the value of a parameter. Returns false if its type does not allow this value.
    static bool assign(Value &parameter, bool value)
    {
        parameter.bool_value = value;
        return parameter.type == Type::PARAMETER_BOOL;
    }

    static bool assign(Value &parameter, double value)
    {
        const bool is_integer = std::trunc(value) == value && std::abs(value) <= 1e15;
        parameter.integer_value = is_integer ? static_cast<int64_t>(value) : 0;
        parameter.double_value = value;
        return parameter.type == Type::PARAMETER_DOUBLE ||
               (parameter.type == Type::PARAMETER_INTEGER && is_integer);
    }

    static bool assign(Value &parameter, const std::string &value)
    {
        parameter.string_value = value;
        return parameter.type == Type::PARAMETER_STRING;
    }

    std::string name_;
    std::string owner_;
    Client<GetParameters> get_;
    Client<SetParameters> set_;
    std::optional<Value> kept_; // the value before the first change
};

using SetTask = ChangeTask<Parameter>;
