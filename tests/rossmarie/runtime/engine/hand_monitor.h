/* A monitor of one rule, written by hand: the speed is out of [-1, 2] for a second. */
#ifndef HAND_MONITOR_H
#define HAND_MONITOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { hand_RULES = 1, hand_INPUTS = 1 };

enum hand_change { hand_CLEARED, hand_ACTIVATED, hand_ACTIVATED_STALE, hand_TIME_JUMP };

typedef struct hand_event {
    int64_t at_ns;
    int64_t from_ns;
    int64_t since_ns[1];
    double values[1];
    int32_t rule;
    int32_t change;
    unsigned char truth_values[1];
    unsigned char inputs[1];
} hand_event;

typedef void (*hand_callback)(void *user, const hand_event *event);

typedef struct hand_monitor {
    int64_t now_ns;
    int64_t wake_ns;
    double value[1];
    double low[1];
    double high[1];
    uint64_t dirty;
    bool quiet[1];
    bool started;
    int64_t stamp_ns[1];
    unsigned char state[1];
    unsigned char active[1];
    unsigned char truth_value[4];
    int64_t since_ns[4];
    int place[1];
    int64_t held_due_ns[1];
    unsigned char held_before[1];
    hand_callback on_event;
    void *user;
} hand_monitor;

#endif
