#pragma once
#include <string>

#include "middleware.h"
namespace alarm_safety {
struct Exempt {
    struct Request {
        std::string rule;
        Middleware::Duration time;
        std::string reason;
    };
    struct Response {
        bool success = false;
        std::string message;
    };
};
} // namespace alarm_safety
