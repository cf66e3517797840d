// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The goals of one action server: goals of other nodes, which tasks interrupt, and goals that tasks
// send.
#pragma once

#include <action_msgs/msg/goal_status_array.hpp>
#include <action_msgs/srv/cancel_goal.hpp>
#include <rclcpp_action/types.hpp>

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "middleware.h"

class Task;

using GoalName = rclcpp_action::GoalUUID;

class Goals {
public:
    Goals(Middleware &middleware, const std::string &server)
        : middleware_(middleware), server_(server),
          cancel_(middleware, server + "/_action/cancel_goal")
    {
        middleware.subscribe_latched<StatusArray>(
            server + "/_action/status",
            [this](const StatusArray &status, const ServerName &from) { on_status(status, from); },
            [this] { on_gone(); });
    }
    virtual ~Goals() = default;

    // Calls `look` after each change of the goals.
    void watch(std::function<void()> look) { watchers_.push_back(std::move(look)); }

    // Gives the server to a task.
    void take(const Task *task)
    {
        tasks_.insert(task);
        is_resent_.reset();
        hold();
        cancel_all();
    }

    // Takes the server from a task. The last task decides whether the interrupted goal is sent
    // again.
    void release(const Task *task, bool resend)
    {
        if (tasks_.erase(task) > 0 && tasks_.empty())
            is_resent_ = resend;
    }

    // Sends requests that are due. Call this function regularly, and after the last task command of
    // a call. The server may have missed an earlier request.
    virtual void tick()
    {
        const bool is_over = std::all_of(listed_.begin(), listed_.end(), Goals::is_over);
        if (!tasks_.empty() && Steady::now() - asked_ >= AGAIN)
            ask_again();
        else if (tasks_.empty() && is_resent_ && is_over && cancel_.is_there())
            let_go(*std::exchange(is_resent_, std::nullopt));
    }

    // Cancels all goals of other nodes.
    void interrupt()
    {
        if (is_sending_)
            return; // one of the goals may be the goal of the task
        for (const Status &each : listed_) {
            const GoalName &name = each.goal_info.goal_id.uuid;
            if (is_untouched(each) && own_.count(name) == 0 && interrupted_.insert(name).second)
                cancel(name);
        }
    }

    // Returns true if the server pursues no goal of other nodes. Returns false before the server
    // has reported its goals.
    bool is_free() const
    {
        const auto is_no_other = [this](const Status &each) {
            return is_over(each) || own_.count(each.goal_info.goal_id.uuid) > 0;
        };
        return has_answered_ && std::all_of(listed_.begin(), listed_.end(), is_no_other);
    }

    // Enclose the time in which a task has sent a goal and does not know its ID yet.
    void begin_sending() { is_sending_ = true; }
    void end_sending(const GoalName *own)
    {
        is_sending_ = false;
        if (own != nullptr)
            own_.insert(*own);
    }
    void forget(const GoalName &own) { own_.erase(own); }

    // Returns the number of servers that have disappeared. An earlier goal that is not listed any
    // more has disappeared with its server.
    int losses() const { return losses_; }
    bool is_listed(const GoalName &name) const
    {
        return std::any_of(listed_.begin(), listed_.end(), [&name](const Status &each) {
            return each.goal_info.goal_id.uuid == name;
        });
    }

    const std::string &server() const { return server_; }
    Middleware &middleware() { return middleware_; }

protected:
    // `hold` makes new goals of other nodes wait. `let_go` sends the waiting goals or drops them.
    virtual void hold() {}
    virtual void let_go(bool /*resend*/) {}

    // Handles the disappearance of a server.
    virtual void lose() {}

    // Returns true if goals of other nodes wait.
    bool is_held() const { return !tasks_.empty() || is_resent_; }

private:
    using Status = action_msgs::msg::GoalStatus;
    using StatusArray = action_msgs::msg::GoalStatusArray;
    using CancelGoal = action_msgs::srv::CancelGoal;
    using Answer = CancelGoal::Response;
    using ServerName = Middleware::PublisherName;
    using Steady = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds AGAIN{100};

    static bool is_over(const Status &status)
    {
        return !is_untouched(status) && status.status != Status::STATUS_CANCELING;
    }

    // Returns true if the server pursues or will pursue a goal that has not been cancelled.
    static bool is_untouched(const Status &status)
    {
        return status.status == Status::STATUS_ACCEPTED ||
               status.status == Status::STATUS_EXECUTING;
    }

    // Cancels all goals.
    void cancel_all()
    {
        has_answered_ = is_cancelling_ = false;
        asked_ = Steady::now();
        const auto take = [this, asked = asked_](bool has_answered, const Answer &answer) {
            if (asked != asked_)
                return; // a later request replaces this request
            // The next status reports the goals that are being cancelled.
            is_cancelling_ = !answer.goals_canceling.empty();
            has_answered_ = has_answered && !is_cancelling_;
            notify_watchers();
        };
        cancel_.call(CancelGoal::Request(), take); // no ID and no time mean all goals
    }

    void cancel(const GoalName &name)
    {
        CancelGoal::Request request;
        request.goal_info.goal_id.uuid = name;
        cancel_.call(request, [](bool, const Answer &) {}); // the status reports the result
    }

    void ask_again()
    {
        if (!has_answered_)
            return cancel_all();
        asked_ = Steady::now();
        interrupted_.clear();
        middleware_.later([this] { notify_watchers(); }); // after the present work of the guard
    }

    // Handles the disappearance of a server. ROS may detect the end of a killed server after its
    // successor has reported its goals.
    void on_gone()
    {
        say::warning("an action server " + server_ + " has disappeared with all its goals");
        losses_ += 1;
        if (!servers_.empty())
            servers_.pop_front();
        if (servers_.empty()) {
            listed_.clear();
            own_.clear();
            is_sending_ = is_cancelling_ = has_answered_ = false;
        }
        lose();
        notify_watchers();
    }

    void on_status(const StatusArray &message, const ServerName &from)
    {
        if (servers_.empty() || servers_.back() != from)
            servers_.push_back(from);
        listed_ = message.status_list;
        has_answered_ = has_answered_ || std::exchange(is_cancelling_, false);
        notify_watchers();
    }

    void notify_watchers()
    {
        for (const auto &look : watchers_)
            look();
    }

    Middleware &middleware_;
    std::string server_;
    Client<CancelGoal> cancel_;
    std::vector<std::function<void()>> watchers_;
    std::set<const Task *> tasks_;   // the tasks that have the server
    std::optional<bool> is_resent_;  // true: send the goal again when the server is free
    std::vector<Status> listed_;     // the goals that the server lists
    std::set<GoalName> own_;         // goals of tasks
    std::set<GoalName> interrupted_; // goals of other nodes, since the last request
    bool is_sending_ = false;
    bool is_cancelling_ = false;     // true: the server cancels, no status yet
    bool has_answered_ = false;      // true: the server answered since a task took it
    std::deque<ServerName> servers_; // servers that reported a status, newest last
    int losses_ = 0;
    Steady::time_point asked_{};
};
