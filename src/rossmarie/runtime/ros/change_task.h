// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Changes an external state by service calls. When no task needs the change any more, the old state
// is restored.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "shared.h"
#include "task.h"

template <class Resource> class ChangeTask : public Task {
public:
    using Report = std::function<void(bool success)>;

    ChangeTask(std::shared_ptr<Shared<Resource>> shared, typename Resource::Change change,
               Report report)
        : shared_(std::move(shared)), change_(std::move(change)), report_(std::move(report))
    {
    }

    void start(int64_t /*now_ns*/) override
    {
        const int run = ++run_;
        shared_->take(this, change_, [this, run](bool success) {
            if (run == run_)
                report_(success);
        });
    }

    void stop() override
    {
        ++run_;
        shared_->release(this);
    }

    void tick(int64_t /*now_ns*/) override { shared_->tick(); }

private:
    std::shared_ptr<Shared<Resource>> shared_;
    typename Resource::Change change_;
    Report report_;
    int run_ = 0;
};
