// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The services of the node for operators.
#include "guard.h"
#include "reports.h"

static int rule_called(const std::string &name)
{
    for (int rule = 0; rule < count(RULES); rule++)
        if (name == RULES[rule].name)
            return rule;
    return -1;
}

void Guard::serve()
{
    middleware_.serve<Reset>(
        "~reset", [this](const auto &request, auto &response) { reset(request, response); });
    middleware_.serve<Why>("~why", [this](const auto &, auto &response) { why(response); });
    middleware_.serve<Exempt>(
        "~exempt", [this](const auto &request, auto &response) { exempt(request, response); });
}

void Guard::reset(const Reset::Request &request, Reset::Response &response)
{
    const int wanted = rule_called(request.rule);
    if (!request.rule.empty() && (wanted < 0 || !RULES[wanted].is_latched)) {
        response.message = "there is no latched rule " + request.rule;
        return;
    }
    if (!has_begun_) {
        response.message = "the node is still waiting for its inputs";
        return;
    }
    const int64_t at_ns = clock_.now();
    core::advance(&monitor_, at_ns);
    core::reset(&monitor_, at_ns, wanted);
    for (int rule = 0; rule < count(RULES); rule++)
        if ((wanted < 0 || rule == wanted) && RULES[rule].is_latched &&
            core::is_active(&monitor_, rule))
            response.message += "the condition still holds: " + why_active(rule);
    response.success = response.message.empty();
    say::information("reset: " + (response.success ? "done" : response.message));
    follow(at_ns);
}

std::string Guard::why_active(int rule) const
{
    const std::string name = std::string("rule ") + RULES[rule].name;
    const std::string clears = std::string("; ") + RULES[rule].contract + "\n";
    const auto found = causes_.find(rule);
    if (found == causes_.end())
        return name + ", latched before the node started" + clears;
    const double age = static_cast<double>(clock_.latest() - found->second.at_ns) / 1e9;
    const std::string cause = reports::cause(found->second);
    return name + ", active for " + std::to_string(age) + " s; cause: " + cause + clears;
}

void Guard::why(Why::Response &response) const
{
    for (int rule = 0; rule < count(RULES); rule++)
        if (core::is_active(&monitor_, rule))
            response.text += why_active(rule);
    if (clock_.stands_still())
        response.text += "no command passes: ROS time stands still\n";
    for (const auto &[topic, by] : found_.bypassed)
        response.text +=
            "no command passes on " + topic + ": " + by + " also publishes this topic\n";
    if (!is_open_)
        for (int channel = 0; channel < count(CHANNELS); channel++)
            if (CHANNELS[channel].timeout_ns != 0 && !arrived_ns_[channel])
                response.text += "no command passes: no message has arrived on " +
                                 inputs_[channel]->topic() + "\n";
    if (response.text.empty())
        response.text = "no rule is active\n";
}

void Guard::exempt(const Exempt::Request &request, Exempt::Response &response)
{
    const int rule = rule_called(request.rule);
    if (rule < 0)
        response.message = "there is no rule " + request.rule;
    else if (RULES[rule].is_always)
        response.message = "rule " + request.rule + " has `always`: it cannot be exempted";
    else if (Middleware::nanoseconds(request.time) < 0)
        response.message = "the time is negative";
    else if (request.reason.empty())
        response.message = "a reason is required";
    response.success = response.message.empty();
    if (!response.success)
        return;
    const int64_t time_ns = Middleware::nanoseconds(request.time);
    exempted_[rule] = true;
    exemptions_[rule] = {clock_.now() + time_ns, Wall::now() + std::chrono::nanoseconds(time_ns),
                         request.reason};
    has_changed_ = true;
    say::warning("rule " + request.rule + " is exempted for " +
                 std::to_string(Middleware::seconds(request.time)) + " s: " + request.reason);
}
