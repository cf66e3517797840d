#pragma once
#include <string>
namespace alarm_safety {
struct Reset {
    struct Request {
        std::string rule;
    };
    struct Response {
        bool success = false;
        std::string message;
    };
};
} // namespace alarm_safety
