// Conditions that last and rules that clear. Do not change this file.
#pragma once

// True when a condition has been true for some seconds.
class Lasting {
public:
    explicit Lasting(double seconds) : seconds_(seconds) {}

    bool update(double now, bool condition) {
        if (!condition) {
            is_waiting_ = false;
            return false;
        }
        if (!is_waiting_) {
            is_waiting_ = true;
            since_ = now;
        }
        return now - since_ >= seconds_;
    }

private:
    double seconds_;
    double since_ = 0;
    bool is_waiting_ = false;
};

// Active from its condition on, until the condition has been false for some seconds.
class Rule {
public:
    explicit Rule(double clear_seconds) : clear_(clear_seconds) {}

    bool update(double now, bool condition) {
        if (condition) is_active_ = true;
        if (clear_.update(now, !condition)) is_active_ = false;
        return is_active_;
    }

private:
    Lasting clear_;
    bool is_active_ = false;
};
