// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The instants of the node: nanoseconds of ROS time, in order. ROS time stands still if no node
// publishes /clock any more. The steady clock of the system detects this and replaces ROS time.
// Otherwise no message would ever expire.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "middleware.h"

class Clock {
public:
    // ROS time may stand still for `patience_ns` of wall time. 0 means without limit.
    Clock(const Middleware &middleware, int64_t patience_ns)
        : middleware_(middleware), patience_ns_(patience_ns)
    {
    }

    // Returns an instant that is not earlier than the previous instants and not in the future. The
    // instants go back only if ROS time jumps back (a recording starts over), or if ROS time
    // advances again after a standstill.
    int64_t in_order(int64_t at_ns)
    {
        const int64_t now = look();
        given_ns_ = std::max(given_ns_, std::min(at_ns, now));
        return given_ns_;
    }

    int64_t now() { return in_order(INT64_MAX); }

    int64_t latest() const { return given_ns_; }

    // Returns the number of jumps back.
    int jumps() const { return jumps_; }

    bool stands_still() const { return is_still_; }

    // Returns the distance (ns) by which ROS time jumped forward since the last call. 0: no jump.
    int64_t take_leap() { return std::exchange(leap_ns_, 0); }

private:
    using Steady = std::chrono::steady_clock;

    static constexpr int64_t LEAP_NS = 1'000'000'000;
    static constexpr int64_t FASTER =
        10; // minimum factor of a jump: simulated time may run fast, but evenly

    // Returns the present instant.
    int64_t look()
    {
        const int64_t now = middleware_.now_ns();
        const int64_t waited_ns = elapsed_ns();
        if (now == seen_ns_ && now != 0) {
            is_still_ = patience_ns_ > 0 && waited_ns >= patience_ns_;
            return is_still_ ? now + waited_ns : now;
        }
        const int64_t ahead_ns = now - seen_ns_ - waited_ns;
        if (seen_ns_ != 0 && ahead_ns > LEAP_NS && ahead_ns / FASTER > ahead_ns_)
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

    // Returns the wall time since ROS time last advanced.
    int64_t elapsed_ns() const { return std::chrono::nanoseconds(Steady::now() - moved_).count(); }

    const Middleware &middleware_;
    int64_t patience_ns_;
    int64_t seen_ns_ = 0;
    Steady::time_point moved_ = Steady::now();
    int64_t ahead_ns_ = 0; // lead over the wall clock when ROS time last advanced
    int64_t leap_ns_ = 0;
    int64_t given_ns_ = 0;
    int jumps_ = 0;
    bool is_still_ = false;
};
