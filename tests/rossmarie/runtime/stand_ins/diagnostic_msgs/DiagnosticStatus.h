#pragma once
#include <string>
namespace diagnostic_msgs {
struct DiagnosticStatus {
    enum { OK, WARN, ERROR };
    signed char level = OK;
    std::string name, message, hardware_id;
};
} // namespace diagnostic_msgs
