// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// A command that a rule publishes.
#pragma once

#include "filter.h"
#include "task.h"

// Sends a command once or repeatedly. A repeated command replaces the commands of the planner. The
// bounds apply to the command.
template <class Command> class CommandTask : public Task {
public:
    using Message = typename Command::Message;

    CommandTask(Filter<Command> &filter, int64_t period_ns, Message message)
        : filter_(filter), period_ns_(period_ns), message_(std::move(message))
    {
    }

    void start(int64_t now_ns) override
    {
        if (period_ns_ > 0)
            filter_.take_over(message_);
        else
            filter_.pass(message_, now_ns);
        next_ns_ = period_ns_ > 0 ? now_ns + period_ns_ : INT64_MAX;
    }

    void stop() override
    {
        if (next_ns_ != INT64_MAX)
            filter_.give_back();
        next_ns_ = INT64_MAX;
    }

    void tick(int64_t now_ns) override
    {
        if (now_ns >= next_ns_ || (next_ns_ != INT64_MAX && next_ns_ - now_ns > period_ns_))
            start(now_ns);
    }

    int64_t next_ns() const override { return next_ns_; }

private:
    Filter<Command> &filter_;
    int64_t period_ns_;
    int64_t next_ns_ = INT64_MAX;
    Message message_;
};
