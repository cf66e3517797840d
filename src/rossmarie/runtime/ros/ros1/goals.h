// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The goals of one action server: goals of other nodes, which tasks interrupt, and goals that tasks
// send. Action servers and their clients communicate over topics. This class keeps goals of other
// nodes as bytes, so it needs no action type.
#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <std_msgs/Header.h>
#include <topic_tools/shape_shifter.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "middleware.h"
#include "throttle.h"

class Task;

class Goals {
public:
    using Status = actionlib_msgs::GoalStatus;

    Goals(Middleware &middleware, const std::string &server)
        : node_(middleware.node()), server_(server),
          cancel_(node_.advertise<actionlib_msgs::GoalID>(server + "/cancel", 10)),
          goal_(node_.subscribe(server + "/goal", 10, &Goals::on_goal, this)),
          status_(node_.subscribe(server + "/status", 10, &Goals::on_status, this))
    {
    }

    // Calls `look` after each change of the goals.
    void watch(std::function<void()> look) { watchers_.push_back(std::move(look)); }

    // Gives the server to a task.
    void take(const Task *task)
    {
        tasks_.insert(task);
        has_reported_ = false;
        interrupt();
    }

    // Takes the server from a task. The last task decides whether the interrupted goal is sent
    // again.
    void release(const Task *task, bool resend)
    {
        if (tasks_.erase(task) > 0 && tasks_.empty() && !resend)
            kept_ = Goal();
    }

    // Sends the interrupted goal again if this is due. Call this function regularly, and after the
    // last task command of a call. The server does not receive a goal that is sent before the
    // server subscribes.
    void tick()
    {
        if (tasks_.empty() && kept_.is_known() && is_connected())
            send_again();
    }

    // Cancels all goals of other nodes, and keeps the last of these goals.
    void interrupt()
    {
        if (latest_.is_known())
            kept_ = latest_;
        if (latest_.is_known() && !latest_.is_listed)
            cancel(latest_.id.id);
        for (const Status &each : listed_)
            if (is_untouched(each) && own_.count(each.goal_id.id) == 0)
                cancel(each.goal_id.id);
    }

    void cancel(const std::string &id)
    {
        if (throttle_.is_due())
            say::warning("the goal " + id + " for " + server_ + " is cancelled");
        own_.erase(id);
        actionlib_msgs::GoalID cancelled;
        cancelled.id = id;
        cancel_.publish(cancelled);
    }

    // Returns true if the server pursues no goal. Returns false before the server has reported its
    // goals.
    bool is_free() const
    {
        return has_reported_ && !latest_.is_known() &&
               std::all_of(listed_.begin(), listed_.end(), is_over);
    }

    // Connects to the server early, so that the server subscribes before the first goal.
    template <class ActionGoal> void advertise()
    {
        namespace traits = ros::message_traits;
        advertise(traits::md5sum<ActionGoal>(), traits::datatype<ActionGoal>(),
                  traits::definition<ActionGoal>());
    }

    // Returns true if the server receives goals: the publisher of the status subscribes to goals.
    bool is_connected() const { return subscribers_.count(server_node_) > 0; }

    // Returns the number of servers that have disappeared. Such a server never answers a request.
    int losses() const { return losses_; }

    // Sends a goal of a task. Returns the ID of the goal.
    template <class ActionGoal> std::string send(ActionGoal message)
    {
        message.goal_id = new_id();
        message.header.stamp = message.goal_id.stamp;
        own_.insert(message.goal_id.id);
        publisher_.publish(message);
        return message.goal_id.id;
    }

    // Returns the status of a goal, or null if the server does not list the goal.
    const Status *find(const std::string &id) const
    {
        const auto found = std::find_if(listed_.begin(), listed_.end(), [&id](const Status &each) {
            return each.goal_id.id == id;
        });
        return found == listed_.end() ? nullptr : &*found;
    }

    static bool is_over(const Status &status)
    {
        return !is_untouched(status) && status.status != Status::PREEMPTING &&
               status.status != Status::RECALLING;
    }

    const std::string &server() const { return server_; }

private:
    using ShapeShifter = topic_tools::ShapeShifter;
    using GoalEvent = ros::MessageEvent<const ShapeShifter>;
    using StatusEvent = ros::MessageEvent<const actionlib_msgs::GoalStatusArray>;

    // A goal of another node: its ID, and the received message.
    struct Goal {
        actionlib_msgs::GoalID id;
        std::vector<uint8_t> bytes; // the message after the ID
        boost::shared_ptr<const ShapeShifter> message;
        bool is_listed = false; // true: the server lists the goal
        bool is_known() const { return message != nullptr; }
    };

    // Returns true if the server pursues or will pursue a goal that has not been cancelled.
    static bool is_untouched(const Status &status)
    {
        return status.status == Status::PENDING || status.status == Status::ACTIVE;
    }

    void on_goal(const GoalEvent &event)
    {
        if (event.getPublisherName() == ros::this_node::getName())
            return;
        const ShapeShifter &message = *event.getConstMessage();
        latest_ = taken_apart(event.getConstMessage());
        newest_ = std::max(newest_, latest_.id.stamp);
        kept_ = Goal(); // the new goal replaces it
        advertise(message.getMD5Sum(), message.getDataType(), message.getMessageDefinition());
        notify_watchers();
    }

    void on_status(const StatusEvent &event)
    {
        server_node_ = event.getPublisherName();
        listed_ = event.getConstMessage()->status_list;
        has_reported_ = true;
        for (const Status &each : listed_)
            if (is_over(each))
                own_.erase(each.goal_id.id);
        // A restarted server does not list earlier goals, and does not pursue them.
        const Status *latest = find(latest_.id.id);
        if (latest == nullptr ? latest_.is_listed : is_over(*latest))
            latest_ = Goal();
        else
            latest_.is_listed = latest != nullptr;
        notify_watchers();
    }

    void notify_watchers()
    {
        for (const auto &look : watchers_)
            look();
    }

    void advertise(const std::string &md5, const std::string &type, const std::string &definition)
    {
        if (publisher_)
            return;
        ros::AdvertiseOptions options(
            server_ + "/goal", 10, md5, type, definition,
            [this](const auto &subscriber) { subscribers_.insert(subscriber.getSubscriberName()); },
            [this](const auto &subscriber) { on_disconnected(subscriber.getSubscriberName()); });
        publisher_ = node_.advertise(options);
    }

    void on_disconnected(const std::string &subscriber)
    {
        const bool was_connected = is_connected();
        const auto found = subscribers_.find(subscriber);
        if (found != subscribers_.end())
            subscribers_.erase(found);
        if (was_connected && !is_connected())
            on_gone();
    }

    void on_gone()
    {
        say::warning("the action server " + server_ + " has disappeared with all its goals");
        losses_ += 1;
        latest_ = Goal();
        listed_.clear();
        own_.clear();
        has_reported_ = false;
        notify_watchers();
    }

    // Returns a new ID. Servers refuse a goal that is older than an earlier goal.
    actionlib_msgs::GoalID new_id()
    {
        newest_ = std::max(newest_, ros::Time::now());
        actionlib_msgs::GoalID id;
        id.stamp = newest_;
        id.id = ros::this_node::getName() + "-" + std::to_string(++sent_) + "-" +
                std::to_string(id.stamp.toNSec());
        return id;
    }

    static Goal taken_apart(const boost::shared_ptr<const ShapeShifter> &message)
    {
        std::vector<uint8_t> bytes(message->size());
        ros::serialization::OStream out(bytes.data(), message->size());
        message->write(out);
        ros::serialization::IStream in(bytes.data(), message->size());
        std_msgs::Header header;
        Goal goal;
        ros::serialization::deserialize(in, header);
        ros::serialization::deserialize(in, goal.id);
        goal.bytes.assign(in.getData(), in.getData() + in.getLength());
        goal.message = message;
        return goal;
    }

    // Sends the interrupted goal with a new ID: servers ignore an ID that they know.
    void send_again()
    {
        latest_ = std::exchange(kept_, Goal());
        latest_.id = new_id();
        latest_.is_listed = false;
        std_msgs::Header header;
        header.stamp = latest_.id.stamp;
        using ros::serialization::serializationLength;
        const uint32_t head = serializationLength(header) + serializationLength(latest_.id);
        std::vector<uint8_t> bytes(head);
        ros::serialization::OStream out(bytes.data(), head);
        ros::serialization::serialize(out, header);
        ros::serialization::serialize(out, latest_.id);
        bytes.insert(bytes.end(), latest_.bytes.begin(), latest_.bytes.end());
        ros::serialization::IStream in(bytes.data(), static_cast<uint32_t>(bytes.size()));
        const ShapeShifter &model = *latest_.message;
        ShapeShifter message;
        message.morph(model.getMD5Sum(), model.getDataType(), model.getMessageDefinition(), "0");
        message.read(in);
        publisher_.publish(message);
        say::information("the interrupted goal for " + server_ + " is sent again");
    }

    ros::NodeHandle node_;
    std::string server_;
    std::vector<std::function<void()>> watchers_;
    std::set<const Task *> tasks_; // the tasks that have the server
    Goal latest_;                  // the last goal of other nodes, until its end
    Goal kept_;                    // the interrupted goal
    std::set<std::string> own_;    // running goals of tasks
    std::vector<Status> listed_;   // the goals that the server lists
    std::string server_node_;
    std::multiset<std::string> subscribers_; // subscribers to the goals of this node
    Throttle throttle_;
    ros::Time newest_;
    int sent_ = 0;
    int losses_ = 0;
    bool has_reported_ = false; // true: the server has reported since a task took it
    ros::Publisher publisher_;  // publishes goals
    ros::Publisher cancel_;
    ros::Subscriber goal_;
    ros::Subscriber status_;
};
