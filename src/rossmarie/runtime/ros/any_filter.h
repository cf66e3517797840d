// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// What the node knows of the filter of a command topic, whatever its messages are.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

// Lets what is due happen before a command that has come later is bounded.
using CatchUp = std::function<void(int64_t now_ns)>;

class AnyFilter {
public:
    virtual ~AnyFilter() = default;

    // To be called whenever bounds may have changed, and regularly.
    virtual void update(int64_t now_ns) = 0;

    // Sends 0, the last that is sent. May be called from another thread.
    virtual void stop() = 0;

    // Whether somebody else commands the robot past the filter: then nothing but 0 is sent.
    virtual void bar(bool is_bypassed) = 0;

    // Whether nothing but 0 passes.
    virtual bool is_blocked() const = 0;

    // How many nodes listen to what passes.
    virtual int listeners() const = 0;

    // How many commands were not finite.
    virtual int refused() const = 0;
    virtual const std::string &topic() const = 0;

    // Where commands come from, and of which type they are.
    virtual const std::string &source() const = 0;
    virtual std::string type() const = 0;
};
