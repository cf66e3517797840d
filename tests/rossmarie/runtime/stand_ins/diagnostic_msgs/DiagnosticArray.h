#pragma once
#include <vector>

#include "diagnostic_msgs/DiagnosticStatus.h"
#include "middleware.h"
namespace diagnostic_msgs {
struct DiagnosticArray {
    struct {
        Middleware::Time stamp;
    } header;
    std::vector<DiagnosticStatus> status;
};
} // namespace diagnostic_msgs
