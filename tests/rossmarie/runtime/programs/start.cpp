// The start of a node without ROS: which messages from before the start count.
#include "guard.h"

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "check.h"

static const int64_t MILLISECOND_NS = 1'000'000;
static const int64_t BEGIN_NS = 1'700'000'000'000'000'000; // a recording says when it was made

static void number(const std::string &topic, double value)
{
    std_msgs::Float64 message;
    message.data = value;
    deliver(topic, message);
}

static void mode(const std::string &text)
{
    std_msgs::String message;
    message.data = text;
    deliver("mode", message);
}

static void obstacle(double x)
{
    geometry_msgs::PointStamped message;
    message.header.frame_id = "scanner";
    message.point.x = x;
    deliver("obstacle", message);
}

static void transform()
{
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = "base_link";
    message.transforms[0].child_frame_id = "scanner";
    deliver("/tf_static", message);
}

static double passed()
{
    published<geometry_msgs::Twist>("cmd_vel");
    geometry_msgs::Twist command;
    command.linear.x = 1.0;
    deliver("unfil_cmd_vel", command);
    return published<geometry_msgs::Twist>("cmd_vel").back().linear.x;
}

static void wait(Guard &guard, int64_t milliseconds)
{
    network.now_ns += milliseconds * MILLISECOND_NS;
    guard.step();
}

// The causes of the verdicts about a rule.
static std::vector<std::string> causes(const std::string &rule)
{
    std::vector<std::string> found;
    for (const Verdict &verdict : published<Verdict>("~verdicts"))
        if (verdict.rule == rule)
            found.push_back(verdict.cause);
    return found;
}

static Settings patient(int64_t clock_timeout_ns)
{
    Settings settings{};
    settings.command_timeout_ns = 500 * MILLISECOND_NS;
    settings.filter_period_ns = 50 * MILLISECOND_NS;
    settings.patience_ns = 1000 * MILLISECOND_NS;
    settings.clock_timeout_ns = clock_timeout_ns;
    return settings;
}

// A guard that starts at an instant.
template <class Checks>
static void start(int64_t now_ns, Checks checks, int64_t clock_timeout_ns = INT64_MAX)
{
    network = Network();
    network.now_ns = now_ns;
    Middleware middleware;
    Guard guard(middleware, patient(clock_timeout_ns));
    guard.step();
    checks(guard);
}

// A message that never expires counts, even if it arrives only once: before simulated time begins,
// long before the other inputs, or while time stands still.
static void check_what_arrives_once()
{
    start(0, [](Guard &guard) {
        transform();
        network.now_ns = BEGIN_NS;
        guard.step();
        number("level", 0.0);
        number("height", 0.0);
        obstacle(2.0);
        CHECK(passed() == 1.0);
    });
    start(BEGIN_NS, [](Guard &guard) {
        transform();
        mode("back");
        wait(guard, 1100);
        CHECK(causes("near") == std::vector<std::string>({"mode = back; mode == \"back\""}));
        number("level", 0.0);
        number("height", 0.0);
        obstacle(2.0);
        CHECK(passed() == 0.2);
        mode("onwards");
        CHECK(passed() == 1.0);
    });
    const auto while_time_stands_still = [](Guard &guard) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        guard.step();
        transform();
        mode("back");
        number("level", 0.0);
        CHECK(say::lines.back().find("ROS time stands still") != std::string::npos);
        wait(guard, 10);
        number("height", 0.0);
        CHECK(passed() == 0.0);
        number("level", 0.0);
        obstacle(2.0);
        CHECK(passed() == 0.2);
        mode("onwards");
        CHECK(passed() == 1.0);
    };
    start(BEGIN_NS, while_time_stands_still, 10 * MILLISECOND_NS);
}

// Without the transform no command passes, and a close obstacle is seen with it.
static void check_a_transform_is_needed()
{
    start(BEGIN_NS, [](Guard &guard) {
        number("level", 0.0);
        number("height", 0.0);
        obstacle(2.0);
        wait(guard, 1100);
        number("level", 0.0);
        number("height", 0.0);
        CHECK(passed() == 0.0);
        transform();
        obstacle(0.5);
        CHECK(passed() == 0.2);
    });
}

// An expired message does not count, and a fresh one counts from the start on.
static void check_what_expires()
{
    start(BEGIN_NS, [](Guard &guard) {
        transform();
        number("level", 2.0);
        wait(guard, 900);
        number("height", 2.0);
        wait(guard, 200);
        const auto verdicts = published<Verdict>("~verdicts");
        CHECK(verdicts.size() == 2);
        CHECK(verdicts.at(0).rule == "fast");
        CHECK(verdicts.at(0).cause == "input level (/level) has never been received");
        CHECK(verdicts.at(1).rule == "high");
        CHECK(verdicts.at(1).cause == "height = 2; height > 1");
        wait(guard, 600); // the message on /height has expired
        number("level", 0.0);
        CHECK(passed() == 0.2);
        number("height", 0.0);
        CHECK(passed() == 1.0);
    });
    start(0, [](Guard &guard) { // nobody knows how long ago that was
        transform();
        number("level", 0.0);
        number("height", 0.0);
        network.now_ns = 1;
        guard.step();
        CHECK(passed() == 0.0);
    });
}

int main()
{
    check_what_arrives_once();
    check_a_transform_is_needed();
    check_what_expires();
    return result();
}
