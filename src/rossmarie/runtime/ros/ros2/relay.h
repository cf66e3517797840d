// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// A relay: an action server in front of the real action server. The relay forwards each goal, so it
// can send an interrupted goal again. The goal of the client stays active all the time.
#pragma once

#include <rclcpp_action/rclcpp_action.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "goals.h"

template <class Action> class Relay : public Goals {
public:
    // `front` is the name for clients. The relay opens it when the real server is available, so
    // that clients wait for the real server.
    Relay(Middleware &middleware, const std::string &server, const std::string &front)
        : Goals(middleware, server), front_name_(front),
          client_(rclcpp_action::create_client<Action>(&middleware.node(), server))
    {
    }

    // Cancels all goals: without the relay, no rule could interrupt them.
    ~Relay() override
    {
        for (const auto &[name, entry] : entries_)
            cancel_there(entry);
    }

    void tick() override
    {
        Goals::tick();
        const auto now = Steady::now();
        if (front_ || now - looked_ < PERIOD)
            return;
        looked_ = now; // the check of the server is slow
        if (client_->action_server_is_ready())
            open();
    }

protected:
    void hold() override
    {
        for (auto &[name, entry] : entries_)
            entry.is_held = true;
    }

    // If `resend` is true, sends the last goal again. Ends the other held goals.
    void let_go(bool resend) override
    {
        resent_ = 0;
        for (const auto &[name, entry] : entries_)
            if (resend && entry.is_held)
                resent_ = std::max(resent_, entry.number);
        for (const auto &[name, entry] : std::map<GoalName, Entry>(entries_))
            if (entry.is_held)
                settle(name);
    }

    void lose() override
    {
        for (const auto &[name, entry] : std::map<GoalName, Entry>(entries_))
            if (entry.is_away && !entry.there)
                send_elsewhere(name);
            else if (entry.is_away && !this->is_listed(entry.there->get_goal_id()))
                forsake(name);
    }

private:
    using Goal = typename Action::Goal;
    using Result = typename Action::Result;
    using Feedback = typename Action::Feedback;
    using Handle = std::shared_ptr<rclcpp_action::ServerGoalHandle<Action>>;
    using There = rclcpp_action::ClientGoalHandle<Action>;
    using Code = rclcpp_action::ResultCode;
    using Steady = std::chrono::steady_clock;
    using GoalResponse = rclcpp_action::GoalResponse;
    using CancelResponse = rclcpp_action::CancelResponse;

    static constexpr std::chrono::milliseconds PERIOD{100};

    struct Entry {
        Handle here;                     // the goal of the client
        int number = 0;                  // in the order of arrival
        int attempt = 0;                 // number of times that the relay sent it to the server
        typename There::SharedPtr there; // the goal at the server, while the server knows it
        bool is_away = false;            // sent to the server, without a result yet
        bool is_held = false;            // by a rule
        bool is_cancelled = false;       // by the client
    };

    void open()
    {
        front_ = rclcpp_action::create_server<Action>(
            &middleware().node(), front_name_,
            [this](const GoalName &, std::shared_ptr<const Goal>) { return judge(); },
            [this](const Handle &handle) {
                middleware().run([&] { on_cancel(handle->get_goal_id()); });
                return CancelResponse::ACCEPT;
            },
            [this](const Handle &handle) { middleware().run([&] { on_goal(handle); }); });
    }

    GoalResponse judge() const
    {
        if (client_->action_server_is_ready())
            return GoalResponse::ACCEPT_AND_EXECUTE;
        say::warning("a goal for " + this->server() + " is rejected: the server has disappeared");
        return GoalResponse::REJECT;
    }

    void on_goal(const Handle &handle)
    {
        const GoalName name = handle->get_goal_id();
        Entry &entry = entries_[name];
        entry.here = handle;
        entry.number = ++count_;
        entry.is_held = is_held();
        if (is_held())
            say::warning("a goal for " + this->server() + " waits: a rule holds the server");
        else
            forward(name);
    }

    void on_cancel(const GoalName &name)
    {
        const auto found = entries_.find(name);
        if (found == entries_.end())
            return;
        found->second.is_cancelled = true;
        cancel_there(found->second);
        if (!found->second.is_away) // a goal can end only after this callback
            middleware().later(
                [this, name] { end(name, Code::CANCELED, std::make_shared<Result>()); });
    }

    void cancel_there(const Entry &entry)
    {
        if (entry.there)
            client_->async_cancel_goal(entry.there);
    }

    // Sends or ends a goal that waited.
    void settle(const GoalName &name)
    {
        if (is_held() || entries_[name].is_away)
            return;
        if (entries_[name].number == resent_)
            forward(name);
        else
            end(name, Code::ABORTED, std::make_shared<Result>());
    }

    void forward(const GoalName &name)
    {
        Entry &entry = entries_[name];
        entry.is_held = false;
        entry.is_away = true;
        entry.attempt += 1;
        typename rclcpp_action::Client<Action>::SendGoalOptions options;
        options.goal_response_callback =
            [this, name, attempt = entry.attempt](typename There::SharedPtr there) {
                middleware().run([&] { on_response(name, attempt, there); });
            };
        options.feedback_callback = [this, name](auto, auto feedback) {
            const auto found = entries_.find(name);
            if (found != entries_.end())
                found->second.here->publish_feedback(std::make_shared<Feedback>(*feedback));
        };
        options.result_callback = [this, name, attempt = entry.attempt](const auto &wrapped) {
            middleware().run([&] { on_result(name, attempt, wrapped.code, wrapped.result); });
        };
        client_->async_send_goal(*entry.here->get_goal(), options);
    }

    // Sends the goal to another server if there is one. The old server may never have received the
    // goal.
    void send_elsewhere(const GoalName &name)
    {
        const Entry &entry = entries_[name];
        if (entry.is_held || entry.is_cancelled || !client_->action_server_is_ready())
            on_result(name, entry.attempt, Code::ABORTED, std::make_shared<Result>());
        else
            forward(name);
    }

    // Ends a goal whose server has disappeared. Cancels it too: its server may only not have
    // reported yet.
    void forsake(const GoalName &name)
    {
        const Entry &entry = entries_[name];
        cancel_there(entry);
        on_result(name, entry.attempt, Code::ABORTED, std::make_shared<Result>());
    }

    // Handles the response to `attempt`. Cancels the goal if the attempt is out of date.
    void on_response(const GoalName &name, int attempt, const typename There::SharedPtr &there)
    {
        const auto found = entries_.find(name);
        const bool is_awaited =
            found != entries_.end() && found->second.attempt == attempt && found->second.is_away;
        if (!is_awaited) {
            if (there)
                client_->async_cancel_goal(there);
            return;
        }
        if (!there)
            return on_result(name, attempt, Code::ABORTED, std::make_shared<Result>());
        found->second.there = there;
        if (found->second.is_cancelled || found->second.is_held)
            cancel_there(found->second);
    }

    void on_result(const GoalName &name, int attempt, Code code,
                   const std::shared_ptr<Result> &result)
    {
        const auto found = entries_.find(name);
        if (found == entries_.end() || found->second.attempt != attempt || !found->second.is_away)
            return;
        found->second.there = nullptr;
        found->second.is_away = false;
        const bool was_interrupted = found->second.is_held && !found->second.is_cancelled;
        if (was_interrupted && code != Code::SUCCEEDED)
            settle(name);
        else
            end(name, code, result);
    }

    void end(const GoalName &name, Code code, const std::shared_ptr<Result> &result)
    {
        const auto found = entries_.find(name);
        if (found == entries_.end())
            return;
        const Handle handle = found->second.here;
        entries_.erase(found);
        if (code == Code::SUCCEEDED)
            handle->succeed(result);
        else if (code == Code::CANCELED && handle->is_canceling())
            handle->canceled(result);
        else
            handle->abort(result);
    }

    std::string front_name_;
    typename rclcpp_action::Client<Action>::SharedPtr client_;
    typename rclcpp_action::Server<Action>::SharedPtr front_;
    std::map<GoalName, Entry> entries_; // running and waiting goals
    Steady::time_point looked_{};       // last check of the server
    int count_ = 0;                     // number of received goals
    int resent_ = 0;                    // the number of the goal to send again
};
