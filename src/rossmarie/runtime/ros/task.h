// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// The actions of rules. The reactor decides the time: it calls `start` when a task comes into
// force, `stop` when its rule is released or another rule has its resource, `give_up` when it has
// failed.
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

    // Sends a pose of the past: x, y and z in m, and with an orientation its quaternion.
    virtual void retrace(int64_t /*now_ns*/, const double * /*pose*/) {}

    // Finds missing requirements of `start` on other nodes. The result comes later, in a few words;
    // "" if nothing is missing.
    virtual void check(std::function<void(const std::string &lacking)> /*tell*/) {}

    // The instant at which `tick` has something to do next.
    virtual int64_t next_ns() const { return INT64_MAX; }
};

// A limit or a scale: the reactor bounds the commands itself.
class BoundTask : public Task {};

// A message, sent once (period_ns is 0) or repeatedly.
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
        // After a jump back in time, the period begins anew.
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

// Poses of the past, one per message: the reactor decides which, and when.
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

// True if a response means success: it does unless it has a field `success` that is false.
template <class Response>
auto is_success(const Response &response, int) -> decltype(bool(response.success))
{
    return response.success;
}
template <class Response> bool is_success(const Response &, long) { return true; }

// A service call.
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

    // The result of the call does not matter any more.
    void stop() override { ++run_; }

private:
    Request request_;
    Report report_;
    int run_ = 0;
    Client<Service> client_;
};

// A function at the start, at the end, or at both.
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
