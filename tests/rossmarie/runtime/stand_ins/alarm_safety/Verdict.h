#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "middleware.h"
namespace alarm_safety {
struct Value {
    std::string name;
    double value = 0.0;
    std::string unit;
};
struct Verdict {
    enum : std::uint8_t { CLEARED, ACTIVATED, ACTIVATED_WITHOUT_INPUT, TIME_JUMP };
    std::string rule;
    std::uint8_t change = CLEARED;
    Middleware::Time at;
    std::string cause, clears;
    std::vector<Value> values;
    std::vector<std::string> categories, actions, overruled;
};
} // namespace alarm_safety
