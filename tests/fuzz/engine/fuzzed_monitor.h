/* A monitor that uses all parts of the engine; rules.py says what its rules mean. */
#ifndef FUZZED_MONITOR_H
#define FUZZED_MONITOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef PADDING
#define PADDING 0
#endif

#define GUARDS 11
#define INPUTS 3
#define RULES 10
#define PROPOSITIONS (36 + PADDING)
#define VALUES 11
#define MOST_SAMPLES 4

enum fuzzed_change { fuzzed_CLEARED, fuzzed_ACTIVATED, fuzzed_ACTIVATED_STALE, fuzzed_TIME_JUMP };

enum fuzzed_truth_value { fuzzed_FALSE, fuzzed_TRUE, fuzzed_UNKNOWN, fuzzed_STALE };

typedef struct fuzzed_event {
    int64_t at_ns;
    int64_t from_ns;
    int64_t since_ns[2];
    double values[2];
    int32_t rule;
    int32_t change;
    unsigned char truth_values[2];
    unsigned char inputs[1];
} fuzzed_event;

typedef void (*fuzzed_callback)(void *user, const fuzzed_event *event);

typedef struct fuzzed_monitor {
    int64_t now_ns;
    int64_t wake_ns;
    double value[VALUES];
    double low[GUARDS];
    double high[GUARDS];
#if PADDING
    uint64_t dirty[(PROPOSITIONS + RULES + 63) / 64];
    bool pending;
#else
    uint64_t dirty;
#endif
    bool quiet[2];
    bool started;
    int64_t stamp_ns[INPUTS];
    unsigned char state[INPUTS];
    unsigned char active[(RULES + 7) / 8];
    unsigned char truth_value[PROPOSITIONS];
    int64_t since_ns[PROPOSITIONS];
    int place[GUARDS];
    int64_t held_due_ns[5];
    unsigned char held_before[5];
    unsigned char since_before[2];
    double latest[3];
    double before[3];
    int64_t latest_ns[3];
    int64_t before_ns[3];
    double window_value[2][MOST_SAMPLES];
    int64_t window_ns[2][MOST_SAMPLES];
    uint16_t window_first[2];
    uint16_t window_count[2];
    double extreme[2];
    signed char heading[2];
    unsigned char swinging[2];
    unsigned char edge_before[2];
    int64_t recent_ns[8];
    uint16_t recent_count[4];
    uint16_t recent_next[4];
    unsigned char gap[4];
    int64_t gap_end_ns[4];
    fuzzed_callback on_event;
    void *user;
} fuzzed_monitor;

#endif
