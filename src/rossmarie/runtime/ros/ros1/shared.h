// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// A state that several tasks change by service calls; it is restored when none of them needs it any
// more.
#pragma once

#include <functional>
#include <set>
#include <utility>

#include "middleware.h"
#include "worker.h"

class Task;

// `Resource` has `bool apply(Change)`, and `restore()`, which restores the state before the first
// change. Both may take long: they run in another thread, one after the other.
template <class Resource> class Shared {
public:
    template <class... Arguments>
    explicit Shared(Middleware &middleware, Arguments &&...arguments)
        : resource_(middleware, std::forward<Arguments>(arguments)...), worker_(middleware.queue())
    {
    }

    // A task has it from now on.
    void take(const Task *task, typename Resource::Change change,
              std::function<void(bool success)> then)
    {
        tasks_.insert(task);
        is_changed_ = true;
        worker_.begin([this, change, then]() -> Worker::Then {
            const bool success = resource_.apply(change);
            return [then, success] { then(success); };
        });
    }

    // A task does not need it any more.
    void release(const Task *task) { tasks_.erase(task); }

    // Call it when all task commands of a call have been given.
    void tick()
    {
        if (!is_changed_ || !tasks_.empty())
            return;
        is_changed_ = false;
        worker_.begin([this]() -> Worker::Then {
            resource_.restore();
            return [] {};
        });
    }

private:
    Resource resource_;            // for the thread of the worker alone
    std::set<const Task *> tasks_; // that have it
    bool is_changed_ = false;
    Worker worker_; // last: it uses what stands above
};
