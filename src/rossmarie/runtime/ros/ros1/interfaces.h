// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// The interfaces of this node: its own messages and services, and diagnostics.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <std_msgs/Bool.h>

#include "rules.h"

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;
using std_msgs::Bool;
