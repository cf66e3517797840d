// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// The goals of one action server: those of others, which tasks interrupt, and those that tasks
// send. Action servers and their clients communicate over topics; goals of others
// are kept as bytes, so that this works for actions of any type.
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

    // `look` is called whenever there is news about the goals.
    void watch(std::function<void()> look) { watchers_.push_back(std::move(look)); }

    // A task has the server from now on.
    void take(const Task *task)
    {
        tasks_.insert(task);
        has_reported_ = false;
        interrupt();
    }

    // A task does not have the server any more. When no task has it, the last task decides whether
    // the interrupted goal is sent again.
    void release(const Task *task, bool resend)
    {
        if (tasks_.erase(task) > 0 && tasks_.empty() && !resend)
            kept_ = Goal();
    }

    // To be called when all task commands of a call have been given, and regularly: what is sent
    // before the server listens is lost.
    void tick()
    {
        if (tasks_.empty() && kept_.is_known() && is_connected())
            send_again();
    }

    // Cancels all goals of others, and keeps the last one.
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

    // True if no goal is pursued; false before the server has reported its goals.
    bool is_free() const
    {
        return has_reported_ && !latest_.is_known() &&
               std::all_of(listed_.begin(), listed_.end(), is_over);
    }

    // Connects to the server early, so that it listens when it is needed.
    template <class ActionGoal> void advertise()
    {
        namespace traits = ros::message_traits;
        advertise(traits::md5sum<ActionGoal>(), traits::datatype<ActionGoal>(),
                  traits::definition<ActionGoal>());
    }

    // True if the server hears what is sent: whoever tells the status subscribes to goals.
    bool is_connected() const { return subscribers_.count(server_node_) > 0; }

    // The number of times that a server has gone: it does not answer earlier requests any more.
    int losses() const { return losses_; }

    // Sends a goal of a task; returns its name.
    template <class ActionGoal> std::string send(ActionGoal message)
    {
        message.goal_id = new_id();
        message.header.stamp = message.goal_id.stamp;
        own_.insert(message.goal_id.id);
        publisher_.publish(message);
        return message.goal_id.id;
    }

    // The server's report about a goal; null if it does not list the goal.
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

    // A goal of others: its name, and the message as it came.
    struct Goal {
        actionlib_msgs::GoalID id;
        std::vector<uint8_t> bytes; // of what stands behind the name
        boost::shared_ptr<const ShapeShifter> message;
        bool is_listed = false; // by the server
        bool is_known() const { return message != nullptr; }
    };

    // True if a goal is pursued, or will be, and has not been cancelled.
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
        kept_ = Goal(); // the new one takes its place
        advertise(message.getMD5Sum(), message.getDataType(), message.getMessageDefinition());
        tell_watchers();
    }

    void on_status(const StatusEvent &event)
    {
        server_node_ = event.getPublisherName();
        listed_ = event.getConstMessage()->status_list;
        has_reported_ = true;
        for (const Status &each : listed_)
            if (is_over(each))
                own_.erase(each.goal_id.id);
        // A server that has forgotten a goal, because it was restarted, does not pursue it.
        const Status *latest = find(latest_.id.id);
        if (latest == nullptr ? latest_.is_listed : is_over(*latest))
            latest_ = Goal();
        else
            latest_.is_listed = latest != nullptr;
        tell_watchers();
    }

    void tell_watchers()
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
        say::warning("the action server " + server_ + " has gone, and its goals with it");
        losses_ += 1;
        latest_ = Goal();
        listed_.clear();
        own_.clear();
        has_reported_ = false;
        tell_watchers();
    }

    // A name that no goal has had. Servers refuse goals that are older than one that they have had.
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

    // The goal that was interrupted, under a new name: servers ignore one that they have had.
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
        say::information("the goal for " + server_ + " that was interrupted is sent again");
    }

    ros::NodeHandle node_;
    std::string server_;
    std::vector<std::function<void()>> watchers_;
    std::set<const Task *> tasks_; // that have the server
    Goal latest_;                  // of others, as far as it is not over
    Goal kept_;                    // that was interrupted
    std::set<std::string> own_;    // goals of tasks that are pursued
    std::vector<Status> listed_;   // by the server
    std::string server_node_;
    std::multiset<std::string> subscribers_; // to goals of this node
    Throttle throttle_;
    ros::Time newest_;
    int sent_ = 0;
    int losses_ = 0;
    bool has_reported_ = false; // since a task took the server
    ros::Publisher publisher_;  // of goals
    ros::Publisher cancel_;
    ros::Subscriber goal_;
    ros::Subscriber status_;
};
