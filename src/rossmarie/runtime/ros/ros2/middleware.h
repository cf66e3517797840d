// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The functions of ROS 2 that the node uses, behind the same interface as for ROS 1.
#pragma once

#include <builtin_interfaces/msg/duration.hpp>
#include <builtin_interfaces/msg/time.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "need.h"
#include "rules.h"
#include "subscription.h"

// Writes lines to the log, with the logger of the node for which the thread works. One process may
// contain several nodes.
namespace say {
inline rclcpp::Logger &logger()
{
    static thread_local rclcpp::Logger current = rclcpp::get_logger(NODE);
    return current;
}

class As {
public:
    explicit As(const rclcpp::Logger &node) : before_(std::exchange(logger(), node)) {}
    ~As() { logger() = before_; }
    As(const As &) = delete;
    As &operator=(const As &) = delete;

private:
    rclcpp::Logger before_;
};

inline void debug(const std::string &text) { RCLCPP_DEBUG(logger(), "%s", text.c_str()); }
inline void information(const std::string &text) { RCLCPP_INFO(logger(), "%s", text.c_str()); }
inline void warning(const std::string &text) { RCLCPP_WARN(logger(), "%s", text.c_str()); }
inline void error(const std::string &text) { RCLCPP_ERROR(logger(), "%s", text.c_str()); }
} // namespace say

template <class Message> class Publisher {
public:
    Publisher() = default;
    explicit Publisher(typename rclcpp::Publisher<Message>::SharedPtr publisher)
        : publisher_(std::move(publisher))
    {
    }
    void publish(const Message &message) { publisher_->publish(message); }
    int listeners() const { return static_cast<int>(publisher_->get_subscription_count()); }

private:
    typename rclcpp::Publisher<Message>::SharedPtr publisher_;
};

class Middleware {
public:
    using Node = rclcpp_lifecycle::LifecycleNode;
    using Time = builtin_interfaces::msg::Time;
    using Duration = builtin_interfaces::msg::Duration;
    using PublisherName = std::array<uint8_t, RMW_GID_STORAGE_SIZE>;

    // Calls `after` after each callback.
    Middleware(Node &node, std::function<void()> after) : node_(node), after_(std::move(after)) {}

    Node &node() { return node_; }

    // Runs `job` for a callback.
    template <class Job> void run(Job job)
    {
        const say::As as(node_.get_logger());
        job();
        after_();
    }

    // Runs `job` after the present callback has returned.
    void later(std::function<void()> job)
    {
        later_.push_back(std::move(job));
        after_();
    }

    bool has_later() const { return !later_.empty(); }

    void run_later()
    {
        for (const auto &job : std::exchange(later_, {}))
            job();
    }

    // --- time

    int64_t now_ns() const { return node_.get_clock()->now().nanoseconds(); }
    static int64_t nanoseconds(const Time &time) { return time.sec * SECOND_NS + time.nanosec; }
    static int64_t nanoseconds(const Duration &time) { return time.sec * SECOND_NS + time.nanosec; }
    template <class Instant> static double seconds(const Instant &time)
    {
        return static_cast<double>(nanoseconds(time)) / 1e9;
    }
    static Time time(int64_t at_ns) { return split<Time>(at_ns > 0 ? at_ns : 0); }
    static Duration duration(int64_t time_ns) { return split<Duration>(time_ns); }

    // --- topics and services; a name that begins with ~ is private to the node

    std::string name() const { return node_.get_fully_qualified_name(); }

    std::string resolved(const std::string &topic) const
    {
        return node_.get_node_topics_interface()->resolve_topic_name(topic);
    }

    template <class Message> static std::string type()
    {
        return rosidl_generator_traits::name<Message>();
    }

    template <class Message> Publisher<Message> advertise(const std::string &topic, size_t depth)
    {
        return Publisher<Message>(
            rclcpp::create_publisher<Message>(node_, full(topic), rclcpp::QoS(depth)));
    }

    // Later subscribers receive the last message.
    template <class Message> Publisher<Message> advertise_latched(const std::string &topic)
    {
        return Publisher<Message>(rclcpp::create_publisher<Message>(
            node_, full(topic), rclcpp::QoS(1).transient_local()));
    }

    // TAKEN lets messages arrive that were published before the subscription. LEFT does not.
    enum class Kept { TAKEN, LEFT };
    template <class Message>
    void subscribe(const std::string &topic, size_t depth, Kept kept,
                   std::function<void(const Message &, int64_t received_ns)> receive)
    {
        const auto take = [this, receive](const Message &message, const rclcpp::MessageInfo &info) {
            const bool is_simulated = node_.get_clock()->ros_time_is_active();
            const int64_t received_ns = info.get_rmw_message_info().received_timestamp;
            run([&] {
                receive(message, is_simulated || received_ns == 0 ? now_ns() : received_ns);
            });
        };
        subscriptions_.push_back(std::make_unique<Subscription<Message>>(
            node_, full(topic), depth, kept == Kept::TAKEN, take));
    }

    // Subscribes to a topic that keeps its last message for later subscribers. Calls `lose` when a
    // publisher disappears. `receive` gets the ID of the publisher with each message.
    template <class Message>
    void subscribe_latched(const std::string &topic,
                           std::function<void(const Message &, const PublisherName &)> receive,
                           std::function<void()> lose)
    {
        rclcpp::SubscriptionOptions options;
        options.event_callbacks.matched_callback = [this, lose](rclcpp::MatchedInfo &publishers) {
            if (publishers.current_count_change < 0)
                run(lose);
        };
        kept_.push_back(node_.create_subscription<Message>(
            topic, rclcpp::QoS(1).transient_local(),
            [this, receive](const Message &message, const rclcpp::MessageInfo &info) {
                PublisherName publisher;
                const auto &data = info.get_rmw_message_info().publisher_gid.data;
                std::copy(std::begin(data), std::end(data), publisher.begin());
                run([&] { receive(message, publisher); });
            },
            options));
    }

    // `answer(request, response)` fills in the response.
    template <class Service, class Answer> void serve(const std::string &name, Answer answer)
    {
        using Request = std::shared_ptr<typename Service::Request>;
        using Response = std::shared_ptr<typename Service::Response>;
        services_.push_back(node_.create_service<Service>(
            full(name), [this, answer](const Request request, const Response response) {
                run([&] { answer(*request, *response); });
            }));
    }

    // Finds unmet requirements, and other publishers of the command topics.
    void check(const std::vector<Need> &needs, const std::vector<std::string> &commanded,
               std::function<void(const Findings &)> report)
    {
        Findings found;
        for (const Need &need : needs)
            if (const std::string problem = problem_of(need); !problem.empty())
                found.problems[need.title] = problem;
        for (const auto &subscription : subscriptions_)
            if (const std::string problem = subscription->match(); !problem.empty())
                found.problems["topic " + subscription->topic()] = problem;
        for (const std::string &topic : commanded)
            if (const std::string other = other_publisher(topic); !other.empty())
                found.bypassed[topic] = other;
        report(found);
    }

private:
    std::string problem_of(const Need &need) const
    {
        if (need.is_service)
            return node_.get_node_graph_interface()->count_services(need.name) > 0
                       ? ""
                       : "no node offers " + need.name;
        const auto publishers = node_.get_publishers_info_by_topic(need.name);
        for (const auto &publisher : publishers)
            if (!need.type.empty() && publisher.topic_type() != need.type)
                return "its type is " + publisher.topic_type() + ", not " + need.type;
        if (publishers.empty() && !need.is_optional)
            return "no node publishes " + (need.type.empty() ? need.name : "it");
        return "";
    }

    // Returns the name of another publisher of a topic, or "" if there is none. This node publishes
    // the topic once. A second publisher with its name is another node, or a dead node that ROS
    // still lists.
    std::string other_publisher(const std::string &topic) const
    {
        int own = 0;
        for (const auto &publisher : node_.get_publishers_info_by_topic(topic))
            if (const std::string who = full_name(publisher); who != name())
                return who;
            else if (++own > 1)
                return "another " + who;
        return "";
    }

    static std::string full_name(const rclcpp::TopicEndpointInfo &endpoint)
    {
        const std::string &space = endpoint.node_namespace();
        return space + (space == "/" ? "" : "/") + endpoint.node_name();
    }

    static constexpr int64_t SECOND_NS = 1'000'000'000;

    template <class Instant> static Instant split(int64_t time_ns)
    {
        Instant instant;
        const int64_t rest = ((time_ns % SECOND_NS) + SECOND_NS) % SECOND_NS;
        instant.nanosec = static_cast<uint32_t>(rest);
        instant.sec = static_cast<int32_t>((time_ns - rest) / SECOND_NS);
        return instant;
    }

    static std::string full(const std::string &name)
    {
        return name[0] == '~' ? "~/" + name.substr(1) : name;
    }

    Node &node_;
    std::function<void()> after_;
    std::vector<std::function<void()>> later_;
    std::vector<std::unique_ptr<AnySubscription>> subscriptions_;
    std::vector<rclcpp::SubscriptionBase::SharedPtr> kept_;
    std::vector<rclcpp::ServiceBase::SharedPtr> services_;
};

// Calls a service. The result arrives later.
template <class Service> class Client {
public:
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    using Answer = std::function<void(bool has_answered, const Response &)>;

    Client(Middleware &middleware, const std::string &service)
        : middleware_(middleware),
          client_(middleware.node().template create_client<Service>(service))
    {
    }

    bool is_there() const { return client_->service_is_ready(); }

    // Returns true: a call never waits for an earlier call.
    static bool is_free() { return true; }

    void call(const Request &request, Answer report)
    {
        if (!is_there()) {
            middleware_.later([report] { report(false, Response()); });
            return;
        }
        client_->prune_pending_requests(); // requests without an answer
        using Future = typename rclcpp::Client<Service>::SharedFuture;
        client_->async_send_request(std::make_shared<Request>(request),
                                    [this, report](Future answer) {
                                        middleware_.run([&] { report(true, *answer.get()); });
                                    });
    }

private:
    Middleware &middleware_;
    typename rclcpp::Client<Service>::SharedPtr client_;
};
