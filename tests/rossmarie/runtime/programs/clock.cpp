// Instants stay in order, and ROS time that jumps or stands still is noticed.
#include "clock.h"

#include <chrono>
#include <cstdint>
#include <thread>

#include "check.h"
#include "throttle.h"

static const int64_t SECOND_NS = 1'000'000'000;

static void check_order()
{
    const Middleware middleware;
    Clock clock(middleware, 0);
    network.now_ns = 10 * SECOND_NS;
    CHECK(clock.now() == 10 * SECOND_NS);
    CHECK(clock.in_order(9 * SECOND_NS) == 10 * SECOND_NS);  // not before one given earlier
    CHECK(clock.in_order(11 * SECOND_NS) == 10 * SECOND_NS); // not in the future
    CHECK(clock.jumps() == 0);
}

static void check_jumps()
{
    const Middleware middleware;
    Clock clock(middleware, 0);
    network.now_ns = 100 * SECOND_NS;
    clock.now();
    network.now_ns = 5 * SECOND_NS;
    CHECK(clock.now() == 5 * SECOND_NS);
    CHECK(clock.jumps() == 1);
    CHECK(clock.take_leap() == 0);
    network.now_ns = 50 * SECOND_NS;
    clock.now();
    const int64_t leap_ns = clock.take_leap();
    CHECK(44 * SECOND_NS < leap_ns && leap_ns <= 45 * SECOND_NS);
    CHECK(clock.take_leap() == 0);
}

static void check_standstill()
{
    const Middleware middleware;
    const std::chrono::milliseconds patience{20};
    Clock clock(middleware, std::chrono::nanoseconds(patience).count());
    network.now_ns = 10 * SECOND_NS;
    clock.now();
    CHECK(!clock.stands_still());
    std::this_thread::sleep_for(2 * patience);
    CHECK(clock.now() >= 10 * SECOND_NS + std::chrono::nanoseconds(patience).count());
    CHECK(clock.stands_still());
    network.now_ns += 1;
    CHECK(clock.now() == 10 * SECOND_NS + 1);
    CHECK(!clock.stands_still());
    CHECK(clock.jumps() == 1);
}

static void check_throttle()
{
    Throttle throttle;
    CHECK(throttle.is_due());
    CHECK(!throttle.is_due());
}

int main()
{
    check_order();
    check_jumps();
    check_standstill();
    check_throttle();
    return result();
}
