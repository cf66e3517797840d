// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// The interface of the filter of a command topic, independent of its message type.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

// Processes everything that is due before a later command is bounded.
using CatchUp = std::function<void(int64_t now_ns)>;

class AnyFilter {
public:
    virtual ~AnyFilter() = default;

    // Call it whenever bounds may have changed, and regularly.
    virtual void update(int64_t now_ns) = 0;

    // Sends 0 as the last command. May be called from another thread.
    virtual void stop() = 0;

    // True if another node commands the robot past the filter: then only 0 is sent.
    virtual void bar(bool is_bypassed) = 0;

    // True if only 0 passes.
    virtual bool is_blocked() const = 0;

    // The number of nodes that subscribe to the filtered topic.
    virtual int listeners() const = 0;

    // The number of commands that were not finite.
    virtual int refused() const = 0;
    virtual const std::string &topic() const = 0;

    // The source topic of commands, and their type.
    virtual const std::string &source() const = 0;
    virtual std::string type() const = 0;
};
