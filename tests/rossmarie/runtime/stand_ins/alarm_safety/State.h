#pragma once
#include <string>
#include <vector>

#include "middleware.h"
namespace alarm_safety {
struct TaskState {
    std::string rule, action, effect, state;
};
struct State {
    Middleware::Time at;
    bool open = false;
    std::vector<std::string> active, exempted, blocked;
    std::vector<TaskState> tasks;
};
} // namespace alarm_safety
