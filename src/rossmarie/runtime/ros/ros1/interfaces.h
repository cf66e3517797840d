// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The message and service types of this node: its own types, and diagnostics.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <std_msgs/Bool.h>

#include "rules.h"

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;
using std_msgs::Bool;
