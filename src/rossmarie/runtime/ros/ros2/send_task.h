// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Sends a goal to an action server, in place of its present goal.
#pragma once

#include <rclcpp_action/rclcpp_action.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "goals.h"
#include "task.h"

template <class Action> class SendTask : public Task {
public:
    using Goal = typename Action::Goal;
    using Report = std::function<void(bool success)>;

    // If `resend` is true, the interrupted goal is sent again when the rule is released.
    SendTask(std::shared_ptr<Goals> goals, Goal goal, bool resend, Report report)
        : goals_(std::move(goals)), goal_(std::move(goal)), resend_(resend),
          report_(std::move(report)), client_(rclcpp_action::create_client<Action>(
                                          &goals_->middleware().node(), goals_->server()))
    {
        goals_->watch([this] { look(); });
    }

    void start(int64_t /*now_ns*/) override
    {
        run_ += 1;
        is_awaited_ = true;
        is_sent_ = false;
        goals_->take(this);
    }

    void stop() override { end(resend_); }
    void give_up() override { end(false); }

    void tick(int64_t /*now_ns*/) override
    {
        goals_->tick();
        send_when_free();
    }

private:
    using Handle = rclcpp_action::ClientGoalHandle<Action>;

    void look()
    {
        if (!is_sent_ || std::exchange(losses_, goals_->losses()) == goals_->losses())
            return send_when_free();
        if (handle_ && goals_->is_listed(handle_->get_goal_id()))
            return;
        if (handle_) // a server that has not reported yet may have the goal
            client_->async_cancel_goal(handle_);
        finish(run_, false, "the server has disappeared");
    }

    void send_when_free()
    {
        if (!is_awaited_ || is_sent_ || !goals_->is_free() || !client_->action_server_is_ready())
            return;
        is_sent_ = true;
        losses_ = goals_->losses();
        goals_->begin_sending();
        typename rclcpp_action::Client<Action>::SendGoalOptions options;
        options.goal_response_callback = [this, run = run_](typename Handle::SharedPtr handle) {
            goals_->middleware().run([&] { on_response(run, handle); });
        };
        options.result_callback = [this, run = run_](const typename Handle::WrappedResult &result) {
            goals_->middleware().run([&] {
                goals_->forget(result.goal_id);
                finish(run, result.code == rclcpp_action::ResultCode::SUCCEEDED,
                       "the goal did not succeed");
            });
        };
        client_->async_send_goal(goal_, options);
    }

    void on_response(int run, const typename Handle::SharedPtr &handle)
    {
        goals_->end_sending(handle ? &handle->get_goal_id() : nullptr);
        if (!handle)
            finish(run, false, "the server rejected the goal");
        else if (run == run_ && is_awaited_)
            handle_ = handle;
        else
            client_->async_cancel_goal(handle);
    }

    void finish(int run, bool success, const char *reason)
    {
        if (run != run_ || !is_awaited_)
            return;
        is_awaited_ = false;
        handle_.reset();
        if (!success)
            say::error("the goal for " + goals_->server() + " failed: " + reason);
        else if (!resend_)
            goals_->release(this, false);
        report_(success);
    }

    void end(bool resend)
    {
        if (handle_)
            client_->async_cancel_goal(handle_);
        is_awaited_ = false;
        handle_.reset();
        goals_->release(this, resend);
    }

    std::shared_ptr<Goals> goals_;
    Goal goal_;
    bool resend_;
    Report report_;
    typename rclcpp_action::Client<Action>::SharedPtr client_;
    typename Handle::SharedPtr handle_; // the sent goal, until its end
    int run_ = 0;
    bool is_awaited_ = false;
    bool is_sent_ = false;
    int losses_ = 0; // last known goals_->losses()
};
