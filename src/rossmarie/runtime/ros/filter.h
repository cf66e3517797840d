// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The filter of a command topic: receives commands on the unfiltered topic, bounds them, and
// publishes them on the filtered topic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

#include "any_filter.h"
#include "clock.h"
#include "middleware.h"
#include "parts.h"
#include "rules.h"
#include "settings.h"
#include "stamps.h"
#include "throttle.h"

// `Command` describes a command topic: its `Message` type, `topic`, `source` topic, `index`, number
// of `fields`, and each_number(message, visit(field, number)).
template <class Command> class Filter : public AnyFilter {
public:
    using Message = typename Command::Message;

    Filter(Middleware &middleware, Clock &clock, const core::Reactor &reactor,
           const Settings &settings, CatchUp catch_up)
        : middleware_(middleware), clock_(clock), reactor_(reactor), settings_(settings),
          catch_up_(std::move(catch_up)), topic_(middleware.resolved(Command::topic)),
          source_(middleware.resolved(Command::source)),
          publisher_(middleware.advertise<Message>(Command::topic, 10))
    {
        middleware.subscribe<Message>(
            Command::source, 10, Middleware::Kept::LEFT,
            [this](const Message &message, int64_t) { receive(message); });
    }

    void update(int64_t now_ns) override
    {
        const Bounds bounds = bounds_at(now_ns);
        const bool was_blocked = blocked_;
        blocked_ = is_zero(bounds);
        const bool is_due = now_ns - sent_ns_ >= settings_.filter_period_ns || now_ns < sent_ns_;
        if (blocked_ ? is_due || !was_blocked
                     : is_fresh(now_ns) && has_changed(bounds) && (is_due || is_stricter(bounds)))
            send(now_ns);
    }

    // Sends `message` in place of the planner's commands until `give_back`.
    void take_over(const Message &message)
    {
        is_taken_over_ = true;
        latest_ = message;
        send(clock_.now());
    }

    void give_back()
    {
        is_taken_over_ = false;
        latest_ = Message();
        received_ns_ = INT64_MIN;
    }

    void stop() override
    {
        Message message;
        Command::each_number(message, [](std::size_t, auto &number) { number = 0; });
        put_stamp(message, Middleware::time(middleware_.now_ns()));
        const std::lock_guard<std::mutex> lock(sending_);
        is_over_ = true;
        publisher_.publish(message);
    }

    void bar(bool is_bypassed) override { is_bypassed_ = is_bypassed; }

    bool is_blocked() const override { return blocked_; }
    int listeners() const override { return publisher_.listeners(); }
    int refused() const override { return refused_; }
    const std::string &topic() const override { return topic_; }
    const std::string &source() const override { return source_; }
    std::string type() const override { return Middleware::type<Message>(); }

    // Bounds a message and publishes it.
    void pass(Message message, int64_t now_ns)
    {
        const Bounds bounds = bounds_at(now_ns);
        if (!is_finite(message)) {
            refused_ += 1;
            if (throttle_.is_due())
                say::error("a command on " + topic_ + " is not finite; the filter sends 0 instead");
            Command::each_number(message, [](std::size_t, auto &number) { number = 0; });
        }
        Command::each_number(message, [&](std::size_t field, auto &number) {
            using Number = std::remove_reference_t<decltype(number)>;
            number = static_cast<Number>(core::bounded(bounds[field], number));
        });
        {
            const std::lock_guard<std::mutex> lock(sending_);
            if (!is_over_)
                publisher_.publish(message);
        }
        sent_ = bounds;
        sent_ns_ = now_ns;
    }

private:
    using Bounds = std::array<core::Bounds, Command::fields>;

    void receive(const Message &message)
    {
        const int64_t now = clock_.now();
        catch_up_(now);
        if (is_taken_over_)
            return;
        latest_ = message;
        received_ns_ = now;
        pass(message, now);
    }

    // Sends the last command again. If there is none, sends 0.
    void send(int64_t now_ns)
    {
        Message message = latest_;
        put_stamp(message, Middleware::time(now_ns));
        pass(message, now_ns);
    }

    bool is_fresh(int64_t now_ns) const
    {
        const bool has_any = received_ns_ != INT64_MIN && received_ns_ <= now_ns;
        return is_taken_over_ || (has_any && now_ns - received_ns_ < settings_.command_timeout_ns);
    }

    Bounds bounds_at(int64_t now_ns) const
    {
        Bounds bounds;
        core::bounds_of(&reactor_, now_ns, Command::index, bounds.data());
        if (is_bypassed_ || clock_.stands_still())
            bounds.fill(core::Bounds{0.0, 0.0, 0.0});
        return bounds;
    }

    static bool is_finite(Message &message)
    {
        bool is_finite = true;
        Command::each_number(message, [&](std::size_t, auto &number) {
            is_finite = is_finite && std::isfinite(number);
        });
        return is_finite;
    }

    static bool is_zero(const Bounds &bounds)
    {
        return std::all_of(bounds.begin(), bounds.end(), [](const core::Bounds &b) {
            return b.factor == 0.0 || (b.low == 0.0 && b.high == 0.0);
        });
    }

    bool has_changed(const Bounds &bounds) const
    {
        return !std::equal(bounds.begin(), bounds.end(), sent_.begin(), [](auto &a, auto &b) {
            return a.factor == b.factor && a.low == b.low && a.high == b.high;
        });
    }

    // Returns true if the bounds are stricter than the last sent bounds. Such a change must not
    // wait.
    bool is_stricter(const Bounds &bounds) const
    {
        return !std::equal(bounds.begin(), bounds.end(), sent_.begin(), [](auto &a, auto &b) {
            return a.factor >= b.factor && a.low <= b.low && a.high >= b.high;
        });
    }

    Middleware &middleware_;
    Clock &clock_;
    const core::Reactor &reactor_;
    const Settings &settings_;
    CatchUp catch_up_;
    std::string topic_;
    std::string source_;
    Publisher<Message> publisher_;
    Throttle throttle_;
    Message latest_{};
    Bounds sent_{};
    int64_t received_ns_ = INT64_MIN;
    int64_t sent_ns_ = 0;
    bool blocked_ = false;
    bool is_taken_over_ = false;
    bool is_bypassed_ = false;
    std::mutex sending_; // guards is_over_: after the final 0 no thread sends a command
    bool is_over_ = false;
    int refused_ = 0;
};

// Adds the filter of a command topic.
template <class Command>
Filter<Command> &add_filter(Performers &made, Host &host, const Filtering &filtering)
{
    auto filter =
        std::make_unique<Filter<Command>>(host.middleware(), filtering.clock, filtering.reactor,
                                          filtering.settings, filtering.catch_up);
    Filter<Command> &found = *filter;
    made.filters.push_back(std::move(filter));
    return found;
}
