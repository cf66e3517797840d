// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Sends a goal to an action server, in place of its present goal.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "goals.h"
#include "task.h"

template <class Action> class SendTask : public Task {
public:
    using ActionGoal = typename Action::_action_goal_type;
    using Goal = typename ActionGoal::_goal_type;
    using Report = std::function<void(bool success)>;

    // If `resend` is true, the interrupted goal is sent again when the rule is released.
    SendTask(std::shared_ptr<Goals> goals, Goal goal, bool resend, Report report)
        : goals_(std::move(goals)), resend_(resend), report_(std::move(report))
    {
        message_.goal = std::move(goal);
        goals_->template advertise<ActionGoal>();
        goals_->watch([this] { look(); });
    }

    void start(int64_t /*now_ns*/) override
    {
        is_awaited_ = true;
        is_listed_ = false;
        goals_->take(this);
        send_when_connected();
    }

    void stop() override { end(resend_); }
    void give_up() override { end(false); }

    void tick(int64_t /*now_ns*/) override
    {
        goals_->tick();
        send_when_connected();
    }

private:
    void send_when_connected()
    {
        if (!is_awaited_ || !id_.empty() || !goals_->is_connected())
            return;
        losses_ = goals_->losses();
        id_ = goals_->send(message_);
    }

    void end(bool resend)
    {
        if (!id_.empty())
            goals_->cancel(id_);
        id_.clear();
        is_awaited_ = false;
        goals_->release(this, resend);
    }

    void look()
    {
        if (!is_awaited_ || id_.empty())
            return;
        const Goals::Status *status = goals_->find(id_);
        const bool was_listed = is_listed_;
        is_listed_ = status != nullptr;
        if (losses_ != goals_->losses()) {
            finish(false, "the server has disappeared");
        } else if (status == nullptr && was_listed) {
            finish(false, "the server no longer knows the goal");
        } else if (status != nullptr && Goals::is_over(*status)) {
            id_.clear();
            finish(status->status == Goals::Status::SUCCEEDED, outcome(*status));
        }
    }

    static std::string outcome(const Goals::Status &status)
    {
        static const char *const OUTCOMES[] = {
            "pending",  "active",     "preempted", "succeeded", "aborted",
            "rejected", "preempting", "recalling", "recalled",  "lost",
        };
        const bool is_known = status.status <= Goals::Status::LOST;
        return std::string(is_known ? OUTCOMES[status.status] : "unknown") + " " + status.text;
    }

    void finish(bool success, const std::string &outcome)
    {
        is_awaited_ = false;
        if (!success)
            say::error("the goal for " + goals_->server() + " failed: " + outcome);
        else if (!resend_)
            goals_->release(this, false);
        report_(success);
    }

    std::shared_ptr<Goals> goals_;
    ActionGoal message_;
    bool resend_;
    Report report_;
    std::string id_; // the ID of the sent goal, until its end
    int losses_ = 0; // goals_->losses() when the goal was sent
    bool is_listed_ = false;
    bool is_awaited_ = false;
};
