// Stands in for ROS: one thread, a clock that the test sets, and topics that the test looks at.
#pragma once

#include <any>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "need.h"

// What the log said.
namespace say {
inline std::vector<std::string> lines;

inline void debug(const std::string &text) { lines.push_back("debug: " + text); }
inline void information(const std::string &text) { lines.push_back("information: " + text); }
inline void warning(const std::string &text) { lines.push_back("warning: " + text); }
inline void error(const std::string &text) { lines.push_back("error: " + text); }
} // namespace say

struct Network {
    int64_t now_ns = 0;
    int listeners = 1;
    Findings findings;
    std::map<std::string, std::any> subscribed; // what receives the messages of a topic
    std::map<std::string, std::any> published;  // the messages of a topic
    std::map<std::string, std::any> served;
};
inline Network network;

// All messages that were published on a topic since this was asked last.
template <class Message> std::vector<Message> published(const std::string &topic)
{
    std::any &kept = network.published[topic];
    const auto found =
        kept.has_value() ? std::any_cast<std::vector<Message>>(kept) : std::vector<Message>();
    kept.reset();
    return found;
}

template <class Message> void deliver(const std::string &topic, const Message &message)
{
    using Receive = std::function<void(const Message &, int64_t received_ns)>;
    std::any_cast<Receive>(network.subscribed.at(topic))(message, network.now_ns);
}

template <class Service>
typename Service::Response ask(const std::string &name, const typename Service::Request &request)
{
    using Answer =
        std::function<void(const typename Service::Request &, typename Service::Response &)>;
    typename Service::Response response;
    std::any_cast<Answer>(network.served.at(name))(request, response);
    return response;
}

template <class Message> class Publisher {
public:
    Publisher() = default;
    explicit Publisher(std::string topic) : topic_(std::move(topic)) {}

    void publish(const Message &message)
    {
        std::any &kept = network.published[topic_];
        if (!kept.has_value())
            kept = std::vector<Message>();
        std::any_cast<std::vector<Message> &>(kept).push_back(message);
    }

    static int listeners() { return network.listeners; }

private:
    std::string topic_;
};

struct StandInTime {
    int64_t ns = 0;
};
struct StandInDuration {
    int64_t ns = 0;
};

class Middleware {
public:
    using Time = StandInTime;
    using Duration = StandInDuration;
    enum class Kept { TAKEN, LEFT };

    static int64_t now_ns() { return network.now_ns; }
    static int64_t nanoseconds(Time time) { return time.ns; }
    static int64_t nanoseconds(Duration time) { return time.ns; }
    static double seconds(Time time) { return static_cast<double>(time.ns) / 1e9; }
    static double seconds(Duration time) { return static_cast<double>(time.ns) / 1e9; }
    static Time time(int64_t at_ns) { return {at_ns}; }
    static Duration duration(int64_t time_ns) { return {time_ns}; }
    static std::string name() { return "/robot/guard"; }

    static std::string resolved(const std::string &topic)
    {
        return topic.rfind('/', 0) == 0 ? topic : "/robot/" + topic;
    }

    template <class Message> static std::string type() { return "message"; }

    template <class Message> Publisher<Message> advertise(const std::string &topic, std::size_t)
    {
        return Publisher<Message>(topic);
    }

    template <class Message> Publisher<Message> advertise_latched(const std::string &topic)
    {
        return Publisher<Message>(topic);
    }

    template <class Message>
    void subscribe(const std::string &topic, std::size_t, Kept,
                   std::function<void(const Message &, int64_t received_ns)> receive)
    {
        network.subscribed[topic] = std::move(receive);
    }

    template <class Service, class Answer> void serve(const std::string &name, Answer answer)
    {
        using Function =
            std::function<void(const typename Service::Request &, typename Service::Response &)>;
        network.served[name] = Function(std::move(answer));
    }

    static void check(const std::vector<Need> &, const std::vector<std::string> &,
                      const std::function<void(const Findings &)> &tell)
    {
        tell(network.findings);
    }
};

template <class Service> class Client {
public:
    using Response = typename Service::Response;

    Client(Middleware &, const std::string &) {}
    void call(const typename Service::Request &, std::function<void(bool, const Response &)>) {}
};
