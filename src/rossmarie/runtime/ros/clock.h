// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//  Instants: nanoseconds of ROS time, in order. If ROS time stands still (/clock is not published
// any more), the steady clock of the system detects this and takes its place; otherwise no message
// would ever be too old.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "middleware.h"

class Clock {
public:
    // ROS time may stand still for `patience_ns` of wall time; 0: for ever.
    Clock(const Middleware &middleware, int64_t patience_ns)
        : middleware_(middleware), patience_ns_(patience_ns)
    {
    }

    // An instant that is not before one given earlier, and not in the future. It goes back only
    // where ROS time jumps back (a recording starts over), or goes on after it stood still.
    int64_t in_order(int64_t at_ns)
    {
        const int64_t now = look();
        given_ns_ = std::max(given_ns_, std::min(at_ns, now));
        return given_ns_;
    }

    int64_t now() { return in_order(INT64_MAX); }

    int64_t latest() const { return given_ns_; }

    // The number of times that time has gone back.
    int jumps() const { return jumps_; }

    bool stands_still() const { return is_still_; }

    // The distance (ns) by which ROS time has jumped forward since the last call; 0 without a jump.
    int64_t take_leap() { return std::exchange(leap_ns_, 0); }

private:
    using Steady = std::chrono::steady_clock;

    static constexpr int64_t LEAP_NS = 1'000'000'000;
    static constexpr int64_t FASTER = 10; // than before: simulated time may run fast, but evenly

    // The present instant.
    int64_t look()
    {
        const int64_t now = middleware_.now_ns();
        const int64_t waited_ns = elapsed_ns();
        if (now == seen_ns_ && now != 0) {
            is_still_ = patience_ns_ > 0 && waited_ns >= patience_ns_;
            return is_still_ ? now + waited_ns : now;
        }
        const int64_t ahead_ns = now - seen_ns_ - waited_ns;
        if (seen_ns_ != 0 && ahead_ns > LEAP_NS && ahead_ns > FASTER * ahead_ns_)
            leap_ns_ = ahead_ns;
        if (now < given_ns_ && (is_still_ || now < seen_ns_)) {
            jumps_ += 1;
            given_ns_ = now;
        }
        is_still_ = false;
        ahead_ns_ = ahead_ns;
        seen_ns_ = now;
        moved_ = Steady::now();
        return now;
    }

    // Of wall time, since ROS time has moved.
    int64_t elapsed_ns() const { return std::chrono::nanoseconds(Steady::now() - moved_).count(); }

    const Middleware &middleware_;
    int64_t patience_ns_;
    int64_t seen_ns_ = 0;
    Steady::time_point moved_ = Steady::now();
    int64_t ahead_ns_ = 0; // of the wall clock, when ROS time moved at last
    int64_t leap_ns_ = 0;
    int64_t given_ns_ = 0;
    int jumps_ = 0;
    bool is_still_ = false;
};
