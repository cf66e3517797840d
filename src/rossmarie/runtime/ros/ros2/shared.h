// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// A state that several tasks change by service calls; it is restored when none of them needs it any
// more.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <set>
#include <utility>

#include "middleware.h"

class Task;

// `Resource` has `apply(Change, Then)`, and `restore(Then)`, which restores the state before the
// first change. Both call `Then` later with their success. They run one after the other.
template <class Resource> class Shared {
public:
    using Then = std::function<void(bool success)>;

    template <class... Arguments>
    explicit Shared(Middleware &middleware, Arguments &&...arguments)
        : middleware_(middleware), resource_(middleware, std::forward<Arguments>(arguments)...)
    {
    }

    // A task has it from now on.
    void take(const Task *task, typename Resource::Change change, Then then)
    {
        tasks_.insert(task);
        is_changed_ = true;
        begin({[this, change](Then tell) { resource_.apply(change, tell); }, std::move(then)});
    }

    // A task does not need it any more.
    void release(const Task *task) { tasks_.erase(task); }

    // Call it when all task commands of a call have been given, and regularly.
    void tick()
    {
        if (is_changed_ && tasks_.empty()) {
            is_changed_ = false;
            begin({[this](Then tell) { resource_.restore(tell); }, [](bool) {}});
        }
        if (is_busy_ && Steady::now() - begun_ > PATIENCE)
            end(number_, false);
    }

private:
    using Steady = std::chrono::steady_clock;
    static constexpr std::chrono::seconds PATIENCE{10}; // with a server that has gone for good

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
            return; // it was given up
        const Then then = std::move(jobs_.front().then);
        jobs_.pop_front();
        next();
        middleware_.later([then, success] { then(success); });
    }

    Middleware &middleware_;
    Resource resource_;
    std::set<const Task *> tasks_; // that have it
    std::deque<Job> jobs_;         // the first runs
    int number_ = 0;               // of the job that runs
    Steady::time_point begun_{};
    bool is_busy_ = false;
    bool is_changed_ = false;
};
