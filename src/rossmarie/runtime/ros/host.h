// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The interface of the guard for tasks.
#pragma once

#include "middleware.h"

class Host {
public:
    virtual ~Host() = default;
    virtual Middleware &middleware() = 0;
    virtual void report(int task, bool success) = 0;
    virtual void diagnose(int task, int level, const char *text) = 0;
    virtual void end_diagnosis(int task) = 0;
    virtual void reset_all() = 0;
};
