/* Calls come in and answers go out as plain memory: fuzz/engine/program.py has the same layouts. */
#ifndef CALLS_H
#define CALLS_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* A case that takes longer goes on for ever. */
enum { MOST_SECONDS = 60 };

/* One call: its kind, what it is about, an instant, and numbers. */
typedef struct call {
    int32_t kind;
    int32_t about;
    int64_t t_ns;
    double x[4];
} call;

static void answer(const void *memory, size_t size)
{
    if (fwrite(memory, size, 1, stdout) != 1)
        exit(2);
}

/* A case is a number of calls, then these; its answers are reported at once. */
static void answer_all(void (*begin)(void), void (*make)(const call *))
{
    uint32_t count;
    call next;
    while (fread(&count, sizeof count, 1, stdin) == 1) {
        alarm(MOST_SECONDS);
        begin();
        for (; count != 0; count--) {
            if (fread(&next, sizeof next, 1, stdin) != 1)
                exit(2);
            make(&next);
        }
        fflush(stdout);
        alarm(0);
    }
}

#endif
