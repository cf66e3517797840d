// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The tasks of rules. The reactor decides when a task starts and ends. It calls `start` when a task
// starts, `stop` when its rule is released or another rule takes its resource, and `give_up` when
// the task has failed.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "clock.h"
#include "middleware.h"
#include "stamps.h"

class Task {
public:
    virtual ~Task() = default;
    virtual void start(int64_t /*now_ns*/) {}
    virtual void stop() {}
    virtual void give_up() { stop(); }
    virtual void tick(int64_t /*now_ns*/) {}

    // Sends a recorded pose: x, y and z in m, and the quaternion of the orientation if there is
    // one.
    virtual void retrace(int64_t /*now_ns*/, const double * /*pose*/) {}

    // Checks the requirements of `start` on other nodes. Calls `report` later with the unmet
    // requirement as text, or with "".
    virtual void check(std::function<void(const std::string &missing)> /*report*/) {}

    // Returns the instant of the next necessary `tick`.
    virtual int64_t next_ns() const { return INT64_MAX; }
};

// A limit or a scale. The reactor computes the bounds, so the task does nothing.
class BoundTask : public Task {};

// Publishes a message once (period_ns is 0) or repeatedly.
template <class Message> class PublishTask : public Task {
public:
    PublishTask(Middleware &middleware, const std::string &topic, int64_t period_ns,
                Message message)
        : publisher_(middleware.advertise<Message>(topic, 10)), period_ns_(period_ns),
          message_(std::move(message))
    {
    }

    void start(int64_t now_ns) override { send(now_ns); }
    void stop() override { next_ns_ = INT64_MAX; }
    int64_t next_ns() const override { return next_ns_; }

    void tick(int64_t now_ns) override
    {
        // After a jump back in time, the period starts again.
        if (now_ns >= next_ns_ || (next_ns_ != INT64_MAX && next_ns_ - now_ns > period_ns_))
            send(now_ns);
    }

private:
    void send(int64_t now_ns)
    {
        put_stamp(message_, Middleware::time(now_ns));
        publisher_.publish(message_);
        next_ns_ = period_ns_ > 0 ? now_ns + period_ns_ : INT64_MAX;
    }

    Publisher<Message> publisher_;
    int64_t period_ns_;
    int64_t next_ns_ = INT64_MAX;
    Message message_;
};

// Publishes recorded poses, one per message. The reactor chooses the pose and the instant.
template <class Message> class RetraceTask : public Task {
public:
    using Put = std::function<void(Message &message, const double *pose)>;

    RetraceTask(Middleware &middleware, const std::string &topic, Message message, Put put)
        : publisher_(middleware.advertise<Message>(topic, 10)), message_(std::move(message)),
          put_(std::move(put))
    {
    }

    void retrace(int64_t now_ns, const double *pose) override
    {
        put_(message_, pose);
        put_stamp(message_, Middleware::time(now_ns));
        publisher_.publish(message_);
    }

private:
    Publisher<Message> publisher_;
    Message message_;
    Put put_;
};

// Returns false if a response has a field `success` that is false, else true.
template <class Response>
auto is_success(const Response &response, int) -> decltype(bool(response.success))
{
    return response.success;
}
template <class Response> bool is_success(const Response &, long) { return true; }

// Calls a service.
template <class Service> class CallTask : public Task {
public:
    using Report = std::function<void(bool success)>;

    using Request = typename Service::Request;
    using Response = typename Service::Response;

    CallTask(Middleware &middleware, const std::string &service, Request request, Report report)
        : request_(std::move(request)), report_(std::move(report)), client_(middleware, service)
    {
    }

    void start(int64_t /*now_ns*/) override
    {
        const int run = ++run_;
        client_.call(request_, [this, run](bool has_answered, const Response &response) {
            if (run == run_)
                report_(has_answered && is_success(response, 0));
        });
    }

    // Ignores the result of a running call.
    void stop() override { ++run_; }

private:
    Request request_;
    Report report_;
    int run_ = 0;
    Client<Service> client_;
};

// Calls a function at the start, and another function at the end.
class DoTask : public Task {
public:
    explicit DoTask(
        std::function<void()> begin, std::function<void()> end = [] {})
        : begin_(std::move(begin)), end_(std::move(end))
    {
    }

    void start(int64_t /*now_ns*/) override { begin_(); }
    void stop() override { end_(); }

private:
    std::function<void()> begin_;
    std::function<void()> end_;
};
