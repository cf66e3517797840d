// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// The goals of one action server: those of others, which tasks interrupt, and those that tasks
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

    // `look` is called whenever there is news about the goals.
    void watch(std::function<void()> look) { watchers_.push_back(std::move(look)); }

    // A task has the server from now on.
    void take(const Task *task)
    {
        tasks_.insert(task);
        is_resent_.reset();
        hold();
        cancel_all();
    }

    // A task does not have the server any more. When no task has it, the last task decides whether
    // the interrupted goal is sent again.
    void release(const Task *task, bool resend)
    {
        if (tasks_.erase(task) > 0 && tasks_.empty())
            is_resent_ = resend;
    }

    // To be called when all task commands of a call have been given, and regularly: a server may
    // not have listened.
    virtual void tick()
    {
        const bool is_over = std::all_of(listed_.begin(), listed_.end(), Goals::is_over);
        if (!tasks_.empty() && Steady::now() - asked_ >= AGAIN)
            ask_again();
        else if (tasks_.empty() && is_resent_ && is_over && cancel_.is_there())
            let_go(*std::exchange(is_resent_, std::nullopt));
    }

    // Cancels all goals of others.
    void interrupt()
    {
        if (is_sending_)
            return; // one of the goals may be that of the task
        for (const Status &each : listed_) {
            const GoalName &name = each.goal_info.goal_id.uuid;
            if (is_untouched(each) && own_.count(name) == 0 && interrupted_.insert(name).second)
                cancel(name);
        }
    }

    // True if no goal of others is pursued; false before the server has reported its goals.
    bool is_free() const
    {
        const auto is_no_other = [this](const Status &each) {
            return is_over(each) || own_.count(each.goal_info.goal_id.uuid) > 0;
        };
        return has_answered_ && std::all_of(listed_.begin(), listed_.end(), is_no_other);
    }

    // From when a task sends a goal until it knows its name.
    void begin_sending() { is_sending_ = true; }
    void end_sending(const GoalName *own)
    {
        is_sending_ = false;
        if (own != nullptr)
            own_.insert(*own);
    }
    void forget(const GoalName &own) { own_.erase(own); }

    // The number of times that a server has gone. An earlier goal that is not listed now has gone
    // with it.
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
    // Goals of others that come from now on wait; and do so no longer, and are sent or dropped.
    virtual void hold() {}
    virtual void let_go(bool /*resend*/) {}

    // A server has gone.
    virtual void lose() {}

    // True if they wait.
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

    // True if a goal is pursued, or will be, and has not been cancelled.
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
                return; // it has been asked again
            // Of what is being cancelled the status tells next.
            is_cancelling_ = !answer.goals_canceling.empty();
            has_answered_ = has_answered && !is_cancelling_;
            tell_watchers();
        };
        cancel_.call(CancelGoal::Request(), take); // no name and no time mean all goals
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
        middleware_.later([this] { tell_watchers(); }); // not while the guard is at work
    }

    // The end of a killed server is detected late, possibly after its successor has reported its
    // goals.
    void on_gone()
    {
        say::warning("an action server " + server_ + " has gone, and its goals with it");
        losses_ += 1;
        if (!servers_.empty())
            servers_.pop_front();
        if (servers_.empty()) {
            listed_.clear();
            own_.clear();
            is_sending_ = is_cancelling_ = has_answered_ = false;
        }
        lose();
        tell_watchers();
    }

    void on_status(const StatusArray &message, const ServerName &from)
    {
        if (servers_.empty() || servers_.back() != from)
            servers_.push_back(from);
        listed_ = message.status_list;
        has_answered_ = has_answered_ || std::exchange(is_cancelling_, false);
        tell_watchers();
    }

    void tell_watchers()
    {
        for (const auto &look : watchers_)
            look();
    }

    Middleware &middleware_;
    std::string server_;
    Client<CancelGoal> cancel_;
    std::vector<std::function<void()>> watchers_;
    std::set<const Task *> tasks_;   // that have the server
    std::optional<bool> is_resent_;  // what is to be done when the server is free again
    std::vector<Status> listed_;     // by the server
    std::set<GoalName> own_;         // goals of tasks
    std::set<GoalName> interrupted_; // goals of others, since the server was asked last
    bool is_sending_ = false;
    bool is_cancelling_ = false;     // says the server, and the status has not come yet
    bool has_answered_ = false;      // since a task took the server
    std::deque<ServerName> servers_; // that have reported their status, the newest last
    int losses_ = 0;
    Steady::time_point asked_{};
};
