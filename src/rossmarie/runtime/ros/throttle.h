// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Limits the rate of frequent log lines.
#pragma once

#include <chrono>

class Throttle {
public:
    // True at most once a second.
    bool is_due()
    {
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < std::chrono::seconds(1))
            return false;
        last_ = now;
        return true;
    }

private:
    std::chrono::steady_clock::time_point last_{};
};
