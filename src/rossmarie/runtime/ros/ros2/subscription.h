// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// A subscription that adapts to its publishers: it requests the reliability and the durability that
// all publishers offer. If a parameter (qos_overrides) sets the reliability, the subscription
// requests that reliability, and reports each publisher that does not offer it.
#pragma once

#include <rclcpp_lifecycle/lifecycle_node.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

class AnySubscription {
public:
    virtual ~AnySubscription() = default;

    // Adapts to the present publishers. Returns the problem with a publisher, or "".
    virtual std::string match() = 0;
    virtual const std::string &topic() const = 0;
};

template <class Message> class Subscription : public AnySubscription {
public:
    using Node = rclcpp_lifecycle::LifecycleNode;
    using Take = std::function<void(const Message &, const rclcpp::MessageInfo &)>;

    // If `takes_kept` is true, messages arrive that a publisher keeps for later subscribers.
    Subscription(Node &node, const std::string &topic, size_t depth, bool takes_kept, Take take)
        : node_(node), topic_(node.get_node_topics_interface()->resolve_topic_name(topic)),
          depth_(depth), takes_kept_(takes_kept), take_(std::move(take))
    {
        const auto &given = node_.get_node_parameters_interface()->get_parameter_overrides();
        is_declared_ = given.count("qos_overrides." + topic_ + ".subscription.reliability") > 0;
        subscribe(unpretentious());
    }

    std::string match() override
    {
        const auto publishers = node_.get_publishers_info_by_topic(topic_);
        if (!is_declared_ && !publishers.empty())
            adapt(offered_by_all(publishers));
        for (const auto &publisher : publishers) {
            const auto found = rclcpp::qos_check_compatible(publisher.qos_profile(),
                                                            subscription_->get_actual_qos());
            if (found.compatibility == rclcpp::QoSCompatibility::Error)
                return "no message arrives from " + publisher.node_name() + ": " + found.reason;
        }
        return "";
    }

    const std::string &topic() const override { return topic_; }

private:
    using Publishers = std::vector<rclcpp::TopicEndpointInfo>;

    // Returns the QoS that all these publishers offer.
    rclcpp::QoS offered_by_all(const Publishers &publishers) const
    {
        const auto all = [&publishers](auto is_so) {
            return std::all_of(publishers.begin(), publishers.end(),
                               [is_so](const auto &each) { return is_so(each.qos_profile()); });
        };
        const bool is_reliable = all([](const rclcpp::QoS &qos) {
            return qos.reliability() == rclcpp::ReliabilityPolicy::Reliable;
        });
        const bool is_kept = all([](const rclcpp::QoS &qos) {
            return qos.durability() == rclcpp::DurabilityPolicy::TransientLocal;
        });
        rclcpp::QoS offered = unpretentious();
        if (is_reliable)
            offered.reliable();
        if (is_reliable && is_kept && takes_kept_)
            offered.transient_local();
        return offered;
    }

    // Returns the QoS that every publisher offers.
    rclcpp::QoS unpretentious() const
    {
        return rclcpp::QoS(depth_).best_effort().durability_volatile();
    }

    void adapt(const rclcpp::QoS &wanted)
    {
        const rclcpp::QoS present = subscription_->get_actual_qos();
        if (present.reliability() != wanted.reliability() ||
            present.durability() != wanted.durability())
            subscribe(wanted);
    }

    void subscribe(const rclcpp::QoS &quality)
    {
        rclcpp::SubscriptionOptions options;
        if (is_declared_)
            options.qos_overriding_options =
                rclcpp::QosOverridingOptions({rclcpp::QosPolicyKind::Reliability});
        options.event_callbacks.incompatible_qos_callback = [this](auto &) { match(); };
        subscription_ = node_.create_subscription<Message>(topic_, quality, take_, options);
    }

    Node &node_;
    std::string topic_;
    size_t depth_;
    bool takes_kept_;
    Take take_;
    bool is_declared_ = false; // true: a parameter sets the reliability
    typename rclcpp::Subscription<Message>::SharedPtr subscription_;
};
