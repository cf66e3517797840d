// Checks of a test program: what fails is printed with its line, and makes the program fail.
#pragma once

#include <cstdio>
#include <cstdlib>

inline int failures = 0;

inline void check(bool is_so, const char *what, const char *file, int line)
{
    if (is_so)
        return;
    failures += 1;
    std::fprintf(stderr, "%s:%d: %s\n", file, line, what);
}

inline int result() { return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE; }

#define CHECK(condition) check((condition), #condition, __FILE__, __LINE__)
