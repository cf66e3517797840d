// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// A thread for slow work, so that the node never waits. The result of a job arrives as a callback
// in the queue of the node.
#pragma once

#include <ros/callback_queue.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

class Worker {
public:
    using Then = std::function<void()>;
    using Job = std::function<Then()>;

    explicit Worker(ros::CallbackQueue &queue) : queue_(queue), thread_([this] { run(); }) {}

    ~Worker()
    {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            is_over_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }

    Worker(const Worker &) = delete;
    Worker &operator=(const Worker &) = delete;

    // Runs `job` in the thread of the worker, and the function that `job` returns in the node.
    void begin(Job job)
    {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            jobs_.push_back(std::move(job));
        }
        wake_.notify_one();
    }

private:
    class Return : public ros::CallbackInterface {
    public:
        explicit Return(Then then) : then_(std::move(then)) {}
        CallResult call() override
        {
            then_();
            return Success;
        }

    private:
        Then then_;
    };

    void run()
    {
        std::unique_lock<std::mutex> lock(mutex_);
        for (;;) {
            wake_.wait(lock, [this] { return is_over_ || !jobs_.empty(); });
            if (is_over_)
                return;
            const Job job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            queue_.addCallback(boost::make_shared<Return>(job()));
            lock.lock();
        }
    }

    ros::CallbackQueue &queue_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Job> jobs_;
    bool is_over_ = false;
    std::thread thread_; // last: it uses the members above
};
