// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// The interfaces of this node: its own messages and services, and diagnostics.
#pragma once

#include <diagnostic_msgs/msg/diagnostic_array.hpp>
#include <diagnostic_msgs/msg/diagnostic_status.hpp>
#include <std_msgs/msg/bool.hpp>

#include "rules.h"

using diagnostic_msgs::msg::DiagnosticArray;
using diagnostic_msgs::msg::DiagnosticStatus;
using std_msgs::msg::Bool;
