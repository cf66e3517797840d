// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The functions of ROS 1 that the node uses, behind the same interface as for ROS 2.
#pragma once

#include <ros/callback_queue.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "need.h"
#include "worker.h"

// Writes lines to the log.
namespace say {
inline void debug(const std::string &text) { ROS_DEBUG("%s", text.c_str()); }
inline void information(const std::string &text) { ROS_INFO("%s", text.c_str()); }
inline void warning(const std::string &text) { ROS_WARN("%s", text.c_str()); }
inline void error(const std::string &text) { ROS_ERROR("%s", text.c_str()); }
} // namespace say

template <class Message> class Publisher {
public:
    Publisher() = default;
    explicit Publisher(ros::Publisher publisher) : publisher_(std::move(publisher)) {}
    void publish(const Message &message) { publisher_.publish(message); }
    int listeners() const { return static_cast<int>(publisher_.getNumSubscribers()); }

private:
    ros::Publisher publisher_;
};

class Middleware {
public:
    using Time = ros::Time;
    using Duration = ros::Duration;

    Middleware()
    {
        node_.setCallbackQueue(&queue_);
        private_.setCallbackQueue(&queue_);
    }

    ros::NodeHandle &node() { return node_; }
    ros::CallbackQueue &queue() { return queue_; }

    // --- time

    static int64_t now_ns() { return nanoseconds(ros::Time::now()); }
    static int64_t nanoseconds(ros::Time time) { return static_cast<int64_t>(time.toNSec()); }
    static int64_t nanoseconds(ros::Duration time) { return time.toNSec(); }

    static ros::Time time(int64_t at_ns)
    {
        ros::Time time;
        return at_ns > 0 ? time.fromNSec(static_cast<uint64_t>(at_ns)) : time;
    }

    static ros::Duration duration(int64_t time_ns) { return ros::Duration().fromNSec(time_ns); }
    static double seconds(ros::Time time) { return time.toSec(); }
    static double seconds(ros::Duration time) { return time.toSec(); }

    // --- topics and services; a name that begins with ~ is private to the node

    static std::string name() { return ros::this_node::getName(); }

    std::string resolved(const std::string &topic) const { return node_.resolveName(topic); }

    template <class Message> static std::string type()
    {
        return ros::message_traits::datatype<Message>();
    }

    template <class Message> Publisher<Message> advertise(const std::string &topic, uint32_t depth)
    {
        return Publisher<Message>(handle(topic).advertise<Message>(bare(topic), depth));
    }

    // Later subscribers receive the last message.
    template <class Message> Publisher<Message> advertise_latched(const std::string &topic)
    {
        return Publisher<Message>(handle(topic).advertise<Message>(bare(topic), 1, true));
    }

    // ROS 2 uses `Kept`: TAKEN lets messages arrive that were published before the subscription. In
    // ROS 1 the publisher decides.
    enum class Kept { TAKEN, LEFT };
    template <class Message>
    void subscribe(const std::string &topic, uint32_t depth, Kept /*kept*/,
                   std::function<void(const Message &, int64_t received_ns)> receive)
    {
        using Event = const ros::MessageEvent<const Message> &;
        ros::SubscribeOptions options;
        options.initByFullCallbackType<Event>(topic, depth, [receive](Event event) {
            receive(*event.getConstMessage(), nanoseconds(event.getReceiptTime()));
        });
        options.transport_hints = ros::TransportHints().tcpNoDelay();
        subscribers_.push_back(node_.subscribe(options));
    }

    // `answer(request, response)` fills in the response.
    template <class Service, class Answer> void serve(const std::string &name, Answer answer)
    {
        using Request = typename Service::Request;
        using Response = typename Service::Response;
        const boost::function<bool(Request &, Response &)> call = [answer](Request &request,
                                                                           Response &response) {
            answer(request, response);
            return true;
        };
        services_.push_back(handle(name).advertiseService(bare(name), call));
    }

    // Returns false after the check has found a restarted master. Such a master does not know this
    // node.
    bool is_known_to_master() const { return is_known_; }

    // Finds unmet requirements, and other publishers of the command topics. Another thread queries
    // the master.
    void check(const std::vector<Need> &needs, const std::vector<std::string> &commanded,
               std::function<void(const Findings &)> report)
    {
        worker_.begin([this, needs, commanded, report]() -> Worker::Then {
            if (!is_registered())
                return [this] { is_known_ = false; };
            ros::master::V_TopicInfo topics;
            ros::master::getTopics(topics);
            std::map<std::string, std::string> types;
            Findings found;
            for (const ros::master::TopicInfo &topic : topics)
                types[topic.name] = topic.datatype;
            for (const Need &need : needs)
                if (const std::string problem = problem_of(need, types); !problem.empty())
                    found.problems[need.title] = problem;
            const auto published = publishers(commanded);
            if (!published) // unknown: another publisher may exist
                return [this] { is_known_ = false; };
            for (const auto &[topic, nodes] : *published)
                for (const std::string &node : nodes)
                    if (node != name() && is_alive(node))
                        found.bypassed[topic] = node;
            return [report, found] { report(found); };
        });
    }

private:
    static bool is_registered()
    {
        XmlRpc::XmlRpcValue names, response, address;
        names[0] = names[1] = ros::this_node::getName();
        const auto own = ros::XMLRPCManager::instance()->getServerURI();
        return ros::master::execute("lookupNode", names, response, address, true) && address == own;
    }

    // Returns the publishers of topics that the master lists, or nothing if the master does not
    // answer.
    using Publishers = std::map<std::string, std::vector<std::string>>;
    static std::optional<Publishers> publishers(const std::vector<std::string> &topics)
    {
        Publishers found;
        XmlRpc::XmlRpcValue asking, response, state;
        asking[0] = name();
        if (!ros::master::execute("getSystemState", asking, response, state, false))
            return std::nullopt;
        XmlRpc::XmlRpcValue &published = state[0];
        for (int i = 0; i < published.size(); i++) {
            const std::string topic = published[i][0];
            if (std::find(topics.begin(), topics.end(), topic) == topics.end())
                continue;
            for (int node = 0; node < published[i][1].size(); node++)
                found[topic].push_back(published[i][1][node]);
        }
        return found;
    }

    // Returns false for a killed node, which the master continues to list.
    static bool is_alive(const std::string &node)
    {
        XmlRpc::XmlRpcValue asking, response, address, process;
        asking[0] = name();
        asking[1] = node;
        std::string host;
        uint32_t port = 0;
        if (!ros::master::execute("lookupNode", asking, response, address, false) ||
            !ros::network::splitURI(address, host, port))
            return false;
        XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
        XmlRpc::XmlRpcValue alone;
        alone[0] = name();
        return client.execute("getPid", alone, process);
    }

    static std::string problem_of(const Need &need, const std::map<std::string, std::string> &types)
    {
        if (need.is_service)
            return ros::service::exists(need.name, false) ? "" : "no node offers " + need.name;
        const auto found = types.find(need.name);
        if (found == types.end())
            return need.is_optional    ? ""
                   : need.type.empty() ? "no node publishes " + need.name
                                       : "no node publishes it";
        if (!need.type.empty() && found->second != need.type)
            return "its type is " + found->second + ", not " + need.type;
        return "";
    }

    ros::NodeHandle &handle(const std::string &name) { return name[0] == '~' ? private_ : node_; }
    static std::string bare(const std::string &name)
    {
        return name[0] == '~' ? name.substr(1) : name;
    }

    ros::CallbackQueue queue_; // first: it outlives its users
    ros::NodeHandle node_;
    ros::NodeHandle private_{"~"};
    std::vector<ros::Subscriber> subscribers_;
    std::vector<ros::ServiceServer> services_;
    bool is_known_ = true;
    Worker worker_{queue_};
};

// Calls a service. The result arrives later, through the queue of the node.
template <class Service> class Client {
public:
    using Answer = std::function<void(bool has_answered, const typename Service::Response &)>;

    Client(Middleware &middleware, const std::string &service)
        : client_(middleware.node().serviceClient<Service>(service)), worker_(middleware.queue())
    {
    }

    // Returns true if no earlier call is open.
    bool is_free() const { return open_calls_ == 0; }

    void call(const typename Service::Request &request, Answer report)
    {
        ++open_calls_;
        worker_.begin([this, request, report]() mutable -> Worker::Then {
            typename Service::Response response;
            const bool has_answered = client_.call(request, response);
            return [this, report, has_answered, response] {
                --open_calls_;
                report(has_answered, response);
            };
        });
    }

private:
    ros::ServiceClient client_;
    int open_calls_ = 0;
    Worker worker_; // last: it uses the members above
};
