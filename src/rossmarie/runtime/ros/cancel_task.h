// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// Cancels the goals of an action server, and keeps the server free of goals until the rule is
// released.
#pragma once

#include <functional>
#include <memory>

#include "goals.h"
#include "task.h"

class CancelTask : public Task {
public:
    using Report = std::function<void(bool success)>;

    // If `resend` is true, the interrupted goal is sent again when the rule is released.
    CancelTask(std::shared_ptr<Goals> goals, bool resend, Report report)
        : goals_(std::move(goals)), resend_(resend), report_(std::move(report))
    {
        goals_->watch([this] { look(); });
    }

    void start(int64_t /*now_ns*/) override
    {
        is_in_force_ = is_awaited_ = true;
        goals_->take(this);
    }

    void stop() override { end(resend_); }
    void give_up() override { end(false); }
    void tick(int64_t /*now_ns*/) override { goals_->tick(); }

private:
    void end(bool resend)
    {
        is_in_force_ = is_awaited_ = false;
        goals_->release(this, resend);
    }

    void look()
    {
        if (!is_in_force_)
            return;
        goals_->interrupt();
        if (!is_awaited_ || !goals_->is_free())
            return;
        is_awaited_ = false;
        report_(true);
    }

    std::shared_ptr<Goals> goals_;
    bool resend_;
    Report report_;
    bool is_in_force_ = false;
    bool is_awaited_ = false;
};
