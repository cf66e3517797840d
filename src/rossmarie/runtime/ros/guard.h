// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The guard has one thread and one queue of callbacks, so that a command cannot overtake the
// verdict that blocks it. The guard processes each message completely before the next message: the
// monitor decides which rules are active, the reactor decides the task commands and the bounds, and
// the filters apply the bounds. Monitor and reactor are the generated C of the rules (core:: in
// rules.h). The guard performs the task commands.
//
// guard.cpp contains the loop, operators.cpp the services for operators, and reporting.cpp the
// publication of verdicts, states and diagnostics.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "any_filter.h"
#include "clock.h"
#include "descriptions.h"
#include "host.h"
#include "input.h"
#include "interfaces.h"
#include "latched_rules.h"
#include "middleware.h"
#include "parts.h"
#include "rules.h"
#include "settings.h"
#include "task.h"

class Guard : public Host {
public:
    // Throws BadParameter, like `check`.
    Guard(Middleware &middleware, const Settings &settings);

    // Throws BadParameter if these settings are invalid. Does not check files.
    static void check(const Middleware &middleware, const Settings &settings);

    // Returns the topics that the guard subscribes to, relative to its namespace.
    static std::vector<std::string> topics();

    // Processes the passage of time. Call this function after the time that `wait` returns.
    void step();

    // Returns the time (s) until the next necessary `step` if no message arrives.
    double wait();

    // Returns true if the latched rules are saved for a restart.
    bool is_kept() const { return latched_.is_kept(); }

    // Sends 0 as the last command on each command topic.
    void stop_all();

    // The services for tasks.
    Middleware &middleware() override { return middleware_; }
    void report(int task, bool success) override;
    void diagnose(int task, int level, const char *text) override;
    void end_diagnosis(int task) override;
    void reset_all() override { is_reset_wanted_ = true; }

private:
    using Wall = std::chrono::steady_clock;

    struct Exemption { // ends when either clock reaches the end
        int64_t until_ns = 0;
        Wall::time_point until{};
        std::string reason;
    };

    int64_t clock_timeout() const;
    int64_t next_wake() const;
    void catch_up(int64_t at_ns);
    void pass_time(int64_t at_ns);
    void subscribe();
    void serve();
    void take(int64_t at_ns);
    void step_monitor(int64_t at_ns);
    bool begin_when_ready(int64_t at_ns);
    bool is_missing(int channel, int64_t at_ns) const;
    void follow(int64_t at_ns);
    void open_when_ready(int64_t at_ns);
    void end_exemptions(int64_t at_ns);
    void on_event(const core::Event &event);
    void perform(int task, core::TaskCommand command, int by_rule);

    void reset(const Reset::Request &request, Reset::Response &response);
    void why(Why::Response &response) const;
    void exempt(const Exempt::Request &request, Exempt::Response &response);

    void publish_changes(int64_t at_ns);
    void publish_state(int64_t at_ns);
    void publish_diagnostics();
    void check_others();
    void take_findings(const Findings &found);
    std::vector<DiagnosticStatus> statuses() const;
    void add_input_statuses(std::vector<DiagnosticStatus> &found) const;
    void add_rule_statuses(std::vector<DiagnosticStatus> &found) const;
    void add_node_status(std::vector<DiagnosticStatus> &found) const;
    std::string why_active(int rule) const;

    Middleware &middleware_;
    const Settings settings_;
    Clock clock_{middleware_, clock_timeout()};
    core::Monitor monitor_;
    core::Values given_{};  // the parameters of the rules
    core::Values values_{}; // given_, and the fields of the messages for the next step
    Arrays arrays_;
    core::Reactor reactor_;
    LatchedRules latched_{settings_.state_file, middleware_.name()};
    Performers performers_; // after the members that they use
    Inputs inputs_;
    Publisher<Verdict> verdicts_ = middleware_.advertise<Verdict>("~verdicts", 100);
    Publisher<State> state_ = middleware_.advertise_latched<State>("~state");
    Publisher<Bool> bypassed_ = middleware_.advertise_latched<Bool>("~bypassed");
    Publisher<DiagnosticArray> diagnostics_ =
        middleware_.advertise<DiagnosticArray>("/diagnostics", 10);

    std::map<int, core::Event> causes_; // by active rule: the event of its activation
    std::vector<Verdict> new_verdicts_;
    std::vector<std::string> overruled_;
    std::vector<char> in_force_ = std::vector<char>(TASKS.size(), false);
    std::vector<int> task_states_ = std::vector<int>(TASKS.size(), 0);
    std::map<int, DiagnosticStatus> diagnoses_;
    Findings found_;                     // of the last check of other nodes
    std::map<int, std::string> missing_; // by task: its unmet requirement at the last check
    std::vector<unsigned char> exempted_ = std::vector<unsigned char>(RULES.size(), false);
    std::vector<Exemption> exemptions_ = std::vector<Exemption>(RULES.size()); // by rule
    int64_t started_ns_ = 0;
    std::vector<std::optional<int64_t>> arrived_ns_ = // by channel: the instant of the last message
        std::vector<std::optional<int64_t>>(CHANNELS.size());
    bool has_begun_ = false;
    bool has_stepped_ = false; // true: the monitor has the parameters of the rules
    bool is_open_ = false;
    bool is_in_grace_ = false;
    bool is_reset_wanted_ = false;
    bool is_checking_ = false;
    bool has_changed_ = true;
    double longest_pause_ = 0.0; // since the last diagnostics
    Wall::time_point looked_ = Wall::now();
    Wall::time_point diagnosed_{};
    Wall::time_point checked_ = Wall::now();
};
