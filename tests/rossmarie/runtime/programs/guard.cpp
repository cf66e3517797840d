// A whole node without ROS: the guard, with the generated rules of alarm.ross.
#include "guard.h"

#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "check.h"
#include "hooks.h"

using geometry_msgs::Twist;

static const int64_t MILLISECOND_NS = 1'000'000;

static int flashes = 0;
void hooks::flash(Moment moment) { flashes += moment == Moment::START ? 1 : -1; }

static void level(double value)
{
    std_msgs::Float64 message;
    message.data = value;
    deliver("level", message);
}

static void mode(const std::string &text)
{
    std_msgs::String message;
    message.data = text;
    deliver("mode", message);
}

static void place(int64_t stamp_ns, double x)
{
    geometry_msgs::Vector3Stamped message;
    message.header.stamp.ns = stamp_ns;
    message.vector.x = x;
    deliver("place", message);
}

// What becomes of a command; NaN if nothing.
static Twist passed(double x, double z = 0.5)
{
    published<Twist>("cmd_vel");
    Twist command;
    command.linear.x = x;
    command.angular.z = z;
    deliver("unfil_cmd_vel", command);
    const std::vector<Twist> found = published<Twist>("cmd_vel");
    CHECK(found.size() == 1);
    return found.empty() ? Twist{{NAN, NAN, NAN}, {NAN, NAN, NAN}} : found.back();
}

static bool is_zero(const Twist &command)
{
    return command.linear.x == 0.0 && command.angular.z == 0.0;
}

static void wait(Guard &guard, int64_t milliseconds)
{
    network.now_ns += milliseconds * MILLISECOND_NS;
    guard.step();
}

static std::string why() { return ask<Why>("~why", {}).text; }

static bool is_diagnosed(const std::string &name, int level)
{
    const auto arrays = published<DiagnosticArray>("/diagnostics");
    if (!arrays.empty())
        for (const DiagnosticStatus &status : arrays.back().status)
            if (status.name == "robot/guard: " + name && status.level == level)
                return true;
    return false;
}

static Settings quick()
{
    Settings settings{};
    settings.command_timeout_ns = 500 * MILLISECOND_NS;
    settings.filter_period_ns = 50 * MILLISECOND_NS;
    settings.patience_ns = 1000 * MILLISECOND_NS;
    settings.clock_timeout_ns = int64_t{3600'000} * MILLISECOND_NS;
    settings.header_stamps = {"/robot/place"};
    return settings;
}

static std::string refusal(const std::string &topic)
{
    Settings settings = quick();
    settings.header_stamps = {topic};
    try {
        Guard::check(Middleware(), settings);
    } catch (const BadParameter &problem) {
        return problem.what();
    }
    return "";
}

// Nothing passes until the inputs are there.
static void check_opening(Guard &guard)
{
    guard.step();
    CHECK(is_zero(passed(1.0)));
    CHECK(why() == "no command passes: no message has arrived on /robot/level\n");
    CHECK(ask<Reset>("~reset", {""}).message == "the node is still waiting for its inputs");
    level(0.0);
    CHECK(passed(1.0).linear.x == 1.0);
    CHECK(why() == "no rule is active\n");
}

static void check_limit(Guard &guard)
{
    published<Verdict>("~verdicts");
    published<Twist>("cmd_vel");
    level(2.0);
    const auto verdicts = published<Verdict>("~verdicts");
    CHECK(verdicts.size() == 1);
    CHECK(verdicts.at(0).rule == "fast" && verdicts.at(0).change == Verdict::ACTIVATED);
    CHECK((verdicts.at(0).categories == std::vector<std::string>{"operation", "task independent"}));
    CHECK(verdicts.at(0).cause == "level = 2; level > 1");
    CHECK(verdicts.at(0).values.at(0).value == 2.0);
    CHECK(verdicts.at(0).actions == std::vector<std::string>({"slow: limit /cmd_vel"}));
    const auto sent = published<Twist>("cmd_vel"); // the last command is held back as well
    CHECK(sent.size() == 1 && sent.back().linear.x == 0.2);
    CHECK(passed(1.0).linear.x == 0.2 && passed(-1.0).linear.x == -0.2);
    CHECK(passed(1.0).angular.z == 0.5);
    CHECK(published<State>("~state").back().active == std::vector<std::string>({"fast"}));
    level(0.0);
    CHECK(published<Verdict>("~verdicts").at(0).cause == "level = 0; no longer: level > 1");
    CHECK(passed(1.0).linear.x == 1.0);
    guard.step();
}

static void check_what_is_not_finite()
{
    CHECK(is_zero(passed(NAN)));
    CHECK(is_zero(passed(1.0, INFINITY)));
    CHECK(say::lines.back() ==
          "error: a command on /robot/cmd_vel is not finite; the filter sends 0 instead");
}

static void check_latched_rule(Guard &guard)
{
    level(6.0);
    CHECK(flashes == 1);
    CHECK(is_zero(passed(1.0)));
    CHECK(is_diagnosed("rule wild", DiagnosticStatus::ERROR));
    CHECK(!ask<Reset>("~reset", {"fast"}).success);
    CHECK(ask<Reset>("~reset", {"wild"})
              .message.find("the condition still holds: rule wild, active for") == 0);
    level(0.0);
    CHECK(is_zero(passed(1.0)));
    CHECK(ask<Reset>("~reset", {"wild"}).success);
    CHECK(flashes == 0);
    CHECK(passed(1.0).linear.x == 1.0);
    CHECK(guard.is_kept());
}

static void check_exemption(Guard &guard)
{
    level(2.0);
    CHECK(ask<Exempt>("~exempt", {"slow", {1}, "test"}).message == "there is no rule slow");
    const Exempt::Response refused = ask<Exempt>("~exempt", {"torn", {1}, "test"});
    CHECK(!refused.success);
    CHECK(refused.message == "rule torn has `always`: it cannot be exempted");
    CHECK(ask<Exempt>("~exempt", {"fast", {1}, ""}).message == "a reason is required");
    CHECK(ask<Exempt>("~exempt", {"fast", {100 * MILLISECOND_NS}, "test"}).success);
    wait(guard, 50);
    CHECK(passed(1.0).linear.x == 1.0);
    wait(guard, 60);
    CHECK(passed(1.0).linear.x == 0.2);
    level(0.0);
}

static void check_command_of_a_rule(Guard &guard)
{
    published<Twist>("cmd_vel");
    mode("back");
    CHECK(published<Twist>("cmd_vel").back().linear.x == -0.1);
    Twist command;
    command.linear.x = 1.0;
    deliver("unfil_cmd_vel", command);
    CHECK(published<Twist>("cmd_vel").empty()); // the rule commands
    wait(guard, 110);
    CHECK(published<Twist>("cmd_vel").back().linear.x == -0.1);
    mode("onwards");
    CHECK(passed(1.0).linear.x == 1.0);
}

static void check_stamps()
{
    place(network.now_ns, 4.0);
    CHECK(passed(1.0).linear.x == 0.2);
    place(network.now_ns, 0.0);
    CHECK(say::lines.back().find("its stamp is not later than the previous stamp") !=
          std::string::npos);
    CHECK(passed(1.0).linear.x == 0.2);
    network.now_ns += 1;
    place(network.now_ns, 0.0);
    CHECK(passed(1.0).linear.x == 1.0);
}

static void check_bypass(Guard &guard)
{
    network.findings.bypassed["/robot/cmd_vel"] = "/planner";
    published<Bool>("~bypassed");
    std::vector<Bool> reported;
    while (reported.empty()) { // it looks each second of the wall clock
        guard.step();
        reported = published<Bool>("~bypassed");
    }
    CHECK(reported.back().data);
    level(0.0);
    CHECK(is_zero(passed(1.0)));
    CHECK(why().find("/planner also publishes this topic") != std::string::npos);
    network.findings.bypassed.clear();
    while (published<Bool>("~bypassed").empty())
        guard.step();
    CHECK(passed(1.0).linear.x == 1.0);
}

static void check_silence(Guard &guard)
{
    level(0.0);
    published<Verdict>("~verdicts");
    wait(guard, 600);
    const auto verdicts = published<Verdict>("~verdicts");
    CHECK(verdicts.size() == 2);
    CHECK(verdicts.at(0).change == Verdict::ACTIVATED_WITHOUT_INPUT);
    CHECK(verdicts.at(0).cause == "input level (/level) is older than its timeout");
    CHECK(is_zero(passed(1.0)));
}

static void check_end(Guard &guard)
{
    published<Twist>("cmd_vel");
    guard.stop_all();
    CHECK(is_zero(published<Twist>("cmd_vel").back()));
    deliver("unfil_cmd_vel", Twist());
    CHECK(published<Twist>("cmd_vel").empty());
}

int main()
{
    network.now_ns = 1000 * 1000 * MILLISECOND_NS;
    CHECK(refusal("/robot/level").find("have no header") != std::string::npos);
    CHECK(refusal("/lever").find("no rule reads /lever") != std::string::npos);
    CHECK(Guard::topics() == std::vector<std::string>({"level", "mode", "place", "unfil_cmd_vel"}));
    Middleware middleware;
    Guard guard(middleware, quick());
    check_opening(guard);
    check_limit(guard);
    check_what_is_not_finite();
    check_latched_rule(guard);
    check_exemption(guard);
    check_command_of_a_rule(guard);
    check_stamps();
    check_bypass(guard);
    check_silence(guard);
    check_end(guard);
    return result();
}
