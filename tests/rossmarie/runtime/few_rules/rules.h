// Stands in for the C of rules, as far as the file of latched rules asks for it.
#pragma once

#include <set>

namespace core {
struct Monitor {
    std::set<int> active;
};

inline void latch(Monitor *monitor, int rule) { monitor->active.insert(rule); }
inline bool is_active(const Monitor *monitor, int rule) { return monitor->active.count(rule) > 0; }
} // namespace core
