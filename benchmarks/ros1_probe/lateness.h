// The latency of messages.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

inline double now()
{
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

class Lateness {
public:
    void note(double sent)
    {
        late_s_.push_back(now() - sent);
        last_ = now();
    }

    // A line: name, p50, p99 and maximum (us), number of messages, instant of the last message.
    void print(const std::string &name)
    {
        std::sort(late_s_.begin(), late_s_.end());
        std::printf("%s %.1f %.1f %.1f %zu %.6f\n", name.c_str(), at(0.5), at(0.99), at(1.0),
                    late_s_.size(), last_);
    }

private:
    double at(double share) const
    {
        if (late_s_.empty())
            return 0.0;
        const double last = static_cast<double>(late_s_.size() - 1);
        return 1e6 * late_s_[static_cast<std::size_t>(share * last)];
    }

    std::vector<double> late_s_;
    double last_ = 0.0;
};
