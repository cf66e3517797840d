// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// The guard: one thread and one queue of callbacks, so that a verdict and the command that it holds
// back cannot overtake each other. Each message goes through the monitor (which rules are active?),
// the reactor (what follows?) and the filters (what may pass?) before the next is looked at.
// These two are the C of the rules (core:: in rules.h). They decide, the guard performs.
//
// guard.cpp contains its work, operators.cpp the operators' services, telling.cpp the reports.
#pragma once

#include <chrono>
#include <map>
#include <memory>
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
    // Throws BadParameter, as `check` does.
    Guard(Middleware &middleware, const Settings &settings);

    // True if these settings are valid, without a check of files.
    static void check(const Middleware &middleware, const Settings &settings);

    // The topics that the guard subscribes to, with their names in its namespace.
    static std::vector<std::string> topics();

    // Call it when time has passed.
    void step();

    // The seconds until `step` has something to do, if no message arrives.
    double wait();

    // True if latched rules are kept over a restart.
    bool is_kept() const { return latched_.is_kept(); }

    // The last command of the guard on each command topic: 0.
    void stop_all();

    // The services for tasks.
    Middleware &middleware() override { return middleware_; }
    void report(int task, bool success) override;
    void diagnose(int task, int level, const char *text) override;
    void end_diagnosis(int task) override;
    void reset_all() override { is_reset_wanted_ = true; }

private:
    using Wall = std::chrono::steady_clock;

    struct Exemption { // ends by whichever clock comes first
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
    bool begin_when_ready(int64_t at_ns);
    void follow(int64_t at_ns);
    void open_when_ready(int64_t at_ns);
    void end_exemptions(int64_t at_ns);
    void on_event(const core::Event &event);
    void perform(int task, core::TaskCommand command, int by_rule);

    void reset(const Reset::Request &request, Reset::Response &response);
    void why(Why::Response &response) const;
    void exempt(const Exempt::Request &request, Exempt::Response &response);

    void tell(int64_t at_ns);
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
    core::Values values_{}; // of the messages that the monitor takes next, and these
    Arrays arrays_;
    core::Reactor reactor_;
    LatchedRules latched_{settings_.state_file, middleware_.name()};
    Performers performers_; // they use what stands above
    Inputs inputs_;
    Publisher<Verdict> verdicts_ = middleware_.advertise<Verdict>("~verdicts", 100);
    Publisher<State> state_ = middleware_.advertise_latched<State>("~state");
    Publisher<Bool> bypassed_ = middleware_.advertise_latched<Bool>("~bypassed");
    Publisher<DiagnosticArray> diagnostics_ =
        middleware_.advertise<DiagnosticArray>("/diagnostics", 10);

    std::map<int, core::Event> causes_; // of the active rules, as they became so
    std::vector<Verdict> new_verdicts_;
    std::vector<std::string> overruled_;
    std::vector<char> in_force_ = std::vector<char>(TASKS.size(), false);
    std::vector<int> task_states_ = std::vector<int>(TASKS.size(), 0);
    std::map<int, DiagnosticStatus> diagnoses_;
    Findings found_;                     // of others, as checked at last
    std::map<int, std::string> lacking_; // what tasks will need and others lack, likewise
    std::vector<unsigned char> exempted_ = std::vector<unsigned char>(RULES.size(), false);
    std::vector<Exemption> exemptions_ = std::vector<Exemption>(RULES.size()); // of those
    int64_t started_ns_ = 0;
    std::vector<int64_t> arrived_ns_ = std::vector<int64_t>(CHANNELS.size(), 0);
    bool has_begun_ = false;
    bool is_given_ = false; // the monitor has the parameters of the rules
    bool is_open_ = false;
    bool is_in_grace_ = false;
    bool is_reset_wanted_ = false;
    bool is_checking_ = false;
    bool has_changed_ = true;
    double longest_pause_ = 0.0; // since the diagnostics of a second ago
    Wall::time_point looked_ = Wall::now();
    Wall::time_point diagnosed_{};
    Wall::time_point checked_ = Wall::now();
};
