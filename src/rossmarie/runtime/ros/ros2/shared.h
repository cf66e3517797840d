// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// A state that several tasks change by service calls. When no task needs a change any more, the old
// state is restored.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <set>
#include <utility>

#include "middleware.h"

class Task;

// `Resource` has `apply(Change, Then)` and `restore(Then)`. `restore` restores the state before the
// first change. Both functions call `Then` later with their success. They run one after the other.
template <class Resource> class Shared {
public:
    using Then = std::function<void(bool success)>;

    template <class... Arguments>
    explicit Shared(Middleware &middleware, Arguments &&...arguments)
        : middleware_(middleware), resource_(middleware, std::forward<Arguments>(arguments)...)
    {
    }

    // Gives the state to a task, and applies the change of the task.
    void take(const Task *task, typename Resource::Change change, Then then)
    {
        tasks_.insert(task);
        is_changed_ = true;
        begin({[this, change](Then report) { resource_.apply(change, report); }, std::move(then)});
    }

    // Takes the state from a task.
    void release(const Task *task) { tasks_.erase(task); }

    // Restores the state if no task has it. Call this function regularly, and after the last task
    // command of a call.
    void tick()
    {
        if (is_changed_ && tasks_.empty()) {
            is_changed_ = false;
            begin({[this](Then report) { resource_.restore(report); }, [](bool) {}});
        }
        if (is_busy_ && Steady::now() - begun_ > PATIENCE)
            end(number_, false);
    }

private:
    using Steady = std::chrono::steady_clock;
    static constexpr std::chrono::seconds PATIENCE{
        10}; // maximum wait for a server that has disappeared

    struct Job {
        std::function<void(Then)> run;
        Then then;
    };

    void begin(Job job)
    {
        jobs_.push_back(std::move(job));
        if (!is_busy_)
            next();
    }

    void next()
    {
        is_busy_ = !jobs_.empty();
        if (!is_busy_)
            return;
        begun_ = Steady::now();
        jobs_.front().run([this, number = ++number_](bool success) { end(number, success); });
    }

    void end(int number, bool success)
    {
        if (number != number_ || !is_busy_)
            return; // the job has timed out
        const Then then = std::move(jobs_.front().then);
        jobs_.pop_front();
        next();
        middleware_.later([then, success] { then(success); });
    }

    Middleware &middleware_;
    Resource resource_;
    std::set<const Task *> tasks_; // the tasks that have the state
    std::deque<Job> jobs_;         // the first job runs
    int number_ = 0;               // the number of the running job
    Steady::time_point begun_{};
    bool is_busy_ = false;
    bool is_changed_ = false;
};
