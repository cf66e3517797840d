// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// An input topic: decides which messages the monitor accepts, and the instant of each.
#pragma once

#include <functional>
#include <string>

#include "clock.h"
#include "descriptions.h"
#include "middleware.h"
#include "stamps.h"
#include "throttle.h"

// The data of an input topic for the diagnostics.
class AnyInput {
public:
    virtual ~AnyInput() = default;
    const std::string &topic() const { return topic_; }
    const std::string &type() const { return type_; }
    int refused() const { return refused_; }
    const std::string &reason() const { return reason_; }

protected:
    AnyInput(std::string topic, std::string type) : topic_(std::move(topic)), type_(std::move(type))
    {
    }

    bool refuse(const std::string &reason)
    {
        refused_ += 1;
        reason_ = reason;
        if (throttle_.is_due())
            say::warning("a message on " + topic_ + " is refused: " + reason);
        return false;
    }

private:
    std::string topic_;
    std::string type_;
    std::string reason_;
    int refused_ = 0;
    Throttle throttle_;
};

// An input whose messages arrive through the subscription of another input.
class SharedInput : public AnyInput {
public:
    SharedInput(std::string topic, std::string type) : AnyInput(std::move(topic), std::move(type))
    {
    }
};

template <class Message> class Input : public AnyInput {
public:
    using Take = std::function<void(const Message &, int64_t at_ns)>;

    // The topic is stale at the age `timeout_ns`. 0 means never. If `by_stamp` is true, the stamp
    // in the header gives the instant of a message, not its arrival.
    Input(Middleware &middleware, Clock &clock, const std::string &topic, int64_t timeout_ns,
          bool by_stamp, Take take)
        : AnyInput(middleware.resolved(topic), Middleware::type<Message>()), clock_(clock),
          timeout_ns_(timeout_ns), by_stamp_(by_stamp), take_(std::move(take))
    {
        middleware.subscribe<Message>(
            topic, 100, Middleware::Kept::TAKEN,
            [this](const Message &message, int64_t received_ns) { receive(message, received_ns); });
    }

private:
    void receive(const Message &message, int64_t received_ns)
    {
        clock_.now();
        // The age of a message is unknown while ROS time stands still.
        if (clock_.stands_still() && expires(timeout_ns_)) {
            refuse("ROS time stands still");
            return;
        }
        if constexpr (has_stamp<Message>())
            if (by_stamp_) {
                const int64_t stamp_ns = Middleware::nanoseconds(*stamp_of(message, 0));
                if (is_current(stamp_ns))
                    take_(message, clock_.in_order(stamp_ns));
                return;
            }
        take_(message, clock_.in_order(received_ns));
    }

    bool is_current(int64_t stamp_ns)
    {
        const int64_t now = clock_.now();
        if (jumps_ != clock_.jumps()) { // the stamps before the jump are meaningless now
            jumps_ = clock_.jumps();
            latest_ns_ = INT64_MIN;
        }
        if (timeout_ns_ > 0 && now - stamp_ns >= timeout_ns_)
            return refuse("its stamp is older than the timeout");
        if (timeout_ns_ > 0 && stamp_ns - now >= timeout_ns_)
            return refuse("its stamp is in the future");
        if (stamp_ns <= latest_ns_)
            return refuse("its stamp is not later than the previous stamp");
        latest_ns_ = stamp_ns;
        return true;
    }

    Clock &clock_;
    int64_t timeout_ns_;
    bool by_stamp_;
    Take take_;
    int jumps_ = 0;
    int64_t latest_ns_ = INT64_MIN;
};
