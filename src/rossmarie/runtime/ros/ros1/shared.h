// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// A state that several tasks change by service calls. When no task needs a change any more, the old
// state is restored.
#pragma once

#include <functional>
#include <set>
#include <utility>

#include "middleware.h"
#include "worker.h"

class Task;

// `Resource` has `bool apply(Change)` and `restore()`. `restore` restores the state before the
// first change. Both functions may take long, so they run in another thread, one after the other.
template <class Resource> class Shared {
public:
    template <class... Arguments>
    explicit Shared(Middleware &middleware, Arguments &&...arguments)
        : resource_(middleware, std::forward<Arguments>(arguments)...), worker_(middleware.queue())
    {
    }

    // Gives the state to a task, and applies the change of the task.
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

    // Takes the state from a task.
    void release(const Task *task) { tasks_.erase(task); }

    // Restores the state if no task has it. Call this function after the last task command of a
    // call.
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
    Resource resource_;            // only the thread of the worker uses it
    std::set<const Task *> tasks_; // the tasks that have the state
    bool is_changed_ = false;
    Worker worker_; // last: it uses the members above
};
