// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The parameters of the node. A user can set the parameters while the node is unconfigured.
#pragma once

#include <lifecycle_msgs/msg/state.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

#include <algorithm>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "settings.h"

class Parameters : public ParameterSource {
public:
    // Declares the parameters. `read` reports invalid values when the node is configured.
    explicit Parameters(rclcpp_lifecycle::LifecycleNode &node) : node_(node)
    {
        declare(
            AUTOSTART, rclcpp::ParameterValue(true),
            described("If true, the node configures and activates itself. If false, a lifecycle "
                      "manager does so."));
        for (const ParameterText &each : parameter_texts())
            declare(each.name, usual(each), described(each));
        fixed_ = node_.add_on_set_parameters_callback(
            [this](const std::vector<rclcpp::Parameter> &wanted) { return allowed(wanted); });
    }

    bool autostart() const
    {
        const rclcpp::ParameterValue found = given(AUTOSTART);
        if (found.get_type() != rclcpp::PARAMETER_BOOL)
            throw BadParameter(AUTOSTART, "the value must be true or false");
        return found.get<bool>();
    }

    // Throws BadParameter for a QoS setting that would have no effect. `topics` are the full names
    // of the topics that the node subscribes to.
    void check_quality(const std::vector<std::string> &topics) const
    {
        for (const auto &[name, value] : overrides())
            if (is_quality(name))
                check_quality(name, value, topics);
    }

    std::vector<std::string> names() const override
    {
        std::vector<std::string> own;
        for (const auto &each : overrides())
            if (!is_quality(each.first) && !node_.has_parameter(each.first))
                own.push_back(each.first);
        return own;
    }

    bool read(const std::string &name, double &value) const override
    {
        const rclcpp::ParameterValue found = given(name);
        if (found.get_type() == rclcpp::PARAMETER_INTEGER)
            value = static_cast<double>(found.get<int64_t>());
        else if (found.get_type() == rclcpp::PARAMETER_DOUBLE)
            value = found.get<double>();
        else
            throw BadParameter(name, "the value must be a number");
        return true;
    }

    bool read(const std::string &name, std::string &value) const override
    {
        return read_as(name, rclcpp::PARAMETER_STRING, "the value must be a string", value);
    }

    bool read(const std::string &name, std::vector<std::string> &value) const override
    {
        return read_as(name, rclcpp::PARAMETER_STRING_ARRAY, "the value must be a list of strings",
                       value);
    }

private:
    using Descriptor = rcl_interfaces::msg::ParameterDescriptor;
    using Overrides = std::map<std::string, rclcpp::ParameterValue>;

    static constexpr const char *AUTOSTART = "autostart";
    static constexpr const char *QUALITY = "qos_overrides.";
    static constexpr const char *RELIABILITY = ".subscription.reliability";

    // Allows any type, so that 5 can replace 5.0. `read` reports a wrong type.
    static Descriptor described(const std::string &about)
    {
        Descriptor descriptor;
        descriptor.description = about;
        descriptor.dynamic_typing = true;
        return descriptor;
    }

    static Descriptor described(const ParameterText &parameter)
    {
        Descriptor descriptor = described(parameter.about);
        if (parameter.kind == ParameterText::NUMBER) {
            descriptor.floating_point_range.resize(1);
            descriptor.floating_point_range[0].from_value = parameter.low;
            descriptor.floating_point_range[0].to_value = parameter.high;
        }
        return descriptor;
    }

    static rclcpp::ParameterValue usual(const ParameterText &parameter)
    {
        switch (parameter.kind) {
        case ParameterText::NUMBER:
            return rclcpp::ParameterValue(parameter.usual);
        case ParameterText::TEXT:
            return rclcpp::ParameterValue(std::string());
        case ParameterText::TEXTS:
            return rclcpp::ParameterValue(std::vector<std::string>());
        }
        return rclcpp::ParameterValue();
    }

    // Declares a parameter. Stores a value that ROS rejects, so that the node starts and `read`
    // reports the reason.
    void declare(const std::string &name, const rclcpp::ParameterValue &value,
                 const Descriptor &descriptor)
    {
        try {
            node_.declare_parameter(name, value, descriptor);
        } catch (const std::exception &) {
            refused_[name] = overrides().at(name);
            node_.declare_parameter(name, value, descriptor, true);
        }
    }

    rclcpp::ParameterValue given(const std::string &name) const
    {
        const auto found = refused_.find(name);
        return found != refused_.end() ? found->second
                                       : node_.get_parameter(name).get_parameter_value();
    }

    template <class Value>
    bool read_as(const std::string &name, rclcpp::ParameterType type, const char *else_wrong,
                 Value &value) const
    {
        const rclcpp::ParameterValue found = given(name);
        if (found.get_type() != type)
            throw BadParameter(name, else_wrong);
        value = found.get<Value>();
        return true;
    }

    rcl_interfaces::msg::SetParametersResult allowed(const std::vector<rclcpp::Parameter> &wanted)
    {
        using State = lifecycle_msgs::msg::State;
        rcl_interfaces::msg::SetParametersResult result;
        result.successful = true;
        const bool is_free = node_.get_current_state().id() == State::PRIMARY_STATE_UNCONFIGURED;
        for (const rclcpp::Parameter &each : wanted) {
            if (!is_own(each.get_name()))
                continue;
            if (is_free) {
                refused_.erase(each.get_name());
                continue;
            }
            result.successful = false;
            result.reason = each.get_name() +
                            " cannot change while the node is configured; clean up the node first";
        }
        return result;
    }

    static bool is_own(const std::string &name)
    {
        const std::vector<ParameterText> &all = parameter_texts();
        return name == AUTOSTART || std::any_of(all.begin(), all.end(),
                                                [&name](auto &each) { return each.name == name; });
    }

    static bool is_quality(const std::string &name) { return name.rfind(QUALITY, 0) == 0; }

    static void check_quality(const std::string &name, const rclcpp::ParameterValue &value,
                              const std::vector<std::string> &topics)
    {
        std::string known;
        bool is_known = false;
        for (const std::string &topic : topics) {
            is_known = is_known || name == QUALITY + topic + RELIABILITY;
            known += (known.empty() ? "" : ", ") + topic;
        }
        if (!is_known)
            throw BadParameter(name, std::string("the only QoS parameter is ") + QUALITY + "TOPIC" +
                                         RELIABILITY + ", where TOPIC is one of " + known);
        const bool is_text = value.get_type() == rclcpp::PARAMETER_STRING;
        const std::string said = is_text ? value.get<std::string>() : "";
        if (said != "reliable" && said != "best_effort")
            throw BadParameter(name, "the value must be reliable or best_effort");
    }

    const Overrides &overrides() const
    {
        return node_.get_node_parameters_interface()->get_parameter_overrides();
    }

    rclcpp_lifecycle::LifecycleNode &node_;
    Overrides refused_;
    rclcpp_lifecycle::LifecycleNode::OnSetParametersCallbackHandle::SharedPtr fixed_;
};
