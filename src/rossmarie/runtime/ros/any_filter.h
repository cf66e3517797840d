// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The interface of the filter of a command topic, independent of its message type.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

// Brings the guard up to date with an instant before the filter bounds a command.
using CatchUp = std::function<void(int64_t now_ns)>;

class AnyFilter {
public:
    virtual ~AnyFilter() = default;

    // Updates the bounds. Call this function regularly, and after each possible change of the
    // bounds.
    virtual void update(int64_t now_ns) = 0;

    // Sends 0 as the last command. Another thread may call this function.
    virtual void stop() = 0;

    // Tells the filter whether another node bypasses the filter. If so, the filter sends only 0.
    virtual void bar(bool is_bypassed) = 0;

    // Returns true if the bounds allow only 0.
    virtual bool is_blocked() const = 0;

    // Returns the number of subscribers of the filtered topic.
    virtual int listeners() const = 0;

    // Returns the number of commands that were not finite.
    virtual int refused() const = 0;
    virtual const std::string &topic() const = 0;

    // Return the source topic of the commands, and their type.
    virtual const std::string &source() const = 0;
    virtual std::string type() const = 0;
};
