#pragma once
#include <string>
namespace alarm_safety {
struct Why {
    struct Request {};
    struct Response {
        std::string text;
    };
};
} // namespace alarm_safety
