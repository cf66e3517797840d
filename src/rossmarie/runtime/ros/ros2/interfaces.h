// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The message and service types of this node: its own types, and diagnostics.
#pragma once

#include <diagnostic_msgs/msg/diagnostic_array.hpp>
#include <diagnostic_msgs/msg/diagnostic_status.hpp>
#include <std_msgs/msg/bool.hpp>

#include "rules.h"

using diagnostic_msgs::msg::DiagnosticArray;
using diagnostic_msgs::msg::DiagnosticStatus;
using std_msgs::msg::Bool;
